#pragma once
/// \file
/// The sections of the speed benchmark. Each section passes its rows, one JSON object each, to a function.

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

/// Returns the CPU time of the process so far, seconds. On a shared machine it is more reproducible than
/// elapsed time.
double cpu_now();

/// Returns the median. \pre values is not empty
double median(std::vector<double> values);

/// Input arrays of the simplifiers. No two positions are equal.
struct FloatMesh {
    std::string name;
    std::vector<Vec3f> positions;
    std::vector<Triangle> triangles;
};

/// Converts a mesh. Positions are rounded to float.
FloatMesh float_mesh(const std::string& name, const TriangleMesh& mesh);

/// Options of measure_simplifiers().
struct SpeedOptions {
    double ratio = 0.1;                    ///< ratio of faces to keep
    int repetitions = 5;                   ///< timed runs of each simplifier; the median is reported
    bool quality = true;                   ///< also measure Chamfer and Hausdorff distances
    std::vector<std::string> simplifiers;  ///< `meshoptimizer`, `wasm-1.3`, `cgal-lt`, PRESET-THREADS
};

/// Times the simplifiers on the mesh and on the mesh with shuffled vertices. Repetitions of different
/// simplifiers are interleaved, so that other load of the machine affects all of them. Memory and distances
/// are measured in one additional run.
/// \throws OptionError  there is no such simplifier
void measure_simplifiers(const FloatMesh& mesh, const SpeedOptions& options, const WriteRow& write);

/// Times loading and saving of the mesh in each format, with and without UVs.
/// \param folder  directory for the temporary files
void measure_files(const FloatMesh& mesh, const std::filesystem::path& folder, int repetitions,
                   const WriteRow& write);

/// Times the phases of simplifying a textured GLB file to 10,000 faces with a new texture of 2048^2 texels,
/// with one and with four samples per texel.
/// \param folder  directory for the temporary files
void measure_pipeline(const FloatMesh& mesh, const std::filesystem::path& folder, const WriteRow& write);

}  // namespace faqem::bench
