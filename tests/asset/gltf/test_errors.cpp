// Invalid glTF input and the error messages for it.

#include "support/catch.hpp"
#include "support/gltf_builder.hpp"

using namespace faqem;
using namespace faqem::testing;

namespace {

/// Checks that loading throws InputError and that the message contains all given texts.
void check_refused(const std::string& glb, const std::vector<std::string>& words) {
    const std::string message = refusal(glb);
    INFO(message);
    CHECK(contains(message, "a.glb"));
    for (const std::string& word : words) {
        INFO(word);
        CHECK(contains(message, word));
    }
}

void check_refused(const GltfBuilder& builder, const std::vector<std::string>& words) {
    check_refused(builder.glb(), words);
}

}  // namespace

TEST_CASE("a GLB truncated at any byte is rejected") {
    const std::string glb = square_gltf().glb();
    REQUIRE_NOTHROW(load_glb(glb));
    for (std::size_t size = 4; size < glb.size(); ++size) {
        INFO(size);
        CHECK(refusal(glb.substr(0, size)) != "accepted");
    }
    check_refused(glb.substr(0, glb.size() - 4), {"GLB header", "truncated"});
}

TEST_CASE("the GLB version must be 2") {
    std::string glb = square_gltf().glb();
    glb[4] = 1;
    CHECK(contains(refusal<UnsupportedError>(glb), "version 1 is not supported"));
}

TEST_CASE("a BIN chunk longer than the file is rejected") {
    const GltfBuilder builder = square_gltf();
    std::string glb = builder.glb();
    const std::size_t bin_header = glb.size() - builder.bin.size() - 8;
    glb[bin_header] = static_cast<char>(glb[bin_header] + 8);
    check_refused(glb, {"GLB chunk 1", "needs 68 bytes, 60 bytes are left"});
}

TEST_CASE("excess bytes of a BIN chunk are ignored, with a warning beyond the padding") {
    GltfBuilder builder = square_gltf();
    builder.json["buffers"] = {{{"byteLength", builder.bin.size() + 1}}};
    builder.bin += "abcd";
    CHECK(load_glb(builder).warnings.empty());
    builder.bin += "efghi";
    const Asset asset = load_glb(builder);
    CHECK(asset.parts[0].triangles.size() == 2);
    CHECK(any_contains(asset.warnings, "11 bytes more than the buffer"));
}

TEST_CASE("a BIN chunk shorter than its buffer is rejected") {
    GltfBuilder builder = square_gltf();
    builder.json["buffers"] = {{{"byteLength", 1000}}};
    check_refused(builder, {"/buffers/0", "needs 1000 bytes, there are 60"});
    builder.json["buffers"] = {{{"byteLength", UINT64_MAX}}};
    check_refused(builder, {"/buffers/0", "there are 60"});
}

TEST_CASE("an empty BIN chunk is valid") {
    std::string glb = GltfBuilder().glb();
    GltfBuilder::put_u32(glb, 0);
    glb += std::string("BIN\0", 4);
    glb[8] = static_cast<char>(glb.size());
    CHECK(load_glb(glb).parts.empty());
}

TEST_CASE("brackets nested 20000 deep are rejected except inside strings") {
    const std::string many(20000, '[');
    check_refused(GltfBuilder::glb_of(R"({"asset":{"version":"2.0"},"extras":)" + many, ""),
                  {"nested deeper than 64"});
    CHECK_NOTHROW(
        load_glb(GltfBuilder::glb_of(R"({"asset":{"version":"2.0"},"extras":"\")" + many + "\"}", "")));
}

TEST_CASE("invalid JSON is rejected") {
    check_refused(GltfBuilder::glb_of("{\"asset\":", ""), {"JSON", "parse error"});
    check_refused(GltfBuilder::glb_of("[1]", ""), {"neither a GLB nor a JSON object"});
    check_refused(GltfBuilder::glb_of(R"({"asset":{"version":"2.0"},"nodes":[7]})", ""),
                  {"/nodes/0", "object"});
}

