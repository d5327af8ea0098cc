#include "asset/gltf_compressed.hpp"

#include <catch2/catch.hpp>

#include "asset/gltf_builder.hpp"
#include "asset/image.hpp"

#ifdef FAQEM_WITH_DRACO
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#endif
#ifdef FAQEM_WITH_MESHOPT
#include <meshoptimizer.h>
#endif

using namespace faqem;
using namespace faqem::testing;

namespace {

// A view for `count` elements of `stride` bytes that lies in buffer 1, which has no bytes, and is packed in
// buffer 0.
[[maybe_unused]] std::size_t packed_view(GltfBuilder& builder, const std::vector<unsigned char>& packed,
                                         std::size_t count, std::size_t stride, const char* mode,
                                         std::size_t& end) {
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

[[maybe_unused]] Json& packed_of(GltfBuilder& builder, std::size_t view) {
    return builder.json["bufferViews"][view]["extensions"]["EXT_meshopt_compression"];
}

void name_extension(GltfBuilder& builder, const char* name) {
    builder.json["extensionsUsed"] = builder.json["extensionsRequired"] = {name};
}

void check_square(const Asset& asset) {
    REQUIRE(asset.parts.size() == 1);
    const Part& part = asset.parts[0];
    REQUIRE(part.triangles.size() == 2);
    double area = 0;
    for (const Triangle& t : part.triangles) {
        const Vec3 &a = part.positions[t[0]], &b = part.positions[t[1]], &c = part.positions[t[2]];
        area += ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2;
        for (const Index v : t) CHECK(part.positions[v][2] == 0);
    }
    CHECK(area == Approx(1));
    CHECK(asset.warnings.empty());
}

}  // namespace

TEST_CASE("without a decoder the error names the extension and the library") {
    CHECK(detail::missing_decoder("KHR_draco_mesh_compression").find("KHR_draco") == 0);
    CHECK(contains(detail::missing_decoder("KHR_draco_mesh_compression"), "without Draco"));
    CHECK(contains(detail::missing_decoder("EXT_meshopt_compression"), "without meshoptimizer"));
    for (const char* name : {"KHR_draco_mesh_compression", "EXT_meshopt_compression"}) {
        GltfBuilder builder = square_gltf();
        name_extension(builder, name);
        if (detail::can_decode(name))
            check_square(load_glb(builder));
        else
            CHECK(contains(refusal<UnsupportedError>(builder), name));
    }
}

#ifdef FAQEM_WITH_MESHOPT

namespace {

// The square, its vertices and indices packed.
GltfBuilder packed_square() {
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

}  // namespace

TEST_CASE("meshopt: compressed vertices and triangles are read, and written plain") {
    const Asset asset = load_glb(packed_square());
    check_square(asset);
    const std::string out = saved(asset);
    const Json json = json_of(out);
    CHECK_FALSE(json.contains("extensionsRequired"));
    CHECK(json["buffers"].size() == 1);
    check_square(load_glb(out));
}

TEST_CASE("meshopt: damaged data is refused, by view") {
    GltfBuilder builder = packed_square();
    const std::size_t offset = packed_of(builder, 0)["byteOffset"].get<std::size_t>();
    builder.bin[offset] = 'x';
    CHECK(contains(refusal(builder), "/bufferViews/0: EXT_meshopt_compression: the data is damaged"));
}

TEST_CASE("meshopt: what the extension says must fit the view, the buffer and the mode") {
    const auto refused = [](std::size_t view, const char* key, const Json& value) {
        GltfBuilder builder = packed_square();
        packed_of(builder, view)[key] = value;
        return refusal(builder);
    };
    CHECK(contains(refused(0, "buffer", 2), "refers to /buffers/2"));
    CHECK(contains(refused(0, "buffer", 1), "has no bytes"));
    CHECK(contains(refused(0, "byteOffset", 100000), "needs"));
    CHECK(contains(refused(0, "byteLength", std::uint64_t{1} << 63), "needs"));
    CHECK(contains(refused(0, "count", 5), "makes 5 times 12"));
    CHECK(contains(refused(0, "count", std::uint64_t{1} << 62), "makes"));
    CHECK(contains(refused(0, "byteStride", 6), "byteStride"));
    CHECK(contains(refused(1, "byteStride", 3), "byteStride"));
    CHECK(contains(refused(0, "mode", "TRIANGLES"), "byteStride"));
    CHECK(contains(refused(0, "mode", "NONSENSE"), "mode"));
    CHECK(contains(refused(0, "filter", "OCTAHEDRAL"), "filter"));
    CHECK(contains(refused(1, "filter", "EXPONENTIAL"), "filter"));
    CHECK(contains(refused(1, "count", 5), "multiple of 3"));
}

TEST_CASE("meshopt: a view in a buffer without bytes must be compressed, an image may not lie there") {
    GltfBuilder builder = packed_square();
    builder.json["bufferViews"][0].erase("extensions");
    CHECK(contains(refusal(builder), "/bufferViews/0: lies in a buffer that has no bytes"));
    builder = packed_square();
    builder.add("images", {{"bufferView", 0}, {"mimeType", "image/png"}});
    CHECK(contains(refusal(builder), "/images/0: lies in a buffer that has no bytes"));
}

TEST_CASE("meshopt: sizes that so few bytes cannot hold are refused before there is memory for them") {
    GltfBuilder builder = packed_square();
    const std::uint64_t count = std::uint64_t{1} << 40;
    builder.json["buffers"][1]["byteLength"] = 12 * count;
    builder.json["bufferViews"][0]["byteLength"] = 12 * count;
    builder.json["bufferViews"][1]["byteOffset"] = 0;
    builder.json["accessors"][0]["count"] = count;
    packed_of(builder, 0)["count"] = count;
    CHECK(contains(refusal(builder), "cannot hold"));
    // Nor does the placeholder vouch for an accessor without a view.
    builder = packed_square();
    builder.json["buffers"][1]["byteLength"] = 12 * count;
    builder.json["accessors"][0].erase("bufferView");
    builder.json["accessors"][0]["count"] = count;
    CHECK(contains(refusal(builder), "/accessors/0/count"));
}

TEST_CASE("meshopt: octahedral normals and exponential positions are filtered") {
    const float x = 0.6f, y = -0.8f;
    const float normal[4] = {x, y, 0, 0};
    std::vector<unsigned char> raw(8), packed(meshopt_encodeVertexBufferBound(1, 8));
    meshopt_encodeFilterOct(raw.data(), 1, 8, 16, normal);
    packed.resize(meshopt_encodeVertexBuffer(packed.data(), packed.size(), raw.data(), 1, 8));
    const std::vector<std::uint8_t> bytes = detail::decode_meshopt(
        {{"count", 1}, {"byteStride", 8}, {"mode", "ATTRIBUTES"}, {"filter", "OCTAHEDRAL"}}, packed, "", "");
    std::int16_t got[4];
    REQUIRE(bytes.size() == 8);
    std::memcpy(got, bytes.data(), 8);
    CHECK(got[0] / 32767.0 == Approx(x).margin(1e-3));
    CHECK(got[1] / 32767.0 == Approx(y).margin(1e-3));
}

#endif
#ifdef FAQEM_WITH_DRACO

namespace {

enum class Method { edgebreaker = 1, sequential = 0 };

// The square in Draco, no plain data beside it.
GltfBuilder draco_square(Method method) {
    draco::TriangleSoupMeshBuilder soup;
    soup.Start(2);
    const int at = soup.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    for (int f = 0; f < 2; ++f) {
        const auto corner = [&](int c) { return square[square_corners[std::size_t(3 * f + c)]].data(); };
        soup.SetAttributeValuesForFace(at, draco::FaceIndex(std::uint32_t(f)), corner(0), corner(1),
                                       corner(2));
    }
    const std::unique_ptr<draco::Mesh> mesh = soup.Finalize();
    draco::Encoder encoder;
    encoder.SetEncodingMethod(int(method));
    draco::EncoderBuffer buffer;
    REQUIRE(encoder.EncodeMeshToBuffer(*mesh, &buffer).ok());
    GltfBuilder builder;
    const auto view = builder.view(std::vector<char>(buffer.data(), buffer.data() + buffer.size()));
    const auto positions = builder.add("accessors", {{"componentType", f32}, {"type", "VEC3"}, {"count", 4}});
    const auto corners = builder.add("accessors", {{"componentType", u16}, {"type", "SCALAR"}, {"count", 6}});
    const Json extension = {{"bufferView", view},
                            {"attributes", {{"POSITION", mesh->attribute(at)->unique_id()}}}};
    builder.mesh({{"attributes", {{"POSITION", positions}}},
                  {"indices", corners},
                  {"extensions", {{"KHR_draco_mesh_compression", extension}}}});
    name_extension(builder, "KHR_draco_mesh_compression");
    return builder;
}

Json& draco_of(GltfBuilder& builder) {
    return builder.json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"];
}

}  // namespace

TEST_CASE("draco: compressed meshes are read, and written plain") {
    for (const Method method : {Method::edgebreaker, Method::sequential}) {
        const Asset asset = load_glb(draco_square(method));
        check_square(asset);
        const std::string out = saved(asset);
        CHECK_FALSE(json_of(out).contains("extensionsUsed"));
        check_square(load_glb(out));
    }
}

TEST_CASE("draco: counts that differ from the accessors' are refused before anything is decoded") {
    for (const Method method : {Method::edgebreaker, Method::sequential}) {
        GltfBuilder builder = draco_square(method);
        builder.json["accessors"][1]["count"] = 9;
        CHECK(contains(refusal(builder), "has 2 faces, the indices are 9"));
        builder = draco_square(method);
        builder.json["accessors"][0]["count"] = 3;
        CHECK(contains(refusal(builder), "vertices, the accessors 3"));
        builder = draco_square(method);
        builder.json["accessors"][0]["count"] = 5;
        CHECK(contains(refusal(builder), "not what the accessors say"));
        builder.json["accessors"][0]["count"] = std::uint64_t{1} << 40;
        CHECK(contains(refusal(builder), "/accessors/0/count"));
    }
}

TEST_CASE("draco: damaged and contradictory data is refused, by primitive") {
    GltfBuilder builder = draco_square(Method::edgebreaker);
    builder.bin[0] = 'X';
    CHECK(contains(refusal(builder), "/meshes/0/primitives/0: KHR_draco_mesh_compression: the header"));
    builder = draco_square(Method::edgebreaker);
    builder.json["bufferViews"][0]["byteLength"] = 20;
    CHECK(contains(refusal(builder), "KHR_draco_mesh_compression: "));
    builder = draco_square(Method::edgebreaker);
    draco_of(builder)["attributes"]["POSITION"] = 77;
    CHECK(contains(refusal(builder), "has no attribute 77"));
    draco_of(builder)["attributes"] = {{"NORMAL", 0}};
    CHECK(contains(refusal(builder), "NORMAL: is no attribute of the primitive"));
    draco_of(builder).erase("attributes");
    CHECK(contains(refusal(builder), "has no attributes"));
    builder = draco_square(Method::edgebreaker);
    draco_of(builder)["bufferView"] = 5;
    CHECK(contains(refusal(builder), "refers to /bufferViews/5"));
    builder = draco_square(Method::edgebreaker);
    builder.json["meshes"][0]["primitives"][0].erase("indices");
    CHECK(contains(refusal(builder), "no indices"));
}

TEST_CASE("draco: every truncation and every changed byte is an error or a mesh, never a crash") {
    for (const Method method : {Method::edgebreaker, Method::sequential}) {
        const GltfBuilder good = draco_square(method);
        for (std::size_t i = 0; i < good.bin.size(); ++i) {
            for (const int change : {1, 0x80, 0xff}) {
                GltfBuilder builder = good;
                builder.bin[i] = static_cast<char>(builder.bin[i] ^ change);
                try {
                    load_glb(builder);
                } catch (const Error&) {
                }
            }
            if (i == 0) continue;
            GltfBuilder cut = good;
            cut.json["bufferViews"][0]["byteLength"] = i;
            try {
                load_glb(cut);
            } catch (const Error&) {
            }
        }
    }
    SUCCEED();
}

#endif

TEST_CASE("textures whose only image is WebP are read where OpenImageIO can, and stay WebP") {
    // 1 x 1, lossless, one red pixel.
    const std::vector<std::uint8_t> webp = {
        'R', 'I', 'F', 'F',  0x1a, 0, 0, 0,    'W', 'E',  'B',  'P',  'V',  'P',  '8',  'L', 0x0d,
        0,   0,   0,   0x2f, 0,    0, 0, 0x10, 7,   0x10, 0x11, 0x11, 0x88, 0x88, 0xfe, 7,   0};
    GltfBuilder builder = square_gltf();
    builder.add("images", {{"bufferView", builder.view(webp)}, {"mimeType", "image/webp"}});
    builder.json["textures"] = Json::parse(R"([{"extensions":{"EXT_texture_webp":{"source":0}}}])");
    builder.json["materials"] = Json::parse(R"([{"emissiveTexture":{"index":0}}])");
    builder.json["meshes"][0]["primitives"][0]["material"] = 0;
    name_extension(builder, "EXT_texture_webp");
    if (!detail::can_decode_image("image/webp")) {
        CHECK(contains(refusal<UnsupportedError>(builder), "EXT_texture_webp"));
        return;
    }
    const Asset asset = load_glb(builder);
    REQUIRE(asset.materials[0].emissive_texture);
    const Pixels pixels = decode(asset.images[0]);
    CHECK(pixels.width == 1);
    const Json json = json_of(saved(asset));
    CHECK(json["textures"][0]["extensions"]["EXT_texture_webp"]["source"] == 0);
    CHECK(json["extensionsRequired"] == Json({"EXT_texture_webp"}));
}
