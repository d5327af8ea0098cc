#include "scene/parts/parts_error_bound_search.hpp"

#include <algorithm>

#include "faqem/detail/simplify/run.hpp"
#include "faqem/error.hpp"
#include "scene/motion.hpp"
#include "scene/parts/simplify_parts.hpp"
#include "scene/position_grids.hpp"

namespace faqem::detail {

ReferenceParts::ReferenceParts(const Asset& source, const Options& options, const RunContext& context)
    : options_(options),
      precision_(result_precision(source, options.format)),
      size_(scene_size(source)),
      rounding_(position_grids(source, options).max_distance()) {
    for (std::size_t p = 0; p < source.parts.size(); ++p) {
        const Part& part = source.parts[p];
        originals_.emplace_back(MeshView{part.positions, part.triangles},
                                part_options(options, size_, size_.scales[p]), context);
        faces_ += part.triangles.size();
    }
}

// In units of the part. Throws if rounding alone may exceed it.
double ReferenceParts::allowed_for(std::size_t part, double allowed) const {
    if (!(rounding_ < allowed))
        throw OptionError("max_error: rounding of positions alone may move them by " +
                          std::to_string(rounding_) + ", " + std::to_string(allowed) +
                          " is allowed; quantize must be off, or position_bits larger");
    const double scale = size_.scales[part].largest;
    return (allowed - rounding_) / (scale > 0 ? scale : 1);
}

std::optional<SimplifyResult> ReferenceParts::run_within(std::size_t part, const MeshView& view,
                                                         double allowed, Simplified what,
                                                         const Options& options,
                                                         const RunContext& context) const {
    const double own = allowed_for(part, allowed);
    FarFaceSearch search(originals_[part], own);
    return detail::run_within(
        view, own,
        [&](const TriangleMesh& result) {
            std::vector<Vec3> rounded = result.positions;
            round_positions(precision_, result.triangles, rounded);
            std::vector<FarFaces> far = search({rounded, result.triangles}, context.untimed());
            for (FarFaces& place : far)
                if (what == Simplified::finer_level) place.original = no_index;
            return far;
        },
        options, context);
}

MeasuredDistance ReferenceParts::operator()(const SimplifiedParts& simplified, double allowed,
                                            MeasureMode mode, const RunContext& context) const {
    MeasuredDistance most;
    for (std::size_t p = 0; p < originals_.size(); ++p) {
        const PartScale& scale = size_.scales[p];
        if (originals_[p].surface().triangles.empty() || !(scale.largest > 0)) continue;
        const MeasuredDistance own =
            distance(originals_[p], simplified.parts[p], allowed_for(p, allowed), mode, options_, context);
        most.value = std::max(most.value, own.value > 0 ? own.value * scale.smallest : 0);
        most.bound = std::max(most.bound, own.bound > 0 ? own.bound * scale.largest : 0);
        most.undecided_count += own.undecided_count;
    }
    most.value = std::max(0.0, most.value - rounding_);
    most.bound += rounding_;
    return most;
}

RunWithin<SimplifiedParts> parts_within(const Asset& source, const ReferenceParts& measured,
                                        const Options& options, Simplified what) {
    // A part that is flat at rest is simplified in another shape than it is measured in.
    if (!refuses_collapses(options) || std::ranges::any_of(source.parts, has_displacements)) return {};
    return [&, what](double allowed, const Options& own, const RunContext& context) {
        return simplify_each_part(source, own, context,
                                  [&](std::size_t p, const MeshView& view, const Options& of_part_options,
                                      const RunContext& of_part) {
                                      return measured.run_within(p, view, allowed, what, of_part_options,
                                                                 of_part);
                                  });
    };
}

SimplifiedParts simplify_parts_within_error(const Asset& source, const Options& options,
                                            const RunContext& context) {
    context.show(Phase::simplify, 0);
    const ReferenceParts measured(source, options, context.untimed());
    const double allowed = measured.size()(*options.max_error);
    std::vector<LevelTarget> found;
    if (options.target.kind == Target::Kind::unset) found.resize(1);
    return search_within_error<SimplifiedParts>(
        options, context, measured.faces(), allowed,
        [&](const Options& own, const RunContext& of_run) {
            return simplify_welded_parts(source, own, of_run, found);
        },
        [&](const SimplifiedParts& simplified, MeasureMode mode, const RunContext& of_measurement) {
            return measured(simplified, allowed, mode, of_measurement);
        },
        parts_within(source, measured, options));
}

}  // namespace faqem::detail
