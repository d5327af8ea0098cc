#include "cli/best_picture.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "bake/keep/kept_uvs.hpp"
#include "bake/scene/unencoded_result.hpp"
#include "bake/simplify/simplify_parts.hpp"
#include "bake/simplify/step_progress.hpp"
#include "cli/budget_choices.hpp"
#include "faqem/detail/base/stopwatch.hpp"
#include "faqem/detail/base/time_limit.hpp"
#include "faqem/detail/simplify/run.hpp"

namespace faqem::cli {

namespace {

// Shares of the faces that are tried first.
constexpr std::array<double, 7> first_ratios = {1, 0.7, 0.45, 0.28, 0.16, 0.09, 0.045};

// Image qualities that are tried first, dB, and the distance of those that are tried around the best one.
constexpr std::array<double, 4> first_qualities = {43, 38, 33, 28};
constexpr double quality_step = 2.5;

// Sides of the smallest images, and of those that are tried first, texels: smaller ones are tried if these do not fit.
constexpr std::uint32_t least_side = 64, first_side = 256;

// A choice is made again if all effort makes its images smaller by more than this factor.
constexpr double worthwhile_effort = 0.97;

// Larger images are not tried if the last doubling made the error smaller by less than this factor.
constexpr double least_improvement = 0.97;

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

std::uint64_t encoded_bytes(const std::vector<Image>& images) {
    std::uint64_t result = 0;
    for (const Image& image : images) result += image.encoded.size();
    return result;
}

/// One search, see best_picture_within_bytes().
class BestPictureSearch {
public:
    BestPictureSearch(const Asset& source, const Options& options, const ByteBudget& budget)
        : source_(source), options_(options), budget_(budget), faces_(total_faces(source)) {
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
        if (is_late()) return std::nullopt;
        meter_.emplace(source_, workers_);
        try_faces(std::move(levels));
        if (is_late() || tried_faces_.back().bytes >= budget_.bytes) return std::nullopt;
        try_images();
        try_choices();
        return std::move(best_);
    } catch (const engine::Cancelled& stopped) {
        if (stopped.reason != StopReason::cancelled) return std::nullopt;
        SimplifiedAsset none;
        none.report.stop = StopReason::cancelled;
        return none;
    }

private:
    bool is_late() const { return engine::is_over(deadline_); }

    // Reports a share of Phase::bake, and shows the same for the steps that follow.
    void report(double fraction) {
        fraction_ = fraction;
        monitor_.check_now();
    }

    // Options of a step whose own progress is not shown.
    Options step() {
        Options own = options_;
        own.progress = [this](Phase, double) {
            return options_.progress ? options_.progress(Phase::bake, fraction_) : Continue::yes;
        };
        return own;
    }

    std::vector<SimplifiedParts> simplified(std::span<const std::uint64_t> targets, Phase phase, double from,
                                            double to) {
        const detail::Stopwatch watch;
        const Options own =
            phase == Phase::simplify ? detail::step_options(options_, phase, from, to) : step();
        std::vector<SimplifiedParts> result =
            detail::simplify_parts_in_steps(source_, targets, detail::with_time_left(own, deadline_));
        seconds_of_simplify_ += watch.seconds();
        if (result.back().report.stop == StopReason::cancelled) throw engine::Cancelled{};
        return result;
    }

    // The result with the images of the source or, if `pending`, with images that are encoded later.
    detail::UnencodedResult made(const SimplifiedParts& parts, bool pending) {
        Options own = step();
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
            report(begin_of_images * static_cast<double>(i) / static_cast<double>(levels.size()));
            detail::UnencodedResult result = made(levels[i], i == 0 && !keeps_images_);
            if (i == 0) full_ = result;
            Asset& asset = result.asset.asset;
            const PictureError error = meter_->with_source_images(asset);
            for (Image& image : asset.images) image.encoded = placeholder.encoded;
            tried_faces_.push_back(
                {result.asset.report.faces_out, model_bytes(asset, budget_.file).geometry, error});
            levels[i] = {};
        }
    }

    // Tries images from the smallest to those that do not fit.
    void try_images() {
        if (full_.pending.empty()) {
            tried_images_.push_back({{}, {}, encoded_bytes(full_.asset.asset.images), {}});
            return;
        }
        make_sizes();
        const std::vector<std::optional<double>> qualities =
            has_image_quality(options_.bake.image_format)
                ? std::vector<std::optional<double>>(first_qualities.begin(), first_qualities.end())
                : std::vector<std::optional<double>>(1);
        // The smallest of the sizes that are tried first.
        std::size_t first = sizes_.size() - 1;
        while (first > 0 && sizes_[first].first < first_side) --first;
        double last = 0;
        for (std::size_t s = first + 1; s-- > 0;) {
            const std::optional<double> error = try_size(s, qualities);
            if (!error || (last > 0 && *error > least_improvement * last)) break;
            last = *error;
        }
        for (std::size_t s = first + 1; s < sizes_.size() && choices().empty(); ++s) try_size(s, qualities);
        try_images_around_best();
    }

    // Tries images of one size with falling quality, until the codec has no smaller ones.
    // \return the least error, or nothing if none fits
    std::optional<double> try_size(std::size_t size, std::span<const std::optional<double>> qualities) {
        const double done =
            static_cast<double>(sizes_.size() - 1 - size) / static_cast<double>(sizes_.size());
        std::uint64_t first = 0, last = 0;
        double least = 0;
        bool fits = false;
        for (std::size_t q = 0; q < qualities.size(); ++q) {
            report(begin_of_images + (begin_of_choices - begin_of_images) * done);
            if (is_late()) break;
            const TriedImages& tried = try_images(size, qualities[q]);
            if (q == 0) {
                least = tried.error.unlit + tried.error.lit;
                first = tried.bytes;
            }
            fits = fits || tried.bytes + tried_faces_.back().bytes <= budget_.bytes;
            // Equal bytes from the first quality on may be those of a lossless encoding, and become less.
            if (tried.bytes == last && tried.bytes < first) break;
            last = tried.bytes;
        }
        return fits ? std::optional(least) : std::nullopt;
    }

