#include "scene/resolved_options.hpp"

#include <algorithm>

#include "asset/file_format.hpp"
#include "asset/image/image.hpp"
#include "asset/scene/material_textures.hpp"
#include "asset/scene/part_arrays.hpp"
#include "faqem/error.hpp"
#include "scene/position_grids.hpp"

namespace faqem::detail {
namespace {

// Whether the vertex colours of a part are classes, such as the labels of a segmented scan: nearly all faces have one
// colour, and most vertices are inside a class. A colour between two classes means nothing. O(faces)
bool has_color_classes(const Part& part) {
    if (part.colors.empty()) return false;
    const auto faces = static_cast<double>(part.triangles.size());
    const auto plain = std::ranges::count_if(part.triangles, [&](const Triangle& t) {
        return part.colors[t[0]] == part.colors[t[1]] && part.colors[t[0]] == part.colors[t[2]];
    });
    const bool has_colors =
        std::ranges::any_of(part.colors, [&](const auto& color) { return color != part.colors.front(); });
    return has_colors && static_cast<double>(plain) >= 0.95 * faces &&
           static_cast<double>(part.positions.size()) <= 0.75 * faces;
}

// Normals of formats that need not have any stay automatic, since a normal map that is baked needs them.
void resolve_normals(const Asset& source, const FileFormat& format, BakeOptions& bake) {
    if (bake.normals == Normals::none && bake.kind == Bake::automatic) bake.normal_map = NormalMap::off;
    if (bake.normals != Normals::automatic) return;
    if (format.is_gltf) bake.normals = Normals::transfer;
    // Flat normals need no map to the original. If the source has normals, save() warns that the format cannot store
    // them.
    if (!format.holds_normals)
        bake.normals = some_part_has(source, &Part::normals) ? Normals::flat : Normals::none;
}

// Replaces what is automatic by what the format can hold.
void resolve_bake(const Asset& source, const FileFormat& format, BakeOptions& bake) {
    const bool is_bare = source.materials.empty() && !some_part_has(source, &Part::colors);
    const bool keeps_uvs = format.keeps_plain_parts && some_part_has(source, &Part::uvs);
    bake.kind = !is_bare ? format.bake : keeps_uvs ? Bake::keep : format.bare_bake;
    if (bake.kind == Bake::vertex && source.images.empty() &&
        std::ranges::any_of(source.parts, has_color_classes))
        bake.kind = Bake::keep;
    if (format.is_gltf && names_objects_by_number(source)) bake.kind = Bake::keep;
    if (bake.untouched != UntouchedParts::automatic || !format.keeps_plain_parts) return;
    if (source.materials.empty()) bake.untouched = UntouchedParts::kept;
    if (source.source) bake.untouched = UntouchedParts::baked;
}

}  // namespace

Options resolved_options(const Asset& source, Options options) {
    const FileFormat& format = result_format(options.format, source.format);
    options.format = format.format;
    if (!format.is_gltf) {
        if (options.bake.image_format == ImageFormat::webp)
            throw OptionError("WebP images: the format of the result must be .glb or .gltf");
        if (options.quantize.kind == Quantize::on)
            throw OptionError("quantised vertices: the format of the result must be .glb or .gltf");
        options.quantize.kind = Quantize::off;
    }
    BakeOptions& bake = options.bake;
    resolve_normals(source, format, bake);
    if (bake.kind == Bake::automatic) resolve_bake(source, format, bake);
    const bool needs_pixels = makes_atlas(bake.kind) || bake.kind == Bake::vertex;
    if (needs_pixels && std::ranges::any_of(source.images, is_passed_through)) bake.kind = Bake::keep;
    return options;
}

std::vector<std::string> idle_options(const Asset& source, const Options& options,
                                      std::span<const std::string_view> names, OptionSpelling spelling) {
    Options resolved = resolved_options(source, options);
    resolved.compress = result_compression(source, resolved);
    // Normals and UVs of a source that has them rounded are rounded with the bits of the options; positions are not.
    if (resolved.quantize.kind == Quantize::source && resolved.compress != Compression::draco &&
        source.normal_bits == 0 && source.uv_bits == 0)
        resolved.quantize.kind = Quantize::off;
    return idle_options(resolved, names, spelling);
}

bool may_keep_uvs(const Options& options) {
    const BakeOptions& bake = options.bake;
    return bake.kind == Bake::automatic && bake.normal_map == NormalMap::automatic && !bake.texel_density &&
           bake.correspondence == Recording::off &&
           (bake.normals == Normals::automatic || bake.normals == Normals::transfer) &&
           bake.untouched != UntouchedParts::baked && options.history == Recording::off && !options.max_error;
}

}  // namespace faqem::detail
