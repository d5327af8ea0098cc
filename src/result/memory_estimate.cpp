#include "result/memory_estimate.hpp"

#include <algorithm>
#include <system_error>
#include <vector>

#include "asset/file_format.hpp"
#include "asset/image/image_size.hpp"
#include "asset/model_files.hpp"
#include "asset/scene/measured_instances.hpp"
#include "bake/source/page_groups.hpp"
#include "faqem/detail/simplify/run.hpp"
#include "result/best_picture.hpp"
#include "scene/layers.hpp"
#include "scene/parts/simplify_parts.hpp"
#include "scene/resolved_options.hpp"
#include "scene/weights/contrast.hpp"

namespace faqem::detail {

namespace {

/// Bytes per face of the mesh being simplified. Measured on meshes of 0.06 to 1 million faces, rounded up.
double simplify_bytes_per_face(Preset preset) {
    if (preset == Preset::best) return 1750;
    if (preset == Preset::balanced) return 450;
    return preset == Preset::fast ? 350 : 700;
}

constexpr double history_bytes_per_face = 300;  // collapse history and the data structures of the baking map
constexpr double layer_bytes_per_face = 250;    // see separate_layers()
constexpr double visibility_bytes_per_face = 400;  // per face of all instances, if what is seen affects costs
constexpr double view_bytes = 24e6;                // of pictures, see lower_hidden_weights()
constexpr double bytes_per_corner_value = 12;
constexpr double image_library_bytes = 30e6;  // libraries of PNG, JPEG and WebP, and their buffers
constexpr double bake_bytes_per_texel = 36, page_bytes_per_texel = 8, correspondence_bytes_per_texel = 24;
constexpr double bake_bytes_per_layer_texel = 9;  // per texel of each texture of material extensions

// Of a search for the best picture: pictures, what is rendered, textures, and images that are tried in several sizes.
constexpr double picture_bytes = 60e6, drawn_bytes_per_face = 500;
constexpr double texture_bytes_per_texel = 6, tried_bytes_per_texel = 14;

/// --max-error needs memory for the best mesh so far and the distance measurement.
double search_factor(const Options& options) { return options.max_error ? 1.3 : 1; }

/// Memory for the simplification and its histories.
/// \param all, largest  numbers of faces of all meshes and of the largest one
double work_bytes(const Options& options, double all, double largest) {
    return search_factor(options) *
           (history_bytes_per_face * all + simplify_bytes_per_face(options.preset) * largest);
}

std::size_t attribute_values_per_corner(const Part& part) {
    return 2 * part.uvs.size() + (part.colors.empty() ? 0 : 4);
}

/// Memory of the decoded images, and of the decoder of one of them.
double decoded_image_bytes(const Asset& asset) {
    double bytes = 0;
    std::uint64_t decoder = 0;
    for (const Image& image : asset.images) {
        // Larger images are rejected before memory for their pixels is allocated.
        bytes += 4.0 * static_cast<double>(readable_pixels(image));
        decoder = std::max(decoder, decoding_memory(image));
    }
    return bytes + static_cast<double>(decoder);
}

double page_bytes(const Asset& asset, const BakeOptions& bake) {
    const double texels = static_cast<double>(bake.texture_size) * bake.texture_size;
    const double held =
        page_bytes_per_texel + (bake.correspondence == Recording::on ? correspondence_bytes_per_texel : 0);
    const auto pages =
        has_plain_materials(asset, bake) ? 0.0 : static_cast<double>(page_groups(asset, bake).groups.size());
    std::size_t layers = 0;
    for (const Material& material : asset.materials)
        layers = std::max(layers, material.extension_textures.size());
    return texels *
           (bake_bytes_per_texel + bake_bytes_per_layer_texel * static_cast<double>(layers) + held * pages);
}

double instanced_face_count(const Asset& asset) {
    double faces = 0;
    for (const Instance& instance : measured_instances(asset))
        faces += static_cast<double>(asset.parts[instance.part].triangles.size());
    return faces;
}

}  // namespace

std::uint64_t estimated_document_memory(const std::filesystem::path& model, std::uint64_t allowed) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(model, ignored)) return 0;
    const FileFormat* format = format_of_file(model);
    return format && format->document_memory ? format->document_memory(model, allowed) : 0;
}

