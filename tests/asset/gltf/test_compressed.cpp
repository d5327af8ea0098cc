#include "asset/gltf/read/compressed.hpp"

#include "support/catch.hpp"
#include "support/gltf_compressed_builder.hpp"

#ifdef FAQEM_WITH_MESHOPT
#include <meshoptimizer.h>
#endif

using namespace faqem;
using namespace faqem::testing;

namespace {

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
    CHECK(detail::missing_decoder_message("KHR_draco_mesh_compression").find("KHR_draco") == 0);
    CHECK(contains(detail::missing_decoder_message("KHR_draco_mesh_compression"), "without Draco"));
    CHECK(contains(detail::missing_decoder_message("EXT_meshopt_compression"), "without meshoptimizer"));
    for (const char* name : {"KHR_draco_mesh_compression", "EXT_meshopt_compression"}) {
        GltfBuilder builder = square_gltf();
        name_extension(builder, name);
        if (detail::has_codec(name))
            check_square(load_glb(builder));
        else
            CHECK(contains(refusal<UnsupportedError>(builder), name));
    }
}

#ifdef FAQEM_WITH_MESHOPT

TEST_CASE("meshopt: compressed vertices and triangles are read, and written uncompressed") {
    const Asset asset = load_glb(packed_square());
    check_square(asset);
    const std::string out = saved(asset);
    const Json json = json_of(out);
    CHECK_FALSE(json.contains("extensionsRequired"));
    CHECK(json["buffers"].size() == 1);
    check_square(load_glb(out));
}

TEST_CASE("meshopt: damaged data is rejected with the buffer view") {
    GltfBuilder builder = packed_square();
    const std::size_t offset = packed_of(builder, 0)["byteOffset"].get<std::size_t>();
    builder.bin[offset] = 'x';
    CHECK(contains(refusal(builder), "/bufferViews/0: EXT_meshopt_compression: the data is damaged"));
}

TEST_CASE("meshopt: the extension must be consistent with the view, the buffer and the mode") {
    const auto refused = [](std::size_t view, const char* key, const Json& value) {
        GltfBuilder builder = packed_square();
        packed_of(builder, view)[key] = value;
        return refusal(builder);
    };
    CHECK(contains(refused(0, "buffer", 2), "refers to /buffers/2"));
    CHECK(contains(refused(0, "buffer", 1), "is a buffer without data"));
    CHECK(contains(refused(0, "byteOffset", 100000), "needs"));
    CHECK(contains(refused(0, "byteLength", std::uint64_t{1} << 63), "needs"));
    CHECK(contains(refused(0, "count", 5), "decodes to 5 times 12"));
    CHECK(contains(refused(0, "count", std::uint64_t{1} << 62),
                   "decodes to 4611686018427387904 times 12 bytes, the bufferView has 48"));
    CHECK(contains(refused(0, "byteStride", 6), "byteStride"));
    CHECK(contains(refused(1, "byteStride", 3), "byteStride"));
    CHECK(contains(refused(0, "mode", "TRIANGLES"), "byteStride"));
    CHECK(contains(refused(0, "mode", "NONSENSE"), "mode"));
    CHECK(contains(refused(0, "filter", "OCTAHEDRAL"), "filter"));
    CHECK(contains(refused(1, "filter", "EXPONENTIAL"), "filter"));
    CHECK(contains(refused(1, "count", 5), "multiple of 3"));
}

TEST_CASE("meshopt: views of a buffer without data must be compressed and must not be images") {
    GltfBuilder builder = packed_square();
    builder.json["bufferViews"][0].erase("extensions");
    CHECK(contains(refusal(builder), "/bufferViews/0: refers to a buffer without data"));
    builder = packed_square();
    builder.add("images", {{"bufferView", 0}, {"mimeType", "image/png"}});
    CHECK(contains(refusal(builder), "/images/0: refers to a buffer without data"));
}

