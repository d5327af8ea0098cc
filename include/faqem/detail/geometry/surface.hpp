#pragma once
/// \file
/// Meshes as surfaces to measure between: their faces with area, and nearest faces of many points.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "faqem/detail/geometry/bvh.hpp"
#include "faqem/export.hpp"
#include "faqem/mesh.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

/// The faces with area of a mesh.
struct Surface {
    std::vector<Vec3> positions;      ///< used ones, each once (-0 equals 0), in order of x, y, z
    std::vector<Triangle> triangles;  ///< with area
    std::vector<Index> faces;         ///< per triangle: the mesh's face, whose corners come in the same order
    std::vector<engine::Vector3> normals;  ///< unit, per triangle
    std::vector<double> cumulative_area;   ///< per triangle: area of it and all before
    engine::Vector3 low = engine::Vector3::Zero(), high = engine::Vector3::Zero();

    double diagonal() const { return (high - low).norm(); }
    engine::Vector3 corner(Index f, std::size_t k) const {
        return engine::to_eigen(positions[triangles[f][k]]);
    }
    /// Squared distance of p to face f.
    double distance_squared(const engine::Vector3& p, Index f) const {
        return closest_point_on_triangle(p, corner(f, 0), corner(f, 1), corner(f, 2)).distance_squared;
    }
};

/// Leaves out faces that are lower than 1e-12 of their longest edge, and those that are not finite. Nothing
/// may be left.
/// \throws InputError  an index is out of range
/// \throws what the poll throws
/// O(n log n)
FAQEM_EXPORT Surface extract_surface(const MeshView& mesh, engine::CancellationCheck check_cancelled = {});

/// The same, where something must be left.
/// \param name  of the mesh, for errors
/// \throws InputError  no face has area, or an index is out of range
FAQEM_EXPORT Surface extract_nonempty_surface(const MeshView& mesh, const char* name);

/// Largest cosine between a normal and those of the faces as near to p as the nearest one: at an edge or a
/// corner there are several, and which of them comes first is chance.
/// \param normals    unit, of the tree's triangles
/// \param hit        tree.closest(p)
/// \param normal     unit
/// \param tolerance  faces that are farther by at most this are as near
double max_normal_cosine(const Bvh& tree, std::span<const engine::Vector3> normals, const Vec3& p,
                         const Bvh::Hit& hit, const engine::Vector3& normal, double tolerance);

/// Closest points for queries that come in spatial order: the answer to one bounds the next. Refers to its
/// arguments; the tree is that of the surface.
class CoherentQuery {
public:
    CoherentQuery(const Surface& surface, const Bvh& tree) : surface_(surface), tree_(tree) {}

    /// The point closest to p, as Bvh::closest().
    Bvh::Hit operator()(const Vec3& p) {
        const Bvh::Hit hit = tree_.closest_with_hint(p, last_, surface_.corner(last_, 0),
                                                     surface_.corner(last_, 1), surface_.corner(last_, 2));
        last_ = hit.face;
        return hit;
    }

    /// As the call with one argument, where p is thought to be near this face.
    Bvh::Hit operator()(const Vec3& p, Index near) {
        last_ = near;
        return (*this)(p);
    }

private:
    const Surface& surface_;
    const Bvh& tree_;
    Index last_ = 0;
};

}  // namespace detail
FAQEM_NAMESPACE_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/geometry/surface-inl.hpp"
#endif
