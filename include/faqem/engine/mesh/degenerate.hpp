#pragma once
/// \file
/// Faces that are as good as a line: what is left of a surface must not be these alone.

#include <algorithm>
#include <cstddef>

#include "faqem/export.hpp"
#include "faqem/engine/mesh/triangle_soup.hpp"
#include "faqem/engine/mesh/pair_table.hpp"

FAQEM_NAMESPACE_BEGIN
namespace engine {

/// Height over longest edge below which a face counts as degenerate.
inline constexpr double degenerate_aspect = 1e-9;

/// \param doubled_area  of a triangle
/// \param to_a, to_b    two of its sides, from one corner
inline bool is_degenerate(double doubled_area, const Vector3& to_a, const Vector3& to_b) {
    const double a = to_a.squaredNorm(), b = to_b.squaredNorm();
    // The third side squared is at most twice their sum: few triangles are worth a closer look.
    if (doubled_area > 2 * degenerate_aspect * (a + b)) return false;
    const double longest = std::max({a, b, (to_b - to_a).squaredNorm()});
    return !(doubled_area > degenerate_aspect * longest);
}

/// \pre f is alive
inline bool is_degenerate(const Complex& complex, Index f) {
    const auto [a, b, c] = complex.triangle(f);
    const Vector3& p = complex.position(a);
    return is_degenerate(2 * complex.area(f), complex.position(b) - p, complex.position(c) - p);
}

/// Knows how many degenerate faces there are at most. No legal collapse makes one (see Legality), so that
/// they only become fewer, and are counted anew only when the others seem to run out.
class DegenerateFaces {
public:
    DegenerateFaces() = default;
    /// O(faces)
    /// \throws what the poll throws
    explicit DegenerateFaces(const Complex& complex, Poll poll = {}) : most_(count(complex, poll)) {}

    /// Do the faces of this pair hold all the area there is? Where nothing has an area: are they all there
    /// are? O(the smaller valence of the pair); O(faces) where nearly all are degenerate
    bool are_all_others(const Complex& complex, const PairTable& pairs, Index pair, Poll poll = {}) {
        if (pairs.face_count(pair) + most_ < complex.face_count()) return false;
        const std::size_t with_area = pairs.face_count(pair) - count_of(complex, pairs, pair);
        if (with_area == 0) return pairs.face_count(pair) >= complex.face_count();
        if (with_area + most_ < complex.face_count()) return false;
        most_ = count(complex, poll);
        return with_area + most_ >= complex.face_count();
    }

    /// To be told before the pair is collapsed. O(the smaller valence of the pair); O(1) if none is degenerate
    void collapsing(const Complex& complex, const PairTable& pairs, Index pair) {
        if (most_ > 0) most_ -= std::min(most_, count_of(complex, pairs, pair));
    }

private:
    static std::size_t count(const Complex& complex, Poll poll) {
        std::size_t count = 0;
        for (Index f = 0; f < complex.face_slots(); ++f) {
            poll();
            count += complex.alive(f) && is_degenerate(complex, f);
        }
        return count;
    }

    static std::size_t count_of(const Complex& complex, const PairTable& pairs, Index pair) {
        std::size_t count = 0;
        const auto [u, v] = complex.by_degree(pairs.first(pair), pairs.second(pair));
        complex.for_each_face(u, [&, v = v](Index f, unsigned) {
            count += complex.has_corner(f, v) && is_degenerate(complex, f);
        });
        return count;
    }

    std::size_t most_ = 0;
};

}  // namespace engine
FAQEM_NAMESPACE_END
