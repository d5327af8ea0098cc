// Simplifies a textured model to several levels of detail, saves them in one .glb with MSFT_lod, and prints
// the distance from which on each can be used. Then restores another level of the first mesh from its
// history, without another run.

#include <cmath>
#include <exception>
#include <iostream>
#include <numbers>

#include "faqem/bake_levels.hpp"
#include "faqem/truncate.hpp"

int main(int argc, char** argv) try {
    if (argc != 3) {
        std::cerr << "usage: lod_chain IN OUT.glb\n";
        return 2;
    }
    const faqem::Asset source = faqem::load(argv[1]);
    faqem::Options options;
    options.format = faqem::ModelFormat::glb;
    options.bake.texture_size = 512;
    const auto levels = faqem::simplify_parts_levels(
        source, {faqem::ratio(0.5), faqem::ratio(0.2), faqem::ratio(0.05)}, options);

    // A level is used from the distance where its error covers one pixel of 1080, with a field of view of 60
    // degrees.
    std::vector<faqem::SimplifiedAssetLevel> baked;
    for (const faqem::SimplifiedPartsLevel& level : levels) {
        std::cout << level.result.report.faces_out << " faces, error " << level.error
                  << ": for distances from " << level.error * 1080 / (2 * std::tan(std::numbers::pi / 6))
                  << " on\n";
        baked.push_back({faqem::bake(source, level.result, options), level.distance, level.error});
    }
    for (const std::string& loss : faqem::save_levels(std::move(baked), argv[2], faqem::Overwrite::yes))
        std::cerr << "warning: " << loss << "\n";

    std::vector<faqem::CollapseHistory> histories;
    histories.reserve(levels.size());
    for (const faqem::SimplifiedPartsLevel& level : levels)
        histories.push_back(level.result.parts[0].history);
    const std::uint64_t wanted =
        (histories[0].remaining_faces.size() + histories[1].remaining_faces.size()) / 2;
    const faqem::SimplifyResult restored =
        faqem::restore(faqem::truncate_to_faces(faqem::join(histories), wanted));
    std::cout << restored.mesh.triangles.size() << " faces restored from the history\n";
    return restored.mesh.triangles.size() <= wanted ? 0 : 1;
} catch (const std::exception& error) {
    std::cerr << "lod_chain: " << error.what() << "\n";
    return 1;
}
