#include "cli/no_larger.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "cli/byte_budget.hpp"

namespace faqem::cli {

namespace {

bool has_normal_map(const Asset& asset) {
    return std::any_of(asset.materials.begin(), asset.materials.end(),
                       [](const Material& m) { return bool(m.normal_texture); });
}

/// Takes the next thing away from the options. Returns its name, or nothing if none is left.
std::string give_up_next(const Asset& source, const Asset& result, BakeOptions& bake) {
    if (bake.normal_map == NormalMap::automatic && has_normal_map(result) && !has_normal_map(source)) {
        bake.normal_map = NormalMap::off;
        return "the normal map, which the source does not have";
    }
    if (bake.image_format == ImageFormat::automatic && bake.image_quality > low_image_quality) {
        bake.image_quality = low_image_quality;
        return "image quality (" + std::to_string(static_cast<int>(low_image_quality)) + " dB)";
    }
    return {};
}

}  // namespace

LargerResult larger_result(const BakeOptions& bake, bool allow_larger) {
    if (allow_larger) return LargerResult::allowed;
    return bake.untouched == UntouchedParts::automatic ? LargerResult::gives_up : LargerResult::warns;
}

SimplifiedAsset simplify_no_larger(const Asset& source, const Options& options, const SizeRule& rule) {
    if (source.images.empty() || !makes_atlas(options.bake.kind) || rule.larger == LargerResult::allowed)
        return simplify(source, options);
    const SimplifiedParts parts = simplify_parts(source, options);
    Options less = options;
    std::string given_up;
    for (;;) {
        SimplifiedAsset result = bake(source, parts, less);
        if (result.report.stop == StopReason::cancelled || result.report.faces_out == 0) return result;
        const ModelBytes size = model_bytes(result.asset, rule.out);
        const bool is_larger = size.total() > rule.bytes_in;
        const bool has_new_images = !result.report.pages.empty();
        // Untouched parts stay so, although an option for images is no longer the default.
        if (!result.report.untouched_parts.empty()) less.bake.untouched = UntouchedParts::kept;
        if (is_larger && rule.larger == LargerResult::gives_up && has_new_images &&
            size.geometry < rule.bytes_in) {
            const std::string next = give_up_next(source, result.asset, less.bake);
            if (!next.empty()) {
                given_up += (given_up.empty() ? "" : ", ") + next;
                continue;
            }
        }
        if (!given_up.empty())
            result.report.warnings.push_back("given up, to have no more bytes than the input: " + given_up);
        if (is_larger)
            result.report.warnings.push_back("the result has " + std::to_string(size.total()) +
                                             " bytes, more than the input with " +
                                             std::to_string(rule.bytes_in));
        return result;
    }
}

}  // namespace faqem::cli
