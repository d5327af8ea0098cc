#include "bake/onto/pair_parts.hpp"

#include "asset/scene/part_arrays.hpp"

namespace faqem::detail {
namespace {

using Box = Eigen::AlignedBox3d;

constexpr double min_common_share = 0.5;

// Share of the volume of two boxes that is common. Flat boxes count as thin ones.
double common_share(Box a, Box b) {
    const double margin = 1e-3 * a.merged(b).diagonal().norm();
    for (Box* box : {&a, &b}) *box = Box(box->min().array() - margin, box->max().array() + margin);
    const Box both = a.intersection(b);
    return both.isEmpty() ? 0 : both.volume() / (a.volume() + b.volume() - both.volume());
}

}  // namespace

FacePairs pair_parts(const BoxedParts& source, const BoxedParts& target) {
    if (source.names.size() < 2 || target.names.size() < 2) return {};
    std::vector<Index> of_source(source.names.size(), 0), of_target(target.names.size(), 0);
    for (std::size_t s = 0; s < of_source.size(); ++s) {
        double best = min_common_share;
        for (std::size_t t = 0; t < of_target.size(); ++t) {
            double share = common_share(source.boxes[s], target.boxes[t]);
            if (share > 0 && !source.names[s].empty() && source.names[s] == target.names[t]) share += 1;
            if (!(share > best)) continue;
            best = share;
            of_source[s] = static_cast<Index>(t + 1);
        }
        if (of_source[s] != 0) of_target[of_source[s] - 1] = of_source[s];
    }
    return {gather(of_source, source.of_face), gather(of_target, target.of_face)};
}

}  // namespace faqem::detail
