#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "asset/scene/messages.hpp"
#include "asset/scene/part_arrays.hpp"
#include "asset/scene/position_rounding.hpp"
#include "asset/scene/source_traits.hpp"
#include "faqem/detail/simplify/budget_by_cost.hpp"
#include "faqem/detail/simplify/error_bound_search.hpp"
#include "faqem/detail/simplify/presets.hpp"
#include "faqem/detail/simplify/run.hpp"
#include "scene/check_asset.hpp"
#include "scene/layers.hpp"
#include "scene/material_groups.hpp"
#include "scene/motion.hpp"
#include "scene/parts/face_budget.hpp"
#include "scene/parts/part_reports.hpp"
#include "scene/parts/parts_error_bound_search.hpp"
#include "scene/parts/simplify_parts.hpp"
#include "scene/resolved_options.hpp"
#include "scene/scene_size.hpp"
#include "scene/weights/contrast.hpp"
#include "scene/weights/hidden_surface.hpp"
#include "scene/weights/visibility.hpp"
#include "scene/welded_source.hpp"

namespace faqem {
namespace detail {
namespace {

// UVs and vertex colours of a part as corner attributes.
CornerAttributes corner_attributes(const Part& part) {
    CornerAttributes result;
    result.width = static_cast<std::uint32_t>(2 * part.uvs.size() + (part.colors.empty() ? 0 : 4));
    result.values.reserve(3 * part.triangles.size() * result.width);
    for (const Triangle& t : part.triangles) {
        for (Index v : t) {
            for (const auto& uvs : part.uvs)
                result.values.insert(result.values.end(), uvs[v].begin(), uvs[v].end());
            if (part.colors.empty()) continue;
            result.values.insert(result.values.end(), part.colors[v].begin(), part.colors[v].end());
        }
    }
    return result;
}

// By face: the material group or, without groups, the material. Empty if all are equal.
std::vector<Index> face_groups(const Part& part, const std::optional<MaterialGroups>& groups) {
    std::vector<Index> result;
    for (std::size_t f = 0; f < part.triangles.size(); ++f) {
        const Index material = face_material(part, f);
        result.push_back(groups ? groups->group_of(material) : material);
    }
    const bool one = std::ranges::all_of(result, [&](Index g) { return g == result.front(); });
    return one ? std::vector<Index>{} : result;
}

// The groups of each object that is a part of its own, so that boundaries between objects are those of groups.
std::vector<Index> separate_objects(const Part& part, std::vector<Index> groups) {
    if (part.object_parts.empty()) return groups;
    std::map<std::pair<Index, Index>, Index> number;
    groups.resize(part.triangles.size(), 0);
    for (std::size_t f = 0; f < groups.size(); ++f)
        groups[f] = number.try_emplace({groups[f], part.face_object[f]}, static_cast<Index>(number.size()))
                        .first->second;
    return groups;
}

// A part as the input of the engine. Materials that are baked into one page form one group, so that
// boundaries between them need no faces and samples can cross them; only coincident faces of different
// appearance are separated. Otherwise, and if group boundaries are to be preserved, the groups are the materials.
struct PartInput {
    std::vector<Index> groups;
    CornerAttributes attributes;
    std::vector<Triangle> welded;  // if vertices at one position move apart: the triangles after the weld
    MeshView view;

