#pragma once
/// \file
/// Two-sided distances, normals and topology of triangle meshes.

#include <cstdint>

#include "faqem/mesh.hpp"

namespace faqem {

/// Counts that describe a mesh's connectivity after welding equal positions.
struct MeshInfo {
    std::uint64_t faces = 0;              ///< with three different corners after welding
    std::uint64_t degenerate_faces = 0;   ///< the others
    std::uint64_t vertices = 0;           ///< used ones, after welding
    std::uint64_t components = 0;         ///< joined by a shared vertex
    std::uint64_t boundary_edges = 0;     ///< with one face
    std::uint64_t nonmanifold_edges = 0;  ///< with three faces or more
    std::int64_t euler = 0;               ///< V - E + F
    Vec3 box_min = {}, box_max = {};
    double diagonal = 0;  ///< of the box
    double area = 0;
};

/// Counts and measures one mesh; positions that are equal (-0 equals 0) are one vertex. O(n log n)
/// \throws InputError  an index is out of range
MeshInfo info(const MeshView& mesh);

struct CompareOptions {
    std::uint64_t samples = 200'000;  ///< area-uniform and stratified, on each mesh, besides all vertices
    std::uint64_t seed = 1;
    std::uint32_t threads = 0;  ///< 0: all; the result does not depend on it
};

/// Distances from one mesh's samples to the other mesh, in model units.
struct OneSided {
    double max = 0, mean = 0, mean_squared = 0;
    /// Angle between the face's normal at the sample and the one at its closest point; where several faces
    /// are closest (at an edge or a corner, to 1e-9 of the diagonal) the smallest of their angles.
    double mean_normal_degrees = 0;
};

/// Distances between two surfaces. Point to triangle distances are exact; max is over samples and vertices.
struct Comparison {
    OneSided a_to_b, b_to_a;
    double hausdorff = 0;            ///< the larger max
    double chamfer = 0;              ///< sum of both mean squared distances
    double mean_normal_degrees = 0;  ///< mean of both sides
    double diagonal = 0;             ///< of a's bounding box, to divide by
};

/// Compares two meshes. Faces without area (lower than 1e-12 of their longest edge) are skipped.
/// \throws InputError  a mesh has no face with area, or an index is out of range
/// Complexity: O((samples + vertices) log faces) typically; about 300 bytes per face.
Comparison compare(const MeshView& a, const MeshView& b, const CompareOptions& options = {});

}  // namespace faqem
