#include "cli/budget/byte_budget.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "asset/file_format.hpp"
#include "cli/budget/best_picture.hpp"
#include "faqem/detail/base/time_limit.hpp"

namespace faqem::cli {

namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t min_texture_size = 64;
constexpr std::uint64_t min_faces = 4;
constexpr int max_runs = 8;

/// Factor on the estimated face target: the number of bytes per face varies slightly between runs.
constexpr double safety_factor = 0.98;

// "within N dB" if a quality was chosen.
std::string quality_name(const BakeOptions& bake) {
    if (!bake.image_quality) return "of the usual quality";
    return "within " + std::to_string(static_cast<int>(*bake.image_quality)) + " dB";
}

std::string encoding_name(const BakeOptions& bake) {
    switch (bake.image_format) {
        case ImageFormat::automatic:
            return quality_name(bake);
        case ImageFormat::png:
            return "PNG";
        case ImageFormat::jpeg:
            return "JPEG quality " + std::to_string(bake.jpeg_quality);
        case ImageFormat::source:
            return "format of the source";
        case ImageFormat::webp:
            return "WebP " + quality_name(bake);
        case ImageFormat::png_or_jpeg:
            return "PNG or JPEG " + quality_name(bake);
    }
    return {};
}

/// One search for a result within the budget, see simplify_within_bytes().
class ByteBudgetSearch {
public:
    ByteBudgetSearch(const Asset& source, const Options& options, const ByteBudget& budget)
        : source_(source), options_(options), budget_(budget) {}

    SimplifiedAsset operator()() {
        simplify_again();
        if (is_done()) return std::move(result_);
        const bool baked = makes_atlas(options_.bake.kind) && size_.images > 0;
        const std::uint64_t images = baked ? budget_.bytes - budget_.bytes / 2 : size_.images;
        reduce_faces(images < budget_.bytes ? budget_.bytes - images : 0);
        if (baked) {
            while (!is_done() && !is_late() && reduce_image_size()) bake_again();
            if (!is_done()) reduce_faces(size_.images < budget_.bytes ? budget_.bytes - size_.images : 0);
        }
        if (!is_done() && is_late()) {
            throw TimeLimitError(
                "--max-seconds was over before a result within --max-bytes was found; the last one has " +
                std::to_string(size_.total()) + " bytes: " + summary());
        }
        if (!is_done()) {
            throw BudgetError("the smallest result has " + std::to_string(size_.total()) +
                              " bytes, but --max-bytes allows " + std::to_string(budget_.bytes) + ": " +
                              summary());
        }
        if (!is_cancelled()) result_.report.warnings.push_back("reduced to fit --max-bytes: " + summary());
        return std::move(result_);
    }

private:
    bool is_cancelled() const { return result_.report.stop == StopReason::cancelled; }
    bool is_late() const { return engine::is_over(deadline_); }
    bool is_done() const { return is_cancelled() || size_.total() <= budget_.bytes; }

    void simplify_again() {
        simplified_parts_ = simplify_parts(source_, detail::with_time_left(options_, deadline_));
        bake_again();
    }

    void bake_again() {
        result_ = bake(source_, simplified_parts_, detail::with_time_left(options_, deadline_));
        if (!is_cancelled()) size_ = model_bytes(result_.asset, budget_.file);
    }

    // Lowers the face target until the geometry fits into `bytes` or the face count no longer decreases.
    void reduce_faces(std::uint64_t bytes) {
        for (int run = 0; run < max_runs && !is_cancelled() && !is_late() && size_.geometry > bytes; ++run) {
            const std::uint64_t faces = result_.report.faces_out;
            const double share =
                safety_factor * static_cast<double>(bytes) / static_cast<double>(size_.geometry);
            const auto wanted = static_cast<std::uint64_t>(share * static_cast<double>(faces));
            options_.target = faqem::faces(std::max(wanted, min_faces));
            simplify_again();
            if (result_.report.faces_out >= faces) return;
        }
    }

    // Selects the next smaller image quality or size. Returns false if there is none.
    bool reduce_image_size() {
        BakeOptions& bake = options_.bake;
        const bool is_lower = bake.image_quality && *bake.image_quality <= low_image_quality;
        if (has_image_quality(bake.image_format) && !is_lower) {
            bake.image_quality = low_image_quality;
            return true;
        }
        if (bake.texture_size <= min_texture_size) return false;
        bake.texture_size /= 2;
        return true;
    }

    std::string summary() const {
        std::string text = std::to_string(result_.report.faces_out) + " faces, " +
                           std::to_string(size_.geometry) + " bytes of geometry";
        if (size_.images == 0) return text;
        text += ", " + std::to_string(size_.images) + " bytes of images";
        if (!makes_atlas(options_.bake.kind)) return text;
        return text + " (" + encoding_name(options_.bake) + ", at most " +
               std::to_string(options_.bake.texture_size) + " texels per side)";
    }

    const Asset& source_;
    Options options_;  // of the current run
    const ByteBudget& budget_;
    detail::Deadline deadline_ = detail::deadline_of(options_);
    SimplifiedParts simplified_parts_;
    SimplifiedAsset result_;
    ModelBytes size_;
};

}  // namespace

ModelBytes model_bytes(const Asset& asset, const fs::path& file) {
    const detail::EncodedModel model = detail::encode_model(asset, file);
    return {model.bytes() - model.image_bytes(), model.image_bytes()};
}

SimplifiedAsset simplify_within_bytes(const Asset& source, const Options& options, const ByteBudget& budget) {
    const detail::Deadline deadline = detail::deadline_of(options);
    if (leaves_faces_to_budget(options)) {
        if (auto best = best_picture_within_bytes(source, options, budget)) return *std::move(best);
        return ByteBudgetSearch(source, detail::with_time_left(options, deadline), budget)();
    }
    return ByteBudgetSearch(source, options, budget)();
}

}  // namespace faqem::cli
