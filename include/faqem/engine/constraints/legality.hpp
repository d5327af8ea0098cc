#pragma once
/// \file
/// Legality of a collapse.

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "faqem/engine/constraints/contraction.hpp"
#include "faqem/engine/constraints/fold_test.hpp"
#include "faqem/engine/mesh/collapse_mesh.hpp"
#include "faqem/engine/mesh/degenerate.hpp"
#include "faqem/engine/mesh/pair_table.hpp"
#include "faqem/export.hpp"
#include "faqem/report.hpp"

FAQEM_ENGINE_BEGIN

/// Rules that a legal collapse satisfies. The starvation ladder relaxes them.
struct Rules {
    LinkCondition link = LinkCondition::off;  ///< not `as_preset`; `by_size` is treated as `on`
    /// Smallest allowed cosine between the old and the new normal of a face, in [-1, 1]; -1: not tested.
    double min_normal_cosine = 0;
    /// Pairs shorter than this are not collapsed (paper, supplementary: 1e-8 of the diagonal), unless the
    /// faces around them are as small: see is_short_pair(). Engine units. Tested by the engine, not by
    /// Legality.
    double min_pair_length = 0;
    /// An edge is a fold if the cosine between the normals of its two faces is below this. A collapse must
    /// not increase the number of folds. -1: not tested.
    double min_fold_cosine = -1;
    /// How curves between groups (FeatureCurves) are treated; `free`: they only have a price. Tested by the engine.
    GroupBoundaries groups = GroupBoundaries::preserved;
};

/// Tests whether a collapse is legal. Belongs to one mesh; 8 bytes per vertex slot. Not thread-safe.
class Legality {
public:
    /// \param mesh  used for its number of vertex slots; the mesh of all later calls
    explicit Legality(const CollapseMesh& mesh) : folds_(mesh), mark_(mesh.vertex_slots(), 0) {}

    /// Tests whether (u, v) may be collapsed to a point. O(valence of u and v), except for duplicate faces
    /// and folds: O(valence squared) at worst
    /// \pre u != v, both with faces
    /// \param u, v   vertices of the pair
    /// \param pair   their index in `pairs`
    /// \param p      position of the new vertex, engine units
    /// \param rules  min_pair_length is not tested
    /// \return the reason why the collapse is illegal, or nothing
    std::optional<Refusal> check(const CollapseMesh& mesh, const PairTable& pairs, Index u, Index v,
                                 Index pair, const Vector3& p, const Rules& rules) {
        moved_faces_.clear();
        if (const auto refusal = check_flips_and_areas(mesh, u, v, p, rules.min_normal_cosine))
            return refusal;
        if (const auto refusal = check_flips_and_areas(mesh, v, u, p, rules.min_normal_cosine))
            return refusal;
        if (rules.link != LinkCondition::off && !link_condition(mesh, pairs, u, v, pair, rules.link))
            return Refusal::link;
        if (rules.min_fold_cosine > -1 && folds_.adds_folds(mesh, u, v, moved_faces_, rules.min_fold_cosine))
            return Refusal::fold;
        return std::nullopt;
    }

    /// Tests whether a set of vertices may be contracted to a point. Complexity: as check()
    /// \param contraction  the set; begins with the pair
    /// \param p            position of the new vertex, engine units
    /// \param rules        only min_normal_cosine and min_fold_cosine are tested
    /// \return the reason why the contraction is illegal, or nothing
    std::optional<Refusal> check(const CollapseMesh& mesh, const Contraction& contraction, const Vector3& p,
                                 const Rules& rules) {
        moved_faces_.clear();
        for (const auto& [f, a, b] : contraction.remaining())
            if (const auto refusal = check_face(mesh, f, a, b, p, rules.min_normal_cosine)) return refusal;
        if (rules.min_fold_cosine > -1 &&
            folds_.adds_folds(mesh, contraction.vertices()[0], contraction.vertices()[1], moved_faces_,
                              rules.min_fold_cosine))
            return Refusal::fold;
        return std::nullopt;
    }

    /// To be called after each collapse.
    /// \param survivor  the vertex that remains
    void after_collapse(const CollapseMesh& mesh, Index survivor) { folds_.after_collapse(mesh, survivor); }

private:
    // Tests the faces of `moved` that do not contain `partner`: none may flip or lose its area (Sec. 3.3 of
    // the paper). A face that is already degenerate has neither a normal nor an area to preserve.
    std::optional<Refusal> check_flips_and_areas(const CollapseMesh& mesh, Index moved, Index partner,
                                                 const Vector3& p, double min_normal_cosine) {
        std::optional<Refusal> refusal;
        mesh.all_of_faces(moved, [&](Index f, unsigned corner) {
            if (mesh.has_corner(f, partner)) return true;
            const Triangle& t = mesh.triangle(f);
            refusal = check_face(mesh, f, t[(corner + 1) % 3], t[(corner + 2) % 3], p, min_normal_cosine);
            return !refusal;
        });
        return refusal;
    }

