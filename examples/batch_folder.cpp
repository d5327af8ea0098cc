// Simplifies all models of a directory into another directory. A model that cannot be read does not stop the
// others. (The command `faqem batch` does the same with several models at a time, a memory limit and
// resuming.)

#include <algorithm>
#include <exception>
#include <filesystem>
#include <iostream>
#include <vector>

#include "faqem/bake.hpp"
#include "faqem/error.hpp"

namespace fs = std::filesystem;

// \return false if the model could not be simplified; the reason is printed
bool simplify_file(const fs::path& in, const fs::path& out, const faqem::Options& options) try {
    const faqem::Report report = faqem::simplify(in, out, options, faqem::Overwrite::yes);
    std::cout << in.filename().string() << ": " << report.faces_in << " faces, now " << report.faces_out
              << " (" << name(report.stop) << ")\n";
    return report.bytes_out > 0;
} catch (const faqem::Error& error) {
    std::cout << in.filename().string() << ": skipped: " << error.what() << "\n";
    return false;
}

int main(int argc, char** argv) try {
    if (argc != 3) {
        std::cerr << "usage: batch_folder IN-DIRECTORY OUT-DIRECTORY\n";
        return 2;
    }
    const std::vector<std::string> extensions = {".glb", ".gltf", ".obj", ".off", ".ply", ".stl"};
    std::vector<fs::path> models;
    for (const fs::directory_entry& entry : fs::directory_iterator(argv[1])) {
        const bool is_model =
            std::count(extensions.begin(), extensions.end(), entry.path().extension().string()) > 0;
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
