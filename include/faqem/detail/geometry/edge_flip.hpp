#pragma once
/// \file
/// The edge flip: two triangles trade the diagonal of their quadrilateral.

#include <cstddef>
#include <optional>

#include "faqem/export.hpp"
#include "faqem/mesh.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

/// The corners of triangles (a, b, c) and (b, a, d).
struct Quadrilateral {
    Index a, b, c, d;

    Triangle first() const { return {a, b, c}; }
    Triangle second() const { return {b, a, d}; }
    Triangle first_flipped() const { return {a, d, c}; }
    Triangle second_flipped() const { return {b, c, d}; }
};

/// Nothing where the triangles do not share one edge alone, or are wound differently.
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

/// Swaps the edge that s and t share. \return false: they share none that can be, and nothing happens
inline bool flip_edge(Triangle& s, Triangle& t) {
    const std::optional<Quadrilateral> q = quadrilateral(s, t);
    if (!q) return false;
    s = q->first_flipped();
    t = q->second_flipped();
    return true;
}

}  // namespace detail
FAQEM_NAMESPACE_END
