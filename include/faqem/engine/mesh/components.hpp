#pragma once
/// \file
/// Connected components of a complex.

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "faqem/export.hpp"
#include "faqem/engine/mesh/triangle_soup.hpp"
#include "faqem/engine/mesh/degenerate.hpp"

FAQEM_NAMESPACE_BEGIN
namespace engine {

/// A set of faces joined by shared vertices.
struct Component {
    std::vector<Index> faces;  ///< ascending
    Eigen::AlignedBox3d box;
};

/// Components of the living faces, ordered by their smallest face. O(faces)
/// \throws what the poll throws
inline std::vector<Component> components(const Complex& complex, Poll poll = {}) {
    std::vector<Component> found;
    std::vector<std::uint8_t> seen(complex.face_slots(), 0), is_done(complex.vertex_slots(), 0);
    std::vector<Index> stack;
    for (Index seed = 0; seed < complex.face_slots(); ++seed) {
        if (!complex.alive(seed) || seen[seed]) continue;
        Component component;
        seen[seed] = 1;
        stack.push_back(seed);
        while (!stack.empty()) {
            const Index f = stack.back();
            stack.pop_back();
            poll();
            component.faces.push_back(f);
            for (const Index v : complex.triangle(f)) {
                if (std::exchange(is_done[v], std::uint8_t{1})) continue;
                component.box.extend(complex.position(v));
                complex.for_each_face(v, [&](Index g, unsigned) {
                    if (!seen[g]) seen[g] = 1, stack.push_back(g);
                });
            }
        }
        std::sort(component.faces.begin(), component.faces.end(), polled_less(poll));
        found.push_back(std::move(component));
    }
    return found;
}

/// Components that may be deleted, smallest box first: all but the largest, without those that hold a locked
/// vertex or are larger than asked for. What has no area will not be missed: it has no size. O(faces)
/// \param locked            one per vertex slot: nonzero must stay
/// \param largest_diagonal  of the boxes; engine units
/// \throws what the poll throws
inline std::vector<Component> expendable_components(const Complex& complex,
                                                    std::span<const std::uint8_t> locked,
                                                    double largest_diagonal, Poll poll = {}) {
    std::vector<Component> all = components(complex, poll);
    for (Component& c : all) {
        const bool is_line =
            std::all_of(c.faces.begin(), c.faces.end(), [&](Index f) { return is_degenerate(complex, f); });
        if (is_line) c.box = Eigen::AlignedBox3d(c.box.min());
    }
    const auto diagonal = [](const Component& c) { return c.box.diagonal().norm(); };
    std::stable_sort(all.begin(), all.end(),
                     [&](const Component& a, const Component& b) { return diagonal(a) < diagonal(b); });
    if (!all.empty()) all.pop_back();
    const auto has_locked = [&](Index f) {
        const Triangle& t = complex.triangle(f);
        return locked[t[0]] || locked[t[1]] || locked[t[2]];
    };
    std::erase_if(all, [&](const Component& c) {
        return !(diagonal(c) <= largest_diagonal) || std::any_of(c.faces.begin(), c.faces.end(), has_locked);
    });
    return all;
}

}  // namespace engine
FAQEM_NAMESPACE_END
