#pragma once
/// \file
/// Comparison of two triangle meshes (distances, normals), and statistics of one.

#include <cstdint>
#include <limits>

#include "faqem/export.hpp"
#include "faqem/mesh.hpp"

FAQEM_NAMESPACE_BEGIN

/// Connectivity and size of a mesh, after welding vertices with equal positions.
struct MeshInfo {
    std::uint64_t faces = 0;              ///< faces with three different corners
    std::uint64_t degenerate_faces = 0;   ///< all other faces; they do not count below
    std::uint64_t vertices = 0;           ///< vertices that a face refers to
    std::uint64_t components = 0;         ///< connected components; a shared vertex connects faces
    std::uint64_t boundary_edges = 0;     ///< edges with one face
    std::uint64_t nonmanifold_edges = 0;  ///< edges with three or more faces
    std::int64_t euler = 0;               ///< Euler characteristic V - E + F
    Vec3 box_min = {}, box_max = {};      ///< axis-aligned bounding box, model units
    double diagonal = 0;                  ///< of the bounding box, model units
    double area = 0;                      ///< sum over the faces, squared model units
};

/// Computes the connectivity and size of a mesh. Vertices with equal positions (-0 equals 0) count as one.
/// \param mesh  any triangle soup; only positions and triangles are read
/// \throws InputError  a vertex index is out of range
/// Complexity: O(n log n) in the number of vertices and faces.
FAQEM_EXPORT MeshInfo info(const MeshView& mesh);

/// Options of compare() and compare_colors().
struct CompareOptions {
    std::uint64_t samples = 200'000;  ///< samples on each mesh, area-uniform and stratified, for the means
    std::uint64_t seed = 1;           ///< seed of the samples
    std::uint32_t threads = 0;        ///< maximum number of threads, 0: all; the result does not depend on it
    /// Maximum relative difference between a maximum distance and its upper bound, >= 0. Infinity: no branch
    /// and bound; the maximum is over samples and vertices, and the bound is a coarse one from whole faces.
    double tolerance = 0.01;
};

/// One-sided distances from one mesh to the other, in model units. The means are over the samples.
struct OneSided {
    double max = 0;        ///< lower bound of the maximum distance: the distance of a point that was found
    double max_bound = 0;  ///< upper bound of the maximum distance
    double mean = 0, mean_squared = 0;
    /// Angle between the normal of a sample's face and that of the closest face, in degrees. If several faces
    /// are closest (at an edge or a vertex, within 1e-9 of the diagonal), the smallest of their angles.
    double mean_normal_degrees = 0;
};

/// Two-sided distances between two meshes, in model units. Distances from points to triangles are exact up to
/// rounding.
struct Comparison {
    OneSided a_to_b, b_to_a;
    double hausdorff = 0;            ///< lower bound of the Hausdorff distance: the larger OneSided::max
    double hausdorff_bound = 0;      ///< its upper bound: the larger OneSided::max_bound
    double chamfer = 0;              ///< sum of both mean squared distances, squared model units
    double mean_normal_degrees = 0;  ///< mean of both directions
    double diagonal = 0;             ///< diagonal of the bounding box of `a`, for relative values
};

/// Computes two-sided distances between two meshes: Hausdorff distance by branch and bound, Chamfer distance
/// and normal deviation by sampling. Faces of zero area (height below 1e-12 of the longest edge) are skipped.
/// Branch and bound ends when lower and upper bound differ by at most the tolerance or 1e-9 of the diagonal,
/// or when HausdorffOptions::max_pieces is reached; the bounds are valid in each case.
/// \param a,b      triangle soups; only positions and triangles are read
/// \param options  see CompareOptions
/// \throws InputError   a mesh has no face with a non-zero area, or an index is out of range
/// \throws OptionError  the tolerance is negative or NaN
/// Complexity: O((samples + vertices + pieces) log faces) typically; about 300 bytes per face.
FAQEM_EXPORT Comparison compare(const MeshView& a, const MeshView& b, const CompareOptions& options = {});

/// Termination criteria of hausdorff().
struct HausdorffOptions {
    double tolerance = 0.01;    ///< as CompareOptions::tolerance
    std::uint32_t threads = 0;  ///< maximum number of threads, 0: all; the result does not depend on it
    /// Stop when a distance above this is found, model units. The upper bound may then be infinite.
    double stop_above = std::numeric_limits<double>::infinity();
    /// Stop when the upper bound is at most this, model units, whatever the tolerance.
    double stop_below = 0;
    /// Maximum number of face pieces evaluated in each direction. If it is reached, the bound is less tight.
    std::uint64_t max_pieces = 1'000'000;
};

/// A distance with its bounds, in model units: value <= true distance <= bound, up to rounding.
struct DistanceBound {
    double value = 0, bound = 0;
    std::uint64_t pieces = 0;  ///< number of face pieces evaluated
};

/// Computes the Hausdorff distance of two meshes, without sampling: at the vertices, then by branch and
/// bound. Faces of zero area are skipped. With stop_above and stop_below both set to E, the search ends as
/// soon as it is known whether the distance is at most E, as in within().
/// \param a,b      triangle soups; only positions and triangles are read
/// \param options  see HausdorffOptions
/// \throws InputError   a mesh has no face with a non-zero area, or an index is out of range
/// \throws OptionError  the tolerance is negative or NaN
/// Complexity: O((vertices + faces + pieces) log faces) typically; about 300 bytes per face, 150 per piece.
FAQEM_EXPORT DistanceBound hausdorff(const MeshView& a, const MeshView& b,
                                     const HausdorffOptions& options = {});

/// Result of within().
enum class Within { yes, no, undecided };

/// Tests whether the Hausdorff distance of two meshes is at most `distance`. Ends as soon as that is known.
/// \param a,b       triangle soups; only positions and triangles are read
/// \param distance  model units
/// \param threads   maximum number of threads, 0: all
/// \return `undecided` if HausdorffOptions::max_pieces was reached, or if the Hausdorff distance equals
///         `distance` up to 1e-9 of the diagonal
/// \throws InputError   a mesh has no face with a non-zero area, or an index is out of range
/// Complexity: as hausdorff().
FAQEM_EXPORT Within within(const MeshView& a, const MeshView& b, double distance, std::uint32_t threads = 0);

FAQEM_NAMESPACE_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/measure/compare-inl.hpp"
#include "faqem/detail/measure/mesh_info-inl.hpp"
#endif
