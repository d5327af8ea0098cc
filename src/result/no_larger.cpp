#include "result/size_rules.hpp"

#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "asset/scene/position_rounding.hpp"
#include "bake/scene/unencoded_result.hpp"
#include "faqem/error.hpp"
#include "result/fit_images.hpp"
#include "result/picture_meter.hpp"
#include "scene/part_reports.hpp"
#include "scene/resolved_options.hpp"

namespace faqem::detail {

namespace {

/// A result with its size, and what it gave up.
struct SizedResult {
    UnencodedResult result;
    ModelSize size;
    std::vector<std::string> given_up;
};

class SmallerResultSearch {
public:
    SmallerResultSearch(const Asset& source, const SimplifiedParts& simplified, const Options& options,
                        const RunContext& context)
        : source_(source),
          simplified_(simplified),
          requested_(options),
          context_(context),
          options_(resolved_options(source, options)) {}

    SimplifiedAsset operator()() {
        SizedResult best{bake_unencoded(source_, simplified_, requested_, context_), {}, {}};
        encode(best);
        if (has_rule() && best.result.asset.report.faces_out > 0) {
            measure(best);
            if (may_give_up(best)) give_up_normal_map(best);
            if (may_give_up(best)) give_up_images(best);
            report(best);
        }
        return std::move(best.result.asset);
    }

private:
    bool has_rule() const {
        return source_.file_bytes > 0 && options_.larger == LargerFiles::avoided && !source_.images.empty() &&
               makes_atlas(options_.bake.kind);
    }

    bool fits(const SizedResult& one) const { return one.size.total() <= source_.file_bytes; }

    bool may_give_up(const SizedResult& one) const {
        return !fits(one) && !one.result.pending.empty() && !context_.is_late();
    }

    void encode(SizedResult& one) const { encode_images(one.result, options_, context_); }

    void measure(SizedResult& one) const { one.size = model_size(one.result.asset.asset, options_.format); }

    void give_up_normal_map(SizedResult& best) const {
        if (options_.bake.normal_map != NormalMap::automatic || !remove_new_normal_maps(best.result)) return;
        encode(best);
        measure(best);
        best.given_up.emplace_back("the normal map, which the source does not have");
    }

    void give_up_images(SizedResult& best) const {
        std::optional<SizedResult> kept = with_source_uvs();
        std::optional<SizedResult> fitted = with_fitted_images(best);
        const bool takes_kept =
            kept && (!fitted ? kept->size.total() < best.size.total() : is_better(*kept, *fitted));
        if (takes_kept)
            best = std::move(*kept);
        else if (fitted)
            best = std::move(*fitted);
    }

    // Nothing if no images fit, or their quality was asked for.
    std::optional<SizedResult> with_fitted_images(const SizedResult& from) const try {
        if (options_.bake.image_quality || from.size.geometry >= source_.file_bytes) return std::nullopt;
        SizedResult one = from;
        one.size = fit_images(one.result, options_, context_, source_.file_bytes);
        if (!fits(one)) return std::nullopt;
        one.given_up.emplace_back("size and quality of the images");
        return one;
    } catch (const TimeLimitError&) {
        return std::nullopt;
    }

    // Nothing if the parts were not simplified with their UVs.
    std::optional<SizedResult> with_source_uvs() const {
        if (simplified_.with_uvs.empty()) return std::nullopt;
        std::vector<Index> all(simplified_.with_uvs.size());
        std::iota(all.begin(), all.end(), Index{0});
        const SimplifiedParts parts{simplified_.with_uvs, report_with_uvs(source_, simplified_, all), {}};
        SizedResult one{bake_with_uvs(source_, parts, options_, context_), {}, {}};
        encode(one);
        remove_unused_materials(one.result);
        measure(one);
        one.given_up.emplace_back("the new texture: UVs and images are those of the source");
        return one;
    }

    // Whether a result fits and looks better than another one, which fits.
    bool is_better(const SizedResult& one, const SizedResult& other) const {
        if (!fits(one)) return false;
        const PictureMeter meter(source_, context_);
        const auto psnr = [&](Asset asset) {
            round_vertices(asset);
            return picture_psnr(meter(std::move(asset)));
        };
        return psnr(one.result.asset.asset) >= psnr(other.result.asset.asset);
    }

    void report(SizedResult& best) const {
        Report& report = best.result.asset.report;
        report.given_up = best.given_up;
        std::string joined;
        for (const std::string& one : best.given_up) joined += (joined.empty() ? "" : ", ") + one;
        if (!joined.empty())
            report.warnings.push_back("given up, to have no more bytes than the input: " + joined);
        if (!fits(best))
            report.warnings.push_back("the result has " + std::to_string(best.size.total()) +
                                      " bytes, more than the input with " +
                                      std::to_string(source_.file_bytes) +
                                      "; a smaller texture_size or image_quality makes it smaller");
    }

    const Asset& source_;
    const SimplifiedParts& simplified_;
    const Options& requested_;
    const RunContext& context_;
    const Options options_;
};

}  // namespace

SimplifiedAsset bake_no_larger(const Asset& source, const SimplifiedParts& simplified, const Options& options,
                               const RunContext& context) {
    return SmallerResultSearch(source, simplified, options, context)();
}

}  // namespace faqem::detail
