#pragma once
/// \file
/// Edges at which a surface must not fold while its vertices move.

#include <array>
#include <span>
#include <vector>

#include "faqem/detail/geometry/surface_samples.hpp"
#include "faqem/export.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

/// The edges between two faces of a mesh that are no folds: the faces do not look away from each other,
/// as seen from the side that the winding of the first one gives.
class FoldGuard {
public:
    /// \param mesh        as it is at the start; its triangles are referred to
    /// \param min_fold_cosine  cosine between the faces' normals below which an edge is a fold
    /// \throws what the poll throws
    /// O(faces log faces)
    FoldGuard(const MeshRef& mesh, double min_fold_cosine, engine::CancellationCheck check_cancelled = {});

    /// Calls visit(Triangle, Triangle) for the faces of each edge that is a fold now.
    /// \throws what the poll throws.
    /// O(faces)
    template <class Visit>
    void for_each_fold(std::span<const engine::Vector3> positions, Visit&& visit,
                       engine::CancellationCheck check_cancelled = {}) const {
        const std::vector<engine::Vector3> normals = unit_normals({positions, triangles_}, check_cancelled);
        for (const Edge& edge : edges_) {
            check_cancelled();
            if (is_fold(edge, normals)) visit(triangles_[edge.faces[0]], triangles_[edge.faces[1]]);
        }
    }

private:
    struct Edge {
        std::array<Index, 2> faces;
        bool has_same_direction;  ///< both faces go through it from the same end
    };
    bool is_fold(const Edge& edge, std::span<const engine::Vector3> normals) const {
        const double cosine = normals[edge.faces[0]].dot(normals[edge.faces[1]]);
        return (edge.has_same_direction ? -cosine : cosine) < min_fold_cosine_;
    }

    std::span<const Triangle> triangles_;
    double min_fold_cosine_;
    std::vector<Edge> edges_;
};

}  // namespace detail
FAQEM_NAMESPACE_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/fitting/fold_guard-inl.hpp"
#endif
