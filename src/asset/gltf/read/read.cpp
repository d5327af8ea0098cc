#include "asset/gltf/read/read.hpp"

#include <algorithm>
#include <cmath>

#include "asset/file.hpp"
#include "asset/gltf/gltf.hpp"
#include "asset/image/image.hpp"
#include "asset/material_textures.hpp"
#include "faqem/error.hpp"

namespace faqem::detail {
namespace {

/// \throws UnsupportedError  a texture of the core material model is of a kind that cannot be decoded
void check_image_types(const Asset& asset, const SourceDocument& source, const std::string& file) {
    const auto check = [&](const TextureRef& ref) {
        if (!ref) return;
        const std::string& type = source.images[ref.image].mime_type;
        if (type.empty() || can_decode_image(type)) return;
        throw UnsupportedError(file, step("/images", ref.image),
                               "is " +
                                   (type == "image/ktx2" ? std::string("KTX2 (KHR_texture_basisu)") : type) +
                                   ", only " + decodable_images() + " are supported");
    };
    for (const Material& material : asset.materials) for_each_core_texture(material, check);
}

/// Gives the asset the images its materials use, each once, and renumbers the references.
void share_images(Asset& asset, const SourceDocument& source) {
    std::vector<Index> shared(source.images.size(), no_index);
    for (const Material& material : asset.materials)
        for_each_texture(material, [&](const TextureRef& ref) {
            if (ref) shared[ref.image] = 0;
        });
    for (std::size_t i = 0; i < shared.size(); ++i)
        if (shared[i] != no_index) {
            shared[i] = static_cast<Index>(asset.images.size());
            asset.images.push_back(source.images[i]);
        }
    for (Material& material : asset.materials)
        for_each_texture(material, [&](TextureRef& ref) {
            if (ref) ref.image = shared[ref.image];
        });
}

/// Everything in the scene must be at a place that doubles can say, so that it can be flattened and measured.
void check_places(const Asset& asset, const std::string& file) {
    std::vector<double> reach(asset.parts.size(), 0);  // largest coordinate of each part
    for (std::size_t p = 0; p < reach.size(); ++p)
        for (const Vec3& position : asset.parts[p].positions)
            for (const double x : position) reach[p] = std::max(reach[p], std::abs(x));
    for (const Instance& instance : instances(asset)) {
        const auto& m = instance.transform;
        for (std::size_t r = 0; r < 3; ++r) {
            const double farthest = (std::abs(m[r]) + std::abs(m[4 + r]) + std::abs(m[8 + r])) *
                                        std::max(reach[instance.part], 1.0) +
                                    std::abs(m[12 + r]);
            if (!std::isfinite(farthest))
                throw InputError(file, step("/meshes", asset.parts[instance.part].source),
                                 "a node places it beyond the range of numbers");
        }
    }
}

}  // namespace

Asset read_gltf(const std::filesystem::path& file) { return read_gltf(read_file(file), file); }

Asset read_gltf(std::span<const std::uint8_t> bytes, const std::filesystem::path& file) {
    LoadedGltf loaded = load_gltf(bytes, file);
    Asset asset;
    loaded.source->materials = read_materials(loaded);
    asset.materials = loaded.source->materials;
    check_image_types(asset, *loaded.source, loaded.file);
    share_images(asset, *loaded.source);
    std::uint64_t faces = 0, dropped_faces = 0;
    for (Index mesh = 0; mesh < loaded.model.meshes.size(); ++mesh) {
        asset.parts.push_back(read_part(loaded, mesh, dropped_faces));
        faces += asset.parts.back().triangles.size();
    }
    if (faces == 0 && dropped_faces != 0)
        throw InputError(loaded.file, "/meshes", "all faces have a position that is not finite");
    asset.source = std::move(loaded.source);
    asset.warnings = std::move(loaded.warnings);
    check_places(asset, loaded.file);
    return asset;
}

}  // namespace faqem::detail
