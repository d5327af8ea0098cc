#include "result/best_picture.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "asset/scene/part_arrays.hpp"
#include "asset/scene/position_rounding.hpp"
#include "bake/scene/unencoded_result.hpp"
#include "faqem/detail/base/stopwatch.hpp"
#include "faqem/detail/simplify/run.hpp"
#include "result/image_trials.hpp"
#include "result/result_choices.hpp"
#include "scene/parts/simplify_parts.hpp"
#include "scene/position_grids.hpp"
#include "scene/resolved_options.hpp"

namespace faqem::detail {

namespace {

// Shares of the faces that are tried first.
constexpr std::array<double, 7> first_ratios = {1, 0.7, 0.45, 0.28, 0.16, 0.09, 0.045};

// Bits of positions that are tried if none are given; the usual ones first.
constexpr std::array<std::uint32_t, 4> tried_position_bits = {usual_position_bits, 13, 15, 16};

// Number of choices that are made and compared, and by which factor the bytes of their images differ at least.
constexpr std::size_t compared_choices = 2;
constexpr double different_bytes = 1.15;

// More faces than a model has.
constexpr std::uint64_t no_faces = std::numeric_limits<std::uint64_t>::max();

// How often a choice that is too large is made again with fewer faces, or with more until it has most of the bytes, and
// factors on the number that is estimated from other face counts, and from nearly the same one.
constexpr int most_attempts = 4;
constexpr double full_share = 0.98, face_margin = 0.985, near_face_margin = 0.997;

// What the work reports, as shares of Phase::bake.
constexpr double begin_of_images = 0.2, begin_of_choices = 0.7;

// Whether no part has normals, so that viewers show its faces flat (glTF 2.0, "Meshes").
bool is_shown_flat(const Asset& asset) { return !some_part_has(asset, &Part::normals); }

/// One search, see best_picture_within_bytes().
class BestPictureSearch {
public:
    BestPictureSearch(const Asset& source, const Options& options, const RunContext& context)
        : source_(source),
          options_(options),
          context_(context),
          limit_(*options.max_bytes),
          faces_(face_count(source)) {
        keeps_images_ = options.bake.kind != Bake::automatic;
        if (options.bake.kind == Bake::automatic) {
            options_.bake.kind = Bake::keep;
            options_.bake.untouched = UntouchedParts::baked;  // their images would stay as they are
        }
        may_omit_normals_ = options_.bake.normals == Normals::transfer &&
                            (options_.bake.kind == Bake::keep || options_.bake.kind == Bake::none) &&
                            is_shown_flat(source);
    }

    std::optional<SimplifiedAsset> operator()() try {
        std::vector<std::uint64_t> targets;
        for (const double share : first_ratios) {
            const std::uint64_t target = target_face_count(ratio(share), static_cast<double>(faces_));
            if (targets.empty() || target < targets.back())
                targets.push_back(std::max(target, min_target_faces));
        }
        std::vector<SimplifiedParts> levels = simplified(targets, context_);
        if (context_.is_late()) return std::nullopt;
        meter_.emplace(source_, context_);
        try_faces(std::move(levels));
        if (tried_faces_.back().bytes >= limit_) return std::nullopt;
        images_->try_all(tried_faces_, tried_roundings_, bytes_to_share(), begin_of_images, begin_of_choices);
        try_choices();
        return reported_best();
    } catch (const engine::Cancelled& stopped) {
        if (stopped.reason == StopReason::cancelled) throw;
        return reported_best();
    }

private:
    std::vector<SimplifiedParts> simplified(std::span<const std::uint64_t> targets,
                                            const RunContext& of_step) {
        const Stopwatch watch;
        std::vector<SimplifiedParts> result = simplify_parts_in_steps(source_, targets, options_, of_step);
        seconds_of_simplify_ += watch.seconds();
        return result;
    }

