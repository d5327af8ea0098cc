// What users call: simplify() and bake(), with the rules about the size of results.

#include "result/simplify.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "asset/scene/material_textures.hpp"
#include "asset/scene/position_rounding.hpp"
#include "bake/scene/unencoded_result.hpp"
#include "faqem/detail/simplify/run.hpp"
#include "faqem/engine/mesh/index_lists.hpp"
#include "faqem/error.hpp"
#include "result/best_picture.hpp"
#include "result/image_trials.hpp"
#include "result/picture_meter.hpp"
#include "scene/parts/part_reports.hpp"
#include "scene/parts/simplify_parts.hpp"
#include "scene/resolved_options.hpp"
#include "scene/touching_parts.hpp"

namespace faqem {
namespace detail {

namespace {

constexpr int most_runs = 12;

/// Factor on the estimated face target: the number of bytes per face varies slightly between runs.
constexpr double safety_factor = 0.98;

/// What a limit of bytes is.
enum class ByteLimit {
    wanted,    ///< the size of the source: quality that was asked for stays
    required,  ///< Options::max_bytes
};

/// A baked result that gives things up until it fits, in the order of bake_no_larger().
class SizedResult {
public:
    SizedResult(const Asset& source, const SimplifiedParts& simplified, const Options& requested,
                const RunContext& context, std::uint64_t limit, ByteLimit kind)
        : source_(source),
          simplified_(simplified),
          context_(context),
          limit_(limit),
          kind_(kind),
          options_(resolved_options(source, requested)),
          now_{bake_unencoded(source, simplified, requested, context), {}, {}} {
        encode(now_);
    }

    const Options& options() const { return options_; }
    const ModelSize& size() const { return now_.size; }
    const Report& report() const { return now_.result.asset.report; }
    const std::vector<std::string>& given_up() const { return now_.given_up; }
    bool has_new_images() const { return !now_.result.pending.empty(); }
    bool fits() const { return fits(now_); }

    /// Sets the size.
    void measure() { measure(now_); }

    void give_up_normal_map() {
        if (!may_give_up() || options_.bake.normal_map != NormalMap::automatic ||
            !remove_new_normal_maps(now_.result))
            return;
        encode(now_);
        measure();
        now_.given_up.emplace_back("a new normal map, which the source does not have");
    }

    void give_up_images() {
        if (!may_give_up()) return;
        std::optional<State> kept = with_source_uvs(), fitted = with_fitted_images();
        const bool takes_kept =
            kept && (!fitted ? kept->size.total() < now_.size.total() : is_better(*kept, *fitted));
        if (takes_kept)
            now_ = std::move(*kept);
        else if (fitted)
            now_ = std::move(*fitted);
    }

    /// Returns the result, whose report says what was given up.
    SimplifiedAsset take() {
        now_.result.asset.report.given_up = std::move(now_.given_up);
        return std::move(now_.result.asset);
    }

private:
    struct State {
        UnencodedResult result;
        ModelSize size;
        std::vector<std::string> given_up;
    };

    bool fits(const State& one) const { return one.size.total() <= limit_; }
    bool may_give_up() const { return !fits() && has_new_images() && !context_.is_late(); }
    void encode(State& one) const { encode_images(one.result, options_, context_); }
    void measure(State& one) const { one.size = model_size(one.result.asset.asset, options_.format); }

    // Nothing if no images fit, or their quality was asked for, unless the limit is required.
    std::optional<State> with_fitted_images() const try {
        const bool is_required = kind_ == ByteLimit::required;
        if (!is_required && (options_.bake.image_quality || now_.size.geometry >= limit_))
            return std::nullopt;
        State one = now_;
        one.size = fit_images(one.result, options_, context_, limit_);
        if (!is_required && !fits(one)) return std::nullopt;
        one.given_up.emplace_back("size and quality of the images");
        return one;
    } catch (const TimeLimitError&) {
        if (kind_ == ByteLimit::required) throw;
        return std::nullopt;
    }

