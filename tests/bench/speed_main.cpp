/// \file
/// faqem-bench-speed: compares time and memory of faqem's presets and meshoptimizer.

#include <benchmark/benchmark.h>

#include <charconv>
#include <cstdlib>
#include <fstream>
#include <iostream>

#include "faqem/error.hpp"
#include "input.hpp"
#include "isosurface.hpp"
#include "speed.hpp"

namespace {

using namespace faqem;
using namespace faqem::bench;
namespace fs = std::filesystem;

constexpr const char* usage = R"(Usage: faqem-bench-speed [OPTION]...
  --models DIR        directory of .obj .ply .stl .off files; default: environment variable FAQEM_BENCH_MODELS, or none
  --min-faces N       skip smaller models; default: 1000000
  --sizes N,...       face counts of generated surfaces; default: 1000000
  --sections S,...    default: simplify,files,pipeline; the last two use the first generated surface
  --simplifiers S,... meshoptimizer, cgal-lt, PRESET-THREADS, and versions of meshoptimizer from npm: wasm-0.18,
                      wasm-1.3 and wasm-1.3-update; default: meshoptimizer,fast-1,fast-2,balanced-2
  --ratio R           ratio of faces to keep; default: 0.1
  --repetitions N     timed runs of each simplifier, of which the median is reported; default: 5
  --no-quality        do not measure distances
  --seed N            seed of the generated surfaces; default: 1
  --folder DIR        directory for temporary files; default: the system's temporary directory
  --out FILE          append rows to this file, one JSON object per line; default: standard output
)";

std::vector<std::string> words(const std::string& text) {
    std::vector<std::string> all;
    for (std::size_t first = 0; first <= text.size();) {
        const std::size_t end = std::min(text.find(',', first), text.size());
        if (end > first) all.push_back(text.substr(first, end - first));
        first = end + 1;
    }
    return all;
}

double number(const std::string& option, const std::string& text) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !(value > 0))
        throw OptionError(option + ": '" + text + "' is not a positive number");
    return value;
}

struct Arguments {
    std::string models, out;
    fs::path folder = fs::temp_directory_path();
    std::size_t min_faces = 1'000'000;
    std::uint64_t seed = 1;
    std::vector<double> sizes = {1e6};
    std::vector<std::string> sections = {"simplify", "files", "pipeline"};
    SpeedOptions speed = {.simplifiers = {"meshoptimizer", "fast-1", "fast-2", "balanced-2"}};

    bool has(const char* section) const {
        return std::find(sections.begin(), sections.end(), section) != sections.end();
    }
};

Arguments parse(int argc, char** argv) {
    Arguments a;
    if (const char* folder = std::getenv("FAQEM_BENCH_MODELS")) a.models = folder;
    for (int i = 1; i < argc; ++i) {
        const std::string option = argv[i];
        if (option == "--no-quality") {
            a.speed.quality = false;
            continue;
        }
        if (i + 1 == argc) throw OptionError(option + ": unknown option or missing value");
        const std::string value = argv[++i];
        if (option == "--models") {
            a.models = value;
        } else if (option == "--min-faces") {
            a.min_faces = static_cast<std::size_t>(number(option, value));
        } else if (option == "--sizes") {
            a.sizes.clear();
            for (const std::string& word : words(value)) a.sizes.push_back(number(option, word));
        } else if (option == "--sections") {
            a.sections = words(value);
        } else if (option == "--simplifiers") {
            a.speed.simplifiers = words(value);
        } else if (option == "--ratio") {
            a.speed.ratio = number(option, value);
        } else if (option == "--repetitions") {
            a.speed.repetitions = static_cast<int>(number(option, value));
        } else if (option == "--seed") {
            a.seed = static_cast<std::uint64_t>(number(option, value));
        } else if (option == "--folder") {
            a.folder = value;
        } else if (option == "--out") {
            a.out = value;
        } else {
            throw OptionError(option + ": unknown option");
        }
    }
    return a;
}

void run(const Arguments& a) {
    std::ofstream file;
    if (!a.out.empty()) file.open(a.out, std::ios::app);
    const WriteRow write = [&](const Json& row) {
        (a.out.empty() ? std::cout : file) << row.dump() << std::endl;
    };
    bool first = true;
    for (const double size : a.sizes) {
        const FloatMesh mesh =
            float_mesh("isosurface", isosurface_of(static_cast<std::size_t>(size), a.seed));
        std::cerr << mesh.name << ", " << mesh.triangles.size() << " faces\n";
        if (a.has("simplify")) measure_simplifiers(mesh, a.speed, write);
        if (first && a.has("files")) measure_files(mesh, a.folder, a.speed.repetitions, write);
        if (first && a.has("pipeline")) measure_pipeline(mesh, a.folder, write);
        first = false;
    }
    if (a.models.empty() || !a.has("simplify")) return;
    for (const fs::path& model : mesh_files(a.models)) {
        // In all formats a face takes at least 10 bytes: skips small files without loading them.
        if (fs::file_size(model) < 10 * a.min_faces) continue;
        const FloatMesh mesh = float_mesh(model.stem().string(), load_welded(model));
        if (mesh.triangles.size() < a.min_faces) continue;
        std::cerr << mesh.name << ", " << mesh.triangles.size() << " faces\n";
        measure_simplifiers(mesh, a.speed, write);
    }
}

}  // namespace

int main(int argc, char** argv) try {
    if (argc > 1 && std::string(argv[1]) == "--help") {
        std::cout << usage;
        return 0;
    }
    // Interleaves the repetitions of the simplifiers, so that they are measured under the same load.
    char name[] = "faqem-bench-speed", interleaving[] = "--benchmark_enable_random_interleaving=true";
    char* flags[] = {name, interleaving, nullptr};
    int count = 2;
    benchmark::Initialize(&count, flags);
    run(parse(argc, argv));
    return 0;
} catch (const std::exception& error) {
    std::cerr << "faqem-bench-speed: " << error.what() << "\n";
    return 2;
}
