// Images that are not decoded, but passed through.

#include "faqem/bake_levels.hpp"
#include "faqem/error.hpp"
#include "support/catch.hpp"
#include "support/gltf_builder.hpp"

using namespace faqem;
using namespace faqem::testing;

namespace {

struct PassedKind {
    std::string extension, media_type, bytes;
};

const PassedKind passed_kinds[] = {
    {"KHR_texture_basisu", "image/ktx2", "\xabKTX 20\xbb\r\n\x1a\n and more"},
    {"EXT_texture_avif", "image/avif", std::string("\0\0\0\x1c", 4) + "ftypavif and more"},
    {"MSFT_texture_dds", "image/vnd-ms.dds", "DDS | and much more"}};

/// The square with a base colour texture of an extension.
GltfBuilder passed_square(const PassedKind& kind) {
    const auto& [extension, media_type, bytes] = kind;
    GltfBuilder builder = square_gltf();
    builder.attribute<Vec2f>("TEXCOORD_0", {{0, 0}, {1, 0}, {0, 1}, {1, 1}}, f32, "VEC2");
    builder.add("images", {{"bufferView", builder.view(std::vector<char>(bytes.begin(), bytes.end()))},
                           {"mimeType", media_type}});
    builder.add("textures", {{"extensions", {{extension, {{"source", 0}}}}}});
    builder.material(R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}})");
    builder.json["extensionsUsed"] = builder.json["extensionsRequired"] = {extension};
    return builder;
}

}  // namespace

TEST_CASE("KTX2, AVIF and DDS images are passed through, with their extensions") {
    const PassedKind& kind = passed_kinds[GENERATE(0, 1, 2)];
    const auto& [extension, media_type, bytes] = kind;
    const Asset asset = load_glb(passed_square(kind));
    REQUIRE(asset.images.size() == 1);
    CHECK(asset.images[0].mime_type == media_type);
    const auto check = [&](const Asset& out) {
        const Json json = json_of(saved(out));
        CHECK(json["extensionsRequired"] == Json({extension}));
        CHECK(json["textures"][0]["extensions"][extension]["source"] == 0);
        CHECK_FALSE(json["textures"][0].contains("source"));
        const Image image = load_glb(saved(out)).images.at(0);
        CHECK(std::string(image.encoded.begin(), image.encoded.end()) == bytes);
    };
    check(asset);
    for (const Bake bake : {Bake::automatic, Bake::atlas, Bake::vertex, Bake::keep}) {
        Options options{.target = ratio(0.5)};
        options.bake.kind = bake;
        const SimplifiedAsset result = simplify(asset, options);
        check(result.asset);
        CHECK(result.asset.parts[0].uvs.size() == 1);
        CHECK(any_contains(result.report.warnings, "cannot be baked") == (bake != Bake::keep));
        options.target = {};
        const auto levels = simplify_levels(asset, {ratio(0.5)}, options);
        REQUIRE(levels.size() == 1);
        check(levels[0].result.asset);
    }
    Options options{.bake = {.kind = Bake::none}};
    CHECK(simplify(asset, options).asset.images.empty());
    CHECK_THROWS_AS(decode(asset.images[0]), UnsupportedError);
}

TEST_CASE("an image that is passed through keeps its type beside one of another type with the same bytes") {
    GltfBuilder builder = passed_square({"EXT_texture_avif", "image/avif", "bytes of no known kind"});
    Json other = builder.json["images"][0];
    other["mimeType"] = "image/other";
    builder.json["images"] = {other, builder.json["images"][0]};
    builder.json["textures"][0]["extensions"]["EXT_texture_avif"]["source"] = 1;
    const Json json = json_of(saved(load_glb(builder)));
    REQUIRE(json["images"].size() == 1);
    CHECK(json["images"][0]["mimeType"] == "image/avif");
}

