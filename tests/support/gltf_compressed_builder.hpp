#pragma once
// Builds glTF documents with compressed data, valid or invalid.

#include <array>
#include <memory>
#include <stdexcept>

#include "support/gltf_builder.hpp"

#ifdef FAQEM_WITH_DRACO
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#endif
#ifdef FAQEM_WITH_MESHOPT
#include <meshoptimizer.h>
#endif

namespace faqem::testing {

// Adds a bufferView compressed with meshopt: its uncompressed range is in the fallback buffer 1, which has no
// data, and its compressed data in buffer 0.
// \param count, stride  number of elements and bytes per element
// \param end            size of buffer 1; updated
// \return the index of the bufferView
inline std::size_t packed_view(GltfBuilder& builder, const std::vector<unsigned char>& packed,
                               std::size_t count, std::size_t stride, const char* mode, std::size_t& end) {
    const Json from = builder.json["bufferViews"][builder.view(packed)];
    builder.json["bufferViews"].erase(builder.json["bufferViews"].size() - 1);
    const Json extension = {{"buffer", 0},
                            {"byteOffset", from["byteOffset"]},
                            {"byteLength", packed.size()},
                            {"byteStride", stride},
                            {"count", count},
                            {"mode", mode}};
    const std::size_t offset = end;
    end += (count * stride + 3) / 4 * 4;
    return builder.add("bufferViews", {{"buffer", 1},
                                       {"byteOffset", offset},
                                       {"byteLength", count * stride},
                                       {"extensions", {{"EXT_meshopt_compression", extension}}}});
}

// The EXT_meshopt_compression extension of a bufferView.
inline Json& packed_of(GltfBuilder& builder, std::size_t view) {
    return builder.json["bufferViews"][view]["extensions"]["EXT_meshopt_compression"];
}

inline void name_extension(GltfBuilder& builder, const char* name) {
    builder.json["extensionsUsed"] = builder.json["extensionsRequired"] = {name};
}

#ifdef FAQEM_WITH_MESHOPT

// The square with vertices and indices compressed with meshopt.
inline GltfBuilder packed_square() {
    GltfBuilder builder;
    std::vector<unsigned char> vertices(meshopt_encodeVertexBufferBound(4, 12)), indices;
    vertices.resize(
        meshopt_encodeVertexBuffer(vertices.data(), vertices.size(), square.data(), 4, sizeof(Vec3f)));
    const std::vector<unsigned> corners(square_corners.begin(), square_corners.end());
    indices.resize(meshopt_encodeIndexBufferBound(6, 4));
    indices.resize(meshopt_encodeIndexBuffer(indices.data(), indices.size(), corners.data(), 6));
    std::size_t end = 0;
    const auto positions =
        builder.add("accessors", {{"bufferView", packed_view(builder, vertices, 4, 12, "ATTRIBUTES", end)},
                                  {"componentType", f32},
                                  {"type", "VEC3"},
                                  {"count", 4}});
    builder.json["bufferViews"][0]["byteStride"] = 12;
    const auto order =
        builder.add("accessors", {{"bufferView", packed_view(builder, indices, 6, 2, "TRIANGLES", end)},
                                  {"componentType", u16},
                                  {"type", "SCALAR"},
                                  {"count", 6}});
    builder.mesh({{"attributes", {{"POSITION", positions}}}, {"indices", order}});
    builder.json["buffers"] = {
        {{"byteLength", builder.bin.size()}},
        {{"byteLength", end}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}}};
    name_extension(builder, "EXT_meshopt_compression");
    return builder;
}

#endif
#ifdef FAQEM_WITH_DRACO

enum class Method { edgebreaker = 1, sequential = 0 };

// A mesh of separate triangles compressed with Draco, without uncompressed data.
// \param bits  quantization of positions; 0: none
inline GltfBuilder draco_gltf(const std::vector<std::array<Vec3f, 3>>& triangles, Method method, int bits) {
    draco::TriangleSoupMeshBuilder soup;
    soup.Start(static_cast<int>(triangles.size()));
    const int at = soup.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    for (std::uint32_t f = 0; f < triangles.size(); ++f) {
        const auto& t = triangles[f];
        soup.SetAttributeValuesForFace(at, draco::FaceIndex(f), t[0].data(), t[1].data(), t[2].data());
    }
    const std::unique_ptr<draco::Mesh> mesh = soup.Finalize();
    draco::Encoder encoder;
    encoder.SetEncodingMethod(int(method));
    if (bits > 0) encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, bits);
    draco::EncoderBuffer buffer;
    if (!encoder.EncodeMeshToBuffer(*mesh, &buffer).ok())
        throw std::runtime_error("Draco cannot encode the mesh");
    GltfBuilder builder;
    const auto view = builder.view(std::vector<char>(buffer.data(), buffer.data() + buffer.size()));
    const auto positions =
        builder.add("accessors", {{"componentType", f32}, {"type", "VEC3"}, {"count", mesh->num_points()}});
    const auto corners = builder.add(
        "accessors", {{"componentType", u16}, {"type", "SCALAR"}, {"count", 3 * triangles.size()}});
    const Json extension = {{"bufferView", view},
                            {"attributes", {{"POSITION", mesh->attribute(at)->unique_id()}}}};
    builder.mesh({{"attributes", {{"POSITION", positions}}},
                  {"indices", corners},
                  {"extensions", {{"KHR_draco_mesh_compression", extension}}}});
    name_extension(builder, "KHR_draco_mesh_compression");
    return builder;
}

inline GltfBuilder draco_square(Method method, int bits = 0) {
    const auto corner = [](std::size_t c) { return square[square_corners[c]]; };
    return draco_gltf({{corner(0), corner(1), corner(2)}, {corner(3), corner(4), corner(5)}}, method, bits);
}

// A strip of `count` triangles.
inline GltfBuilder draco_strip(std::size_t count) {
    const auto point = [](std::size_t i) { return Vec3f{float(i / 2), float(i % 2), 0}; };
    std::vector<std::array<Vec3f, 3>> triangles;
    for (std::size_t i = 0; i < count; ++i) triangles.push_back({point(i), point(i + 1), point(i + 2)});
    return draco_gltf(triangles, Method::sequential, 0);
}

inline Json& draco_of(GltfBuilder& builder) {
    return builder.json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"];
}

#endif

// A lossless WebP image of one red pixel.
inline const std::vector<std::uint8_t> small_webp = {
    'R', 'I', 'F', 'F',  0x1a, 0, 0, 0,    'W', 'E',  'B',  'P',  'V',  'P',  '8',  'L', 0x0d,
    0,   0,   0,   0x2f, 0,    0, 0, 0x10, 7,   0x10, 0x11, 0x11, 0x88, 0x88, 0xfe, 7,   0};

// The square with a texture that has only a WebP image.
inline GltfBuilder webp_square() {
    GltfBuilder builder = square_gltf();
    builder.add("images", {{"bufferView", builder.view(small_webp)}, {"mimeType", "image/webp"}});
    builder.json["textures"] = Json::parse(R"([{"extensions":{"EXT_texture_webp":{"source":0}}}])");
    builder.json["materials"] = Json::parse(R"([{"emissiveTexture":{"index":0}}])");
    builder.json["meshes"][0]["primitives"][0]["material"] = 0;
    name_extension(builder, "EXT_texture_webp");
    return builder;
}

}  // namespace faqem::testing