TEST_CASE("meshopt: implausible sizes are rejected before memory is allocated") {
    GltfBuilder builder = packed_square();
    const std::uint64_t count = std::uint64_t{1} << 40;
    builder.json["buffers"][1]["byteLength"] = 12 * count;
    builder.json["bufferViews"][0]["byteLength"] = 12 * count;
    builder.json["bufferViews"][1]["byteOffset"] = 0;
    builder.json["accessors"][0]["count"] = count;
    packed_of(builder, 0)["count"] = count;
    CHECK(contains(refusal(builder), "cannot hold"));
    // The length of the placeholder buffer does not raise the limit for accessors without a view either.
    builder = packed_square();
    builder.json["buffers"][1]["byteLength"] = 12 * count;
    builder.json["accessors"][0].erase("bufferView");
    builder.json["accessors"][0]["count"] = count;
    CHECK(contains(refusal(builder), "/accessors/0/count"));
}

TEST_CASE("meshopt: the total size of views that share the same bytes is limited") {
    GltfBuilder builder = packed_square();
    const Json view = builder.json["bufferViews"][0];
    for (int i = 0; i < 1000; ++i) builder.json["bufferViews"].push_back(view);
    CHECK(
        contains(refusal(builder), "EXT_meshopt_compression: the total decompressed size exceeds the limit"));
}

TEST_CASE("meshopt: data truncated or changed at any byte gives an error or a mesh") {
    const GltfBuilder good = packed_square();
    for (const std::size_t view : {0u, 1u}) {
        GltfBuilder of_view = good;
        const Json packed = packed_of(of_view, view);
        const auto offset = packed["byteOffset"].get<std::size_t>();
        const auto length = packed["byteLength"].get<std::size_t>();
        for (std::size_t i = 0; i < length; ++i) {
            GltfBuilder cut = good;
            packed_of(cut, view)["byteLength"] = i;
            INFO(view << " cut at " << i);
            CHECK(contains(refusal(cut), "/bufferViews/" + std::to_string(view)));
            for (const int change : {1, 0x80, 0xff}) {
                GltfBuilder builder = good;
                builder.bin[offset + i] = static_cast<char>(builder.bin[offset + i] ^ change);
                try {
                    load_glb(builder);
                } catch (const Error&) {
                }
            }
        }
    }
}

