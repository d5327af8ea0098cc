#pragma once
/// \file
/// The surface as it was, for the metric that tracks its distance.

#include <vector>

#include "bvh.hpp"
#include "faqem/engine/complex.hpp"
#include "faqem/engine/tracked.hpp"

namespace faqem::detail {

/// Distances to a copy of a complex, in its units.
class OriginalTree {
public:
    /// O(n log n), about 140 bytes per face.
    explicit OriginalTree(const engine::Complex& complex) : tree_(positions(complex), triangles(complex)) {}

    /// Squared distance of p, or `at_most` where that is smaller.
    double squared_distance(const engine::Vector3& p, double at_most) const {
        const Bvh::Hit hit = tree_.closest(engine::to_array(p), at_most);
        return hit.face == no_index ? at_most : hit.distance_squared;
    }

private:
    static std::vector<Vec3> positions(const engine::Complex& complex) {
        std::vector<Vec3> all(complex.vertex_slots());
        for (Index v = 0; v < all.size(); ++v) all[v] = engine::to_array(complex.position(v));
        return all;
    }
    static std::vector<Triangle> triangles(const engine::Complex& complex) {
        std::vector<Triangle> all(complex.face_slots());
        for (Index f = 0; f < all.size(); ++f) all[f] = complex.triangle(f);
        return all;
    }

    Bvh tree_;
};

static_assert(engine::OriginalSurface<OriginalTree>);

}  // namespace faqem::detail
