#include "result/simplify_file.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <system_error>

#include "asset/file_format.hpp"
#include "asset/finest_level.hpp"
#include "asset/io/encoded_model.hpp"
#include "asset/scene/part_arrays.hpp"
#include "faqem/detail/base/stopwatch.hpp"
#include "result/simplify.hpp"

namespace faqem {

namespace fs = std::filesystem;

namespace {

// Whether the run was not cancelled, faces are left, and the result is within Options::max_error.
bool may_be_saved(const Report& report) {
    return report.stop != StopReason::cancelled && report.faces_out > 0 &&
           (!report.max_error || report.max_error->within());
}

bool is_most(std::uint64_t share, std::uint64_t whole) {
    return static_cast<double>(share) > LittleSaved::max_share * static_cast<double>(whole);
}

void explain_images(const Report& report, const Options& options, LittleSaved& saved) {
    std::uint64_t made = 0, passed_through = 0;
    for (const ResultImage& image : report.images) {
        if (!image.is_of_source) made += image.bytes;
        if (image.mime_type == "image/ktx2" || image.mime_type == "image/avif") passed_through += image.bytes;
    }
    saved.options = {"max-bytes", "texture-size", "image-quality"};
    if (2 * passed_through > saved.images) {
        saved.reason = "KTX2 and AVIF images stay as they are";
        saved.options.clear();
    } else if (2 * made > saved.images) {
        saved.reason = "they are new, of this size and quality";
    } else if (options.bake.image_format == ImageFormat::source) {
        saved.reason = "the images of the source stay as they are";
        saved.options = {"image-format"};
    } else if (!report.untouched_parts.empty()) {
        saved.reason = "meshes that lose no face keep the images of the source";
        saved.options = {"texture-size", "texel-density"};
    } else {
        saved.reason = "smaller ones than those of the source would be worse";
    }
}

void explain_geometry(const SimplifiedAsset& result, bool is_gltf, LittleSaved& saved) {
    const Report& report = result.report;
    if (is_most(report.faces_out, report.faces_in) && report.bytes_out <= report.bytes_in) {
        const bool is_reached = report.stop == StopReason::reached_target;
        saved.reason = is_reached ? "so many faces were asked for"
                                  : "most faces are left: " + std::string(name(report.stop));
        if (is_reached) saved.options = {"ratio", "faces"};
        if (report.stop == StopReason::reached_max_error) saved.options = {"max-error"};
        if (report.stop == StopReason::reached_time_limit) saved.options = {"max-seconds"};
    } else if (!is_gltf) {
        saved.reason = "the format has no compression, as .glb has";
    } else {
        saved.reason = "vertices and faces have more bytes each than in the source";
        if (result.asset.compression == Compression::none) saved.options.emplace_back("compress");
        if (!report.position_rounding) saved.options.emplace_back("quantize");
    }
}

// Report::little_saved; nothing if enough was saved, or the size of the source is unknown.
std::optional<LittleSaved> little_saved(const SimplifiedAsset& result, const detail::EncodedModel& model,
                                        const Options& options) {
    const Report& report = result.report;
    if (report.bytes_in == 0 || !is_most(report.bytes_out, report.bytes_in)) return std::nullopt;
    LittleSaved saved;
    saved.images = model.image_bytes();
    for (const ResultView& view : report.buffer_views)
        (detail::is_animation(view) ? saved.animation : saved.geometry) += view.bytes;
    const bool is_gltf = !report.buffer_views.empty();
    const std::uint64_t rest = report.bytes_out - saved.images - saved.animation - saved.geometry;
    (is_gltf ? saved.other : saved.geometry) += rest;
    const std::uint64_t most = std::max({saved.geometry, saved.images, saved.animation, saved.other});
    if (saved.images == most)
        explain_images(report, options, saved);
    else if (saved.geometry == most)
        explain_geometry(result, is_gltf, saved);
    else
        saved.reason = saved.animation == most ? "animations stay" : "JSON, extensions and extras stay";
    return saved;
}

}  // namespace

Asset detail::load_triangles(const fs::path& file) {
    Asset asset = load(file);
    const std::string left_out = keep_finest_level(asset);
    if (!left_out.empty()) asset.warnings.push_back(file.string() + ": " + left_out);
    if (!some_part_has(asset, &Part::triangles)) throw InputError(file.string(), "", "has no triangles");
    return asset;
}

SimplifiedAsset detail::simplify_file(const fs::path& file, const Options& options,
                                      const std::function<void(const Asset&)>& loaded) {
    const engine::RunContext context(options);
    const Stopwatch watch;
    const Asset source = load_triangles(file);
    const double seconds = watch.seconds();
    loaded(source);
    SimplifiedAsset result = with_file_in_errors(file, [&] { return simplify(source, options, context); });
    result.report.seconds.load = seconds;
    result.report.seconds.total += seconds;
    return result;
}

void detail::save_result(SimplifiedAsset& result, const fs::path& file, const Options& options,
                         Overwrite overwrite) {
    const Stopwatch watch;
    const EncodedModel model = encode_model(result.asset, file);
    write_model(model, file.parent_path(), overwrite);
    Report& report = result.report;
    report.bytes_out = model.bytes();
    report.buffer_views = model.views;
    report.little_saved = little_saved(result, model, options);
    report.warnings.insert(report.warnings.end(), model.losses.begin(), model.losses.end());
    report.seconds.save = watch.seconds();
    report.seconds.total += report.seconds.save;
}

Report simplify(const fs::path& file, const fs::path& out, const Options& options, Overwrite overwrite) {
    Options own = options;
    own.format = detail::written_format(out).format;
    std::error_code error;
    if (fs::equivalent(file, out, error))
        throw OptionError(out.string() + ": is the model that is simplified");
    if (overwrite == Overwrite::no && fs::exists(out, error))
        throw WriteError(out.string() + ": exists; Overwrite::yes replaces it");
    SimplifiedAsset result = detail::simplify_file(file, own, [](const Asset&) {});
    if (may_be_saved(result.report))
        detail::save_result(result, out, own, overwrite);
    else
        result.report.warnings.push_back(out.string() + " was not written");
    return std::move(result.report);
}

}  // namespace faqem
