#pragma once
/// \file
/// The parts of the speed benchmark. Each gives its rows, one JSON object each, to a function.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "faqem/mesh.hpp"

namespace faqem::bench {

using Json = nlohmann::ordered_json;
using WriteRow = std::function<void(const Json&)>;

/// CPU seconds of the process so far. On a shared machine they tell more than the clock.
double cpu_now();

/// \pre values is not empty
double median(std::vector<double> values);

/// A mesh with the arrays that all simplifiers get: no two positions are equal.
struct FloatMesh {
    std::string name;
    std::vector<Vec3f> positions;
    std::vector<Triangle> triangles;
};

/// Rounded to float.
FloatMesh float_mesh(const std::string& name, const TriangleMesh& mesh);

/// What is measured.
struct SpeedOptions {
    double ratio = 0.1;
    int repetitions = 5;
    bool quality = true;                   ///< Chamfer and Hausdorff distances too
    std::vector<std::string> simplifiers;  ///< `meshoptimizer`, `wasm-1.3`, `cgal-lt`, PRESET-THREADS
};

/// Times the simplifiers on the mesh and on the same with its vertices shuffled, their repetitions in turn,
/// so that what else the machine does falls on all of them; then memory and distances of one more run.
/// \throws OptionError  there is no such simplifier
void measure_simplifiers(const FloatMesh& mesh, const SpeedOptions& options, const WriteRow& write);

/// Times loading and saving of the mesh in each format, with and without UVs. \param folder  for the files
void measure_files(const FloatMesh& mesh, const std::filesystem::path& folder, int repetitions,
                   const WriteRow& write);

/// Times the phases of the whole way from a textured GLB file to one of 10,000 faces and a 2048^2 texture,
/// with one and with four samples per texel.
void measure_pipeline(const FloatMesh& mesh, const std::filesystem::path& folder, const WriteRow& write);

}  // namespace faqem::bench
