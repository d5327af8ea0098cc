#pragma once
/// \file
/// Detection of folds that arise while the vertices of a mesh move.

#include <array>
#include <span>
#include <vector>

#include "faqem/detail/geometry/halfedges.hpp"
#include "faqem/detail/geometry/surface_samples.hpp"
#include "faqem/export.hpp"

FAQEM_DETAIL_BEGIN

/// The edges of a mesh with two faces that are initially not folded. An edge is folded if the cosine between
/// the normals of its faces, after making their orientations consistent, is below a threshold.
class FoldGuard {
public:
    /// \param mesh             the mesh in its initial state; its triangles must outlive this object
    /// \param min_fold_cosine  cosine between the normals below which an edge is folded, in [-1, 1]
    /// O(faces log faces)
    FoldGuard(const MeshRef& mesh, double min_fold_cosine);

    /// Calls visit(const Triangle&, const Triangle&) with the two faces of each edge that is folded.
    /// \param positions  current vertex positions
    /// \throws whatever `visit` throws
    /// O(faces)
    template <class Visit>
    void for_each_fold(std::span<const Vector3> positions, Visit&& visit) const {
        const std::vector<Vector3> normals = unit_normals({positions, triangles_});
        for (const Edge& edge : edges_)
            if (is_fold(edge, normals)) visit(triangles_[edge.faces[0]], triangles_[edge.faces[1]]);
    }

private:
    struct Edge {
        std::array<Index, 2> faces;
        bool has_same_direction;  ///< of both half-edges: the orientations are inconsistent
    };
    bool is_fold(const Edge& edge, std::span<const Vector3> normals) const {
        const double cosine = normals[edge.faces[0]].dot(normals[edge.faces[1]]);
        return (edge.has_same_direction ? -cosine : cosine) < min_fold_cosine_;
    }

    std::span<const Triangle> triangles_;
    double min_fold_cosine_;
    std::vector<Edge> edges_;
};

inline FoldGuard::FoldGuard(const MeshRef& mesh, double min_fold_cosine)
    : triangles_(mesh.triangles), min_fold_cosine_(min_fold_cosine) {
    const std::vector<Vector3> normals = unit_normals(mesh);
    for_each_edge(sorted_halfedges(triangles_), [&](std::span<const Halfedge> on) {
        if (on.size() != 2) return;
        const Edge edge{{on[0].face, on[1].face}, on[0].is_ascending == on[1].is_ascending};
        if (!is_fold(edge, normals)) edges_.push_back(edge);
    });
}

FAQEM_DETAIL_END
