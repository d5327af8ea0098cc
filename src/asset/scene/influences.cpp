#include "asset/scene/influences.hpp"

#include <algorithm>
#include <cstddef>

namespace faqem::detail {

void Influences::add(std::uint16_t joint, double weight) {
    if (!(weight > 0)) return;
    const auto found = std::ranges::find_if(all_, [&](const Influence& x) { return x.joint == joint; });
    if (found == all_.end())
        all_.push_back({joint, weight});
    else
        found->weight += weight;
}

double Influences::take_heaviest(std::array<std::uint16_t, 4>& joints, Vec4f& weights) {
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

}  // namespace faqem::detail
