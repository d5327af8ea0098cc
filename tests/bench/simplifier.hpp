#pragma once
/// \file
/// The simplifiers of the benchmark as functions of one type.

#include <cstddef>
#include <ctime>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "faqem/mesh.hpp"

namespace faqem::bench {

/// Returns the CPU time of the process so far, seconds. On a shared machine it is more reproducible than
/// elapsed time.
inline double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Result of a simplifier.
struct Outcome {
    TriangleMesh mesh;
    double core_seconds = 0;  ///< time of the simplification alone, without conversion from and to arrays
    std::string report;       ///< JSON that is copied into the row, or empty
};

/// Simplifies a welded mesh without attributes to at most `target_faces` faces, or as far as possible.
/// \throws any exception if the mesh is rejected
using Simplify = std::function<Outcome(const TriangleMesh& mesh, std::size_t target_faces)>;

// Peers with the defaults of their libraries. Each is defined only if its package was found.
Outcome cgal_lindstrom_turk(const TriangleMesh& mesh, std::size_t target_faces);
Outcome cgal_garland_heckbert(const TriangleMesh& mesh, std::size_t target_faces);
Outcome meshoptimizer(const TriangleMesh& mesh, std::size_t target_faces);
Outcome openmesh(const TriangleMesh& mesh, std::size_t target_faces);
Outcome open3d(const TriangleMesh& mesh, std::size_t target_faces);
Outcome vtk(const TriangleMesh& mesh, std::size_t target_faces);

/// Simplifies with a package that package_peers.py knows, in a process of the first python3 in PATH.
Outcome package(const std::string& name, const TriangleMesh& mesh, std::size_t target_faces);

/// A simplifier and its name in the rows.
struct NamedSimplifier {
    std::string name;
    Simplify simplify;
};

/// Returns the peers of this build, Lindstrom-Turk first.
std::vector<NamedSimplifier> peers();

/// Returns the peers that are not linked. Their times include starting a process and files.
std::vector<NamedSimplifier> packages();

/// Returns faqem's presets with the names `faqem-NAME`.
std::vector<NamedSimplifier> presets();

/// Returns a simplifier by name: a peer, a package, or `faqem-PRESET[:option=value]...` with the names of options in C,
/// for example `w-area` and `boundary`.
/// \throws OptionError  there is no such simplifier, option or value
NamedSimplifier simplifier_named(std::string_view text);

}  // namespace faqem::bench