    // Nothing if the parts were not simplified with their UVs, or have too many faces with them: seams are kept.
    std::optional<State> with_source_uvs() const {
        if (simplified_.with_uvs.empty()) return std::nullopt;
        const std::vector<Index> all = engine::all_indices(simplified_.with_uvs.size());
        const SimplifiedParts parts{simplified_.with_uvs, report_with_uvs(source_, simplified_, all), {}};
        const std::uint64_t allowed = std::max(report().target_faces, report().faces_out);
        if (parts.report.faces_out > allowed) return std::nullopt;
        State one{bake_with_uvs(source_, parts, options_, context_), {}, {}};
        encode(one);
        remove_unused_materials(one.result);
        measure(one);
        one.given_up.emplace_back("the new texture: UVs and images are those of the source");
        return one;
    }

    // Whether a result fits, and another one does not or looks worse.
    bool is_better(const State& one, const State& other) const {
        if (!fits(one) || !fits(other)) return fits(one);
        const PictureMeter meter(source_, context_);
        const auto psnr = [&](Asset asset) {
            round_vertices(asset);
            return picture_psnr(meter(std::move(asset)));
        };
        return psnr(one.result.asset.asset) >= psnr(other.result.asset.asset);
    }

    const Asset& source_;
    const SimplifiedParts& simplified_;
    const RunContext& context_;
    const std::uint64_t limit_;
    const ByteLimit kind_;
    const Options options_;
    State now_;
};

std::string joined(const std::vector<std::string>& texts) {
    std::string result;
    for (const std::string& text : texts) result += (result.empty() ? "" : ", ") + text;
    return result;
}

std::string size_text(const SizedResult& one) {
    const std::string text = std::to_string(one.report().faces_out) + " faces, " +
                             std::to_string(one.size().geometry) + " bytes of geometry";
    return one.size().images == 0 ? text
                                  : text + ", " + std::to_string(one.size().images) + " bytes of images";
}

/// The result, with a warning that says what was reduced for Options::max_bytes.
SimplifiedAsset reduced(SizedResult& one) {
    const std::string text = "reduced to fit max_bytes: " + size_text(one) +
                             (one.given_up().empty() ? "" : "; given up: " + joined(one.given_up()));
    SimplifiedAsset result = one.take();
    result.report.warnings.push_back(text);
    return result;
}

/// Fewer and fewer faces until a result fits, see simplify_within_bytes().
class FaceReduction {
public:
    FaceReduction(const Asset& source, const Options& options, const RunContext& context)
        : source_(source), options_(options), context_(context), limit_(*options.max_bytes) {}

    SimplifiedAsset operator()() {
        const bool has_target = options_.target.kind != Target::Kind::unset;
        std::uint64_t last_faces = 0;
        for (int run = 0; run < most_runs; ++run) {
            parts_ = simplify_parts(source_, options_, context_);
            now_.emplace(source_, parts_, options_, context_, limit_, ByteLimit::required);
            now_->measure();
            now_->give_up_normal_map();
            const std::uint64_t faces = now_->report().faces_out;
            if (run == 0) asked_faces_ = now_->report().target_faces;
            const bool is_smallest = run > 0 && faces >= last_faces;
            last_faces = faces;
            if (!geometry_limit_) geometry_limit_ = first_geometry_limit();
            const bool keeps_faces = run == 0 && has_target;
            if (keeps_faces || now_->size().geometry <= *geometry_limit_ || is_smallest) {
                now_->give_up_images();
                if (!keeps_faces) geometry_limit_ = left_by(now_->size().images);
            }
            if (now_->fits()) return finish(run > 0);
            if (is_smallest || context_.is_late()) break;
            options_.target = faqem::faces(std::max(fewer_faces(faces), min_target_faces));
        }
        const std::string text = size_text(*now_), total = std::to_string(now_->size().total());
        if (context_.is_late())
            throw TimeLimitError(
                "max_seconds was over before a result within max_bytes was found; the last one has " + total +
                " bytes: " + text);
        throw ByteLimitError("the smallest result has " + total + " bytes, but max_bytes allows " +
                             std::to_string(limit_) + ": " + text);
    }

private:
    std::uint64_t left_by(std::uint64_t bytes) const { return limit_ - std::min(limit_, bytes); }

    // Images that are baked get half of the bytes that depend on neither.
    std::uint64_t first_geometry_limit() const {
        const ModelSize& size = now_->size();
        return now_->has_new_images() ? size.fixed + left_by(size.fixed) / 2 : left_by(size.images);
    }