TEST_CASE("glTF versions other than 2 are unsupported") {
    GltfBuilder builder;
    builder.json["asset"]["version"] = "1.0";
    CHECK(contains(refusal<UnsupportedError>(builder), "/asset/version: '1.0' is not supported"));
    builder.json["asset"] = {{"version", "2.0"}, {"minVersion", "2.1"}};
    CHECK(contains(refusal<UnsupportedError>(builder), "/asset/minVersion"));
    builder.json.erase("asset");
    check_refused(builder, {"/asset", "missing"});
}

TEST_CASE("accessors larger than their buffer view are rejected with both sizes") {
    const auto refused = [](const char* key, const Json& value, const std::vector<std::string>& words) {
        GltfBuilder builder = square_gltf();
        builder.json["accessors"][0][key] = value;
        check_refused(builder, words);
    };
    refused("count", 5, {"/accessors/0", "needs 60 bytes, bufferView 0 has 48"});
    refused("count", std::uint64_t{1} << 62, {"needs 4611686018427387904 elements, bufferView 0 has 48"});
    refused("count", 0, {"/accessors/0/count", "is 0"});
    refused("count", -4, {"/accessors/0/count", "not an unsigned integer"});
    refused("byteOffset", 4, {"/accessors/0", "needs 52 bytes, bufferView 0 has 48"});
    refused("byteOffset", UINT64_MAX - 7, {"/accessors/0", "bufferView 0 has 48"});
    refused("componentType", 5130, {"/accessors/0/componentType", "5130"});
    refused("type", "VEC5", {"/accessors/0/type", "'VEC5'"});
    GltfBuilder builder = square_gltf();
    builder.json["accessors"][0] = {
        {"componentType", f32}, {"type", "VEC3"}, {"count", std::uint64_t{1} << 40}};
    check_refused(builder, {"/accessors/0/count", "without a bufferView"});
}

TEST_CASE("buffer views larger than their buffer are rejected") {
    GltfBuilder builder = square_gltf();
    builder.json["bufferViews"][1]["byteLength"] = 13;
    check_refused(builder, {"/bufferViews/1", "needs 13 bytes at offset 48, buffer 0 has 60"});
    builder.json["bufferViews"][1]["byteLength"] = UINT64_MAX - 40;
    check_refused(builder, {"/bufferViews/1", "buffer 0 has 60"});
}

TEST_CASE("strides smaller than the element or out of range are rejected") {
    GltfBuilder builder = square_gltf();
    builder.json["bufferViews"][0]["byteStride"] = 8;
    check_refused(builder, {"/accessors/0", "elements of 12 bytes, bufferView 0 has a stride of 8"});
    builder.json["bufferViews"][0]["byteStride"] = 256;
    check_refused(builder, {"/bufferViews/0/byteStride", "256"});
}

TEST_CASE("sparse indices must be in range and strictly increasing") {
    GltfBuilder builder = square_gltf();
    const auto values = builder.view(std::vector<Vec3f>{{5, 5, 5}, {6, 6, 6}});
    const auto sparse = [&](std::vector<std::uint16_t> indices) {
        const auto index_view = builder.view(indices);
        builder.json["accessors"][0]["sparse"] = {
            {"count", 2},
            {"indices", {{"bufferView", index_view}, {"componentType", u16}}},
            {"values", {{"bufferView", values}}}};
    };
    sparse({1, 4});
    check_refused(builder, {"/accessors/0/sparse/indices", "contains index 4, the accessor has 4 elements"});
    sparse({2, 1});
    check_refused(builder, {"/accessors/0/sparse/indices", "not increasing: 1 comes after 2"});
    sparse({1, 1});
    check_refused(builder, {"/accessors/0/sparse/indices", "not increasing"});
    sparse({0, 3});
    builder.json["accessors"][0]["sparse"]["count"] = 3;
    check_refused(builder, {"/accessors/0/sparse", "needs 6 bytes"});
    builder.json["accessors"][0]["sparse"]["count"] = 5;
    check_refused(builder, {"/accessors/0/sparse/count", "is 5, the accessor has 4 elements"});
}

