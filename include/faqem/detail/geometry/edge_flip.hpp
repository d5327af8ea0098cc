#pragma once
/// \file
/// Edge flip: replaces the common edge of two triangles by the other diagonal of their quadrilateral.

#include <cstddef>
#include <optional>

#include "faqem/export.hpp"
#include "faqem/mesh.hpp"

FAQEM_DETAIL_BEGIN

/// The corners of two triangles (a, b, c) and (b, a, d), which share the edge ab.
struct Quadrilateral {
    Index a, b, c, d;

    Triangle first() const { return {a, b, c}; }
    Triangle second() const { return {b, a, d}; }
    Triangle first_flipped() const { return {a, d, c}; }
    Triangle second_flipped() const { return {b, c, d}; }
};

/// Finds the quadrilateral that two triangles form.
/// \return nullopt unless the triangles share exactly one edge, have consistent orientation there and have
///         different opposite corners. O(1)
inline std::optional<Quadrilateral> quadrilateral(const Triangle& s, const Triangle& t) {
    std::optional<Quadrilateral> found;
    for (std::size_t k = 0; k < 3; ++k) {
        for (std::size_t l = 0; l < 3; ++l) {
            const Quadrilateral q{s[k], s[(k + 1) % 3], s[(k + 2) % 3], t[(l + 2) % 3]};
            if (t[l] != q.b || t[(l + 1) % 3] != q.a) continue;
            if (found || q.a == q.b || q.c == q.d) return std::nullopt;
            found = q;
        }
    }
    return found;
}

/// Flips the edge that s and t share. The winding is kept.
/// \return false, with s and t unchanged, if they form no quadrilateral(). O(1)
inline bool flip_edge(Triangle& s, Triangle& t) {
    const std::optional<Quadrilateral> q = quadrilateral(s, t);
    if (!q) return false;
    s = q->first_flipped();
    t = q->second_flipped();
    return true;
}

FAQEM_DETAIL_END
