/// \file
/// faqem-bench-speed: compares time and memory of faqem's presets and meshoptimizer.

#include <benchmark/benchmark.h>

#include <CLI/CLI.hpp>
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

struct Arguments {
    std::string models, out;
    std::size_t min_faces = 1'000'000;
    std::uint64_t seed = 1;
    std::vector<std::size_t> sizes = {1'000'000};
    SpeedOptions speed = {.simplifiers = {"meshoptimizer", "fast-1", "fast-2", "balanced-2"}};
};

void add_options(CLI::App& app, Arguments& a) {
    app.option_defaults()->always_capture_default();
    app.add_option("--models", a.models, "directory of .obj .ply .stl .off files")
        ->envname("FAQEM_BENCH_MODELS");
    app.add_option("--min-faces", a.min_faces, "skip smaller models");
    app.add_option("--sizes", a.sizes, "face counts of generated surfaces")->delimiter(',');
    app.add_option(
           "--simplifiers", a.speed.simplifiers,
           "meshoptimizer, cgal-lt, PRESET-THREADS, and versions of meshoptimizer from npm: wasm-0.18, "
           "wasm-1.3 and wasm-1.3-update")
        ->delimiter(',');
    app.add_option("--ratio", a.speed.ratio, "ratio of faces to keep")->check(CLI::PositiveNumber);
    app.add_option("--repetitions", a.speed.repetitions, "timed runs of each simplifier, for the median")
        ->check(CLI::PositiveNumber);
    app.add_flag("!--no-quality", a.speed.quality, "do not measure distances");
    app.add_option("--seed", a.seed, "seed of the generated surfaces");
    app.add_option("--out", a.out,
                   "append rows to this file, one JSON object per line, instead of standard output");
}

void run(const Arguments& a) {
    std::ofstream file;
    if (!a.out.empty()) file.open(a.out, std::ios::app);
    const WriteRow write = [&](const Json& row) {
        (a.out.empty() ? std::cout : file) << row.dump() << std::endl;
    };
    for (const std::size_t size : a.sizes) {
        const FloatMesh mesh = float_mesh("isosurface", isosurface_of(size, a.seed));
        std::cerr << mesh.name << ", " << mesh.triangles.size() << " faces\n";
        measure_simplifiers(mesh, a.speed, write);
    }
    if (a.models.empty()) return;
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
    Arguments a;
    CLI::App app("Compares time and memory of faqem's presets and meshoptimizer.", "faqem-bench-speed");
    add_options(app, a);
    CLI11_PARSE(app, argc, argv);
    // Interleaves the repetitions of the simplifiers, so that they are measured under the same load.
    char name[] = "faqem-bench-speed", interleaving[] = "--benchmark_enable_random_interleaving=true";
    char* flags[] = {name, interleaving, nullptr};
    int count = 2;
    benchmark::Initialize(&count, flags);
    run(a);
    return 0;
} catch (const std::exception& error) {
    std::cerr << "faqem-bench-speed: " << error.what() << "\n";
    return 2;
}
