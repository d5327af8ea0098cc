#pragma once
// Builds small glTF documents in memory, valid or invalid.

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "asset/gltf/json.hpp"
#include "support/format_support.hpp"

namespace faqem::testing {

using detail::Json;

inline constexpr int u8 = 5121, i8 = 5120, u16 = 5123, i16 = 5122, u32 = 5125, f32 = 5126;

/// A document with one buffer. `json` and `bin` may be changed before text() or glb() is called.
class GltfBuilder {
public:
    Json json = {{"asset", {{"version", "2.0"}}}};
    std::string bin;

    /// Adds a bufferView of the raw values at an offset that is a multiple of 4. \return its index
    template <class T>
    std::size_t view(const std::vector<T>& values) {
        bin.resize((bin.size() + 3) / 4 * 4);
        const std::size_t offset = bin.size(), size = values.size() * sizeof(T);
        bin.append(reinterpret_cast<const char*>(values.data()), size);
        return add("bufferViews", {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", size}});
    }

    /// Adds an accessor of scalars or vectors with its own bufferView. \return its index
    template <class T>
    std::size_t accessor(const std::vector<T>& values, int component, const std::string& type) {
        return add("accessors", {{"bufferView", view(values)},
                                 {"componentType", component},
                                 {"type", type},
                                 {"count", values.size()}});
    }

    /// Adds a mesh of triangles with a root node.
    void triangles(const std::vector<Vec3f>& positions, const std::vector<std::uint16_t>& corners) {
        const auto vertices = accessor(positions, f32, "VEC3"), indices = accessor(corners, u16, "SCALAR");
        mesh({{"attributes", {{"POSITION", vertices}}}, {"indices", indices}});
    }

    /// The first primitive of a mesh.
    Json& primitive(std::size_t mesh = 0) { return json["meshes"][mesh]["primitives"][0]; }

    /// Adds a vertex attribute to the first primitive of mesh 0. \return its accessor
    template <class T>
    std::size_t attribute(const std::string& name, const std::vector<T>& values, int component,
                          const std::string& type) {
        const std::size_t index = accessor(values, component, type);
        primitive()["attributes"][name] = index;
        return index;
    }

    /// Adds a material, and gives it to the first primitive of mesh 0. \return its index
    std::size_t material(const std::string& text) {
        const std::size_t index = add("materials", Json::parse(text));
        primitive()["material"] = index;
        return index;
    }

    /// Appends a value to a top-level array of the document. \return its index
    std::size_t add(const char* array, Json value) {
        json[array].push_back(std::move(value));
        return json[array].size() - 1;
    }

    /// Adds a mesh of one primitive, and a root node of the scene with this mesh. \return the index of the
    /// mesh
    std::size_t mesh(Json primitive) {
        const std::size_t index = add("meshes", {{"primitives", Json::array({std::move(primitive)})}});
        const std::size_t node = add("nodes", {{"mesh", index}});
        if (!json.contains("scenes")) json["scenes"] = Json::array({{{"nodes", Json::array()}}});
        json["scenes"][0]["nodes"].push_back(node);
        return index;
    }

    std::string text() const {
        Json document = json;
        if (!bin.empty() && !document.contains("buffers"))
            document["buffers"] = {{{"byteLength", bin.size()}}};
        return document.dump();
    }

    std::string glb() const { return glb_of(text(), bin); }

    static void put_u32(std::string& out, std::size_t value) {
        for (int shift = 0; shift < 32; shift += 8) out.push_back(static_cast<char>(value >> shift));
    }

    /// A GLB file with the given JSON chunk and BIN chunk (none if `bytes` is empty).
    static std::string glb_of(std::string text, std::string bytes) {
        text.resize((text.size() + 3) / 4 * 4, ' ');
        bytes.resize((bytes.size() + 3) / 4 * 4);
        std::string out = "glTF";
        put_u32(out, 2);
        put_u32(out, 20 + text.size() + (bytes.empty() ? 0 : 8 + bytes.size()));
        put_u32(out, text.size());
        out += "JSON" + text;
        if (bytes.empty()) return out;
        put_u32(out, bytes.size());
        return out + std::string("BIN\0", 4) + bytes;
    }
};

/// 2---3
/// | \ |   A square in the plane z = 0, seen from +z, with triangles 0 1 2 and 2 1 3.
/// 0---1
inline const std::vector<Vec3f> square = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
inline const std::vector<std::uint16_t> square_corners = {0, 1, 2, 2, 1, 3};

/// The square as mesh 0, node 0; accessor 0 holds the positions, 1 the indices.
inline GltfBuilder square_gltf() {
    GltfBuilder builder;
    builder.triangles(square, square_corners);
    return builder;
}

/// Loads a GLB from a file named a.glb.
inline Asset load_glb(const std::string& glb) {
    const TemporaryFolder folder;
    put(folder / "a.glb", glb);
    return load(folder / "a.glb");
}

inline Asset load_glb(const GltfBuilder& builder) { return load_glb(builder.glb()); }

/// Message of the exception that load_glb() throws.
template <class Exception = InputError>
std::string refusal(const std::string& glb) {
    return message_of<Exception>([&] { load_glb(glb); });
}

template <class Exception = InputError>
std::string refusal(const GltfBuilder& builder) {
    return refusal<Exception>(builder.glb());
}

/// The JSON chunk of a GLB.
inline Json json_of(const std::string& glb) {
    std::uint32_t size = 0;
    std::memcpy(&size, glb.data() + 12, 4);
    return Json::parse(glb.substr(20, size));
}

/// The bytes that save() writes to a .glb file.
inline std::string saved(const Asset& asset) {
    const TemporaryFolder folder;
    save(asset, folder / "out.glb");
    return get(folder / "out.glb");
}

/// A .glb file that save() has written.
struct WrittenGltf {
    std::string glb;
    Json json;
    std::vector<std::string> warnings;

    bool warns(const std::string& text) const { return any_contains(warnings, text); }
    const Json& primitive() const { return json["meshes"][0]["primitives"][0]; }
    const Json& accessor(const Json& index) const { return json["accessors"][index.get<std::size_t>()]; }
    const Json& positions() const { return accessor(primitive()["attributes"]["POSITION"]); }
};

inline WrittenGltf write_gltf_of(const Asset& asset) {
    const TemporaryFolder folder;
    WrittenGltf written;
    written.warnings = save(asset, folder / "out.glb");
    written.glb = get(folder / "out.glb");
    written.json = json_of(written.glb);
    return written;
}

/// An opaque PNG of 2 x 2 pixels.
inline Image small_png(std::uint8_t shade = 100) {
    Pixels pixels{2, 2, std::vector<std::uint8_t>(16, shade), false};
    for (std::size_t i = 3; i < 16; i += 4) pixels.rgba[i] = 255;
    return encode_png(pixels, "");
}

/// The JSON of the document after loading and saving.
inline Json through(const GltfBuilder& builder) { return json_of(saved(load_glb(builder))); }

/// Adds a texture whose image is a PNG in its own bufferView.
inline void add_texture(GltfBuilder& builder, std::uint8_t shade) {
    const auto view = builder.view(small_png(shade).encoded);
    const auto image = builder.add("images", {{"bufferView", view}, {"mimeType", "image/png"}});
    builder.add("textures", {{"source", image}});
}

/// An asset of one part, a square of two faces, that was not loaded from a file.
inline Asset new_square() {
    Asset asset = one_part({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {2, 1, 3}});
    asset.parts[0].name = "square";
    return asset;
}

}  // namespace faqem::testing
