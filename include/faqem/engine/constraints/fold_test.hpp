#pragma once
/// \file
/// Would a collapse fold the surface? A fold is an edge with two faces that look away from each other, if
/// both are wound the same way.

#include <cmath>
#include <cstdint>
#include <vector>

#include "faqem/export.hpp"
#include "faqem/engine/mesh/triangle_soup.hpp"

FAQEM_NAMESPACE_BEGIN
namespace engine {

/// A face around a pair as its collapse leaves it: the new vertex, then corners a and b.
struct TurnedFace {
    Index face, a, b;
    Vector3 normal;  ///< unit; zero without area
    double turn;     ///< cosine to the normal it has now
};

/// Counts folds; holds scratch memory only.
class Folds {
public:
    explicit Folds(const Complex& complex) : mark_(complex.vertex_slots(), 0) {}

    /// Are there more folds after (u, v) has become one vertex than there are?
    /// \param turned  the faces around both but those with both
    /// \param least   cosine between the faces of an edge below which it is a fold, in (-1, 0)
    /// O(valence squared), O(valence) typically
    bool adds(const Complex& complex, Index u, Index v, const std::vector<TurnedFace>& turned, double least) {
        // Normals at most 120 degrees apart, of which one turns by less than this, make no fold.
        const double calm_turn = least < -0.5 ? -0.5 * least + std::sqrt(0.75 * (1 - least * least)) : 2;
        std::uint32_t before = 0, after = 0;
        for (const TurnedFace& side : turned) {
            const auto [few, many] = complex.by_degree(side.a, side.b);
            if (side.turn > calm_turn && (complex.is_calm(few) || complex.is_calm(many))) continue;
            if (const Index g = across(complex, side); g != no_index) {
                const Vector3 other = (complex.goes_from(g, side.a, side.b) ? -1 : 1) * complex.normal(g);
                before += complex.normal(side.face).dot(other) < least;
                after += side.normal.dot(other) < least;
            }
        }
        after += folds_between(turned, least);
        if (after <= before) return false;
        return after > before + folds_at(complex, u, no_index, least) + folds_at(complex, v, u, least);
    }

private:
    // The other face of edge (a, b); no_index where there is not exactly one.
    static Index across(const Complex& complex, const TurnedFace& side) {
        Index other = no_index;
        std::uint32_t others = 0;
        const auto ends = complex.by_degree(side.a, side.b);  // whole: clang 14 captures no part of a binding
        complex.for_each_face(ends.first, [&](Index g, unsigned) {
            if (g != side.face && complex.has_corner(g, ends.second)) other = g, ++others;
        });
        return others == 1 ? other : no_index;
    }

    // Folds at w, but for its edge to `except`.
    std::uint32_t folds_at(const Complex& complex, Index w, Index except, double least) {
        as_they_are_.clear();
        complex.for_each_face(w, [&](Index f, unsigned corner) {
            const Triangle& t = complex.triangle(f);
            const Index a = t[(corner + 1) % 3], b = t[(corner + 2) % 3];
            as_they_are_.push_back(
                {f, a == except ? no_index : a, b == except ? no_index : b, complex.normal(f), 1});
        });
        return folds_between(as_they_are_, least);
    }

    // Folds among the edges from the vertex in hand to corners of exactly two of its faces.
    std::uint32_t folds_between(const std::vector<TurnedFace>& sides, double least) {
        if (are_within_one_cone(sides, least)) return 0;
        ends_.clear();
        for (const TurnedFace& side : sides) {
            // Faces of one winding have an edge at different places.
            add_end(side.a, side.normal);
            add_end(side.b, -side.normal);
        }
        std::uint32_t folds = 0;
        for (const End& end : ends_) {
            mark_[end.vertex] = 0;
            folds += end.faces == 2 && -end.first.dot(end.last) < least;
        }
        return folds;
    }

    void add_end(Index vertex, const Vector3& normal) {
        if (vertex == no_index) return;
        std::uint32_t& at = mark_[vertex];
        if (at == 0) {
            ends_.push_back({vertex, 0, normal, normal});
            at = static_cast<std::uint32_t>(ends_.size());
        }
        End& end = ends_[at - 1];
        end.last = normal;
        ++end.faces;
    }

    // Two normals at angles below x from a third are less than 2 x apart: cos 2x = 2 cos^2 x - 1. Only
    // windings that disagree could make a fold of such.
    static bool are_within_one_cone(const std::vector<TurnedFace>& sides, double least) {
        Vector3 sum = Vector3::Zero();
        for (const TurnedFace& side : sides) sum += side.normal;
        const double limit = std::sqrt(0.5 * (1 + least)) * sum.norm();
        for (const TurnedFace& side : sides) {
            if (!(side.normal.dot(sum) > limit)) return false;
        }
        return true;
    }

    struct End {
        Index vertex;
        std::uint32_t faces;
        Vector3 first, last;  ///< normals of its faces, turned over where the vertex in hand comes after it
    };
    std::vector<TurnedFace> as_they_are_;
    std::vector<End> ends_;
    std::vector<std::uint32_t> mark_;  // 1 + place in ends_, while counting; else 0
};

}  // namespace engine
FAQEM_NAMESPACE_END
