#pragma once
/// \file
/// The simplifiers of the benchmark behind one function type: arrays in, arrays out.

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "faqem/mesh.hpp"

namespace faqem::bench {

/// What a simplifier made of a mesh.
struct Outcome {
    TriangleMesh mesh;
    double core_seconds = 0;  ///< the simplifying call alone, without conversion from and to arrays
    std::string report;       ///< JSON that goes into the row as it is, or empty
};

/// Simplifies a welded mesh without attributes to at most `target_faces` faces, or as far as it can.
/// \throws any exception if the mesh is refused
using Simplify = std::function<Outcome(const TriangleMesh& mesh, std::size_t target_faces)>;

// Peers with their library's own defaults. Each is there only if its package was found.
Outcome cgal_lindstrom_turk(const TriangleMesh& mesh, std::size_t target_faces);
Outcome cgal_garland_heckbert(const TriangleMesh& mesh, std::size_t target_faces);
Outcome meshoptimizer(const TriangleMesh& mesh, std::size_t target_faces);
Outcome openmesh(const TriangleMesh& mesh, std::size_t target_faces);
Outcome open3d(const TriangleMesh& mesh, std::size_t target_faces);
Outcome vtk(const TriangleMesh& mesh, std::size_t target_faces);

/// A simplifier and the name it has in the rows.
struct NamedSimplifier {
    std::string name;
    Simplify simplify;
};

/// The peers that are compiled in, Lindstrom-Turk first.
std::vector<NamedSimplifier> peers();

/// The library's presets: `faqem-NAME`.
std::vector<NamedSimplifier> presets();

/// A peer by its name, or `faqem-PRESET[:key=value]...` with the keys area, boundary, normal, uv, plane_area,
/// virtual (largest gap / diagonal), weld (distance), link (off, on, strict), border (free, locked) and
/// threads.
/// \throws OptionError  there is none
NamedSimplifier simplifier_named(std::string_view text);

}  // namespace faqem::bench
