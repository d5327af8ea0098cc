#pragma once
/// \file
/// The surface as it was, for the metric that tracks its distance.

#include "bvh.hpp"
#include "faqem/engine/tracked.hpp"

namespace faqem::detail {

/// Distances to the faces of a tree, which it borrows.
class OriginalTree {
public:
    explicit OriginalTree(const Bvh& tree) : tree_(tree) {}

    /// Squared distance of p, or `at_most` where that is smaller.
    double squared_distance(const engine::Vector3& p, double at_most) const {
        const Bvh::Hit hit = tree_.closest(engine::to_array(p), at_most);
        return hit.face == no_index ? at_most : hit.distance_squared;
    }

private:
    const Bvh& tree_;
};

static_assert(engine::OriginalSurface<OriginalTree>);

}  // namespace faqem::detail