    // Sets the weld of the options to none if the part is welded here.
    PartInput(const Asset& source, const Part& part, const std::optional<MaterialGroups>& material_groups,
              bool keeps_uvs, std::span<const float> weights, Options& own)
        : groups(face_groups(part, material_groups)) {
        if (material_groups) groups = separate_coincident_faces(part, std::move(groups));
        groups = separate_objects(part, std::move(groups));
        if (keeps_uvs) attributes = corner_attributes(part);
        if (own.topology.weld != Weld::none)
            welded = welded_by_motion(part, motion_rounding(source, part), settings(own).weld_distance);
        if (!welded.empty()) own.topology.weld = Weld::none;
        view = {part.positions, welded.empty() ? part.triangles : welded, groups, nullptr, {}, weights};
        if (attributes.width) view.attributes = &attributes;
    }
    PartInput(const PartInput&) = delete;
};

// Factors on costs by part and vertex. Empty: 1, also for one part.
using VertexWeights = std::vector<std::vector<float>>;

// Simplification of all parts to all targets.
class PartsRun {
public:
    PartsRun(const Asset& source, const Options& options, const RunContext& context,
             std::span<const LevelTarget> levels = {}, std::optional<VertexWeights> weights = {})
        : source_(source),
          options_(options),
          context_(context),
          levels_(levels),
          weights_(std::move(weights)),
          precision_(result_precision(source, options.format)) {
        const Bake kind = options.bake.kind;
        const bool merged = kind != Bake::keep && kind != Bake::none;
        if (merged) groups_ = group_materials(source, options.bake);
        has_own_uvs_ = parts_with_own_uvs(source, options.bake);
        if (options.topology.prune)
            size_ = scene_size(source);
        else
            size_.scales.resize(source.parts.size());
        faces_ = static_cast<double>(face_count(source));
    }

    /// Factors on the costs, once it has run.
    const VertexWeights& weights() const { return *weights_; }

    std::vector<SimplifiedParts> operator()(std::span<const std::uint64_t> targets) {
        begin(targets.size(), targets.back());
        std::vector<SimplifiedParts> results = run(budgets(targets));
        for (std::size_t i = 0; i < shares_.size(); ++i)
            warn_of_small_shares(source_, shares_[i], results[i]);
        return results;
    }

    /// Simplifies all parts to given face counts, by part.
    SimplifiedParts to_face_counts(std::span<const std::uint64_t> counts) {
        begin(1, std::accumulate(counts.begin(), counts.end(), std::uint64_t{0}));
        std::vector<std::vector<std::uint64_t>> share;
        for (const std::uint64_t count : counts) share.push_back({count});
        return std::move(run(share).front());
    }

    /// Simplifies each part with a function. \return nothing if it returned nothing for a part
    std::optional<SimplifiedParts> with(const SimplifyPart& simplify) {
        begin(1, 0);
        bool is_complete = true;
        std::vector<SimplifiedParts> results = run_parts(
            [&](std::size_t p, const MeshView& view, const Options& own, const RunContext& of_part) {
                std::vector<SimplifyResult> result(1);
                std::optional<SimplifyResult> found;
                if (is_complete) found = simplify(p, view, own, of_part);
                is_complete = found.has_value();
                if (found) result.front() = std::move(*found);
                return result;
            });
        return is_complete ? std::optional(std::move(results.front())) : std::nullopt;
    }

private:
    // \param fewest_faces  of a level; 0: unknown
    void begin(std::size_t levels, std::uint64_t fewest_faces) {
        results_.resize(levels);
        for (SimplifiedParts& level : results_) {
            level.parts.resize(source_.parts.size());
            level.report.preset = options_.preset;
        }
        if (!weights_) compute_weights(static_cast<double>(fewest_faces) / faces_);
    }

    std::vector<SimplifiedParts> run(const std::vector<std::vector<std::uint64_t>>& share) {
        return run_parts(
            [&](std::size_t p, const MeshView& view, const Options& own, const RunContext& of_part) {
                Options of_result = own;
                if (is_fitted(source_.parts[p], view, share[p])) of_result.preset = Preset::best;
                return simplify_part(source_.parts[p], view, share[p], of_result, of_part);
            });
    }

    // Whether a part is simplified as by preset best. Not with kept attributes, which belong to the places that vertices
    // would leave.
    bool is_fitted(const Part& part, const MeshView& view, const std::vector<std::uint64_t>& targets) const {
        return options_.preset == Preset::balanced && !options_.max_error && !source_.images.empty() &&
               !view.attributes && targets.front() <= most_fitted_faces &&
               part.triangles.size() <= most_faces_to_fit && targets.back() < part.triangles.size();
    }

