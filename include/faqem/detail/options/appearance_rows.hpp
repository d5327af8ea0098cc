#pragma once
/// \file
/// Rows of the table of options: those for assets, mainly the baking.

#include "faqem/detail/options/option_row.hpp"

FAQEM_DETAIL_BEGIN

// Functions for OptionRow::idle.

inline std::string_view without_new_texture(const Options& o) {
    return o.bake.kind == Bake::automatic || makes_atlas(o.bake.kind) ? "" : "there is no new texture";
}
inline std::string_view without_new_image(const Options& o) {
    return o.max_bytes ? "" : without_new_texture(o);
}
inline std::string_view without_rounding(const Options& o) {
    const bool may_round = o.compress == Compression::draco || o.compress == Compression::source;
    const bool rounds = o.quantize.kind == Quantize::on || (o.quantize.kind == Quantize::source && may_round);
    return rounds ? "" : "vertices are not rounded to a new grid";
}
inline std::string_view without_compression(const Options& o) {
    if (o.compress == Compression::none) return "vertices are not compressed";
    return o.quantize.kind == Quantize::off ? "vertices are not rounded" : "";
}

inline constexpr OptionRow appearance_rows[] = {
    option_row<&Options::budget>({.name = "budget",
                                  .choices = "scene|mesh",
                                  .help = "How the faces are distributed among the meshes of a scene; scene "
                                          "(by error), mesh (in proportion to their face counts)",
                                  .entry_points = in_all_but_truncate}),
    option_row<&Options::visibility>({.name = "visibility",
                                      .choices = "auto|ignored|weighted",
                                      .help = "Errors on hidden surface; auto (deep inside they count less), "
                                              "ignored (visibility has no effect), weighted (they count as "
                                              "much as the surface is seen)",
                                      .entry_points = in_all_but_truncate}),
    option_row<&Options::format>({.name = "format",
                                  .choices = "auto|glb|gltf|obj|ply|stl",
                                  .help = "Format of the files that the result is for"}),
    option_row<&Options::larger>(
        {.name = "allow-larger",
         .member_name = "larger",
         .choices = "avoided|allowed",
         .flag_value = "allowed",
         .help = "Give nothing up if a textured result has more bytes than its input",
         .entry_points = in_all}),
    option_row<&Options::max_bytes>(
        {.name = "max-bytes",
         .value_name = "SIZE",
         .help = "Maximum size of all files together, as 2MB or 500KB; of a model or level. Without a face "
                 "count, faces and images are chosen for the best picture, otherwise images are reduced, and "
                 "then faces",
         .group = "Target",
         .excludes = "max-error",
         .entry_points = in_all}),
    option_row<&Options::bake, &BakeOptions::kind>(
        {.name = "bake",
         .choices = "auto|atlas|per-triangle|vertex|keep|none",
         .help = "Where colours are stored; auto (keep, atlas or per-triangle, see docs/baking.md), atlas "
                 "(charts), per-triangle, vertex, keep, none",
         .group = "Appearance",
         .entry_points = in_all}),
    option_row<&Options::bake, &BakeOptions::texture_size>(
        {.name = "texture-size",
         .range = {.min = 64, .max = 16384, .power_of_two = true},
         .value_name = "N",
         .help = "Maximum side of a baked image in texels",
         .group = "Appearance",
         .entry_points = in_all,
         .idle = without_new_image}),
    option_row<&Options::bake, &BakeOptions::texel_density>(
        {.name = "texel-density",
         .range = {.min = 0.125, .max = 8},
         .value_name = "X",
         .default_text = "1, more on small pages",
         .help = "Texels per length of a new texture, relative to the source",
         .entry_points = in_all,
         .idle = without_new_texture}),
    option_row<&Options::bake, &BakeOptions::normal_map>(
        {.name = "normal-map",
         .choices = "auto|on|off",
         .help = "Normal map of a new texture; auto (if the source has one or its normals differ), on, off",
         .entry_points = in_all,
         .idle = without_new_texture}),
    option_row<&Options::bake, &BakeOptions::normals>(
        {.name = "normals",
         .choices = "auto|transfer|smooth|flat|none",
         .help = "Vertex normals; auto (in OBJ and PLY only if the input has some), transfer (from the "
                 "original), smooth or smooth:ANGLE (averaged below ANGLE degrees, default 40), flat, none",
         .suffix_choice = "smooth",
         .suffix_option = "crease-angle",
         .entry_points = in_all}),
    option_row<&Options::bake, &BakeOptions::crease_angle>(
        {.name = "crease-angle",
         .command_name = "normals: the angle of smooth",
         .range = {.max = 180},
         .unit = "degrees",
         .help = "Angle between normals above which smooth normals split a vertex"}),
    option_row<&Options::bake, &BakeOptions::image_format>(
        {.name = "image-format",
         .choices = "auto|png|jpeg|source|webp|png-or-jpeg",
         .help = "Format of baked images; auto (the smallest within --image-quality), png, jpeg or "
                 "jpeg:QUALITY (1 to 100, default 90), source (that of the images they are baked from), webp "
                 "(for colours, and where it is smaller; viewers need EXT_texture_webp), png-or-jpeg (as "
                 "auto, never WebP)",
         .suffix_choice = "jpeg",
         .suffix_option = "jpeg-quality",
         .entry_points = in_all,
         .idle = without_new_image}),
    option_row<&Options::bake, &BakeOptions::image_quality>(
        {.name = "image-quality",
         .range = {.min = 20, .max = 80},
         .unit = "dB",
         .value_name = "DB",
         .default_text = "40, 38 to 44 if pictures were compared",
         .help = "Least PSNR of baked colours with --image-format auto, webp or png-or-jpeg; of data 4 dB "
                 "less, of normals up to 4 dB less, where the surface is rough",
         .entry_points = in_all,
         .idle = without_new_image}),
    option_row<&Options::bake, &BakeOptions::jpeg_quality>(
        {.name = "jpeg-quality",
         .command_name = "image-format: the quality of jpeg",
         .range = {.min = 1, .max = 100},
         .help = "Quality of baked JPEG images"}),
    option_row<&Options::bake, &BakeOptions::untouched>(
        {.name = "untouched",
         .choices = "auto|kept|baked",
         .help = "Meshes of which the simplification changed nothing: auto (kept unless another option "
                 "changes their images or normals), kept, baked"}),
    option_row<&Options::bake, &BakeOptions::samples>(
        {.name = "samples", .range = {.min = 1, .max = 8}, .help = "Samples per texel along each axis"}),
    option_row<&Options::bake, &BakeOptions::correspondence>(
        {.name = "correspondence",
         .choices = "off|on",
         .help = "Whether to record the position of each texel of a new atlas on the original",
         .entry_points = 0}),
    option_row<&Options::compress>(
        {.name = "compress",
         .choices = "source|none|meshopt|draco",
         .help = "Compression of geometry in glTF files; source (as the input), none, meshopt (viewers need "
                 "EXT_meshopt_compression), draco (viewers need KHR_draco_mesh_compression)",
         .entry_points = in_all}),
    option_row<&Options::quantize, &QuantizeOptions::kind>(
        {.name = "quantize",
         .choices = "source|off|on",
         .help = "Vertices in glTF files as integers; source (as the input), off, on (viewers need "
                 "KHR_mesh_quantization)",
         .entry_points = in_all}),
    option_row<&Options::quantize, &QuantizeOptions::position_bits>(
        {.name = "position-bits",
         .range = {.min = 8, .max = 16},
         .value_name = "N",
         .default_text = "14",
         .help = "Bits of quantised positions; steps of the grid along the diagonal of the scene",
         .entry_points = in_all,
         .idle = without_rounding}),
    option_row<&Options::quantize, &QuantizeOptions::normal_bits>(
        {.name = "normal-bits",
         .range = {.min = 8, .max = 16},
         .value_name = "N",
         .help = "Bits of quantised normals and tangents that are compressed",
         .entry_points = in_all,
         .idle = without_compression}),
    option_row<&Options::quantize, &QuantizeOptions::uv_bits>(
        {.name = "uv-bits",
         .range = {.min = 8, .max = 16},
         .value_name = "N",
         .help = "Bits of quantised texture coordinates that are compressed",
         .entry_points = in_all,
         .idle = without_compression}),
};

FAQEM_DETAIL_END
