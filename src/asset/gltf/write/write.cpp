#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include "asset/gltf/accessor.hpp"
#include "asset/gltf/container.hpp"
#include "asset/gltf/gltf.hpp"
#include "asset/gltf/source_document.hpp"
#include "asset/gltf/write/levels.hpp"
#include "asset/gltf/write/mesh_grid.hpp"
#include "asset/gltf/write/writer.hpp"
#include "asset/image/image.hpp"
#include "asset/io/file.hpp"
#include "asset/scene/flatten.hpp"

namespace faqem::detail {
namespace {

namespace fs = std::filesystem;

/// Top-level arrays that are rebuilt instead of copied.
constexpr std::array<std::string_view, 8> rebuilt_arrays = {
    "accessors", "bufferViews", "buffers", "images", "materials", "meshes", "samplers", "textures"};

Json start_document(const Json& source) {
    Json out = Json::object();
    if (source.is_object())
        for (const auto& [key, value] : source.items())
            if (std::ranges::find(rebuilt_arrays, key) == rebuilt_arrays.end()) out[key] = value;
    out["asset"]["version"] = "2.0";
    out["asset"]["generator"] = "faqem " FAQEM_VERSION;
    return out;
}

/// Adds min and max if they are missing: they are required for animation times and positions, but some files
/// do not have them.
void add_missing_bounds(Json& description, const std::vector<std::uint8_t>& dense) {
    if (description.contains("min") || description.contains("max") ||
        component_type(description) != NumberType::f32)
        return;
    const std::vector<float> values = floats_of(dense);
    if (values.empty() || !std::ranges::all_of(values, [](float x) { return std::isfinite(x); })) return;
    add_bounds<float>(description, values, component_count(string_member(description, "type")));
}

std::string json_text(const Json& document, int indent) {
    return document.dump(indent, ' ', false, Json::error_handler_t::replace);
}

/// Replaces the numbers of Draco data by the indices of its views.
void number_draco_views(GltfWriter& writer) {
    if (writer.asset.compression != Compression::draco) return;
    const Index first = writer.binary.first_data_view();
    for (Json& mesh : elements(writer.out, "meshes"))
        for (Json& primitive : elements(mesh, "primitives"))
            if (member(primitive, "extensions", draco_name).contains("bufferView"))
                primitive["extensions"][draco_name]["bufferView"] =
                    first + primitive["extensions"][draco_name]["bufferView"].get<Index>();
}

void encode_binary(GltfWriter& writer, const fs::path& file, EncodedModel& model) {
    for (std::size_t i = 0; i < writer.images.size(); ++i) {
        Json& json = writer.out["images"][i];
        json["bufferView"] = writer.binary.add_view(writer.images[i]->encoded);
        json["mimeType"] = writer.images[i]->mime_type;
        model.embedded_image_bytes += writer.images[i]->encoded.size();
    }
    const std::vector<std::uint8_t> buffer = writer.binary.finish(writer.out);
    model.files.push_back(
        encoded_file(file.filename().string(), join_glb(json_text(writer.out, -1), buffer, file.string())));
}

constexpr const char* unreserved = "-._~";  // marks in relative URIs (RFC 3986, section 2.3)

/// The images, the buffer and then the JSON, which refers to them.
void encode_json_with_files(GltfWriter& writer, const fs::path& file, EncodedModel& model) {
    const std::string stem = file.stem().string();
    for (std::size_t i = 0; i < writer.images.size(); ++i) {
        const Image& image = *writer.images[i];
        const std::string name = image_file_name(stem, i, file_extension(image.mime_type));
        writer.out["images"][i]["uri"] = percent_encoded(name, unreserved);
        if (!image.mime_type.empty()) writer.out["images"][i]["mimeType"] = image.mime_type;
        model.files.push_back(encoded_image(name, image));
    }
    std::vector<std::uint8_t> buffer = writer.binary.finish(writer.out);
    if (!buffer.empty()) {
        writer.out["buffers"][0]["uri"] = percent_encoded(buffer_file_name(stem), unreserved);
        model.files.push_back(encoded_file(buffer_file_name(stem), std::move(buffer)));
    }
    model.files.push_back(encoded_file(file.filename().string(), json_text(writer.out, 2)));
}

/// The origin is not changed if there is a source document with meshes, whose nodes, skins and animations depend on it.
GltfWriter make_writer(const Asset& asset) {
    const SourceDocument& source = source_document(asset);
    GltfWriter writer{asset, source, start_document(source.document),
                      array_size(source.document, "meshes") > 0 ? Vec3{} : local_origin(asset.parts),
                      GltfBufferBuilder(asset.compression, {asset.normal_bits, asset.uv_bits})};
    if (!source.unused.empty()) writer.warnings.push_back(source.unused + ": left out");
    if (asset.compression == Compression::meshopt && !has_codec(meshopt_name))
        writer.warnings.push_back("faqem was built without meshoptimizer: the geometry was not compressed");
    if (asset.compression == Compression::draco && !has_codec(draco_name))
        writer.warnings.push_back("faqem was built without Draco: the geometry was not compressed");
    return writer;
}

/// \param leveled  the levels whose asset it is; null: there are none
EncodedModel encode(const Asset& asset, const LeveledAsset* leveled, const fs::path& file) {
    GltfWriter writer = make_writer(asset);
    std::vector<Index> new_meshes, mesh;  // mesh: by part
    if (leveled) writer.sources = leveled->sources;
    find_source_images(writer);
    write_meshes(writer, new_meshes);
    auto next = new_meshes.begin();
    for (const Part& part : asset.parts)
        mesh.push_back(part.source < writer.mesh_map.size() ? writer.mesh_map[part.source] : *next++);
    // Only the meshes of the first level are added to the scene.
    if (leveled) new_meshes.resize(new_meshes.size() + leveled->parts_per_level - asset.parts.size());
    write_scene(writer, new_meshes);
    if (leveled) attach_levels(writer, *leveled, mesh);
    place_grids(writer);  // no accessor is added afterwards
    number_draco_views(writer);
    remap_structural_metadata(writer);
    write_extension_lists(writer);
    EncodedModel model;
    if (lower_case_extension(file) == ".gltf")
        encode_json_with_files(writer, file, model);
    else
        encode_binary(writer, file, model);
    model.losses = std::move(writer.warnings);
    model.views = buffer_views(writer.out);
    return model;
}

}  // namespace

const Json& source_array(const GltfWriter& writer, const char* key) {
    return member(writer.source.document, key);
}

Index append(GltfWriter& writer, const char* key, Json value) {
    Json& array = writer.out[key];
    array.push_back(std::move(value));
    return static_cast<Index>(array.size() - 1);
}

Index copy_accessor(GltfWriter& writer, Index accessor, AccessorUse use) {
    return once(writer.accessors, accessor, [&] {
        Json description = source_array(writer, "accessors")[accessor];
        for (const char* key : {"bufferView", "byteOffset", "sparse"}) description.erase(key);
        // Zero elements without a bufferView are stored too: readers limit the count of such accessors by the
        // number of bytes in the file, which may be too small.
        const std::vector<std::uint8_t> dense = dense_bytes(writer.source, accessor);
        if (use == AccessorUse::vertices || string_member(description, "type") == "SCALAR")
            add_missing_bounds(description, dense);
        return writer.binary.add_accessor(std::move(description), dense, use);
    });
}

EncodedModel encode_gltf(const Asset& asset, const fs::path& file) {
    const std::optional<DividedAsset> divided = divided_into_objects(asset);
    return encode(divided ? divided->asset : asset, nullptr, file);
}

EncodedModel encode_gltf_levels(const LeveledAsset& leveled, const fs::path& file) {
    return encode(leveled.asset, &leveled, file);
}

}  // namespace faqem::detail
