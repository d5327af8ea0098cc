#pragma once
/// \file
/// Measurements of time and memory, which pass their rows, one JSON object each, to a function.

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "faqem/mesh.hpp"

namespace faqem::bench {

using Json = nlohmann::ordered_json;
using WriteRow = std::function<void(const Json&)>;

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

/// Measurements and result of one run of a simplifier.
struct Run {
    double seconds = 0;      ///< elapsed time of the call, from input arrays to output arrays
    double cpu_seconds = 0;  ///< CPU time of all threads
    std::uint64_t bytes =
        0;  ///< peak memory in addition to the input and preallocated output arrays; 0: unknown
    TriangleMesh mesh;
    Json report;
};

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

}  // namespace faqem::bench