    // The result with the images of the source or, if `pending`, with images that are encoded later.
    UnencodedResult made(const SimplifiedParts& parts, bool pending) {
        Options own = options_;
        if (!pending) own.bake.image_format = ImageFormat::source;
        if (parts.report.faces_out >= least_flat_faces_) own.bake.normals = Normals::none;
        return own.bake.kind == Bake::keep ? bake_with_uvs(source_, parts, own, context_.quiet())
                                           : bake_unencoded(source_, parts, own, context_.quiet());
    }

    // The same for a level that is tried, which are in descending order. As long as it looks better, normals are left
    // out.
    UnencodedResult made_level(const SimplifiedParts& parts, bool pending) {
        if (!may_omit_normals_) return made(parts, pending);
        const std::uint64_t before = std::exchange(least_flat_faces_, no_faces);
        UnencodedResult with_normals = made(parts, pending);
        least_flat_faces_ = parts.report.faces_out;
        UnencodedResult flat = made(parts, pending);
        const double error = meter_->lit_with_source_images(flat.asset.asset);
        if (error <= meter_->lit_with_source_images(with_normals.asset.asset)) return flat;
        least_flat_faces_ = before;
        may_omit_normals_ = false;
        return with_normals;
    }

    // Tries the levels of the first run, and makes the images for all faces.
    void try_faces(std::vector<SimplifiedParts> levels) {
        const Image placeholder = encode_png({1, 1, {0, 0, 0, 255}, false}, "");
        for (std::size_t i = 0; i < levels.size(); ++i) {
            context_.report(Phase::bake,
                            begin_of_images * static_cast<double>(i) / static_cast<double>(levels.size()));
            UnencodedResult result = made_level(levels[i], i == 0 && !keeps_images_);
            if (i == 0) images_.emplace(result, options_.bake, context_);
            Asset& asset = result.asset.asset;
            const PictureDifference error = meter_->with_source_images(asset);
            for (Image& image : asset.images) image.encoded = placeholder.encoded;
            tried_faces_.push_back(
                {result.asset.report.faces_out, model_size(asset, options_.format).geometry, error});
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
            const bool is_rounded = round_vertices(rounded);
            tried_roundings_.push_back(
                {bits, model_size(asset, options_.format).geometry,
                 is_rounded ? meter_->with_source_images(std::move(rounded)) : PictureDifference{}});
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
        set_quantization(source_, own, asset, unused);
    }

    // Bytes of the limit for geometry and encoded images.
    std::uint64_t bytes_to_share() const { return limit_ - std::min(limit_, images_->passed_bytes()); }

    // The best choices, whose images have different numbers of bytes.
    std::vector<ResultChoice> different_choices() const {
        std::vector<ResultChoice> result;
        for (ResultChoice& choice :
             result_choices(tried_faces_, images_->tried(), tried_roundings_, bytes_to_share())) {
            const auto is_similar = [&](const ResultChoice& other) {
                const auto [less, more] = std::minmax(choice.image_bytes, other.image_bytes);
                return static_cast<double>(more) <= different_bytes * static_cast<double>(less);
            };
            if (std::any_of(result.begin(), result.end(), is_similar)) continue;
            result.push_back(std::move(choice));
            if (result.size() == compared_choices) break;
        }
        return result;
    }

    void try_choices() {
        double done = 0;
        const std::vector<ResultChoice> all = different_choices();
        for (const ResultChoice& choice : all) {
            context_.report(Phase::bake, begin_of_choices + (1 - begin_of_choices) * done++ /
                                                                static_cast<double>(all.size()));
            try_choice(choice);
        }
    }

    std::optional<SimplifiedAsset> reported_best() {
        if (!best_) return std::nullopt;
        Report& report = best_->report;
        report.compared_results = points_;
        report.seconds.simplify = seconds_of_simplify_;
        report.seconds.map = 0;
        report.seconds.bake = std::max(0.0, watch_.seconds() - seconds_of_simplify_);
        return std::move(best_);
    }

    // Makes as many faces as fit beside the images of the choice.
    void try_choice(const ResultChoice& choice) {
        const std::vector<Image> images = images_->chosen_images(choice.images);
        const std::uint64_t bytes = encoded_bytes(images);
        options_.quantize.position_bits = tried_roundings_[choice.rounding].position_bits;
        std::optional<std::uint64_t> faces =
            bytes < limit_ ? faces_within(tried_faces_, as_first_rounding(tried_roundings_, choice.rounding,
                                                                          limit_ - bytes))
                           : std::nullopt;
        bool has_result = false;
        for (int attempt = 0; faces && attempt < most_attempts; ++attempt) {
            context_.check_now();
            std::uint64_t target = *faces;
            const double margin = attempt == 0 ? face_margin : near_face_margin;
            if (target < faces_) target = static_cast<std::uint64_t>(margin * static_cast<double>(target));
            const SimplifiedParts parts = std::move(simplified({&target, 1}, context_.quiet()).front());
            UnencodedResult result = made(parts, false);
            if (images_->are_encoded()) result.asset.asset.images = images;
            remove_unused_materials(result);
            const ModelSize size = model_size(result.asset.asset, options_.format);
            const bool fits = size.total() <= limit_;
            // At once, so that there is a result if the time is over before the next one.
            if (fits) finish(std::move(result), parts, longest_side(choice), size);
            has_result = has_result || fits;
            const bool is_full =
                static_cast<double>(size.total()) >= full_share * static_cast<double>(limit_);
            if (has_result && (!fits || is_full || target >= faces_)) return;
            const double share = static_cast<double>(limit_ - std::min(limit_, size.images)) /
                                 static_cast<double>(size.geometry);
            faces = std::min(faces_, static_cast<std::uint64_t>(share * static_cast<double>(target)));
            if (*faces < min_target_faces) return;
        }
    }

    std::uint32_t longest_side(const ResultChoice& choice) const {
        std::uint32_t result = 0;
        for (std::size_t i = 0; i < choice.images.size(); ++i)
            result = std::max(result, images_->tried()[i][choice.images[i]].side);
        return result;
    }

    void finish(UnencodedResult result, const SimplifiedParts& parts, std::uint32_t image_side,
                const ModelSize& size) {
        encode_images(result, options_, context_.quiet());  // none is pending, but all are reported
        Asset shown = result.asset.asset;
        round_vertices(shown);
        const double psnr = picture_psnr((*meter_)(std::move(shown)));
        points_.push_back({options_.bake.kind, result.asset.report.faces_out, size.total(), image_side,
                           options_.quantize.position_bits, psnr});
        if (best_ && !(psnr > best_psnr_)) return;
        add_histories(parts, options_, result.asset);
        best_ = std::move(result.asset);
        best_psnr_ = psnr;
    }

    const Asset& source_;
    Options options_;
    const RunContext& context_;
    const std::uint64_t limit_;  // bytes
    const std::uint64_t faces_;
    bool keeps_images_ = false;
    bool may_omit_normals_ = false;
    std::uint64_t least_flat_faces_ = no_faces;  // that are shown flat, as in the source
    Stopwatch watch_;
    double seconds_of_simplify_ = 0;
    std::optional<PictureMeter> meter_;
    std::vector<TriedFaces> tried_faces_;
    std::vector<TriedRounding> tried_roundings_;  // at least one after try_faces()
    std::optional<ImageTrials> images_;           // after try_faces()
    std::vector<ComparedResult> points_;
    std::optional<SimplifiedAsset> best_;
    double best_psnr_ = 0;
};

}  // namespace

bool searches_best_picture(const Options& options) {
    if (!options.max_bytes || options.target.kind != Target::Kind::unset || options.max_error) return false;
    const Bake kind = options.bake.kind;
    if (kind == Bake::keep || kind == Bake::vertex || kind == Bake::none) return true;
    // Format and size of images hold for kept UVs, too.
    Options own = options;
    own.bake.untouched = UntouchedParts::automatic;
    return may_keep_uvs(own);
}

std::optional<SimplifiedAsset> best_picture_within_bytes(const Asset& source, const Options& options,
                                                         const RunContext& context) {
    return BestPictureSearch(source, options, context)();
}

}  // namespace faqem::detail