    std::uint64_t fewer_faces(std::uint64_t faces) const {
        const ModelSize& size = now_->size();
        const double wanted = static_cast<double>(*geometry_limit_) - static_cast<double>(size.fixed);
        const auto today = static_cast<double>(std::max<std::uint64_t>(size.geometry - size.fixed, 1));
        return static_cast<std::uint64_t>(safety_factor * std::max(0.0, wanted) / today *
                                          static_cast<double>(faces));
    }

    SimplifiedAsset finish(bool has_fewer_faces) {
        SimplifiedAsset result = has_fewer_faces || !now_->given_up().empty() ? reduced(*now_) : now_->take();
        result.report.target_faces = asked_faces_;
        add_histories(parts_, options_, result);
        return result;
    }

    const Asset& source_;
    Options options_;  // of the current run
    const RunContext& context_;
    const std::uint64_t limit_;
    SimplifiedParts parts_;
    std::optional<SizedResult> now_;  // of the current run
    std::uint64_t asked_faces_ = 0;
    std::optional<std::uint64_t> geometry_limit_;
};

/// Calls bake_unencoded() and encode_images(). If the result has new images and more bytes than the files of the source
/// (Asset::file_bytes), and Options::larger is LargerFiles::avoided, it gives something up, until it has not:
/// 1. the normal map, if the source has none and BakeOptions::normal_map is automatic;
/// 2. either the size and quality of the images, unless BakeOptions::image_quality is set: fit_images();
///    or the new texture, if the parts were simplified with their UVs, too (SimplifiedParts::with_uvs), and have no more
///    faces than the target: then the result has the UVs and images of the source. What fits is taken and, of two that
///    fit, the one with the better pictures.
/// Untouched parts stay as they are. A warning and
/// Report::given_up say what was given up, and another warning if the result is larger nevertheless.
/// \throws whatever bake() throws
/// Complexity: that of bake() and, if the result is larger, of encoding its images about ten times.
SimplifiedAsset bake_no_larger(const Asset& source, const SimplifiedParts& simplified, const Options& options,
                               const RunContext& context) {
    SizedResult one(source, simplified, options, context, source.file_bytes, ByteLimit::wanted);
    const bool has_rule = source.file_bytes > 0 && one.options().larger == LargerFiles::avoided &&
                          !source.images.empty() && makes_atlas(one.options().bake.kind);
    if (!has_rule || one.report().faces_out == 0) return one.take();
    one.measure();
    one.give_up_normal_map();
    one.give_up_images();
    const bool fits = one.fits();
    const std::uint64_t bytes = one.size().total();
    SimplifiedAsset result = one.take();
    Report& report = result.report;
    if (!report.given_up.empty())
        report.warnings.push_back("given up, to have no more bytes than the input: " +
                                  joined(report.given_up));
    if (!fits)
        report.warnings.push_back("the result has " + std::to_string(bytes) +
                                  " bytes, more than the input with " + std::to_string(source.file_bytes) +
                                  "; a smaller texture_size or image_quality makes it smaller");
    return result;
}

/// Bakes. If the result exceeds Options::max_bytes, it gives up what bake_no_larger() does, also images of a quality that
/// was asked for. A warning has the sizes.
/// \param options  max_bytes is set
/// \return a result within the limit
/// \throws ByteLimitError  even the smallest images exceed the limit; the message has the size of the result with them
/// \throws whatever bake() throws
/// Complexity: that of bake() and fit_images().
SimplifiedAsset bake_within_bytes(const Asset& source, const SimplifiedParts& simplified,
                                  const Options& options, const RunContext& context) {
    SizedResult one(source, simplified, options, context, *options.max_bytes, ByteLimit::required);
    one.measure();
    one.give_up_normal_map();
    one.give_up_images();
    if (!one.fits())
        throw ByteLimitError("the smallest result with " + std::to_string(one.report().faces_out) +
                             " faces has " + std::to_string(one.size().total()) +
                             " bytes, but max_bytes allows " + std::to_string(*options.max_bytes));
    return one.given_up().empty() ? one.take() : reduced(one);
}

/// Simplifies and bakes within Options::max_bytes: best_picture_within_bytes() where the options leave the face count
/// open. Otherwise a result that fits is not changed, and one that does not gives up, as in bake_within_bytes(),
/// 1. the new normal map;
/// 2. images, if the face count was asked for, or the geometry takes at most half of the bytes beside animations, or what
///    existing images leave if none is baked;
/// 3. faces, until the geometry does, and then images again.
/// If anything was reduced, the report has a warning with the sizes; its target is the one that was asked for.
/// \param options  max_bytes is set; target and texture size are upper limits
/// \return as bake_within_bytes()
/// \throws ByteLimitError  no result fits
/// \throws TimeLimitError  Options::max_seconds was over before a result fitted
/// \throws whatever simplify() throws
/// Complexity: at most 12 calls of simplify(), those of the searches aside.
SimplifiedAsset simplify_within_bytes(const Asset& source, const Options& requested,
                                      const RunContext& context) {
    const Options options = resolved_options(source, requested);
    if (searches_best_picture(options))
        if (auto best = best_picture_within_bytes(source, options, context)) return *std::move(best);
    return FaceReduction(source, requested, context)();
}

// Removes new images that are equal to earlier ones, whose textures take their place: textures of one source image, such as
// the normals of a material and of its clearcoat, are baked to equal images. Images that are named by number stay.
// O(images^2 + bytes).
void share_equal_images(const Asset& source, SimplifiedAsset& result) {
    std::vector<Image>& images = result.asset.images;
    std::vector<ResultImage>& reported = result.report.images;
    if (reported.size() != images.size() || names_objects_by_number(source)) return;
    std::vector<Index> number;
    std::vector<Image> distinct;
    std::vector<ResultImage> of_distinct;
    for (std::size_t i = 0; i < images.size(); ++i) {
        const auto same = reported[i].is_of_source
                              ? distinct.end()
                              : std::ranges::find(distinct, images[i].encoded, &Image::encoded);
        number.push_back(static_cast<Index>(same - distinct.begin()));
        if (same != distinct.end()) continue;
        distinct.push_back(std::move(images[i]));
        of_distinct.push_back(std::move(reported[i]));
    }
    images = std::move(distinct);
    reported = std::move(of_distinct);
    for (Material& material : result.asset.materials)
        for_each_texture(material, [&](TextureRef& texture) {
            if (texture) texture.image = number[texture.image];
        });
}

// The result of `work()`, with what is known of the files and images of the source; an empty one if it was cancelled.
template <class Work>
SimplifiedAsset with_source_report(const Asset& source, const Work& work) {
    SimplifiedAsset result;
    try {
        result = work();
    } catch (const engine::Cancelled&) {
        result.report.stop = StopReason::cancelled;
    }
    Report& report = result.report;
    report.warnings.insert(report.warnings.begin(), source.warnings.begin(), source.warnings.end());
    report.bytes_in = source.file_bytes;
    for (std::size_t i = 0; i < report.images.size(); ++i)
        report.images[i].is_of_source =
            std::any_of(source.images.begin(), source.images.end(),
                        [&](const Image& image) { return image.encoded == result.asset.images[i].encoded; });
    share_equal_images(source, result);
    return result;
}

}  // namespace

SimplifiedAsset bake(const Asset& source, const SimplifiedParts& simplified, const Options& options,
                     const RunContext& context) {
    return with_source_report(source, [&] {
        SimplifiedAsset result = options.max_bytes ? bake_within_bytes(source, simplified, options, context)
                                                   : bake_no_larger(source, simplified, options, context);
        add_histories(simplified, options, result);
        return result;
    });
}

SimplifiedAsset simplify(const Asset& given, const Options& options, const RunContext& context) {
    const std::optional<Asset> joined = join_touching_parts(given, options);
    const Asset& source = joined ? *joined : given;
    return with_source_report(source, [&] {
        if (options.max_bytes) return simplify_within_bytes(source, options, context);
        SimplifiedParts simplified = simplify_parts(source, options, context);
        SimplifiedAsset result = bake_no_larger(source, simplified, options, context);
        if (options.history == Recording::on)
            for (SimplifyResult& part : simplified.parts) result.histories.push_back(std::move(part.history));
        return result;
    });
}

}  // namespace detail

SimplifiedAsset bake(const Asset& source, const SimplifiedParts& simplified, const Options& options) {
    return detail::bake(source, simplified, options, engine::RunContext(options));
}

SimplifiedAsset simplify(const Asset& source, const Options& options) {
    return detail::simplify(source, options, engine::RunContext(options));
}

}  // namespace faqem