TEST_CASE("indices greater than the number of vertices are rejected") {
    GltfBuilder builder = square_gltf();
    const auto indices = builder.accessor(std::vector<std::uint16_t>{0, 1, 4}, u16, "SCALAR");
    builder.primitive()["indices"] = indices;
    check_refused(builder, {"/meshes/0/primitives/0/indices", "contains 4, there are 4 vertices"});
}

TEST_CASE("node graphs that are not forests are rejected") {
    const auto refused = [](const char* nodes, const std::vector<std::string>& words) {
        GltfBuilder builder;
        builder.json["nodes"] = Json::parse(nodes);
        builder.json["scenes"] = Json::parse(R"([{"nodes":[0,1]}])");
        check_refused(builder, words);
    };
    refused(R"([{"children":[1]},{"children":[2]},{"children":[0]}])", {"/nodes/", "its own ancestor"});
    refused(R"([{"children":[0]},{}])", {"/nodes/0", "its own ancestor"});
    refused(R"([{},{"children":[2]},{"children":[1,0]}])", {"its own ancestor"});
    refused(R"([{"children":[2]},{"children":[2]},{}])", {"/nodes/2", "two parents: /nodes/0 and /nodes/1"});
    refused(R"([{"children":[1]},{}])", {"/scenes/0/nodes/1", "has a parent"});
}

TEST_CASE("dangling references are rejected in all objects") {
    GltfBuilder builder = square_gltf();
    builder.json["materials"] = Json::array({Json::object()});
    const auto refused_at = [&](const std::string& pointer, Json value, const std::string& where) {
        GltfBuilder wrong = builder;
        wrong.json[Json::json_pointer(pointer)] = std::move(value);
        check_refused(wrong, {where, "refers to", "there are"});
    };
    refused_at("/nodes/0/mesh", 1, "/nodes/0/mesh");
    refused_at("/nodes/0/skin", 0, "/nodes/0/skin");
    refused_at("/nodes/0/camera", 0, "/nodes/0/camera");
    refused_at("/nodes/0/children", {7}, "/nodes/0/children/0");
    refused_at("/scene", 1, "/scene");
    refused_at("/scenes/0/nodes", {9}, "/scenes/0/nodes/0");
    refused_at("/meshes/0/primitives/0/indices", 2, "/meshes/0/primitives/0/indices");
    refused_at("/meshes/0/primitives/0/material", 1, "/meshes/0/primitives/0/material");
    refused_at("/meshes/0/primitives/0/attributes/NORMAL", 5, "/meshes/0/primitives/0/attributes/NORMAL");
    refused_at("/meshes/0/primitives/0/targets", Json::parse(R"([{"POSITION":8}])"),
               "/meshes/0/primitives/0/targets/0/POSITION");
    refused_at("/accessors/0/bufferView", 2, "/accessors/0/bufferView");
    refused_at("/bufferViews/0/buffer", 1, "/bufferViews/0/buffer");
    refused_at("/materials/0/normalTexture", {{"index", 0}}, "/materials/0/normalTexture/index");
    refused_at("/materials/0/extensions",
               Json::parse(R"({"KHR_materials_sheen":{"sheenColorTexture":{"index":0}}})"),
               "/materials/0/extensions/KHR_materials_sheen/sheenColorTexture/index");
    refused_at("/materials/0/teapotTexture", {{"index", 0}}, "/materials/0/teapotTexture/index");
    refused_at("/extensions",
               Json::parse(R"({"EXT_lights_image_based":{"lights":[{"specularImages":[[2]]}]}})"),
               "/extensions/EXT_lights_image_based/lights/0/specularImages");
    refused_at("/textures", Json::parse(R"([{"source":0}])"), "/textures/0/source");
    refused_at("/textures", Json::parse(R"([{"sampler":0}])"), "/textures/0/sampler");
    refused_at("/images", Json::parse(R"([{"bufferView":9,"mimeType":"image/png"}])"),
               "/images/0/bufferView");
    refused_at("/skins", Json::parse(R"([{"joints":[3]}])"), "/skins/0/joints/0");
    refused_at("/skins", Json::parse(R"([{"joints":[0],"inverseBindMatrices":9}])"),
               "/skins/0/inverseBindMatrices");
    refused_at("/animations", Json::parse(R"([{"channels":[],"samplers":[{"input":9,"output":0}]}])"),
               "/animations/0/samplers/0/input");
}