std::uint64_t estimated_model_memory(const std::filesystem::path& model, std::uint64_t allowed) {
    std::error_code ignored;
    // The size of a pipe is unknown, and it must not be opened here.
    if (!std::filesystem::is_regular_file(model, ignored)) return 0;
    const FileFormat* format = format_of_file(model);
    std::vector<std::filesystem::path> files;
    if (format && !format->is_read_for_references) files = referenced_files(model, References::readable);
    files.push_back(model);
    // Factor 5: the bytes, the arrays decoded from them, and the copies made while the arrays grow. The arrays
    // of glTF are counted below.
    const std::uint64_t stored_bytes = total_file_size(files);
    if (!format || !format->decoding_memory) return 5 * stored_bytes;
    std::uint64_t bytes = 3 * stored_bytes;
    if (bytes <= allowed) bytes += format->document_memory(model, allowed - bytes);
    if (bytes <= allowed) bytes += format->decoding_memory(model, stored_bytes);
    return bytes;
}

std::uint64_t estimated_simplify_memory(const Asset& asset, const Options& requested) {
    const Options options = resolved_options(asset, requested);
    double all = 0, largest = 0, values = 0;
    for (const Part& part : asset.parts) {
        const auto faces = static_cast<double>(part.triangles.size());
        all += faces;
        largest = std::max(largest, faces);
        values = std::max(values, 3 * faces * static_cast<double>(attribute_values_per_corner(part)));
    }
    double work = work_bytes(options, all, largest);
    if (options.preset == Preset::balanced && !asset.images.empty() && options.bake.kind != Bake::keep) {
        // Half as much again, because the target is not distributed evenly.
        const double share = static_cast<double>(target_face_count(options.target, all)) / std::max(all, 1.0);
        const double fitted =
            std::min({largest, static_cast<double>(most_faces_to_fit),
                      1.5 * static_cast<double>(most_fitted_faces) / std::max(share, 1e-9)});
        work = std::max(work, history_bytes_per_face * all + simplify_bytes_per_face(Preset::best) * fitted);
    }
    if (separates_layers(asset, options))
        work = std::max(work, (history_bytes_per_face + layer_bytes_per_face) * all);
    if (options.bake.kind == Bake::keep) work += search_factor(options) * bytes_per_corner_value * values;
    if (options.visibility == Visibility::weighted || is_weighted_by_pictures(asset, options))
        work = std::max(work, view_bytes + visibility_bytes_per_face * instanced_face_count(asset));
    const bool searches = searches_best_picture(options);
    double baking = 0;
    if (options.bake.kind != Bake::keep && options.bake.kind != Bake::none)
        baking += decoded_image_bytes(asset);
    // A search keeps the UVs.
    if (makes_atlas(options.bake.kind) && !searches) baking += page_bytes(asset, options.bake);
    if (baking > 0) baking += image_library_bytes;
    if (searches) {
        const double texels = decoded_image_bytes(asset) / 4;
        baking += picture_bytes + drawn_bytes_per_face * instanced_face_count(asset) +
                  texels * (texture_bytes_per_texel +
                            (options.bake.kind == Bake::automatic ? tried_bytes_per_texel : 0));
    }
    return static_cast<std::uint64_t>(work + baking);
}

std::uint64_t estimated_work_memory(const std::filesystem::path& model, std::uint64_t stored_bytes,
                                    const Options& options) {
    double bytes = 64e6;  // the process and its threads
    const bool searches = searches_best_picture(options);
    const double texel_bytes =
        searches ? texture_bytes_per_texel + tried_bytes_per_texel : bake_bytes_per_texel;
    if (makes_atlas(options.bake.kind))
        bytes += texel_bytes * options.bake.texture_size * options.bake.texture_size;
    const FileFormat* format = format_by_name(model);
    const double min_bytes_per_face = format ? format->min_bytes_per_face : 15;
    const double faces = static_cast<double>(stored_bytes) / min_bytes_per_face;
    if (searches) bytes += picture_bytes + drawn_bytes_per_face * faces;
    return static_cast<std::uint64_t>(bytes + work_bytes(options, faces, faces));
}

}  // namespace faqem::detail
