#include "faqem/bake_onto.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "asset/file_format.hpp"
#include "asset/finest_level.hpp"
#include "asset/scene/flatten.hpp"
#include "asset/scene/material_textures.hpp"
#include "asset/scene/messages.hpp"
#include "asset/scene/rest_pose.hpp"
#include "bake/onto/onto_map.hpp"
#include "bake/onto/onto_target.hpp"
#include "bake/scene/unencoded_result.hpp"
#include "bake/texture/bake_job.hpp"
#include "faqem/detail/base/stopwatch.hpp"
#include "faqem/detail/options/option_table.hpp"
#include "faqem/error.hpp"
#include "scene/check_asset.hpp"
#include "scene/material_groups.hpp"
#include "scene/position_grids.hpp"
#include "scene/resolved_options.hpp"
#include "scene/scene_size.hpp"

namespace faqem {
namespace {

using detail::RunContext;

constexpr double usual_max_distance = 0.05;  // share of the diagonal
constexpr double max_silent_share = 0.01;    // of missing texels

bool holds_textures(ModelFormat format) { return format != ModelFormat::ply && format != ModelFormat::stl; }

void check_options(const Options& options, const OntoOptions& onto) {
    validate(options);
    if (!holds_textures(options.format)) throw OptionError("bake_onto: format must be one that has textures");
    if (!makes_atlas(options.bake.kind))
        throw OptionError("bake_onto: an atlas is required, so bake must not be vertex, keep or none");
    if (options.bake.correspondence == Recording::on || options.max_bytes)
        throw OptionError("bake_onto: correspondence and max_bytes must be unset");
    if (onto.max_distance && !(onto.max_distance->value > 0 && std::isfinite(onto.max_distance->value)))
        throw OptionError("bake_onto: max_distance must be finite and above 0");
}

/// A valid asset without coarser levels of detail.
/// \param role  in warnings
Asset finest(Asset asset, const std::string& role, Report& report) {
    detail::check_asset(asset);
    const std::string left_out = detail::keep_finest_level(asset);
    if (!left_out.empty()) asset.warnings.push_back(left_out);
    for (const std::string& warning : asset.warnings) report.warnings.push_back(role + ": " + warning);
    return asset;
}

/// The source as one part.
/// \param keeps_extensions  whether the result can have extensions of materials
Asset flat_source(const Asset& source, bool keeps_extensions, Report& report) {
    Asset flat = detail::flatten_scene(source);
    if (flat.parts[0].triangles.empty()) throw InputError("", "source", "its scene has no faces");
    for (Index m = 0; m < flat.materials.size() && !keeps_extensions; ++m) {
        Material& material = flat.materials[m];
        for (const std::string& extension : material.extensions)
            report.warnings.push_back(detail::material_title(source, m) + ": " + extension + " was left out");
        material.extensions.clear();
        material.extension_textures.clear();
    }
    // A missing material is metal in glTF, and only there.
    if (source.source) {
        std::ranges::replace(flat.parts[0].face_material, no_index,
                             static_cast<Index>(flat.materials.size()));
        flat.materials.emplace_back();
    }
    return flat;
}

/// Bakes the pages, and puts the result together.
/// \param source  the scene as one part
void bake_parts(const Asset& scene, const Asset& source, const Asset& target, const Options& options,
                const OntoOptions& onto, double max_distance, const RunContext& context,
                SimplifiedAsset& result) {
    detail::FlatTarget flat = detail::flat_target(target);
    if (flat.flat.triangles.empty()) throw InputError("", "target", "its scene has no faces");
    const auto mesh = detail::target_mesh(flat.flat, options.bake, context);
    auto own_map = std::make_unique<const detail::OntoMap>(
        source, mesh->part,
        detail::pair_parts(detail::boxed_parts(scene, detail::posed_instances(scene), source.parts[0]),
                           detail::boxed_parts(target, flat.pieces, flat.flat)),
        max_distance, context);
    const detail::OntoMap& map = *own_map;
    // For baking the source is the original of the mesh.
    mesh->part.source = &source.parts[0];
    mesh->part.map = std::move(own_map);
    std::string fault;
    if (onto.uvs != OntoUvs::created) mesh->part.given_uvs = detail::usable_uvs(target, flat, fault);
    if (onto.uvs == OntoUvs::keep && !fault.empty())
        throw InputError("", "target", "its UVs cannot be kept, because " + fault + ": new ones are needed");
    const bool keeps_uvs = !mesh->part.given_uvs.empty();
    std::vector<Index>& source_faces = mesh->mesh.history.remaining_faces;
    source_faces.resize(mesh->part.faces());
    detail::parallel_each(source_faces.size(), 256, context, [&](std::size_t f) {
        source_faces[f] = map.map(static_cast<Index>(f), detail::quarter_points[0]).face;
    });
    detail::UnencodedResult out;
    out.asset.report = std::move(result.report);
    TargetCoverage& coverage = out.asset.report.coverage.emplace();
    if (!detail::bake_pages({source, options.bake, {&mesh->part, 1}, context}, {}, out))
        throw InputError("", "target", "has more charts than a page of texture_size has texels");
    const auto is_matched = [&](Index begin, Index end) {
        while (begin < end && !map.is_matched(begin)) ++begin;
        return begin < end;
    };
    Asset textured = target;
    for (Part& part : textured.parts) part.face_material.assign(part.triangles.size(), no_index);
    const Part baked = std::move(out.asset.asset.parts[0]);
    for (const detail::FlatTarget::Piece& piece : flat.pieces) {
        const Part& part = target.parts[piece.part];
        const auto faces = static_cast<Index>(part.triangles.size());
        if (!is_matched(piece.first_face, piece.first_face + faces))
            coverage.unmatched_parts.push_back(detail::part_title(target, piece.part));
        textured.parts[piece.part] = detail::textured_part(part, flat, piece, baked, keeps_uvs,
                                                           out.asset.asset.materials, options.bake, context);
    }
    if (coverage.unmatched_parts.size() == flat.pieces.size())
        throw InputError("", "target",
                         "no point of it is near the source, on the side that the source shows: they must be "
                         "at the same place and of the same size, or max_distance must be larger");
    textured.materials = std::move(out.asset.asset.materials);
    textured.images = std::move(out.asset.asset.images);
    textured.format = options.format;
    textured.smoothing = Smoothing::unknown;
    out.asset.asset = std::move(textured);
    detail::set_quantization(target, options, out.asset.asset, out.asset.report);
    detail::encode_images(out, options, context);
    coverage.largest_distance = map.largest_distance();
    if (out.shown_texels > 0)
        coverage.missing_texels =
            static_cast<double>(out.missing_texels) / static_cast<double>(out.shown_texels);
    result = std::move(out.asset);
}

void warn(const Asset& target, SimplifiedAsset& result) {
    std::vector<std::string>& warnings = result.report.warnings;
    const TargetCoverage& coverage = *result.report.coverage;
    if (result.asset.images.empty())
        warnings.emplace_back(
            "no texture was made, because the source has one colour; with normal_map on, one shows its "
            "shape");
    for (const std::string& part : coverage.unmatched_parts)
        warnings.push_back(part + ": no point of the source is near it");
    if (coverage.missing_texels > max_silent_share)
        warnings.push_back(std::to_string(std::lround(100 * coverage.missing_texels)) +
                           "% of the texels have no point of the source, and the colours of those around");
    for (std::size_t p = 0; p < target.parts.size(); ++p)
        if (detail::has_non_white_colors(target.parts[p]))
            warnings.push_back(detail::part_title(target, p) + ": its vertex colours were left out");
}

}  // namespace

OntoOptions onto_options(std::string_view uvs, std::string_view max_distance) {
    OntoOptions result;
    if (!uvs.empty() && uvs != "auto") {
        result.uvs = uvs == "keep" ? OntoUvs::keep : OntoUvs::created;
        if (uvs != "keep" && uvs != "new")
            throw OptionError("uvs: '" + std::string(uvs) + "' is not auto, keep or new");
    }
    if (max_distance.empty()) return result;
    const detail::OptionValue length = detail::parse_option_number(
        max_distance, detail::OptionKind::length, {.excludes_min = true}, {}, "max_distance");
    result.max_distance = {*length.number, length.unit};
    return result;
}

SimplifiedAsset bake_onto(const Asset& given_source, const Asset& given_target, const Options& requested,
                          const OntoOptions& onto) {
    check_options(requested, onto);
    const detail::Stopwatch watch;
    const RunContext context(requested);
    SimplifiedAsset result;
    try {
        const Asset source = finest(given_source, "source", result.report),
                    target = finest(given_target, "target", result.report);
        Options options = requested;
        if (!holds_textures(target.format) && options.format == ModelFormat::automatic)
            options.format = ModelFormat::glb;
        options.format = detail::resolved_options(target, options).format;
        const bool keeps_extensions =
            detail::result_format(options.format, {}).is_gltf && !detail::names_objects_by_number(target);
        const Asset flat = flat_source(source, keeps_extensions, result.report);
        const double max_distance =
            detail::scene_size(source)(onto.max_distance.value_or(of_diagonal(usual_max_distance)));
        bake_parts(source, flat, target, options, onto, max_distance, context, result);
        for (Material& material : result.asset.materials) {
            material.rebaked = true;  // variants of the target are of other materials
            if (!keeps_extensions) material.source = no_index;
        }
        if (keeps_extensions) detail::carry_materials(source, result.asset);
        warn(target, result);
        for (std::size_t p = 0; p < target.parts.size(); ++p) {
            result.report.faces_in += target.parts[p].triangles.size();
            result.report.vertices_in += target.parts[p].positions.size();
            result.report.vertices_out += result.asset.parts[p].positions.size();
        }
        result.report.faces_out = result.report.faces_in;
        result.report.bytes_in = target.file_bytes;
    } catch (const engine::Cancelled& stopped) {
        if (stopped.reason != StopReason::cancelled)
            throw TimeLimitError("max_seconds was over before the textures were complete");
        result = {};
        result.report.stop = stopped.reason;
    }
    result.report.seconds.total = watch.seconds();
    return result;
}

}  // namespace faqem
