#include "cli/budget/best_picture.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "asset/scene/rounded_vertices.hpp"
#include "bake/keep/kept_uvs.hpp"
#include "bake/scene/unencoded_result.hpp"
#include "bake/simplify/position_grids.hpp"
#include "bake/simplify/simplify_parts.hpp"
#include "bake/simplify/step_progress.hpp"
#include "cli/budget/budget_choices.hpp"
#include "cli/budget/image_trials.hpp"
#include "cli/budget/search_steps.hpp"
#include "faqem/detail/base/stopwatch.hpp"
#include "faqem/detail/simplify/run.hpp"

namespace faqem::cli {

namespace {

// Shares of the faces that are tried first.
constexpr std::array<double, 7> first_ratios = {1, 0.7, 0.45, 0.28, 0.16, 0.09, 0.045};

// Bits of positions that are tried if none are given; the usual ones first.
constexpr std::array<std::uint32_t, 4> tried_position_bits = {detail::usual_position_bits, 13, 15, 16};

// A choice is made again if all effort makes its images smaller by more than this factor.
constexpr double worthwhile_effort = 0.97;

// Number of choices that are made and compared.
constexpr std::size_t compared_choices = 2;

// How often a choice that is too large is made again with fewer faces, and a factor on the estimated number.
constexpr int most_attempts = 4;
constexpr double face_margin = 0.985;

// What the work reports, as shares of Phase::bake.
constexpr double begin_of_images = 0.2, begin_of_choices = 0.7;

std::uint64_t total_faces(const Asset& asset) {
    std::uint64_t result = 0;
    for (const Part& part : asset.parts) result += part.triangles.size();
    return result;
}

/// One search, see best_picture_within_bytes().
class BestPictureSearch {
public:
    BestPictureSearch(const Asset& source, const Options& options, const ByteBudget& budget)
        : source_(source), steps_(options), budget_(budget), faces_(total_faces(source)) {
        keeps_images_ = options.bake.kind != Bake::automatic;
        if (options.bake.kind == Bake::automatic) {
            options_.bake.kind = Bake::keep;
            options_.bake.untouched = UntouchedParts::baked;  // their images would stay as they are
        }
    }

    std::optional<SimplifiedAsset> operator()() try {
        std::vector<std::uint64_t> targets;
        for (const double share : first_ratios) {
            const std::uint64_t target = detail::target_face_count(ratio(share), static_cast<double>(faces_));
            if (targets.empty() || target < targets.back())
                targets.push_back(std::max(target, detail::min_target_faces));
        }
        std::vector<SimplifiedParts> levels = simplified(targets, Phase::simplify, 0, 1);
        if (steps_.is_late()) return std::nullopt;
        meter_.emplace(source_, detail::Workers{options_.threads});
        try_faces(std::move(levels));
        if (tried_faces_.back().bytes >= budget_.bytes) return std::nullopt;
        images_->try_all(tried_faces_, tried_roundings_, budget_.bytes, begin_of_images, begin_of_choices);
        try_choices();
        return reported_best();
    } catch (const engine::Cancelled& stopped) {
        if (stopped.reason != StopReason::cancelled) return reported_best();
        SimplifiedAsset none;
        none.report.stop = StopReason::cancelled;
        return none;
    }

private:
    std::vector<SimplifiedParts> simplified(std::span<const std::uint64_t> targets, Phase phase, double from,
                                            double to) {
        const detail::Stopwatch watch;
        const Options own =
            phase == Phase::simplify ? detail::step_options(options_, phase, from, to) : steps_.step();
        std::vector<SimplifiedParts> result =
            detail::simplify_parts_in_steps(source_, targets, detail::with_time_left(own, steps_.deadline()));
        seconds_of_simplify_ += watch.seconds();
        if (result.back().report.stop == StopReason::cancelled) throw engine::Cancelled{};
        return result;
    }

    // The result with the images of the source or, if `pending`, with images that are encoded later.
    detail::UnencodedResult made(const SimplifiedParts& parts, bool pending) {
        Options own = steps_.step();
        if (!pending) own.bake.image_format = ImageFormat::source;
        detail::UnencodedResult result = own.bake.kind == Bake::keep
                                             ? detail::bake_with_uvs(source_, parts, own)
                                             : detail::bake_unencoded(source_, parts, own);
        if (result.asset.report.stop == StopReason::cancelled) throw engine::Cancelled{};
        return result;
    }

