#pragma once
/// \file
/// Two-sided distances, normals and topology of triangle meshes.

#include <cstdint>
#include <limits>

#include "faqem/export.hpp"
#include "faqem/mesh.hpp"

FAQEM_NAMESPACE_BEGIN

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
FAQEM_EXPORT MeshInfo info(const MeshView& mesh);

/// How much compare() looks at.
struct CompareOptions {
    std::uint64_t samples = 200'000;  ///< area-uniform and stratified, on each mesh, for the means
    std::uint64_t seed = 1;
    std::uint32_t threads = 0;  ///< 0: all; the result does not depend on it
    /// Gap wanted between a largest distance and its bound, as a share of the distance, >= 0. Infinity: no
    /// search; max is what samples and vertices show, and the bound is a coarse one.
    double tolerance = 0.01;
};

/// Distances from one mesh to the other, in model units. The means are over samples.
struct OneSided {
    double max = 0;        ///< of a point that was found: the largest distance is not smaller
    double max_bound = 0;  ///< no point is farther
    double mean = 0, mean_squared = 0;
    /// Angle between the face's normal at the sample and the one at its closest point; where several faces
    /// are closest (at an edge or a corner, to 1e-9 of the diagonal) the smallest of their angles.
    double mean_normal_degrees = 0;
};

/// Distances between two surfaces. Point to triangle distances are exact up to rounding.
struct Comparison {
    OneSided a_to_b, b_to_a;
    double hausdorff = 0;            ///< the larger max
    double hausdorff_bound = 0;      ///< the larger max_bound: the true value lies between
    double chamfer = 0;              ///< sum of both mean squared distances
    double mean_normal_degrees = 0;  ///< mean of both sides
    double diagonal = 0;             ///< of a's bounding box, to divide by
};

/// Compares two meshes. Faces without area (lower than 1e-12 of their longest edge) are skipped. The search
/// for the largest distances ends where the gap is within the tolerance or below 1e-9 of the diagonal, or
/// after as much work as HausdorffOptions allow; the bounds hold in any case.
/// \throws InputError   a mesh has no face with area, or an index is out of range
/// \throws OptionError  the tolerance is negative or not a number
/// Complexity: O((samples + vertices + pieces) log faces) typically; about 300 bytes per face.
FAQEM_EXPORT Comparison compare(const MeshView& a, const MeshView& b, const CompareOptions& options = {});

/// When the search of hausdorff() may end.
struct HausdorffOptions {
    double tolerance = 0.01;    ///< as CompareOptions::tolerance
    std::uint32_t threads = 0;  ///< 0: all; the result does not depend on it
    /// Model units. Give up once a distance above it is found: the bound may then be infinite.
    double stop_above = std::numeric_limits<double>::infinity();
    /// Model units. A bound this low is good enough, whatever the tolerance.
    double stop_below = 0;
    /// Parts of faces to look at in each direction. Where this ends the search, the bound is what it is then.
    std::uint64_t max_pieces = 1'000'000;
};

/// value <= true distance <= bound, up to rounding.
struct DistanceBound {
    double value = 0, bound = 0;
    std::uint64_t pieces = 0;  ///< parts of faces looked at
};

/// The Hausdorff distance of two meshes, without samples: by vertices, then by branch and bound. Faces
/// without area are skipped. With stop_above and stop_below at E it asks whether the meshes are within E, as
/// within() does.
/// \throws InputError   a mesh has no face with area, or an index is out of range
/// \throws OptionError  the tolerance is negative or not a number
/// Complexity: O((vertices + faces + pieces) log faces) typically; about 300 bytes per face, 150 per piece.
FAQEM_EXPORT DistanceBound hausdorff(const MeshView& a, const MeshView& b,
                                     const HausdorffOptions& options = {});

/// Answer of within().
enum class Within { yes, no, undecided };

/// Whether no point of either mesh is farther than `distance` (model units) from the other mesh. Undecided
/// where the work allowed by HausdorffOptions does not tell, or the distance is that up to 1e-9 of the
/// diagonal. Ends as soon as the answer is known.
/// \throws InputError   a mesh has no face with area, or an index is out of range
FAQEM_EXPORT Within within(const MeshView& a, const MeshView& b, double distance, std::uint32_t threads = 0);

FAQEM_NAMESPACE_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/measure/compare-inl.hpp"
#include "faqem/detail/measure/mesh_info-inl.hpp"
#endif