    // Tests a face whose corners become p, a and b, and adds it to moved_faces_.
    std::optional<Refusal> check_face(const CollapseMesh& mesh, Index f, Index a, Index b, const Vector3& p,
                                      double min_normal_cosine) {
        const Vector3 to_a = mesh.position(a) - p, to_b = mesh.position(b) - p;
        const Vector3 area_vector = to_a.cross(to_b);
        const double length = area_vector.norm();
        const double along = mesh.normal(f).dot(area_vector);
        const double scale = length > 0 ? 1 / length : 0;
        moved_faces_.push_back({f, a, b, scale * area_vector, scale * along});
        if (min_normal_cosine > -1 && mesh.area(f) > 0 && !(along >= min_normal_cosine * length))
            return Refusal::flip;
        if (is_degenerate(length, to_a, to_b) && !is_degenerate(mesh, f)) return Refusal::degenerate;
        return std::nullopt;
    }

    // If (u, v) is an edge, and no edge at u or v has more than two faces: the link condition for surfaces
    // with boundary (Dey et al. 1999), where a vertex at infinity closes the boundary. Otherwise: the
    // collapse must not create duplicate faces, and no edge may get more faces than the larger of the two
    // face counts that are merged into it.
    bool link_condition(const CollapseMesh& mesh, const PairTable& pairs, Index u, Index v, Index pair,
                        LinkCondition link) {
        const std::uint32_t shared = pairs.face_count(pair);
        bool manifold = shared >= 1 && shared <= 2 && is_manifold(pairs, u) && is_manifold(pairs, v);
        if (!manifold && link == LinkCondition::strict) return false;
        mark_edges(pairs, u);
        std::uint32_t common = 0;
        bool legal = true;
        pairs.for_each_pair(v, [&](Neighbour n) {
            const std::uint32_t at_u = mark_[n.vertex];
            const std::uint32_t at_v = pairs.face_count(n.pair);
            if (at_u == 0 || at_v == 0 || n.vertex == u) return;
            ++common;
            if (manifold && shared == 1 && at_u == 1 && at_v == 1)
                legal = false;  // the last triangle or a triangular hole
            if (!manifold && at_u + at_v - 2 * mesh.count_faces_with(v, u, n.vertex) > std::max(at_u, at_v))
                legal = false;
        });
        if (manifold) {
            if (common != shared) legal = false;
            if (shared != 1 && pairs.boundary_degree(u) > 0 && pairs.boundary_degree(v) > 0) legal = false;
        }
        if (legal && common > 1) legal = !makes_duplicate_face(mesh, u, v);
        pairs.for_each_pair(u, [&](Neighbour n) { mark_[n.vertex] = 0; });
        return legal;
    }

    static bool is_manifold(const PairTable& pairs, Index v) {
        return pairs.nonmanifold_degree(v) == 0 &&
               (pairs.boundary_degree(v) == 0 || pairs.boundary_degree(v) == 2);
    }

    void mark_edges(const PairTable& pairs, Index u) {
        pairs.for_each_pair(u, [&](Neighbour n) { mark_[n.vertex] = pairs.face_count(n.pair); });
    }

    // Whether there are faces (v, x, y) and (u, x, y). Only the edges marked at u need to be tested.
    bool makes_duplicate_face(const CollapseMesh& mesh, Index u, Index v) const {
        return !mesh.all_of_faces(v, [&](Index f, unsigned corner) {
            const Index x = mesh.triangle(f)[(corner + 1) % 3];
            const Index y = mesh.triangle(f)[(corner + 2) % 3];
            if (x == u || y == u || mark_[x] == 0 || mark_[y] == 0) return true;
            return mesh.all_of_faces(
                u, [&](Index g, unsigned) { return !(mesh.has_corner(g, x) && mesh.has_corner(g, y)); });
        });
    }

    FoldTest folds_;
    std::vector<MovedFace> moved_faces_;  // faces that remain after the collapse
    std::vector<std::uint32_t> mark_;     // scratch: face count of the edge from u to the vertex, else 0
};

FAQEM_ENGINE_END
