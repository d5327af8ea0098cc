#include "result/size_rules.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "bake/scene/unencoded_result.hpp"
#include "faqem/detail/simplify/run.hpp"
#include "faqem/error.hpp"
#include "result/best_picture.hpp"
#include "result/fit_images.hpp"
#include "scene/resolved_options.hpp"
#include "scene/simplify_parts.hpp"

namespace faqem::detail {

namespace {

constexpr int most_runs = 12;

/// Factor on the estimated face target: the number of bytes per face varies slightly between runs.
constexpr double safety_factor = 0.98;

std::string size_text(const Report& report, const ModelSize& size) {
    std::string text =
        std::to_string(report.faces_out) + " faces, " + std::to_string(size.geometry) + " bytes of geometry";
    return size.images == 0 ? text : text + ", " + std::to_string(size.images) + " bytes of images";
}

/// Fewer and fewer faces until a result fits, see simplify_within_bytes().
class FaceReduction {
public:
    FaceReduction(const Asset& source, const Options& options, const RunContext& context)
        : source_(source), options_(options), context_(context), limit_(*options.max_bytes) {}

    SimplifiedAsset operator()() {
        std::uint64_t last_faces = 0;
        for (int run = 0; run < most_runs; ++run) {
            simplify_again();
            if (fits()) return finish(run > 0);
            const std::uint64_t faces = result_.asset.report.faces_out;
            const bool is_smallest = run > 0 && faces >= last_faces;
            last_faces = faces;
            if (!geometry_limit_) geometry_limit_ = first_geometry_limit();
            if (!result_.pending.empty() && (size_.geometry <= *geometry_limit_ || is_smallest)) {
                size_ = fit_images(result_, resolved_options(source_, options_), context_, limit_);
                if (fits()) return finish(true);
                geometry_limit_ = left_by(size_.images);
            }
            if (is_smallest || context_.is_late()) break;
            const double share = safety_factor * static_cast<double>(*geometry_limit_) /
                                 static_cast<double>(std::max<std::uint64_t>(size_.geometry, 1));
            const auto wanted = static_cast<std::uint64_t>(share * static_cast<double>(faces));
            options_.target = faqem::faces(std::max<std::uint64_t>(wanted, min_target_faces));
        }
        const std::string text = size_text(result_.asset.report, size_);
        if (context_.is_late())
            throw TimeLimitError(
                "max_seconds was over before a result within max_bytes was found; the last one has " +
                std::to_string(size_.total()) + " bytes: " + text);
        throw ByteLimitError("the smallest result has " + std::to_string(size_.total()) +
                             " bytes, but max_bytes allows " + std::to_string(limit_) + ": " + text);
    }

private:
    bool fits() const { return size_.total() <= limit_; }
    std::uint64_t left_by(std::uint64_t images) const { return limit_ - std::min(limit_, images); }

    // Images that are baked get half of the bytes.
    std::uint64_t first_geometry_limit() const {
        return result_.pending.empty() ? left_by(size_.images) : limit_ / 2;
    }

    void simplify_again() {
        parts_ = simplify_parts(source_, options_, context_);
        result_ = bake_unencoded(source_, parts_, options_, context_);
        encode_images(result_, options_, context_);
        size_ = model_size(result_.asset.asset, result_.asset.asset.format);
    }

    SimplifiedAsset finish(bool is_reduced) {
        add_histories(parts_, options_, result_.asset);
        Report& report = result_.asset.report;
        if (is_reduced) report.warnings.push_back("reduced to fit max_bytes: " + size_text(report, size_));
        return std::move(result_.asset);
    }

    const Asset& source_;
    Options options_;  // of the current run
    const RunContext& context_;
    const std::uint64_t limit_;
    SimplifiedParts parts_;
    UnencodedResult result_;
    ModelSize size_;
    std::optional<std::uint64_t> geometry_limit_;
};

}  // namespace

SimplifiedAsset bake_within_bytes(const Asset& source, const SimplifiedParts& simplified,
                                  const Options& requested, const RunContext& context) {
    const Options options = resolved_options(source, requested);
    UnencodedResult result = bake_unencoded(source, simplified, requested, context);
    encode_images(result, options, context);
    ModelSize size = model_size(result.asset.asset, options.format);
    const std::uint64_t before = size.total();
    if (before <= *options.max_bytes) return std::move(result.asset);
    if (!result.pending.empty()) size = fit_images(result, options, context, *options.max_bytes);
    if (size.total() > *options.max_bytes)
        throw ByteLimitError("the smallest result with " + std::to_string(result.asset.report.faces_out) +
                             " faces has " + std::to_string(size.total()) + " bytes, but max_bytes allows " +
                             std::to_string(*options.max_bytes));
    result.asset.report.warnings.push_back("images were reduced to fit max_bytes: the result had " +
                                           std::to_string(before) + " bytes");
    return std::move(result.asset);
}

SimplifiedAsset simplify_within_bytes(const Asset& source, const Options& requested,
                                      const RunContext& context) {
    const Options options = resolved_options(source, requested);
    if (searches_best_picture(options))
        if (auto best = best_picture_within_bytes(source, options, context)) return *std::move(best);
    return FaceReduction(source, requested, context)();
}

}  // namespace faqem::detail
