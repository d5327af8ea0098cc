#pragma once
/// \file
/// Surface of a mesh without degenerate faces, and closest-point queries for sequences of points; used
/// to measure distances between meshes.

#include <cstddef>
#include <span>
#include <vector>

#include "faqem/detail/geometry/bvh.hpp"
#include "faqem/export.hpp"
#include "faqem/mesh.hpp"

FAQEM_DETAIL_BEGIN

/// The faces of a mesh that have nonzero area.
struct Surface {
    std::vector<Vec3> positions;      ///< referenced and distinct (-0 equals 0), sorted by x, y, z
    std::vector<Triangle> triangles;  ///< of nonzero area
    std::vector<Index> faces;         ///< per triangle: index in the mesh; the corners have the same order
    std::vector<Vector3> normals;     ///< per triangle: unit normal
    std::vector<double> cumulative_area;  ///< per triangle: area of the triangles up to and including it
    /// Triangles without area whose three corners are different positions of others: they connect these.
    std::vector<Triangle> slivers;
    /// Axis-aligned bounding box; zero if there are no triangles.
    Vector3 low = Vector3::Zero(), high = Vector3::Zero();

    /// Diagonal of the bounding box.
    double diagonal() const { return (high - low).norm(); }
    /// Position of corner k of triangle f; k is 0, 1 or 2.
    Vector3 corner(Index f, std::size_t k) const { return to_eigen(positions[triangles[f][k]]); }
    /// Squared distance of p to triangle f.
    double distance_squared(const Vector3& p, Index f) const {
        return closest_point_on_triangle(p, corner(f, 0), corner(f, 1), corner(f, 2)).distance_squared;
    }
};

/// Copies the faces of a mesh into a Surface. Leaves out faces whose height is below 1e-12 of their longest
/// edge, and faces with positions that are not finite. The result may be empty.
/// \throws InputError  if a vertex index is out of range
/// O(n log n)
FAQEM_EXPORT Surface extract_surface(const MeshView& mesh);

/// Same as extract_surface(), but the result must not be empty.
/// \param name  name of the mesh in error messages
/// \throws InputError  if no face has nonzero area, or a vertex index is out of range
FAQEM_EXPORT Surface extract_nonempty_surface(const MeshView& mesh, const char* name);

/// Largest cosine between a normal and the normals of all faces that are closest to p. At an edge or a vertex
/// several faces are equally close, and which of them a query returns is arbitrary.
/// \param tree       the tree of the faces
/// \param normals    unit normals of the tree's triangles
/// \param hit        tree.closest(p)
/// \param normal     unit
/// \param tolerance  in model units: faces count as closest up to this much beyond the smallest distance
/// \return at most 1
double max_normal_cosine(const Bvh& tree, std::span<const Vector3> normals, const Vec3& p,
                         const Bvh::Hit& hit, const Vector3& normal, double tolerance);

/// Closest-point queries for a sequence of points in spatial order: the closest face of one point is the
/// initial bound for the next. For one thread at a time.
class CoherentQuery {
public:
    /// \param surface  not empty; must outlive this object
    /// \param tree     the tree of `surface`; must outlive this object
    CoherentQuery(const Surface& surface, const Bvh& tree) : surface_(surface), tree_(tree) {}

    /// The point of the surface that is closest to p; same result as Bvh::closest().
    Bvh::Hit operator()(const Vec3& p) {
        const Bvh::Hit hit = tree_.closest_with_hint(p, last_, surface_.corner(last_, 0),
                                                     surface_.corner(last_, 1), surface_.corner(last_, 2));
        last_ = hit.face;
        return hit;
    }

    /// Same, with a face that is probably near p as the initial bound.
    Bvh::Hit operator()(const Vec3& p, Index near) {
        last_ = near;
        return (*this)(p);
    }

private:
    const Surface& surface_;
    const Bvh& tree_;
    Index last_ = 0;
};

FAQEM_DETAIL_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/geometry/surface-inl.hpp"
#endif
