#include "cli/no_larger.hpp"

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bake/scene/unencoded_result.hpp"
#include "cli/budget/byte_budget.hpp"
#include "faqem/detail/base/time_limit.hpp"

namespace faqem::cli {

namespace {

// Least PSNR of results that are larger than their source, one after the other. Below the first, details of colour are
// lost that the source shows, so the others are for results that are not larger with them.
constexpr std::array<double, 3> lower_qualities = {low_image_quality, 29, 24};

// Takes the next thing away from the result. Returns its name, or nothing if none is left.
std::string give_up_next(detail::UnencodedResult& result, BakeOptions& bake) {
    if (bake.normal_map == NormalMap::automatic && detail::remove_new_normal_maps(result))
        return "the normal map, which the source does not have";
    if (!has_image_quality(bake.image_format)) return {};
    for (const double quality : lower_qualities) {
        if (bake.image_quality && !(*bake.image_quality > quality)) continue;
        bake.image_quality = quality;
        return "image quality (" + std::to_string(static_cast<int>(quality)) + " dB)";
    }
    return {};
}

// Keeps what was given up last only: a lower quality replaces the one before.
void add_given_up(std::vector<std::string>& all, const std::string& next) {
    constexpr std::string_view quality = "image quality";
    if (!all.empty() && all.back().starts_with(quality) && next.starts_with(quality)) all.pop_back();
    all.push_back(next);
}

std::string joined(const std::vector<std::string>& all) {
    std::string result;
    for (const std::string& one : all) result += (result.empty() ? "" : ", ") + one;
    return result;
}

// A result whose images look as those of the source.
struct DetailedResult {
    Asset asset;
    std::vector<ResultImage> images;
    std::vector<std::string> given_up;
    std::uint64_t bytes;
};

void report_size(Report& report, const std::vector<std::string>& given_up, std::uint64_t bytes,
                 std::uint64_t bytes_in) {
    if (!given_up.empty())
        report.warnings.push_back("given up, to have no more bytes than the input: " + joined(given_up));
    report.given_up = given_up;
    if (bytes > bytes_in)
        report.warnings.push_back("the result has " + std::to_string(bytes) +
                                  " bytes, more than the input with " + std::to_string(bytes_in) +
                                  "; a smaller --texture-size or --image-quality makes it smaller");
}

}  // namespace

LargerResult larger_result(const BakeOptions& bake, bool allow_larger) {
    if (allow_larger) return LargerResult::allowed;
    return bake.untouched == UntouchedParts::automatic ? LargerResult::gives_up : LargerResult::warns;
}

SimplifiedAsset bake_no_larger(const Asset& source, const SimplifiedParts& simplified, const Options& options,
                               const SizeRule& rule) {
    if (source.images.empty() || !makes_atlas(options.bake.kind) || rule.larger == LargerResult::allowed)
        return bake(source, simplified, options);
    const detail::Deadline deadline = detail::deadline_of(options);
    detail::UnencodedResult result = detail::bake_unencoded(source, simplified, options);
    Options less = options;
    std::vector<std::string> given_up;
    std::optional<DetailedResult> detailed;  // the last one
    for (;;) {
        detail::encode_images(result, detail::with_time_left(less, deadline));
        const Report& report = result.asset.report;
        if (report.stop == StopReason::cancelled || report.faces_out == 0) break;
        const ModelBytes size = model_bytes(result.asset.asset, rule.out);
        const bool is_larger = size.total() > rule.bytes_in;
        if (is_larger && rule.larger == LargerResult::gives_up && !result.pending.empty() &&
            !engine::is_over(deadline) && size.geometry < rule.bytes_in) {
            if (!(less.bake.image_quality.value_or(low_image_quality) < low_image_quality))
                detailed = DetailedResult{result.asset.asset, report.images, given_up, size.total()};
            const std::string next = give_up_next(result, less.bake);
            if (!next.empty()) {
                add_given_up(given_up, next);
                continue;
            }
        }
        if (is_larger && detailed) {  // all that could be given up was not enough
            result.asset.asset = std::move(detailed->asset);
            result.asset.report.images = std::move(detailed->images);
            given_up = std::move(detailed->given_up);
        }
        report_size(result.asset.report, given_up, is_larger && detailed ? detailed->bytes : size.total(),
                    rule.bytes_in);
        break;
    }
    detail::add_histories(simplified, options, result.asset);
    return std::move(result.asset);
}

SimplifiedAsset simplify_no_larger(const Asset& source, const Options& options, const SizeRule& rule) {
    const detail::Deadline deadline = detail::deadline_of(options);
    const SimplifiedParts simplified = simplify_parts(source, options);
    return bake_no_larger(source, simplified, detail::with_time_left(options, deadline), rule);
}

}  // namespace faqem::cli
