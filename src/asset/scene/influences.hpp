#pragma once
/// \file
/// Joint influences of a vertex, of which a part stores four.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "faqem/mesh.hpp"

namespace faqem::detail {

/// The influences of a vertex: each joint once, with the sum of its weights.
class Influences {
public:
    /// Adds a weight to that of a joint. Weights that are not above 0 are ignored.
    void add(std::uint16_t joint, double weight) {
        if (!(weight > 0)) return;
        const auto found = std::ranges::find_if(all_, [&](const Influence& x) { return x.joint == joint; });
        if (found == all_.end())
            all_.push_back({joint, weight});
        else
            found->weight += weight;
    }

    /// Sets the four joints with the largest weights, of equal ones the lower joints, in descending order of weight; the
    /// weights are scaled to the sum 1. Unused entries, and all if there is no influence, are 0. Removes all influences.
    /// \return the share of the weights that was left out, in [0, 1)
    double take_heaviest(std::array<std::uint16_t, 4>& joints, Vec4f& weights) {
        std::ranges::sort(all_, [](const Influence& a, const Influence& b) {
            return a.weight != b.weight ? a.weight > b.weight : a.joint < b.joint;
        });
        joints = {};
        weights = {};
        double sum = 0, left_out = 0;
        for (std::size_t k = 0; k < all_.size(); ++k) (k < joints.size() ? sum : left_out) += all_[k].weight;
        for (std::size_t k = 0; k < std::min(all_.size(), joints.size()); ++k) {
            joints[k] = all_[k].joint;
            weights[k] = static_cast<float>(all_[k].weight / sum);
        }
        all_.clear();
        return left_out > 0 ? left_out / (sum + left_out) : 0;
    }

private:
    struct Influence {
        std::uint16_t joint;
        double weight;
    };
    std::vector<Influence> all_;
};

}  // namespace faqem::detail