    // Simplifies each part with a function that returns one result for each of results_.
    template <class Simplify>
    std::vector<SimplifiedParts> run_parts(Simplify&& simplify) {
        for_each_part([&](std::size_t p, const MeshView& view, Options& own, const RunContext& of_part) {
            own.history = Recording::on;
            std::vector<SimplifyResult> results = simplify(p, view, own, of_part);
            if (results.back().report.stop == StopReason::cancelled) throw engine::Cancelled{};
            for (std::size_t i = 0; i < results.size(); ++i) {
                results_[i].parts[p] = std::move(results[i]);
                if (groups_) restore_face_groups(p, results_[i].parts[p]);
            }
        });
        for (SimplifiedParts& level : results_) finish(level);
        return std::move(results_);
    }

    // What concerns all parts together, and the report.
    void finish(SimplifiedParts& level) const {
        const Stopwatch watch;
        if (separates_layers(source_, options_))
            context_.in_time([&] { separate_layers(source_, level.parts, context_); });
        for (std::size_t p = 0; p < source_.parts.size(); ++p) {
            if (source_.parts[p].triangles.empty()) continue;
            round_result(level.parts[p]);
            add_part_report(level.report, level.parts[p].report, part_title(source_, p));
        }
        report_removed_components(source_, level);
        if (level.report.stop == StopReason::reached_time_limit)
            level.report.warnings.push_back("max_seconds was over before the target was reached");
        level.report.seconds.simplify += watch.seconds();
        level.report.seconds.total = level.report.seconds.simplify;
    }

    // Rounds the positions as the file will have them, so that this is what is measured.
    void round_result(SimplifyResult& result) const {
        const std::vector<Vec3> before = result.mesh.positions;
        round_positions(precision_, result.mesh.triangles, result.mesh.positions);
        if (result.mesh.positions != before) result.history.final_positions = result.mesh.positions;
    }

    // run_to_targets(), with a hint of its shape for a part that is flat at rest and not in a morph target.
    static std::vector<SimplifyResult> simplify_part(const Part& part, MeshView view,
                                                     const std::vector<std::uint64_t>& targets,
                                                     const Options& own, const RunContext& context) {
        std::vector<Vec3> bent;
        if (has_displacements(part)) bent = bent_positions(part, view, own, context, targets.front());
        if (!bent.empty()) view.positions = bent;
        return run_to_targets(view, targets, own, context);
    }

    void compute_weights(double share) {
        const Stopwatch watch;
        context_.show(Phase::simplify, 0);
        weights_.emplace();
        context_.in_time([&] {
            if (options_.visibility == Visibility::weighted)
                return use_visibility(vertex_visibility(source_, context_));
            if (!is_weighted_by_pictures(source_, options_)) return;
            weights_ = contrast_weights(source_, context_);
            // What has no textures is measured rather than looked at.
            if (options_.visibility == Visibility::automatic && !source_.images.empty())
                report_hidden(lower_hidden_weights(source_, share, *weights_, context_));
        });
        results_.front().report.seconds.simplify += watch.seconds();
    }

    void use_visibility(VertexVisibility seen) {
        weights_ = std::move(seen.weights);
        if (const std::string warning = visibility_warning(source_); !warning.empty())
            for (SimplifiedParts& level : results_) level.report.warnings.push_back(warning);
        report_hidden(seen.hidden_vertices);
    }

    void report_hidden(std::uint64_t vertices) {
        for (SimplifiedParts& level : results_) level.report.vertices_hidden = vertices;
    }

    // Face counts by part and target; in descending order for every part.
    std::vector<std::vector<std::uint64_t>> budgets(std::span<const std::uint64_t> targets) {
        const Stopwatch watch;
        const auto filled =
            std::ranges::count_if(source_.parts, [](const Part& part) { return !part.triangles.empty(); });
        // Without a target below the number of faces there is nothing to distribute.
        bool by_cost =
            options_.budget == Budget::scene && filled >= 2 && static_cast<double>(targets.back()) < faces_;
        if (by_cost) by_cost = compute_cost_curves(targets.front());
        std::vector<std::vector<std::uint64_t>> result(source_.parts.size());
        for (std::size_t i = 0; i < targets.size(); ++i) {
            const std::uint64_t target_faces = std::min(targets[i], static_cast<std::uint64_t>(faces_));
            const std::vector<std::uint64_t> share = by_cost ? budget_by_cost(target_faces, is_asked_for(i))
                                                             : budget_by_faces(source_, target_faces);
            for (std::size_t p = 0; p < share.size(); ++p)
                result[p].push_back(result[p].empty() ? share[p] : std::min(share[p], result[p].back()));
        }
        curves_.clear();
        results_.front().report.seconds.simplify += watch.seconds();
        return result;
    }

