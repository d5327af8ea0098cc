// Makes levels of detail of a textured model, saves them in one .glb with MSFT_lod and says from where on
// each will do; then makes one more level of the first mesh's history alone, without another run.

#include <cmath>
#include <exception>
#include <iostream>
#include <numbers>

#include "faqem/bake_levels.hpp"
#include "faqem/save_levels.hpp"
#include "faqem/truncate.hpp"

int main(int argc, char** argv) try {
    if (argc != 3) {
        std::cerr << "usage: lod_chain IN OUT.glb\n";
        return 2;
    }
    const faqem::Asset source = faqem::load(argv[1]);
    faqem::Options options;
    options.bake.texture_size = 512;
    const auto levels = faqem::simplify_parts_levels(
        source, {faqem::ratio(0.5), faqem::ratio(0.2), faqem::ratio(0.05)}, options);

    // Where the error of a level covers one pixel of 1080, seen under 60 degrees.
    const double height_at_one = 2 * std::tan(std::numbers::pi / 6);
    std::vector<faqem::SavedLevel> saved;
    for (const faqem::SimplifiedPartsLevel& level : levels) {
        const double distance = level.error * 1080 / height_at_one;
        std::cout << level.result.report.faces_out << " faces, at most " << level.error
                  << " away: from distance " << distance << " on\n";
        // A model one unit large; a real one says how large each part is.
        const std::vector<double> coverage(source.parts.size(), 1 / (height_at_one * distance));
        saved.push_back({faqem::bake(source, level.result, options).asset, coverage});
    }
    for (const std::string& lost : faqem::save_levels(std::move(saved), argv[2], faqem::Overwrite::yes))
        std::cerr << "warning: " << lost << "\n";

    std::vector<faqem::CollapseHistory> histories;
    histories.reserve(levels.size());
    for (const faqem::SimplifiedPartsLevel& level : levels)
        histories.push_back(level.result.parts[0].history);
    const std::uint64_t wanted = (histories[0].kept_faces.size() + histories[1].kept_faces.size()) / 2;
    const faqem::SimplifyResult cut =
        faqem::restore(faqem::truncate_to_faces(faqem::join(histories), wanted));
    std::cout << cut.mesh.triangles.size() << " faces cut from the history\n";
    return cut.mesh.triangles.size() <= wanted ? 0 : 1;
} catch (const std::exception& error) {
    std::cerr << "lod_chain: " << error.what() << "\n";
    return 1;
}