TEST_CASE("extensions must be objects of objects except in extras") {
    GltfBuilder builder = square_gltf();
    builder.json["extras"] = Json::parse(R"({"extensions":[1]})");
    CHECK_NOTHROW(load_glb(builder));
    builder.json["extensions"] = {1};
    check_refused(builder, {"/extensions", "is not an object"});
    builder.json["extensions"] = {{"ACME_a", {{"deep", Json::parse(R"([{"extensions":{"ACME_b":3}}])")}}}};
    check_refused(builder, {"/extensions/ACME_a/deep/0/extensions/ACME_b", "is not an object"});
}

TEST_CASE("attributes must have the correct type and equal counts") {
    GltfBuilder builder = square_gltf();
    Json& attributes = builder.primitive()["attributes"];
    attributes["TEXCOORD_0"] = 0;
    check_refused(builder, {"attributes/TEXCOORD_0", "is a VEC3, TEXCOORD_0 must be a VEC2"});
    attributes.erase("TEXCOORD_0");
    attributes["NORMAL"] = builder.accessor(std::vector<Vec3f>{{0, 0, 1}}, f32, "VEC3");
    check_refused(builder, {"elements, other attributes of the primitive"});
}

TEST_CASE("unsupported required extensions are rejected with their name") {
    GltfBuilder builder = square_gltf();
    const auto required = [&](const char* name) {
        builder.json["extensionsUsed"] = builder.json["extensionsRequired"] = {name};
        return refusal<UnsupportedError>(builder);
    };
    CHECK(contains(required("ACME_teapots"),
                   "/extensionsRequired/0: the extension ACME_teapots is not supported"));
    for (const char* name :
         {"KHR_mesh_quantization", "KHR_texture_transform", "KHR_materials_unlit", "KHR_materials_variants",
          "KHR_lights_punctual", "KHR_texture_basisu", "EXT_texture_avif", "MSFT_texture_dds"})
        CHECK(required(name) == "accepted");
}

TEST_CASE("URIs outside the folder are rejected for buffers, and images with them left out with a warning") {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "inside");
    put(folder / "secret.bin", std::string(60, 'x'));
    put(folder / "secret.png", std::string(60, 'x'));
    const auto message = [&](const char* array, const std::string& uri) {
        GltfBuilder builder;
        Json entry = {{"uri", uri}};
        if (array == std::string("buffers")) entry["byteLength"] = 4;
        builder.add(array, entry);
        put(folder / "inside/a.gltf", builder.text());
        if (array == std::string("buffers"))
            return message_of<InputError>([&] { load(folder / "inside/a.gltf"); });
        const std::vector<std::string> warnings = load(folder / "inside/a.gltf").warnings;
        REQUIRE(warnings.size() == 1);
        CHECK(contains(warnings[0], "; the textures that use it were left out"));
        return warnings[0];
    };
    for (const char* array : {"buffers", "images"}) {
        const std::string name = array == std::string("buffers") ? "secret.bin" : "secret.png";
        for (const std::string& uri :
             {"../" + name, "%2e%2e/" + name, "%2E%2E%2F" + name, "./x/../../" + name}) {
            INFO(uri);
            const std::string text = message(array, uri);
            INFO(text);
            CHECK(contains(text, std::string("/") + array + "/0/uri"));
            CHECK(contains(text, "is outside the folder"));
        }
        CHECK(contains(message(array, (folder / name).string()), "absolute"));
        CHECK(contains(message(array, "http://example.org/" + name), "not a relative path"));
        CHECK(contains(message(array, "."), "not a regular file"));
    }
}

