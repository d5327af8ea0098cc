// Every model of a folder: a light one of each goes into another folder. One that cannot be read does not
// stop the others. (`faqem batch` does this with several models at a time, a memory budget and a way to
// resume.)

#include <algorithm>
#include <exception>
#include <filesystem>
#include <iostream>
#include <vector>

#include "faqem/bake.hpp"
#include "faqem/error.hpp"

namespace fs = std::filesystem;

// \return false where the model was left out
bool simplify_file(const fs::path& in, const fs::path& out, const faqem::Options& options) try {
    const faqem::SimplifiedAsset light = faqem::simplify(faqem::load(in), options);
    faqem::save(light.asset, out, faqem::Overwrite::yes);
    std::cout << in.filename().string() << ": " << light.report.faces_in << " faces, now "
              << light.report.faces_out << " (" << name(light.report.stop) << ")\n";
    return true;
} catch (const faqem::Error& error) {
    std::cout << in.filename().string() << ": left out: " << error.what() << "\n";
    return false;
}

int main(int argc, char** argv) try {
    if (argc != 3) {
        std::cerr << "usage: batch_folder IN-FOLDER OUT-FOLDER\n";
        return 2;
    }
    const std::vector<std::string> endings = {".glb", ".gltf", ".obj", ".off", ".ply", ".stl"};
    std::vector<fs::path> models;
    for (const fs::directory_entry& entry : fs::directory_iterator(argv[1])) {
        const bool is_model =
            std::count(endings.begin(), endings.end(), entry.path().extension().string()) > 0;
        if (entry.is_regular_file() && is_model) models.push_back(entry.path());
    }
    std::sort(models.begin(), models.end());
    fs::create_directories(argv[2]);

    faqem::Options options{.target = faqem::ratio(0.1), .preset = faqem::Preset::fast};
    options.bake.texture_size = 256;
    std::size_t done = 0;
    for (const fs::path& model : models)
        done += simplify_file(model, argv[2] / fs::path(model.filename()).replace_extension(".glb"), options);
    std::cout << done << " of " << models.size() << " models\n";
    return done > 0 ? 0 : 1;
} catch (const std::exception& error) {
    std::cerr << "batch_folder: " << error.what() << "\n";
    return 1;
}
