#pragma once
/// \file
/// Connected components of a complex.

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "faqem/engine/complex.hpp"

namespace faqem::engine {

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

}  // namespace faqem::engine
