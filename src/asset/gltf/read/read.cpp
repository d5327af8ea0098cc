#include "asset/gltf/read/load.hpp"

#include <algorithm>
#include <cmath>

#include "asset/gltf/gltf.hpp"
#include "asset/gltf/read/checker.hpp"
#include "asset/gltf/scene.hpp"
#include "asset/gltf/source_document.hpp"
#include "asset/image/image.hpp"
#include "asset/scene/affine.hpp"
#include "asset/scene/material_textures.hpp"
#include "asset/scene/messages.hpp"
#include "asset/scene/rest_pose.hpp"
#include "faqem/error.hpp"

namespace faqem::detail {
namespace {

bool is_listed(const Json& document, const char* list, const char* extension) {
    const Json& names = member(document, list);
    return std::ranges::find(names, extension) != names.end();
}

/// Some programs write KTX2, AVIF and DDS images as the core source of a texture, where glTF allows PNG and JPEG only.
/// Such a source becomes that of the extension for its type, which is required then.
void move_sources_to_extensions(SourceDocument& source, std::vector<std::string>& warnings) {
    Json& document = source.document;
    for (const ImageExtension& extension : image_extensions) {
        std::uint64_t moved = 0;
        for (std::size_t t = 0; t < array_size(document, "textures"); ++t) {
            Json& texture = document["textures"][t];
            const Index image = index_member(texture, "source");
            if (image == no_index || !keeps_encoding(source.images[image]) ||
                source.images[image].mime_type != extension.media_type ||
                member(texture, "extensions", extension.name).contains("source"))
                continue;
            texture.erase("source");
            texture["extensions"][extension.name]["source"] = image;
            ++moved;
        }
        if (moved == 0) continue;
        for (const char* list : {"extensionsUsed", "extensionsRequired"})
            if (!is_listed(document, list, extension.name)) document[list].push_back(extension.name);
        warnings.push_back(pluralized(moved, "texture") + " with " + extension.media_type +
                           " as the core source: read as the source of " + extension.name);
    }
}

/// Checks that all positions, in world space and in the pose at rest, are within the range of double, so that the scene
/// can be flattened and measured.
void check_world_positions(const Asset& asset, const std::string& file) {
    std::vector<double> largest;  // absolute coordinate of each part, at least 1
    for (const Part& part : asset.parts) largest.push_back(std::max(largest_component(part.positions), 1.0));
    const auto fail = [&](Index part, const char* why) {
        throw InputError(file, child_path("/meshes", asset.parts[part].source), why);
    };
    for (const Instance& instance : instances(asset))
        if (!std::isfinite(transformed_bound(instance.transform, largest[instance.part])))
            fail(instance.part, "a node transform moves it out of the range of double");
    for (const PosedInstance& instance : posed_instances(asset)) {
        const Part& part = asset.parts[instance.part];
        if (instance.pose && !std::isfinite(posed_coordinate_bound(part, largest[instance.part], instance)))
            fail(instance.part, "its joints or default morph weights move it out of the range of double");
    }
}

void warn_of_inverse_binds(const SourceDocument& source, const std::string& file,
                           std::vector<std::string>& warnings) {
    const Json& skins = member(source.document, "skins");
    for (std::size_t i = 0; i < skins.size(); ++i)
        if (const std::uint64_t repaired = inverse_binds(source, skins[i]).repaired)
            warnings.push_back((file.empty() ? "" : file + ": ") + child_path("/skins", i) + ": " +
                               std::to_string(repaired) +
                               " inverse bind matrices that are not finite are taken as the identity");
}

}  // namespace

Asset read_gltf(std::span<const std::uint8_t> bytes, const std::filesystem::path& file) {
    LoadedGltf loaded = load_gltf(bytes, file);
    Asset asset;
    move_sources_to_extensions(*loaded.source, loaded.warnings);
    loaded.source->materials = read_materials(loaded);
    asset.materials = loaded.source->materials;
    asset.images = used_images(asset.materials, loaded.source->images);
    std::uint64_t faces = 0, dropped_faces = 0;
    for (Index mesh = 0; mesh < array_size(loaded.source->document, "meshes"); ++mesh) {
        asset.parts.push_back(read_part(loaded, mesh, dropped_faces));
        faces += asset.parts.back().triangles.size();
    }
    if (faces == 0 && dropped_faces != 0)
        throw InputError(loaded.file, "/meshes", "all faces have a non-finite position");
    read_vertex_bits(loaded, asset);
    asset.precision.type = StoredPrecision::Type::float32;
    asset.compression = loaded.source->compression;
    loaded.source->unused = unused_objects(loaded.source->document);
    asset.source = std::move(loaded.source);
    asset.warnings = std::move(loaded.warnings);
    for (const std::string& name : unknown_extensions(asset.source->document))
        asset.not_understood.push_back("extension " + name);
    check_world_positions(asset, loaded.file);
    warn_of_inverse_binds(*asset.source, loaded.file, asset.warnings);
    return asset;
}

}  // namespace faqem::detail