    // The pending images of the largest size, and those of each half of it.
    void make_sizes() {
        std::uint32_t side = 0;
        for (const detail::PendingImage& image : full_.pending)
            side = std::max({side, image.pixels.width, image.pixels.height});
        for (;;) {
            sizes_.emplace_back(side, full_.pending);
            for (detail::PendingImage& image : sizes_.back().second) image.may_shrink = false;
            side /= 2;
            if (side < least_side || !detail::limit_image_sides(full_, side)) break;
        }
    }

    const TriedImages& try_images(std::size_t size, const std::optional<double>& quality) {
        encode(size, quality, detail::ImageEffort::estimate);
        tried_images_.push_back({sizes_[size].first, quality, encoded_bytes(full_.asset.asset.images),
                                 (*meter_)(full_.asset.asset)});
        size_of_images_.push_back(size);
        return tried_images_.back();
    }

    void encode(std::size_t size, std::optional<double> quality, detail::ImageEffort effort) {
        full_.pending = sizes_[size].second;
        Options own = step();
        own.bake.image_quality = quality;
        detail::encode_images(full_, own, effort);
        if (full_.asset.report.stop == StopReason::cancelled) throw engine::Cancelled{};
    }

    void try_images_around_best() {
        const std::vector<BudgetChoice> choices = this->choices();
        if (choices.empty() || is_late()) return;
        const std::size_t best = choices.front().images;
        const std::optional<double> quality = tried_images_[best].quality;
        if (!quality) return;
        for (const double change : {-quality_step, quality_step})
            try_images(size_of_images_[best], *quality + change);
    }

    std::vector<BudgetChoice> choices() const {
        return budget_choices(tried_faces_, tried_images_, budget_.bytes);
    }

    // The best choices, of which no two have images of the same size.
    std::vector<BudgetChoice> different_choices() const {
        std::vector<BudgetChoice> result;
        for (const BudgetChoice& choice : choices()) {
            const auto is_same_size = [&](const BudgetChoice& other) {
                return tried_images_[other.images].side == tried_images_[choice.images].side;
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
            report(begin_of_choices + (1 - begin_of_choices) * done++ / static_cast<double>(all.size()));
            if (is_late()) return;
            if (try_choice(choice, detail::ImageEffort::estimate)) best = choice;
        }
        if (!best_) return;
        if (!sizes_.empty() && !is_late()) try_choice(best, detail::ImageEffort::full);
        Report& report = best_->report;
        report.budget_points = points_;
        report.seconds.simplify = seconds_of_simplify_;
        report.seconds.map = 0;
        report.seconds.bake = std::max(0.0, watch_.seconds() - seconds_of_simplify_);
    }

    // Makes the images, and then as many faces as fit.
    // \return whether the result is the best one so far
    bool try_choice(const BudgetChoice& choice, detail::ImageEffort effort) {
        const TriedImages& tried = tried_images_[choice.images];
        if (!sizes_.empty()) encode(size_of_images_[choice.images], tried.quality, effort);
        const std::vector<Image> images = full_.asset.asset.images;
        const std::uint64_t bytes = encoded_bytes(images);
        const bool is_again = effort == detail::ImageEffort::full;
        if (is_again && static_cast<double>(bytes) > worthwhile_effort * static_cast<double>(tried.bytes))
            return false;
        std::optional<std::uint64_t> faces =
            bytes < budget_.bytes ? faces_within(tried_faces_, budget_.bytes - bytes) : std::nullopt;
        for (int attempt = 0; faces && attempt < most_attempts && !is_late(); ++attempt) {
            std::uint64_t target = *faces;
            if (target < faces_)
                target = static_cast<std::uint64_t>(face_margin * static_cast<double>(target));
            const SimplifiedParts parts = std::move(simplified({&target, 1}, Phase::bake, 0, 1).front());
            detail::UnencodedResult result = made(parts, false);
            if (!sizes_.empty()) result.asset.asset.images = images;
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
        detail::encode_images(result, step());  // none is pending, but all are reported
        if (result.asset.report.stop == StopReason::cancelled) throw engine::Cancelled{};
        const double psnr = picture_psnr((*meter_)(result.asset.asset));
        points_.push_back({options_.bake.kind, result.asset.report.faces_out, size.total(), images.side,
                           images.quality, psnr});
        if (best_ && !(psnr > best_psnr_)) return false;
        detail::add_histories(parts, options_, result.asset);
        best_ = std::move(result.asset);
        best_psnr_ = psnr;
        return true;
    }

    const Asset& source_;
    Options options_;
    const ByteBudget& budget_;
    const std::uint64_t faces_;
    bool keeps_images_ = false;
    detail::Stopwatch watch_;
    detail::Deadline deadline_ = detail::deadline_of(options_);
    double fraction_ = 0, seconds_of_simplify_ = 0;
    engine::ProgressMonitor monitor_{
        [this] { return options_.progress ? options_.progress(Phase::bake, fraction_) : Continue::yes; }};
    detail::Workers workers_{options_.threads};
    std::optional<PictureMeter> meter_;
    detail::UnencodedResult full_;  // all faces; the images that are tried
    std::vector<std::pair<std::uint32_t, std::vector<detail::PendingImage>>> sizes_;  // from large to small
    std::vector<TriedFaces> tried_faces_;
    std::vector<TriedImages> tried_images_;
    std::vector<std::size_t> size_of_images_;  // indices into sizes_, by tried images
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