    bool is_asked_for(std::size_t target) const { return levels_.empty() || levels_[target].faces; }

    std::vector<std::uint64_t> budget_by_cost(std::uint64_t target_faces, bool has_floors) {
        std::vector<double> shares;
        if (has_floors) shares = proportional_shares(source_, target_faces, *weights_);
        std::vector<std::uint64_t> floors;
        for (const double share : shares)
            floors.push_back(static_cast<std::uint64_t>(std::ceil(min_share * share)));
        shares_.push_back(std::move(shares));
        return distribute_face_budget(curves_, cost_weights_, target_faces, floors);
    }

    // Returns false if the time is over; then there are no curves.
    bool compute_cost_curves(std::uint64_t target) {
        passes_ = 2;
        curves_.resize(source_.parts.size());
        for_each_part(
            [&](std::size_t p, const MeshView& view, const Options& own, const RunContext& of_part) {
                const Part& part = source_.parts[p];
                curves_[p] = cost_curve(view, own, of_part);
                if (has_displacements(part)) {
                    const double share =
                        static_cast<double>(part.triangles.size()) * static_cast<double>(target) / faces_;
                    curves_[p] = curve_in_motion(std::move(curves_[p]), part, view, own, of_part,
                                                 static_cast<std::uint64_t>(share));
                }
                if (curves_[p].stop == StopReason::cancelled) throw engine::Cancelled{};
            });
        cost_weights_ = cost_weights(curves_.size(), seen_instances(source_));
        return !context_.is_late();
    }

    bool keeps_groups() const { return options_.topology.group_boundaries == GroupBoundaries::preserved; }

    // Restores the material groups, which determine the pages. The groups for the simplification also
    // separate coincident faces and, with preserved boundaries, materials.
    void restore_face_groups(std::size_t p, SimplifyResult& result) const {
        result.history.face_groups = face_groups(source_.parts[p], groups_);
        result.mesh.face_groups = gather(result.history.face_groups, result.face_origin);
    }

    // Calls work(part, view, options, context) for every part with faces.
    template <class Work>
    void for_each_part(Work&& work) {
        for (std::size_t p = 0; p < source_.parts.size(); ++p) {
            const Part& part = source_.parts[p];
            if (part.triangles.empty()) continue;
            const double size = static_cast<double>(part.triangles.size());
            Options own = part_options(options_, size_, size_.scales[p]);
            // Materials that stay apart are not mixed on flat surfaces.
            GroupBoundaries& boundaries = own.topology.group_boundaries;
            if (boundaries == GroupBoundaries::free) boundaries = GroupBoundaries::preferred;
            const RunContext of_part = context_.step(Phase::simplify, done_ / (passes_ * faces_),
                                                     (done_ + size) / (passes_ * faces_));
            const auto& groups = keeps_groups() ? std::nullopt : groups_;
            const std::span<const float> weights =
                weights_->empty() ? std::span<const float>() : (*weights_)[p];
            const bool keeps_uvs = options_.bake.kind == Bake::keep || has_own_uvs_[p];
            const PartInput input(source_, part, groups, keeps_uvs, weights, own);
            work(p, input.view, own, of_part);
            done_ += size;
        }
    }