    // Tries the levels of the first run, and makes the images for all faces.
    void try_faces(std::vector<SimplifiedParts> levels) {
        const Image placeholder = encode_png({1, 1, {0, 0, 0, 255}, false}, "");
        for (std::size_t i = 0; i < levels.size(); ++i) {
            steps_.report(begin_of_images * static_cast<double>(i) / static_cast<double>(levels.size()));
            detail::UnencodedResult result = made(levels[i], i == 0 && !keeps_images_);
            if (i == 0) images_.emplace(result, *meter_, steps_);
            Asset& asset = result.asset.asset;
            const PictureError error = meter_->with_source_images(asset);
            for (Image& image : asset.images) image.encoded = placeholder.encoded;
            tried_faces_.push_back(
                {result.asset.report.faces_out, model_bytes(asset, budget_.file).geometry, error});
            levels[i] = {};
            if (i == 0) try_roundings(asset);
        }
    }

    // Tries bits of positions on all faces. \param asset  with images that are not used
    void try_roundings(Asset& asset) {
        std::vector<std::optional<std::uint32_t>> tried = {options_.quantize.position_bits};
        if (!tried[0]) tried.assign(tried_position_bits.begin(), tried_position_bits.end());
        for (const std::optional<std::uint32_t>& bits : tried) {
            const std::vector<double> last = spacings(asset);
            set_position_bits(asset, bits);
            // Only new grids depend on the bits.
            if (!tried_roundings_.empty() && spacings(asset) == last) break;
            Asset rounded = asset;
            const bool is_rounded = detail::round_vertices(rounded);
            tried_roundings_.push_back(
                {bits, model_bytes(asset, budget_.file).geometry,
                 is_rounded ? meter_->with_source_images(std::move(rounded)) : PictureError{}});
        }
        if (tried_roundings_.size() == 1) tried_roundings_[0].position_bits = options_.quantize.position_bits;
    }

    static std::vector<double> spacings(const Asset& asset) {
        std::vector<double> result;
        for (const Part& part : asset.parts) result.push_back(part.position_spacing);
        return result;
    }

    void set_position_bits(Asset& asset, const std::optional<std::uint32_t>& bits) const {
        Options own = options_;
        own.quantize.position_bits = bits;
        Report unused;
        detail::set_quantization(source_, own, asset, unused);
    }

    std::vector<BudgetChoice> choices() const {
        return budget_choices(tried_faces_, images_->tried(), tried_roundings_, budget_.bytes);
    }

    // The best choices, of which no two have images of the same size.
    std::vector<BudgetChoice> different_choices() const {
        std::vector<BudgetChoice> result;
        for (const BudgetChoice& choice : choices()) {
            const auto is_same_size = [&](const BudgetChoice& other) {
                return images_->tried()[other.images].side == images_->tried()[choice.images].side;
            };
            if (std::any_of(result.begin(), result.end(), is_same_size)) continue;
            result.push_back(choice);
            if (result.size() == compared_choices) break;
        }
        return result;
    }

    void try_choices() {
        double done = 0;
        BudgetChoice best;
        const std::vector<BudgetChoice> all = different_choices();
        for (const BudgetChoice& choice : all) {
            steps_.report(begin_of_choices +
                          (1 - begin_of_choices) * done++ / static_cast<double>(all.size()));
            if (try_choice(choice, detail::ImageEffort::estimate)) best = choice;
        }
        if (best_ && images_->are_encoded()) try_choice(best, detail::ImageEffort::full);
    }

    std::optional<SimplifiedAsset> reported_best() {
        if (!best_) return std::nullopt;
        Report& report = best_->report;
        report.budget_points = points_;
        report.budget_trials = trials();
        report.seconds.simplify = seconds_of_simplify_;
        report.seconds.map = 0;
        report.seconds.bake = std::max(0.0, watch_.seconds() - seconds_of_simplify_);
        return std::move(best_);
    }

    std::vector<BudgetTrial> trials() const {
        std::vector<BudgetTrial> result;
        for (const TriedFaces& tried : tried_faces_)
            result.push_back(
                {BudgetTrialKind::faces, tried.faces, tried.bytes, 0, {}, {}, picture_psnr(tried.error)});
        for (const TriedRounding& tried : tried_roundings_)
            result.push_back({BudgetTrialKind::positions,
                              faces_,
                              tried.bytes,
                              0,
                              {},
                              tried.position_bits,
                              picture_psnr(tried.error)});
        if (!images_->are_encoded()) return result;
        for (const TriedImages& tried : images_->tried())
            result.push_back({BudgetTrialKind::images,
                              faces_,
                              tried.bytes,
                              tried.side,
                              tried.quality,
                              {},
                              picture_psnr(tried.error)});
        return result;
    }

