#pragma once
/// \file
/// Degenerate faces. A collapse must not leave a mesh in which all faces are degenerate.

#include <algorithm>
#include <cstddef>

#include "faqem/engine/mesh/collapse_mesh.hpp"
#include "faqem/engine/mesh/pair_table.hpp"
#include "faqem/export.hpp"

FAQEM_ENGINE_BEGIN

/// A face is degenerate if its height divided by its longest edge is at most this.
inline constexpr double degenerate_aspect = 1e-9;

/// Whether a triangle is degenerate. O(1)
/// \param doubled_area  twice its area
/// \param to_a, to_b    vectors from one corner to the two others
inline bool is_degenerate(double doubled_area, const Vector3& to_a, const Vector3& to_b) {
    const double a = to_a.squaredNorm(), b = to_b.squaredNorm();
    // The squared third side is at most twice the sum of the other two, so that most triangles are decided
    // here.
    if (doubled_area > 2 * degenerate_aspect * (a + b)) return false;
    const double longest = std::max({a, b, (to_b - to_a).squaredNorm()});
    return !(doubled_area > degenerate_aspect * longest);
}

/// Whether face f is degenerate. O(1)
/// \pre mesh.is_alive(f)
inline bool is_degenerate(const CollapseMesh& mesh, Index f) {
    const auto [a, b, c] = mesh.triangle(f);
    const Vector3& p = mesh.position(a);
    return is_degenerate(2 * mesh.area(f), mesh.position(b) - p, mesh.position(c) - p);
}

/// Whether a pair is shorter than a limit, and also shorter than 1e-8 of the longest edge at its vertex of
/// lower degree. A limit alone would fail where the surface is tiny compared with the model, because of a
/// vertex far away: all of its pairs would be too short. O(1), O(smaller valence) below the limit
/// \param u, v    vertex slots
/// \param length  the limit, engine units
inline bool is_short_pair(const CollapseMesh& mesh, Index u, Index v, double length) {
    const double square = (mesh.position(u) - mesh.position(v)).squaredNorm();
    if (square >= length * length) return false;
    double longest = 0;
    const Index center = mesh.lower_degree_first(u, v).first;
    mesh.for_each_face(center, [&](Index f, unsigned) {
        for (const Index w : mesh.triangle(f))
            longest = std::max(longest, (mesh.position(w) - mesh.position(center)).squaredNorm());
    });
    return !(square > 1e-16 * longest);
}

/// An upper bound of the number of degenerate faces. Legal collapses do not create any (see Legality), so
/// the number only decreases. Faces are counted again only if the bound is too large to decide.
class DegenerateFaces {
public:
    DegenerateFaces() = default;
    /// Counts the degenerate faces. O(face slots)
    /// \param mesh             the initial mesh
    explicit DegenerateFaces(const CollapseMesh& mesh) : max_count_(count(mesh)) {}

    /// Whether the faces of a pair are the only faces that are not degenerate. If all faces of the pair are
    /// degenerate: whether they are the only faces. O(smaller valence of the pair); O(face slots) if nearly
    /// all faces are degenerate
    /// \param pair             index of a pair that is alive
    bool are_last_faces(const CollapseMesh& mesh, const PairTable& pairs, Index pair) {
        if (pairs.face_count(pair) + max_count_ < mesh.face_count()) return false;
        const std::size_t with_area = pairs.face_count(pair) - count_at_pair(mesh, pairs, pair);
        if (with_area == 0) return pairs.face_count(pair) >= mesh.face_count();
        if (with_area + max_count_ < mesh.face_count()) return false;
        max_count_ = count(mesh);
        return with_area + max_count_ >= mesh.face_count();
    }

    /// The bound.
    std::size_t max_count() const { return max_count_; }

    /// Must be called before a pair is collapsed. O(smaller valence of the pair); O(1) if the bound is 0
    void before_collapse(const CollapseMesh& mesh, const PairTable& pairs, Index pair) {
        if (max_count_ > 0) max_count_ -= std::min(max_count_, count_at_pair(mesh, pairs, pair));
    }

private:
    static std::size_t count(const CollapseMesh& mesh) {
        std::size_t count = 0;
        for (Index f = 0; f < mesh.face_slots(); ++f) count += mesh.is_alive(f) && is_degenerate(mesh, f);
        return count;
    }

    static std::size_t count_at_pair(const CollapseMesh& mesh, const PairTable& pairs, Index pair) {
        std::size_t count = 0;
        mesh.for_each_face_between(pairs.first(pair), pairs.second(pair),
                                   [&](Index f) { count += is_degenerate(mesh, f); });
        return count;
    }

    std::size_t max_count_ = 0;
};

FAQEM_ENGINE_END