TEST_CASE("meshopt: the filter of octahedral normals is applied") {
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

TEST_CASE("meshopt: octahedral normals are rounded to the nearest integers") {
    std::vector<std::int8_t> raw;
    for (int x = -127; x <= 127; ++x)
        for (int y = -127; y <= 127; ++y)
            for (const int value : {x, y, 127, 5}) raw.push_back(static_cast<std::int8_t>(value));
    const std::size_t count = raw.size() / 4;
    std::vector<unsigned char> packed(meshopt_encodeVertexBufferBound(count, 4));
    packed.resize(meshopt_encodeVertexBuffer(packed.data(), packed.size(), raw.data(), count, 4));
    const std::vector<std::uint8_t> bytes = detail::decode_meshopt(
        {{"count", count}, {"byteStride", 4}, {"mode", "ATTRIBUTES"}, {"filter", "OCTAHEDRAL"}}, packed, "",
        "");
    double worst = 0;
    for (std::size_t i = 0; i < raw.size(); i += 4) {
        const double z = 127.0 - std::abs(raw[i]) - std::abs(raw[i + 1]), fold = std::min(z, 0.0);
        const double x = raw[i] + std::copysign(fold, raw[i] < 0 ? 1 : -1),
                     y = raw[i + 1] + std::copysign(fold, raw[i + 1] < 0 ? 1 : -1);
        const double scale = 127 / std::hypot(x, y, z);
        for (const auto& [k, wanted] : {std::pair{0, x}, {1, y}, {2, z}})
            worst = std::max(worst, std::abs(static_cast<std::int8_t>(bytes[i + k]) - wanted * scale));
        CHECK(bytes[i + 3] == 5);
    }
    CHECK(worst < 0.5001);
}

#endif
#ifdef FAQEM_WITH_DRACO

TEST_CASE("draco: compressed meshes are read, and written uncompressed") {
    for (const Method method : {Method::edgebreaker, Method::sequential}) {
        Asset asset = load_glb(draco_square(method));
        check_square(asset);
        CHECK(asset.compression == Compression::draco);
        asset.compression = Compression::none;
        const std::string out = saved(asset);
        CHECK_FALSE(json_of(out).contains("extensionsUsed"));
        check_square(load_glb(out));
    }
}

TEST_CASE("draco: counts that differ from the accessors are rejected before decoding") {
    for (const Method method : {Method::edgebreaker, Method::sequential}) {
        GltfBuilder builder = draco_square(method);
        builder.json["accessors"][1]["count"] = 9;
        CHECK(contains(refusal(builder), "has 2 faces, the number of indices is 9"));
        builder = draco_square(method);
        builder.json["accessors"][0]["count"] = 3;
        CHECK(contains(refusal(builder), "vertices, the accessors have 3"));
        builder = draco_square(method);
        builder.json["accessors"][0]["count"] = 5;
        CHECK(contains(refusal(builder), "which differs from the accessors"));
        builder.json["accessors"][0]["count"] = std::uint64_t{1} << 40;
        CHECK(contains(refusal(builder), "/accessors/0/count"));
    }
}

TEST_CASE("draco: invalid counts and attribute ids are rejected with the element") {
    for (const std::uint64_t huge : {std::uint64_t{1} << 62, UINT64_MAX}) {
        for (const std::size_t accessor : {0u, 1u}) {
            GltfBuilder builder = draco_square(Method::sequential);
            builder.json["accessors"][accessor]["count"] = huge;
            CHECK(contains(refusal(builder), "/accessors/" + std::to_string(accessor) + "/count: is " +
                                                 std::to_string(huge) + " without a bufferView"));
        }
    }
    for (const Json& id : {Json(std::uint64_t{1} << 32), Json(-1), Json(0.5), Json("0")}) {
        GltfBuilder builder = draco_square(Method::sequential);
        draco_of(builder)["attributes"]["POSITION"] = id;
        CHECK(contains(refusal(builder),
                       "/meshes/0/primitives/0/extensions/KHR_draco_mesh_compression/"
                       "attributes/POSITION: is not an unsigned 32-bit integer"));
    }
    GltfBuilder builder = draco_square(Method::sequential);
    builder.json["accessors"][1]["count"] = 3'000'000;
    CHECK(contains(refusal(builder), "has 2 faces, the number of indices is 3000000"));
    builder.json["accessors"][1]["count"] = 5'000'000;
    CHECK(contains(refusal(builder), "/accessors/1/count"));
}

TEST_CASE("draco: the total decompressed size is limited") {
    const std::string file = "a.glb";
    detail::DecompressionLimit limit{10, file};
    limit.consume(7, "/meshes/0", "X");
    limit.consume(3, "/meshes/1", "X");
    CHECK_THROWS_WITH(limit.consume(1, "/meshes/2", "X"),
                      "a.glb: /meshes/2: X: the total decompressed size exceeds the limit for this file");
    CHECK_THROWS_AS(limit.consume(UINT64_MAX, "", ""), InputError);
}

TEST_CASE("draco: indices out of the range of the index type are rejected") {
    GltfBuilder strip = draco_strip(300);
    CHECK(load_glb(strip).parts[0].triangles.size() == 300);
    strip.json["accessors"][1]["componentType"] = u8;
    CHECK(contains(refusal(strip), "has more vertices than the index type can address"));
}

TEST_CASE("draco: damaged and inconsistent data is rejected with the primitive") {
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
    CHECK(contains(refusal(builder), "NORMAL: is not an attribute of the primitive"));
    draco_of(builder).erase("attributes");
    CHECK(contains(refusal(builder), "has no attributes"));
    builder = draco_square(Method::edgebreaker);
    draco_of(builder)["bufferView"] = 5;
    CHECK(contains(refusal(builder), "refers to /bufferViews/5"));
    builder = draco_square(Method::edgebreaker);
    builder.primitive().erase("indices");
    CHECK(contains(refusal(builder), "no indices"));
}

TEST_CASE("draco: data truncated or changed at any byte gives an error or a mesh") {
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

TEST_CASE("WebP textures are read and written as WebP") {
    const GltfBuilder builder = webp_square();
    const Asset asset = load_glb(builder);
    REQUIRE(asset.materials[0].emissive_texture);
    const Pixels pixels = decode(asset.images[0]);
    CHECK(pixels.width == 1);
    const Json json = json_of(saved(asset));
    CHECK(json["textures"][0]["extensions"]["EXT_texture_webp"]["source"] == 0);
    CHECK(json["extensionsRequired"] == Json({"EXT_texture_webp"}));
}
