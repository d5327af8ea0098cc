#pragma once
/// \file
/// Would a collapse fold the surface? A fold is an edge with two faces that look away from each other, if
/// both are wound the same way.

#include <cmath>
#include <cstdint>
#include <vector>

#include "faqem/engine/mesh/collapse_mesh.hpp"
#include "faqem/export.hpp"

FAQEM_NAMESPACE_BEGIN
namespace engine {

/// A face around a pair as its collapse leaves it: the new vertex, then corners a and b.
struct MovedFace {
    Index face, a, b;
    Vector3 normal;        ///< unit; zero without area
    double normal_cosine;  ///< cosine to the normal it has now
};

/// Counts folds; holds scratch memory only.
class FoldTest {
public:
    explicit FoldTest(const CollapseMesh& mesh) : mark_(mesh.vertex_slots(), 0) {}

    /// Are there more folds after (u, v) has become one vertex than there are?
    /// \param moved_faces  the faces around both but those with both
    /// \param min_cosine   cosine between the faces of an edge below which it is a fold, in (-1, 0)
    /// O(valence squared), O(valence) typically
    bool adds_folds(const CollapseMesh& mesh, Index u, Index v, const std::vector<MovedFace>& moved_faces,
                    double min_cosine) {
        // Normals at most 120 degrees apart, of which one turns by less than this, make no fold.
        const double safe_cosine =
            min_cosine < -0.5 ? -0.5 * min_cosine + std::sqrt(0.75 * (1 - min_cosine * min_cosine)) : 2;
        std::uint32_t before = 0, after = 0;
        for (const MovedFace& moved : moved_faces) {
            const auto [lower, higher] = mesh.lower_degree_first(moved.a, moved.b);
            if (moved.normal_cosine > safe_cosine &&
                (mesh.has_narrow_normal_cone(lower) || mesh.has_narrow_normal_cone(higher)))
                continue;
            if (const Index g = opposite_face(mesh, moved); g != no_index) {
                const Vector3 other = (mesh.has_directed_edge(g, moved.a, moved.b) ? -1 : 1) * mesh.normal(g);
                before += mesh.normal(moved.face).dot(other) < min_cosine;
                after += moved.normal.dot(other) < min_cosine;
            }
        }
        after += count_folds_among(moved_faces, min_cosine);
        if (after <= before) return false;
        return after > before + count_folds_at(mesh, u, no_index, min_cosine) +
                           count_folds_at(mesh, v, u, min_cosine);
    }

private:
    // The other face of edge (a, b); no_index where there is not exactly one.
    static Index opposite_face(const CollapseMesh& mesh, const MovedFace& moved) {
        Index other = no_index;
        std::uint32_t others = 0;
        const auto ends =
            mesh.lower_degree_first(moved.a, moved.b);  // whole: clang 14 captures no part of a binding
        mesh.for_each_face(ends.first, [&](Index g, unsigned) {
            if (g != moved.face && mesh.has_corner(g, ends.second)) other = g, ++others;
        });
        return others == 1 ? other : no_index;
    }

    // Folds at w, but for its edge to `except`.
    std::uint32_t count_folds_at(const CollapseMesh& mesh, Index w, Index except, double min_cosine) {
        current_faces_.clear();
        mesh.for_each_face(w, [&](Index f, unsigned corner) {
            const Triangle& t = mesh.triangle(f);
            const Index a = t[(corner + 1) % 3], b = t[(corner + 2) % 3];
            current_faces_.push_back(
                {f, a == except ? no_index : a, b == except ? no_index : b, mesh.normal(f), 1});
        });
        return count_folds_among(current_faces_, min_cosine);
    }

    // Folds among the edges from the vertex in hand to corners of exactly two of its faces.
    std::uint32_t count_folds_among(const std::vector<MovedFace>& moved_faces, double min_cosine) {
        if (are_within_one_cone(moved_faces, min_cosine)) return 0;
        edges_.clear();
        for (const MovedFace& moved : moved_faces) {
            // Faces of one winding have an edge at different places.
            add_edge_face(moved.a, moved.normal);
            add_edge_face(moved.b, -moved.normal);
        }
        std::uint32_t folds = 0;
        for (const EdgeNormals& end : edges_) {
            mark_[end.vertex] = 0;
            folds += end.faces == 2 && -end.first.dot(end.last) < min_cosine;
        }
        return folds;
    }

    void add_edge_face(Index vertex, const Vector3& normal) {
        if (vertex == no_index) return;
        std::uint32_t& at = mark_[vertex];
        if (at == 0) {
            edges_.push_back({vertex, 0, normal, normal});
            at = static_cast<std::uint32_t>(edges_.size());
        }
        EdgeNormals& end = edges_[at - 1];
        end.last = normal;
        ++end.faces;
    }

    // Two normals at angles below x from a third are less than 2 x apart: cos 2x = 2 cos^2 x - 1. Only
    // windings that disagree could make a fold of such.
    static bool are_within_one_cone(const std::vector<MovedFace>& moved_faces, double min_cosine) {
        Vector3 sum = Vector3::Zero();
        for (const MovedFace& moved : moved_faces) sum += moved.normal;
        const double limit = std::sqrt(0.5 * (1 + min_cosine)) * sum.norm();
        for (const MovedFace& moved : moved_faces) {
            if (!(moved.normal.dot(sum) > limit)) return false;
        }
        return true;
    }

    struct EdgeNormals {
        Index vertex;
        std::uint32_t faces;
        Vector3 first, last;  ///< normals of its faces, turned over where the vertex in hand comes after it
    };
    std::vector<MovedFace> current_faces_;
    std::vector<EdgeNormals> edges_;
    std::vector<std::uint32_t> mark_;  // 1 + place in ends_, while counting; else 0
};

}  // namespace engine
FAQEM_NAMESPACE_END
