#include "bake/scene/parts_error_bound_search.hpp"

#include <algorithm>

namespace faqem::detail {

MeasuredParts::MeasuredParts(const Asset& source, const Options& options, Poll poll)
    : options_(options), size_(scene_size(source)) {
    for (std::size_t p = 0; p < source.parts.size(); ++p) {
        const Part& part = source.parts[p];
        originals_.emplace_back(MeshView{part.positions, part.triangles},
                                part_options(options, size_, size_.scales[p]), poll);
        faces_ += part.triangles.size();
    }
}

Distance MeasuredParts::operator()(const SmallParts& small, double allowed, Look look, Poll poll) const {
    Distance most;
    for (std::size_t p = 0; p < originals_.size(); ++p) {
        const PartScale& scale = size_.scales[p];
        if (originals_[p].surface().triangles.empty() || !(scale.most > 0)) continue;
        const Distance own =
            distance(originals_[p], small.parts[p], allowed / scale.most, look, options_, poll);
        most.value = std::max(most.value, own.value > 0 ? own.value * scale.least : 0);
        most.bound = std::max(most.bound, own.bound > 0 ? own.bound * scale.most : 0);
        most.unsettled += own.unsettled;
    }
    return most;
}

SmallParts simplify_parts_within(const Asset& source, const Options& options) try {
    const AskMeanwhile meanwhile(options, 0);
    const MeasuredParts measured(source, options, meanwhile.poll());
    const double allowed = measured.size()(*options.max_error);
    return run_within<SmallParts>(
        options, measured.faces(), allowed, [&](const Options& own) { return simplify_parts(source, own); },
        [&](const SmallParts& small, Look look, Poll poll) { return measured(small, allowed, look, poll); });
} catch (const engine::Cancelled&) {
    SmallParts nothing = cancelled<SmallParts>();
    nothing.parts.resize(source.parts.size());
    return nothing;
}

}  // namespace faqem::detail
