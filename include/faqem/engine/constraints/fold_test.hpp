#pragma once
/// \file
/// Test whether a collapse folds the surface. A fold is an edge with two faces whose normals, for
/// consistent windings, point in nearly opposite directions.

#include <cmath>
#include <cstdint>
#include <vector>

#include "faqem/engine/mesh/collapse_mesh.hpp"
#include "faqem/engine/mesh/normal_cones.hpp"
#include "faqem/export.hpp"

FAQEM_ENGINE_BEGIN

/// A face at a pair as it will be after the collapse. Its corners are the new vertex, a and b.
struct MovedFace {
    Index face, a, b;
    Vector3 normal;        ///< new unit normal; zero if it has no area
    double normal_cosine;  ///< cosine between the old and the new normal
};

/// Compares the number of folds before and after a collapse. Belongs to one mesh. Not thread-safe.
class FoldTest {
public:
    /// \param mesh  used for its number of vertex slots
    explicit FoldTest(const CollapseMesh& mesh) : mark_(mesh.vertex_slots(), 0) {}

    /// Whether collapsing (u, v) increases the number of folds. O(valence) typically, O(valence squared) at
    /// worst
    /// \param u, v         vertices of the pair
    /// \param moved_faces  the faces with exactly one of both vertices
    /// \param min_cosine   an edge is a fold if the cosine between the normals of its faces is below this;
    ///     in (-1, 0)
    bool adds_folds(const CollapseMesh& mesh, Index u, Index v, const std::vector<MovedFace>& moved_faces,
                    double min_cosine) {
        // Two normals at most 120 degrees apart do not become a fold if one of them deviates by less than
        // this.
        const double safe_cosine =
            min_cosine < -0.5 ? -0.5 * min_cosine + std::sqrt(0.75 * (1 - min_cosine * min_cosine)) : 2;
        std::uint32_t before = 0, after = 0;
        for (const MovedFace& moved : moved_faces) {
            const auto [lower, higher] = mesh.lower_degree_first(moved.a, moved.b);
            if (moved.normal_cosine > safe_cosine &&
                (cones_.is_narrow(mesh, lower) || cones_.is_narrow(mesh, higher)))
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

    /// To be called after each collapse.
    /// \param survivor  the vertex that remains
    void after_collapse(const CollapseMesh& mesh, Index survivor) { cones_.after_collapse(mesh, survivor); }

private:
    // The other face of edge (a, b); no_index unless there is exactly one.
    static Index opposite_face(const CollapseMesh& mesh, const MovedFace& moved) {
        Index other = no_index;
        std::uint32_t others = 0;
        mesh.for_each_face_between(moved.a, moved.b, [&](Index g) {
            if (g != moved.face) other = g, ++others;
        });
        return others == 1 ? other : no_index;
    }

    // Number of folds at w, without its edge to `except`.
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

    // Number of folds among the edges from the common vertex of the faces to vertices of exactly two of
    // them.
    std::uint32_t count_folds_among(const std::vector<MovedFace>& moved_faces, double min_cosine) {
        if (are_within_one_cone(moved_faces, min_cosine)) return 0;
        edges_.clear();
        for (const MovedFace& moved : moved_faces) {
            // Consistently oriented faces contain their common edge once as (vertex, a) and once as (b,
            // vertex).
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

    // Two normals at angles below x from a third one are less than 2 x apart: cos 2x = 2 cos^2 x - 1. Such
    // normals can only be a fold if the windings are inconsistent.
    static bool are_within_one_cone(const std::vector<MovedFace>& moved_faces, double min_cosine) {
        Vector3 sum = Vector3::Zero();
        for (const MovedFace& moved : moved_faces) sum += moved.normal;
        const double limit = std::sqrt(0.5 * (1 + min_cosine)) * sum.norm();
        for (const MovedFace& moved : moved_faces)
            if (!(moved.normal.dot(sum) > limit)) return false;
        return true;
    }

    struct EdgeNormals {
        Index vertex;
        std::uint32_t faces;
        /// normals of its faces; negated for faces that pass the edge towards the common vertex
        Vector3 first, last;
    };
    std::vector<MovedFace> current_faces_;
    std::vector<EdgeNormals> edges_;
    std::vector<std::uint32_t> mark_;  // scratch: 1 + index in edges_, else 0
    NormalCones cones_;
};

FAQEM_ENGINE_END
