#include "asset/gltf_read.hpp"

#include "asset/gltf.hpp"
#include "faqem/error.hpp"

namespace faqem::detail {
namespace {

/// \throws UnsupportedError  a texture of the core material model is of a kind that cannot be decoded
void check_image_types(const Asset& asset, const SourceDocument& source, const std::string& file) {
    for (const Material& material : asset.materials)
        for (const TextureRef* ref : texture_slots(material)) {
            if (!*ref) continue;
            const std::string& type = source.images[ref->image].mime_type;
            const std::string where = step("/images", ref->image);
            if (type == "image/ktx2")
                throw UnsupportedError(file, where,
                                       "is KTX2 (KHR_texture_basisu), which is not supported yet");
            if (!type.empty() && type != "image/png" && type != "image/jpeg")
                throw UnsupportedError(file, where, "is " + type + ", only PNG and JPEG are supported");
        }
}

/// Gives the asset the images its materials use, each once, and renumbers the references.
void share_images(Asset& asset, const SourceDocument& source) {
    std::vector<Index> shared(source.images.size(), no_index);
    for (Material& material : asset.materials)
        for (TextureRef* ref : texture_slots(material))
            if (*ref) shared[ref->image] = 0;
    for (std::size_t i = 0; i < shared.size(); ++i)
        if (shared[i] != no_index) {
            shared[i] = static_cast<Index>(asset.images.size());
            asset.images.push_back(source.images[i]);
        }
    for (Material& material : asset.materials)
        for (TextureRef* ref : texture_slots(material))
            if (*ref) ref->image = shared[ref->image];
}

}  // namespace

Asset read_gltf(const std::filesystem::path& file) {
    LoadedGltf loaded = load_gltf(file);
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
    return asset;
}

}  // namespace faqem::detail