    // Makes the images, and then as many faces as fit.
    // \return whether the result is the best one so far
    bool try_choice(const BudgetChoice& choice, detail::ImageEffort effort) {
        const TriedImages& tried = images_->tried()[choice.images];
        const std::vector<Image> images = images_->encoded(choice.images, effort);
        const std::uint64_t bytes = encoded_bytes(images);
        const bool is_again = effort == detail::ImageEffort::full;
        if (is_again && static_cast<double>(bytes) > worthwhile_effort * static_cast<double>(tried.bytes))
            return false;
        options_.quantize.position_bits = tried_roundings_[choice.rounding].position_bits;
        std::optional<std::uint64_t> faces =
            bytes < budget_.bytes
                ? faces_within(tried_faces_,
                               as_first_rounding(tried_roundings_, choice.rounding, budget_.bytes - bytes))
                : std::nullopt;
        for (int attempt = 0; faces && attempt < most_attempts; ++attempt) {
            steps_.check();
            std::uint64_t target = *faces;
            if (target < faces_)
                target = static_cast<std::uint64_t>(face_margin * static_cast<double>(target));
            const SimplifiedParts parts = std::move(simplified({&target, 1}, Phase::bake, 0, 1).front());
            detail::UnencodedResult result = made(parts, false);
            if (images_->are_encoded()) result.asset.asset.images = images;
            detail::remove_unused_materials(result);
            const ModelBytes size = model_bytes(result.asset.asset, budget_.file);
            if (size.total() > budget_.bytes) {
                const double share =
                    static_cast<double>(budget_.bytes - std::min(budget_.bytes, size.images)) /
                    static_cast<double>(size.geometry);
                faces = static_cast<std::uint64_t>(share * static_cast<double>(target));
                if (*faces < detail::min_target_faces) return false;
                continue;
            }
            return finish(std::move(result), parts, tried, size);
        }
        return false;
    }

    bool finish(detail::UnencodedResult result, const SimplifiedParts& parts, const TriedImages& images,
                const ModelBytes& size) {
        detail::encode_images(result, steps_.step());  // none is pending, but all are reported
        if (result.asset.report.stop == StopReason::cancelled) throw engine::Cancelled{};
        Asset shown = result.asset.asset;
        detail::round_vertices(shown);
        const double psnr = picture_psnr((*meter_)(std::move(shown)));
        points_.push_back({options_.bake.kind, result.asset.report.faces_out, size.total(), images.side,
                           images.quality, options_.quantize.position_bits, psnr});
        if (best_ && !(psnr > best_psnr_)) return false;
        detail::add_histories(parts, options_, result.asset);
        best_ = std::move(result.asset);
        best_psnr_ = psnr;
        return true;
    }

    const Asset& source_;
    SearchSteps steps_;
    Options& options_ = steps_.options();
    const ByteBudget& budget_;
    const std::uint64_t faces_;
    bool keeps_images_ = false;
    detail::Stopwatch watch_;
    double seconds_of_simplify_ = 0;
    std::optional<PictureMeter> meter_;
    std::vector<TriedFaces> tried_faces_;
    std::vector<TriedRounding> tried_roundings_;  // at least one after try_faces()
    std::optional<ImageTrials> images_;           // after try_faces()
    std::vector<BudgetPoint> points_;
    std::optional<SimplifiedAsset> best_;
    double best_psnr_ = 0;
};

}  // namespace

bool leaves_faces_to_budget(const Options& options) {
    if (options.target.kind != Target::Kind::unset || options.max_error) return false;
    const Bake kind = options.bake.kind;
    if (kind == Bake::keep || kind == Bake::vertex || kind == Bake::none) return true;
    // Format and size of images hold for kept UVs, too.
    Options own = options;
    own.bake.untouched = UntouchedParts::automatic;
    return detail::may_keep_uvs(own);
}

std::optional<SimplifiedAsset> best_picture_within_bytes(const Asset& source, const Options& options,
                                                         const ByteBudget& budget) {
    return BestPictureSearch(source, options, budget)();
}

}  // namespace faqem::cli