    const Asset& source_;
    const Options& options_;
    const RunContext& context_;
    std::optional<MaterialGroups> groups_;
    std::vector<std::uint8_t> has_own_uvs_;  // by part
    std::vector<SimplifiedParts> results_;
    std::span<const LevelTarget> levels_;  // see simplify_parts_to_targets()
    std::optional<VertexWeights> weights_;
    StoredPrecision precision_;                // to which results are rounded
    std::vector<std::vector<double>> shares_;  // by target: of proportional_shares(), or empty
    std::vector<CostCurve> curves_;
    std::vector<double> cost_weights_;  // by part
    SceneSize size_;
    double faces_ = 0;   // of all parts
    double done_ = 0;    // faces of the parts that are finished, in all passes
    double passes_ = 1;  // number of passes over all parts
};

}  // namespace

std::vector<SimplifiedParts> simplify_parts_to_targets(const Asset& source,
                                                       std::span<const std::uint64_t> targets,
                                                       const Options& options, const RunContext& context,
                                                       std::span<const LevelTarget> levels) {
    return PartsRun(source, options, context, levels)(targets);
}

namespace {

// Whether a new atlas could have images: for textures, vertex colours, or several materials on one page.
bool has_appearance(const Asset& source) {
    return !source.images.empty() || source.materials.size() > 1 || some_part_has(source, &Part::colors);
}

// Simplifies all parts again, with UVs, to the face counts that they have.
void add_parts_with_uvs(const Asset& source, Options own, const RunContext& context,
                        const VertexWeights& weights, SimplifiedParts& simplified) {
    own.bake.kind = Bake::keep;
    std::vector<std::uint64_t> counts;
    for (const SimplifyResult& part : simplified.parts) counts.push_back(part.mesh.triangles.size());
    SimplifiedParts with_uvs = PartsRun(source, own, context, {}, weights).to_face_counts(counts);
    simplified.report.seconds.simplify += with_uvs.report.seconds.simplify;
    simplified.report.seconds.total += with_uvs.report.seconds.simplify;
    simplified.with_uvs = std::move(with_uvs.parts);
}

}  // namespace

SimplifiedParts simplify_welded_parts(const Asset& source, const Options& options, const RunContext& context,
                                      std::span<const LevelTarget> levels) {
    const std::uint64_t faces = face_count(source);
    const std::uint64_t target = target_face_count(options.target, static_cast<double>(faces));
    // Plain materials are kept anyway.
    const bool tries_uvs = may_keep_uvs(options) && has_appearance(source) &&
                           !has_plain_materials(source, options.bake) && target < faces;
    const RunContext step = context.step(Phase::simplify, 0, tries_uvs ? 0.5 : 1);
    PartsRun run(source, options, step, levels);
    SimplifiedParts result = std::move(run({&target, 1}).front());
    if (tries_uvs && !context.is_late())
        add_parts_with_uvs(source, options, context.step(Phase::simplify, 0.5, 1), run.weights(), result);
    return result;
}

std::optional<SimplifiedParts> simplify_each_part(const Asset& source, const Options& options,
                                                  const RunContext& context, const SimplifyPart& simplify) {
    return PartsRun(source, options, context).with(simplify);
}

std::vector<SimplifiedParts> simplify_parts_in_steps(const Asset& source,
                                                     std::span<const std::uint64_t> targets,
                                                     const Options& requested, const RunContext& context) {
    validate(requested);
    check_asset(source);
    const Options options = resolved_options(source, requested);
    const WeldedSource welded(source, options);
    std::vector<SimplifiedParts> results =
        simplify_parts_to_targets(welded.asset(), targets, options, context);
    for (SimplifiedParts& result : results) welded.add_to(result.report);
    return results;
}

SimplifiedParts simplify_parts(const Asset& source, const Options& requested, const RunContext& context) {
    validate(requested);
    check_asset(source);
    const Options options = resolved_options(source, requested);
    const WeldedSource welded(source, options);
    SimplifiedParts result = options.max_error ? simplify_parts_within_error(welded.asset(), options, context)
                                               : simplify_welded_parts(welded.asset(), options, context);
    welded.add_to(result.report);
    return result;
}

}  // namespace detail

SimplifiedParts simplify_parts(const Asset& source, const Options& options) try {
    return detail::simplify_parts(source, options, detail::RunContext(options));
} catch (const engine::Cancelled&) {
    auto nothing = detail::cancelled_result<SimplifiedParts>();
    nothing.parts.resize(source.parts.size());
    return nothing;
}

}  // namespace faqem
