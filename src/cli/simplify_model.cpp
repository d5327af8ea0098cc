#include "cli/simplify_model.hpp"

#include <algorithm>
#include <cstdint>
#include <sstream>
#include <vector>

#include "asset/file_format.hpp"
#include "asset/finest_level.hpp"
#include "asset/model_files.hpp"
#include "asset/scene/messages.hpp"
#include "cli/file_stamp.hpp"
#include "cli/strict.hpp"
#include "faqem/error.hpp"

namespace faqem::cli {

Asset load_model(const std::filesystem::path& file, Strictness strictness) {
    Asset asset = load(file);
    const std::string left_out = detail::keep_finest_level(asset);
    if (!left_out.empty()) asset.warnings.push_back(file.string() + ": " + left_out);
    std::uint64_t faces = 0;
    for (const Part& part : asset.parts) faces += part.triangles.size();
    if (faces == 0) throw InputError(file.string(), "", "has no triangles");
    if (strictness == Strictness::strict) require_clean(asset, file.string());
    return asset;
}

BakeOptions resolve_automatic_bake(BakeOptions requested, const Asset& source,
                                   const std::filesystem::path& out) {
    const detail::FileFormat* format = detail::format_by_name(out);
    if (!format) return requested;
    if (requested.image_format == ImageFormat::webp && !format->is_gltf)
        throw OptionError("--image-format webp: the output must be .glb or .gltf");
    if (requested.kind != Bake::automatic) return requested;
    const auto no_part_has = [&](auto values) {
        return std::all_of(source.parts.begin(), source.parts.end(),
                           [&](const Part& p) { return (p.*values).empty(); });
    };
    const bool bare = source.materials.empty() && no_part_has(&Part::colors);
    requested.kind = bare ? format->bare_bake : format->bake;
    // Flat normals need no map to the original. If the source has normals, save() warns that the format cannot store
    // them.
    if (!format->holds_normals)
        requested.normals = no_part_has(&Part::normals) ? Normals::none : Normals::flat;
    if (requested.untouched != UntouchedParts::automatic || !format->keeps_plain_parts) return requested;
    if (source.materials.empty()) requested.untouched = UntouchedParts::kept;
    if (source.source) requested.untouched = UntouchedParts::baked;
    return requested;
}

QuantizeOptions resolve_quantize(QuantizeOptions requested, const std::filesystem::path& out) {
    const detail::FileFormat* format = detail::format_by_name(out);
    if (!format || format->is_gltf) return requested;
    if (requested.kind == Quantize::on) throw OptionError("--quantize on: the output must be .glb or .gltf");
    requested.kind = Quantize::off;
    return requested;
}

std::uint64_t input_bytes(const std::filesystem::path& model) {
    std::vector<std::filesystem::path> files = detail::referenced_files(model, detail::References::readable);
    files.push_back(model);
    return total_file_size(files);
}

std::string warnings_text(const std::vector<std::string>& warnings) {
    std::string text = detail::pluralized(warnings.size(), "warning") + "\n";
    for (const std::string& warning : warnings) text += "  " + warning + "\n";
    return text;
}

SimplifiedAsset simplify_model(const Asset& source, const std::filesystem::path& file, const Options& options,
                               const SizeRule& rule, const std::optional<ByteBudget>& budget) {
    return with_file_in_errors(file, [&] {
        return budget ? simplify_within_bytes(source, options, *budget)
                      : simplify_no_larger(source, options, rule);
    });
}

ExitCode rejection_code(const Report& report, bool strict_target) {
    if (report.faces_out == 0) return exit_bad_input;
    if (strict_target && report.faces_out > report.target_faces) return exit_target_missed;
    if (report.max_error && !report.max_error->within()) return exit_error_exceeded;
    return exit_ok;
}

std::string rejection_message(ExitCode rejection, const std::filesystem::path& in,
                              const std::filesystem::path& out, const Report& report) {
    std::ostringstream text;
    if (rejection == exit_bad_input) {
        text << "nothing is left of " << in.string() << "; ";
    } else if (rejection == exit_target_missed) {
        text << in.string() << ": target missed: the result has " << report.faces_out
             << " faces, the target is " << report.target_faces << "; ";
    } else {
        text << in.string() << ": max error exceeded: the result with " << report.faces_out
             << " faces may have a distance of up to " << report.max_error->bound << ", "
             << report.max_error->allowed << " is allowed; ";
    }
    text << out.string() << " was not written";
    return text.str();
}

}  // namespace faqem::cli
