#include "bake/parts_within_error.hpp"

#include <algorithm>
#include <vector>

#include "bake/scene_size.hpp"
#include "within_error.hpp"

namespace faqem::detail {

namespace {

// In the units of the scene, the largest of all parts.
Distance distance(const std::vector<Original>& originals, const SceneSize& size, const SmallParts& small,
                  double allowed, Look look, const Options& options) {
    Distance most;
    for (std::size_t p = 0; p < originals.size(); ++p) {
        const PartScale& scale = size.scales[p];
        if (originals[p].surface().triangles.empty() || !(scale.most > 0)) continue;
        const Distance own =
            detail::distance(originals[p], small.parts[p], allowed / scale.most, look, options);
        most.value = std::max(most.value, own.value > 0 ? own.value * scale.least : 0);
        most.bound = std::max(most.bound, own.bound > 0 ? own.bound * scale.most : 0);
        most.unsettled += own.unsettled;
    }
    return most;
}

}  // namespace

SmallParts simplify_parts_within(const Asset& source, const Options& options) {
    const SceneSize size = scene_size(source);
    const double allowed = size(*options.max_error);
    std::vector<Original> originals;
    std::uint64_t faces = 0;
    for (std::size_t p = 0; p < source.parts.size(); ++p) {
        const Part& part = source.parts[p];
        originals.emplace_back(MeshView{part.positions, part.triangles},
                               part_options(options, size, size.scales[p]));
        faces += part.triangles.size();
    }
    return run_within<SmallParts>(
        options, faces, allowed, [&](const Options& own) { return simplify_parts(source, own); },
        [&](const SmallParts& small, Look look) {
            return distance(originals, size, small, allowed, look, options);
        });
}

}  // namespace faqem::detail