TEST_CASE("an image in a data URI that cannot be read is left out with a warning") {
    for (const char* uri : {"data:image/svg+xml;utf8,<svg/>", "data:image/png;base64,A*", "data:"}) {
        GltfBuilder builder = square_gltf();
        builder.add("images", {{"uri", uri}});
        CHECK(contains(load_glb(builder).warnings.at(0), "/images/0/uri: "));
    }
}

TEST_CASE("an embedded image that is none is left out with a warning that names it") {
    const std::pair<std::string, const char*> contents[] = {
        {"x", "/images/0 ('sky'): is no image: it has fewer than 16 bytes"},
        {"<!DOCTYPE html><p>404</p>", "/images/0 ('sky'): is no image: it begins like an HTML page"},
        {"version https://git-lfs.github.com/spec/v1", "it begins like a Git LFS pointer"}};
    for (const auto& [bytes, message] : contents) {
        GltfBuilder builder = square_gltf();
        const auto view = builder.view(std::vector<char>(bytes.begin(), bytes.end()));
        builder.add("images", {{"bufferView", view}, {"mimeType", "image/png"}, {"name", "sky"}});
        builder.json["textures"] = Json::parse(R"([{"source":0}])");
        builder.json["materials"] = Json::parse(R"([{"emissiveTexture":{"index":0}}])");
        const Asset asset = load_glb(builder);
        REQUIRE(asset.warnings.size() == 1);
        CHECK(contains(asset.warnings[0], message));
        CHECK(contains(asset.warnings[0], "; the textures that use it were left out"));
        CHECK(!asset.materials.at(0).emissive_texture);
        CHECK(asset.images.empty());
    }
}

TEST_CASE("files in the current directory are not used for missing files of the asset") {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "inside");
    put(folder / "a.bin", std::string(4, 'x'));
    put(folder / "inside/a.gltf",
        R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":4,"uri":"a.bin"}]})");
    const std::filesystem::path before = std::filesystem::current_path();
    std::filesystem::current_path(folder.path());
    const std::string message = message_of<ReadError>([&] { load(folder / "inside/a.gltf"); });
    std::filesystem::current_path(before);
    CHECK(contains(message, "/buffers/0/uri"));
    CHECK(contains(message, "a.bin"));
}

TEST_CASE("buffers without data are rejected") {
    GltfBuilder builder;
    builder.json["buffers"] = Json::parse(R"([{"byteLength":0}])");
    check_refused(builder, {"/buffers/0/byteLength", "is 0"});
    builder.json["buffers"] = Json::parse(R"([{"byteLength":4}])");
    check_refused(builder, {"/buffers/0", "neither a uri nor a BIN chunk"});
    builder.json["buffers"] =
        Json::parse(R"([{"byteLength":4,"uri":"data:application/octet-stream;base64,AAA="}])");
    check_refused(builder, {"/buffers/0", "needs 4 bytes, there are 2"});
}

TEST_CASE("a model whose faces all have a non-finite position is rejected") {
    GltfBuilder builder;
    const std::vector<Vec3f> positions = {{0, 0, 0}, {1, 0, 0}, {0, std::nanf(""), 0}};
    builder.mesh({{"attributes", {{"POSITION", builder.accessor(positions, f32, "VEC3")}}}});
    check_refused(builder, {"/meshes", "all faces"});
}