TEST_CASE("KTX2, AVIF and DDS images as core sources are those of extensions, which the file need not list") {
    const PassedKind& kind = passed_kinds[GENERATE(0, 1, 2)];
    const auto& [extension, media_type, bytes] = kind;
    GltfBuilder builder = passed_square(kind);
    builder.json["textures"][0] = {{"source", 0}, {"name", "kept"}};
    builder.json.erase("extensionsRequired");
    if (GENERATE(true, false)) builder.json.erase("extensionsUsed");
    const Asset asset = load_glb(builder);
    CHECK(asset.warnings ==
          std::vector<std::string>{"1 texture with " + media_type +
                                   " as the core source: read as the source of " + extension});
    Options options{.target = ratio(0.5)};
    for (const Asset& out : {asset, simplify(asset, options).asset}) {
        const Json json = json_of(saved(out));
        CHECK(json["textures"] ==
              Json::array({{{"name", "kept"}, {"extensions", {{extension, {{"source", 0}}}}}}}));
        CHECK(json["extensionsUsed"] == Json({extension}));
        CHECK(json["extensionsRequired"] == Json({extension}));
    }
}

TEST_CASE("an image of an unknown kind or extension stays as it is, with the UVs of the source") {
    GltfBuilder builder = passed_square({"VENDOR_image", "image/other", "bytes of no known kind"});
    builder.json.erase("extensionsRequired");
    if (GENERATE(true, false)) builder.json["textures"][0] = {{"source", 0}};
    const SimplifiedAsset result = simplify(load_glb(builder), Options{.target = ratio(0.5)});
    CHECK(any_contains(result.report.warnings, "cannot be baked"));
    const std::string out = saved(result.asset);
    CHECK(json_of(out)["textures"] == builder.json["textures"]);
    CHECK(load_glb(out).images.at(0).encoded.size() == 22);
    CHECK(load_glb(out).parts[0].uvs.size() == 1);
}

TEST_CASE("a model with VRM keeps its UVs and the numbers of materials and images, which are encoded again") {
    // A noisy picture, and one that no mesh uses.
    constexpr std::uint32_t side = 64;
    Pixels pixels{side, side, {}, false};
    std::uint32_t state = 1;
    for (std::uint32_t i = 0; i < 4 * side * side; ++i) {
        state = state * 1664525 + 1013904223;
        pixels.rgba.push_back(i % 4 == 3 ? 255 : static_cast<std::uint8_t>(100 + (state >> 24) / 8));
    }
    const std::vector<std::uint8_t> noise = encode_png(pixels, "").encoded;
    GltfBuilder builder = passed_square({"unused", "image/png", std::string(noise.begin(), noise.end())});
    add_texture(builder, 10);
    builder.json["textures"][0] = {{"source", 0}};
    builder.json["materials"].insert(builder.json["materials"].begin(), Json{{"name", "unused"}});
    builder.json["meshes"][0]["primitives"][0]["material"] = 1;
    builder.json["extensions"]["VRM"]["materialProperties"] = {{{"texture", 1}}};
    builder.json["extensionsUsed"] = builder.json["extensionsRequired"] = {"VRM"};
    const Asset asset = load_glb(builder);
    const auto check = [&](const SimplifiedAsset& result) {
        CHECK(result.report.warnings.empty());
        const Json json = json_of(saved(result.asset));
        CHECK(json["extensions"] == builder.json["extensions"]);
        CHECK(json["textures"] == builder.json["textures"]);
        CHECK(json["materials"] == builder.json["materials"]);
        CHECK(json["images"].size() == 2);
        CHECK(json["images"][0]["mimeType"] == "image/jpeg");
        CHECK(json["meshes"][0]["primitives"][0]["attributes"].contains("TEXCOORD_0"));
        CHECK(json["meshes"][0]["primitives"][0]["material"] == 1);
    };
    Options options{.target = ratio(0.5)};
    options.bake.untouched = UntouchedParts::baked;
    options.bake.image_format = ImageFormat::jpeg;
    check(simplify(asset, options));
    SimplifiedParts parts = simplify_parts(asset, options);
    parts.parts[0].mesh.attributes = {};  // as in a history
    check(bake(asset, parts, options));
    options.target = {};
    check(simplify_levels(asset, {ratio(0.5)}, options).at(0).result);
    options.bake.kind = Bake::keep;
    CHECK_THROWS_AS(bake(asset, parts, options), InputError);
}
