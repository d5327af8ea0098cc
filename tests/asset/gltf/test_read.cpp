// Reading of valid glTF documents.

#include <cmath>
#include <limits>

#include "support/catch.hpp"
#include "support/gltf_builder.hpp"

using namespace faqem;
using namespace faqem::testing;

namespace {

/// Twice the signed area of a face in the plane z = 0: positive if it is counter-clockwise as seen from +z.
double orientation(const Part& part, const Triangle& t) {
    const Vec3 &a = part.positions[t[0]], &b = part.positions[t[1]], &c = part.positions[t[2]];
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

const Part& only_part(const Asset& asset) {
    REQUIRE(asset.parts.size() == 1);
    return asset.parts[0];
}

/// Loads the square with an additional attribute.
template <class T>
Asset with_attribute(const char* name, const std::vector<T>& values, int component, const char* type,
                     bool normalized = false) {
    GltfBuilder builder = square_gltf();
    const auto accessor = builder.attribute(name, values, component, type);
    if (normalized) builder.json["accessors"][accessor]["normalized"] = true;
    return load_glb(builder);
}

constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

}  // namespace

TEST_CASE("an indexed mesh is read without changes") {
    GltfBuilder builder = square_gltf();
    builder.json["meshes"][0]["name"] = "patch";
    const Asset asset = load_glb(builder);
    const Part& part = only_part(asset);
    CHECK(part.name == "patch");
    CHECK(part.source == 0);
    CHECK(part.positions == std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}});
    CHECK(part.triangles == std::vector<Triangle>{{0, 1, 2}, {2, 1, 3}});
    CHECK(part.face_material == std::vector<Index>{no_index, no_index});
    CHECK(part.normals.empty());
    CHECK(asset.warnings.empty());
}

TEST_CASE("meshes with 8-bit, 16-bit, 32-bit and no indices are read") {
    GltfBuilder builder = square_gltf();
    Json& primitive = builder.primitive();
    primitive["indices"] = builder.accessor(std::vector<std::uint8_t>{3, 2, 1}, u8, "SCALAR");
    CHECK(only_part(load_glb(builder)).triangles == std::vector<Triangle>{{3, 2, 1}});
    primitive["indices"] = builder.accessor(std::vector<std::uint32_t>{1, 3, 2}, u32, "SCALAR");
    CHECK(only_part(load_glb(builder)).triangles == std::vector<Triangle>{{1, 3, 2}});
    primitive.erase("indices");
    const Asset asset = load_glb(builder);
    CHECK(only_part(asset).triangles == std::vector<Triangle>{{0, 1, 2}});
    CHECK(any_contains(asset.warnings, "1 indices at the end"));
}

TEST_CASE("triangle strips are read with consistent winding") {
    // 2---3
    // | \ |   the strip 0 1 2 3 4 5 is a zigzag in +y direction
    // 0---1
    GltfBuilder builder;
    const std::vector<Vec3f> positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 2, 0}, {1, 2, 0}};
    builder.mesh({{"attributes", {{"POSITION", builder.accessor(positions, f32, "VEC3")}}}, {"mode", 5}});
    const Asset asset = load_glb(builder);
    const Part& part = only_part(asset);
    CHECK(part.triangles == std::vector<Triangle>{{0, 1, 2}, {1, 3, 2}, {2, 3, 4}, {3, 5, 4}});
    for (const Triangle& t : part.triangles) CHECK(orientation(part, t) == 1);
}

TEST_CASE("degenerate triangles of a strip are left out and do not change the winding") {
    GltfBuilder builder = square_gltf();
    Json& primitive = builder.primitive();
    primitive["mode"] = 5;
    primitive["indices"] = builder.accessor(std::vector<std::uint16_t>{0, 1, 2, 2, 2, 1, 3}, u16, "SCALAR");
    const Asset asset = load_glb(builder);
    CHECK(only_part(asset).triangles == std::vector<Triangle>{{0, 1, 2}, {2, 1, 3}});
}

TEST_CASE("triangle fans share their first vertex") {
    GltfBuilder builder;
    const std::vector<Vec3f> positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {-1, 1, 0}};
    builder.mesh({{"attributes", {{"POSITION", builder.accessor(positions, f32, "VEC3")}}}, {"mode", 6}});
    const Asset asset = load_glb(builder);
    const Part& part = only_part(asset);
    CHECK(part.triangles == std::vector<Triangle>{{1, 2, 0}, {2, 3, 0}, {3, 4, 0}});
    for (const Triangle& t : part.triangles) CHECK(orientation(part, t) == 1);
}

TEST_CASE("primitives are joined and missing attributes get neutral values") {
    GltfBuilder builder = square_gltf();
    builder.json["materials"] = Json::parse(R"([{"name":"a"},{"name":"b"}])");
    const auto normals = builder.accessor(std::vector<Vec3f>(4, Vec3f{0, 0, 1}), f32, "VEC3");
    const auto uvs = builder.accessor(std::vector<Vec2f>(4, Vec2f{0.5f, 0.25f}), f32, "VEC2");
    const auto colors = builder.accessor(std::vector<Vec3f>(4, Vec3f{0.25f, 0.5f, 1}), f32, "VEC3");
    Json& primitives = builder.json["meshes"][0]["primitives"];
    primitives[0]["material"] = 1;
    primitives.push_back(
        {{"attributes", {{"POSITION", 0}, {"NORMAL", normals}, {"TEXCOORD_0", uvs}, {"COLOR_0", colors}}},
         {"indices", 1},
         {"material", 0}});
    const Asset asset = load_glb(builder);
    const Part& part = only_part(asset);
    REQUIRE(part.positions.size() == 8);
    CHECK(part.triangles[2] == Triangle{4, 5, 6});
    CHECK(part.face_material == std::vector<Index>{1, 1, 0, 0});
    CHECK(part.normals[0] == Vec3f{0, 0, 0});
    CHECK(part.normals[4] == Vec3f{0, 0, 1});
    CHECK(part.uvs[0][3] == Vec2f{0, 0});
    CHECK(part.uvs[0][7] == Vec2f{0.5f, 0.25f});
    CHECK(part.colors[0] == Vec4f{1, 1, 1, 1});
    CHECK(part.colors[5] == Vec4f{0.25f, 0.5f, 1, 1});
}

TEST_CASE("primitives with the same attributes share their vertices") {
    GltfBuilder builder = square_gltf();
    const auto first = builder.accessor(std::vector<std::uint16_t>{0, 1, 2}, u16, "SCALAR");
    const auto second = builder.accessor(std::vector<std::uint16_t>{2, 1, 3}, u16, "SCALAR");
    Json& primitives = builder.json["meshes"][0]["primitives"];
    primitives[0]["indices"] = first;
    primitives.push_back({{"attributes", {{"POSITION", 0}}}, {"indices", second}});
    const Asset asset = load_glb(builder);
    CHECK(only_part(asset).positions.size() == 4);
    CHECK(only_part(asset).triangles == std::vector<Triangle>{{0, 1, 2}, {2, 1, 3}});
}

TEST_CASE("normalised integers are converted to the unit range") {
    using Bytes = std::array<std::uint8_t, 4>;
    const Asset colors =
        with_attribute("COLOR_0", std::vector<Bytes>(4, Bytes{0, 51, 255, 128}), u8, "VEC4", true);
    CHECK(colors.parts[0].colors[0] == Vec4f{0, 0.2f, 1, 128 / 255.0f});
    using Shorts = std::array<std::uint16_t, 2>;
    const Asset uvs =
        with_attribute("TEXCOORD_0", std::vector<Shorts>(4, Shorts{65535, 13107}), u16, "VEC2", true);
    CHECK(uvs.parts[0].uvs[0][0] == Vec2f{1, 0.2f});
    using Signed = std::array<std::int8_t, 4>;
    const Asset tangents =
        with_attribute("TANGENT", std::vector<Signed>(4, Signed{-128, -127, 127, 127}), i8, "VEC4", true);
    CHECK(tangents.parts[0].tangents[0] == Vec4f{-1, -1, 1, 1});
}

TEST_CASE("quantised positions are read with strides and normalisation") {
    GltfBuilder builder;
    // Elements of 6 bytes with a stride of 8 bytes.
    const auto view = builder.view(std::vector<std::int16_t>{0, 0, 0, 9, 32767, 0, 0, 9, 0, -32768, 0, 9});
    builder.json["bufferViews"][view]["byteStride"] = 8;
    builder.json["accessors"] = {
        {{"bufferView", view}, {"componentType", i16}, {"type", "VEC3"}, {"count", 3}}};
    builder.mesh({{"attributes", {{"POSITION", 0}}}});
    builder.json["extensionsUsed"] = builder.json["extensionsRequired"] = {"KHR_mesh_quantization"};
    CHECK(load_glb(builder).parts[0].positions ==
          std::vector<Vec3>{{0, 0, 0}, {32767, 0, 0}, {0, -32768, 0}});
    builder.json["accessors"][0]["normalized"] = true;
    CHECK(load_glb(builder).parts[0].positions == std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, -1, 0}});
}

TEST_CASE("sparse accessors replace elements of a buffer view or of zeros") {
    GltfBuilder builder = square_gltf();
    const auto index_view = builder.view(std::vector<std::uint8_t>{1, 3});
    const auto values = builder.view(std::vector<Vec3f>{{5, 0, 0}, {5, 1, 0}});
    builder.json["accessors"][0]["sparse"] = {
        {"count", 2},
        {"indices", {{"bufferView", index_view}, {"componentType", u8}}},
        {"values", {{"bufferView", values}}}};
    CHECK(load_glb(builder).parts[0].positions ==
          std::vector<Vec3>{{0, 0, 0}, {5, 0, 0}, {0, 1, 0}, {5, 1, 0}});
    builder.json["accessors"][0].erase("bufferView");
    CHECK(load_glb(builder).parts[0].positions ==
          std::vector<Vec3>{{0, 0, 0}, {5, 0, 0}, {0, 0, 0}, {5, 1, 0}});
}

TEST_CASE("vertices with a non-finite position are removed with their faces, and counted") {
    GltfBuilder builder;
    builder.triangles({{7, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, not_a_number, 0}}, square_corners);
    const Asset asset = load_glb(builder);
    CHECK(only_part(asset).triangles == std::vector<Triangle>{{0, 1, 2}});
    CHECK(only_part(asset).face_material.size() == 1);
    CHECK(only_part(asset).positions == std::vector<Vec3>{{7, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    CHECK(any_contains(asset.warnings, "/meshes/0: 1 vertex with a non-finite position and 1 adjacent face"));
}

TEST_CASE("non-finite normals, texture coordinates and colours are reset and counted") {
    const Asset normals = with_attribute(
        "NORMAL", std::vector<Vec3f>{{0, 0, 1}, {not_a_number, 0, 0}, {0, 0, 1}, {0, INFINITY, 0}}, f32,
        "VEC3");
    CHECK(normals.parts[0].normals[1] == Vec3f{0, 0, 0});
    CHECK(any_contains(normals.warnings, "2 non-finite vectors of normals set to zero"));
    const Asset uvs = with_attribute(
        "TEXCOORD_0", std::vector<Vec2f>{{1, 1}, {1, not_a_number}, {1, 1}, {1, 1}}, f32, "VEC2");
    CHECK(uvs.parts[0].uvs[0][1] == Vec2f{0, 0});
    CHECK(any_contains(uvs.warnings, "1 non-finite vector of uvs 0 set to zero"));
    const Asset colors = with_attribute(
        "COLOR_0", std::vector<Vec3f>{{0, 0, 0}, {0, not_a_number, 0}, {0, 0, 0}, {0, 0, 0}}, f32, "VEC3");
    CHECK(colors.parts[0].colors[1] == Vec4f{1, 1, 1, 1});
}

TEST_CASE("of several sets of joints the four heaviest stay, with the sum 1, and the rest is reported") {
    // Vertex 0 has six joints; in vertex 1 joint 7 is in both sets; of vertex 2 two of four equal ones stay beside two
    // heavier ones; vertex 3 has no weights.
    using Four = std::array<std::uint8_t, 4>;
    GltfBuilder builder = square_gltf();
    const auto add = [&](const char* name, const auto& values, int type) {
        builder.attribute(name, values, type, "VEC4");
    };
    add("JOINTS_0", std::vector<Four>{{0, 1, 2, 3}, {7, 1, 0, 0}, {9, 8, 7, 6}, {1, 2, 3, 4}}, u8);
    add("JOINTS_1", std::vector<Four>{{4, 5, 0, 0}, {7, 2, 0, 0}, {5, 4, 0, 0}, {5, 6, 7, 8}}, u8);
    add("WEIGHTS_0",
        std::vector<Vec4f>{
            {0.0625f, 0.125f, 0.1875f, 0.125f}, {0.25f, 0.25f, 0, 0}, {0.125f, 0.125f, 0.125f, 0.125f}, {}},
        f32);
    add("WEIGHTS_1", std::vector<Vec4f>{{0.25f, 0.25f, 0, 0}, {0.25f, 0.25f, 0, 0}, {0.25f, 0.25f, 0, 0}, {}},
        f32);
    const Asset asset = load_glb(builder);
    const Part& part = only_part(asset);
    using Joints = std::array<std::uint16_t, 4>;
    CHECK(part.joints == std::vector<Joints>{{4, 5, 2, 1}, {7, 1, 2, 0}, {4, 5, 6, 7}, {0, 0, 0, 0}});
    const float s = 0.8125f, third = 0.25f / 0.75f, sixth = 0.125f / 0.75f;
    CHECK(part.weights == std::vector<Vec4f>{{0.25f / s, 0.25f / s, 0.1875f / s, 0.125f / s},
                                             {0.5f, 0.25f, 0.25f, 0},
                                             {third, third, sixth, sixth},
                                             {0, 0, 0, 0}});
    // 3/16 of the weight of vertex 0 and 1/4 of that of vertex 2.
    REQUIRE(asset.warnings.size() == 1);
    CHECK(contains(asset.warnings[0], "/meshes/0: 2 vertices have more than four joints"));
    CHECK(contains(asset.warnings[0], "21.9% of the weights in the mean and at most 25.0% were left out"));
}

TEST_CASE("materials are read with factors, textures, wrap modes and texture transforms") {
    GltfBuilder builder = square_gltf();
    const Image png = small_png();
    const auto view = builder.view(png.encoded);
    builder.json["images"] = {{{"bufferView", view}, {"mimeType", "image/jpeg"}, {"name", "paint"}}};
    builder.json["samplers"] = Json::parse(R"([{"wrapS":33071,"wrapT":33648,"magFilter":9728}])");
    builder.json["textures"] = Json::parse(R"([{"source":0,"sampler":0},{"source":0}])");
    builder.json["materials"] = Json::parse(R"([{
        "name":"m","doubleSided":true,"alphaMode":"MASK","alphaCutoff":0.25,"emissiveFactor":[0.5,0,1],
        "pbrMetallicRoughness":{"baseColorFactor":[0.5,1,1,0.5],"metallicFactor":0.25,"roughnessFactor":0.75,
            "baseColorTexture":{"index":0,"texCoord":1,"extensions":{"KHR_texture_transform":
                {"offset":[0.5,0.25],"scale":[2,4],"rotation":1.5,"texCoord":2}}}},
        "normalTexture":{"index":1,"scale":0.5},"occlusionTexture":{"index":1,"strength":0.25},
        "extensions":{"KHR_materials_unlit":{},"KHR_materials_ior":{"ior":1.4},"ACME_x":{}}}])");
    const Asset asset = load_glb(builder);
    REQUIRE(asset.materials.size() == 1);
    const Material& m = asset.materials[0];
    CHECK(m.name == "m");
    CHECK(m.source == 0);
    CHECK(m.double_sided);
    CHECK(m.unlit);
    CHECK(m.extensions == std::vector<std::string>{"ACME_x", "KHR_materials_ior"});
    CHECK(m.alpha_mode == AlphaMode::mask);
    CHECK(m.alpha_cutoff == 0.25f);
    CHECK(m.base_color == Vec4f{0.5f, 1, 1, 0.5f});
    CHECK(m.emissive == Vec3f{0.5f, 0, 1});
    CHECK(m.metallic == 0.25f);
    CHECK(m.roughness == 0.75f);
    CHECK(m.normal_scale == 0.5f);
    CHECK(m.occlusion_strength == 0.25f);
    const TextureRef& base = m.base_color_texture;
    CHECK(base.image == 0);
    CHECK(base.uv_set == 2);
    CHECK(base.wrap_u == Wrap::clamp);
    CHECK(base.wrap_v == Wrap::mirror);
    CHECK(base.filter == Filter::nearest);
    CHECK(base.offset == Vec2f{0.5f, 0.25f});
    CHECK(base.scale == Vec2f{2, 4});
    CHECK(base.rotation == 1.5f);
    CHECK(m.normal_texture.wrap_u == Wrap::repeat);
    CHECK_FALSE(m.emissive_texture);
    REQUIRE(asset.images.size() == 1);
    CHECK(asset.images[0].name == "paint");
    CHECK(asset.images[0].mime_type == "image/png");
    CHECK(asset.images[0].encoded == png.encoded);
}

TEST_CASE("a missing image removes its textures with a warning") {
    const TemporaryFolder folder;
    GltfBuilder builder;
    builder.json["images"] = Json::parse(R"([{"uri":"gone.png"},{"uri":"here%20it%20is.png"}])");
    builder.json["textures"] = Json::parse(R"([{"source":0},{"source":1},{"source":1}])");
    builder.json["materials"] = Json::parse(R"([{"normalTexture":{"index":0},"emissiveTexture":{"index":1}},
                                               {"emissiveTexture":{"index":2}}])");
    put(folder / "a.gltf", builder.text());
    const Image png = small_png();
    put(folder / "here it is.png", std::string(png.encoded.begin(), png.encoded.end()));
    const Asset asset = load(folder / "a.gltf");
    CHECK_FALSE(asset.materials[0].normal_texture);
    CHECK(asset.materials[0].emissive_texture.image == 0);
    CHECK(asset.materials[1].emissive_texture.image == 0);
    REQUIRE(asset.images.size() == 1);
    CHECK(asset.images[0].uri == "here%20it%20is.png");
    CHECK(any_contains(asset.warnings, "gone.png"));
}

TEST_CASE("buffers and images with paths of another machine are found with a warning") {
    const TemporaryFolder folder;
    GltfBuilder builder = square_gltf();
    std::filesystem::create_directory(folder / "Data");
    put(folder / "Data/Square.bin", std::string(builder.bin.begin(), builder.bin.end()));
    builder.json["buffers"] = {{{"byteLength", builder.bin.size()}, {"uri", "data\\square.BIN"}}};
    builder.bin.clear();
    builder.json["images"] = Json::parse(R"([{"uri":"C:\\job\\Wood.PNG"}])");
    builder.json["textures"] = Json::parse(R"([{"source":0}])");
    builder.json["materials"] = Json::parse(R"([{"emissiveTexture":{"index":0}}])");
    put(folder / "a.gltf", builder.text());
    const Image png = small_png();
    put(folder / "wood.png", std::string(png.encoded.begin(), png.encoded.end()));
    const Asset asset = load(folder / "a.gltf");
    CHECK(asset.images.at(0).encoded == png.encoded);
    CHECK(asset.warnings ==
          std::vector<std::string>{
              R"(/buffers/0/uri: 'data\square.BIN' was not found; the file 'Data/Square.bin' is read)",
              R"(/images/0/uri: 'C:\job\Wood.PNG' was not found; the file 'wood.png' is read)"});
}

TEST_CASE("extensions that are kept without being known are named") {
    GltfBuilder builder = square_gltf();
    builder.json["nodes"][0]["extensions"] = {{"OTHER_node", Json::object()},
                                              {"EXT_instance_features", Json::object()}};
    builder.json["extensions"]["ANY_document"] = {{"extras", {{"extensions", {{"NO_extension", 1}}}}}};
    builder.json["materials"] =
        Json::parse(R"([{"extensions": {"KHR_materials_new": {"extensions": {"ANY_document": {}}}}}])");
    const Asset asset = load_glb(builder);
    CHECK(asset.warnings.empty());
    CHECK(asset.not_understood == std::vector<std::string>{"extension ANY_document", "extension OTHER_node"});
}

TEST_CASE("members of glTF that are null are absent, also where the source is copied") {
    GltfBuilder builder;
    const auto positions = builder.accessor<Vec3f>({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, f32, "VEC3");
    Json triangle = {{"attributes", {{"POSITION", positions}}}, {"indices", nullptr}};
    Json point = triangle;
    triangle["extensions"]["FB_ngon_encoding"] = Json::object();
    point["mode"] = 0;
    builder.mesh(triangle);
    builder.json["meshes"][0]["primitives"].push_back(point);
    builder.json["nodes"][0].update({{"skin", 0}, {"camera", nullptr}});
    builder.json["skins"] = {{{"joints", {0}}, {"inverseBindMatrices", nullptr}, {"skeleton", nullptr}}};
    const Json json = through(builder);
    const Json& primitives = json["meshes"][0]["primitives"];
    CHECK(primitives[0]["extensions"].contains("FB_ngon_encoding"));
    CHECK_FALSE(primitives[1].contains("indices"));
    CHECK(json["skins"] == Json::array({{{"joints", {0}}}}));
    CHECK_FALSE(json["nodes"][0].contains("camera"));
}

TEST_CASE("data URIs of any media type are decoded") {
    const TemporaryFolder folder;
    put(folder / "a.gltf",
        R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":36,"uri":"data:model/strange;base64,)"
        R"(AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}],)"
        R"("bufferViews":[{"buffer":0,"byteLength":36}],)"
        R"("accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":3}],)"
        R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}]})");
    const Asset asset = load(folder / "a.gltf");
    CHECK(only_part(asset).positions == std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
}

TEST_CASE("meshes of points and lines are parts without triangles") {
    GltfBuilder builder = square_gltf();
    builder.primitive()["mode"] = 0;
    const Asset asset = load_glb(builder);
    CHECK(only_part(asset).triangles.empty());
    CHECK(asset.warnings.empty());
}

TEST_CASE("material values too large for a float are reset and counted") {
    GltfBuilder builder = square_gltf();
    const auto view = builder.view(small_png().encoded);
    builder.json["images"] = {{{"bufferView", view}, {"mimeType", "image/png"}}};
    builder.json["textures"] = Json::parse(R"([{"source":0}])");
    builder.json["materials"] = Json::parse(R"([{"pbrMetallicRoughness":{"baseColorFactor":[1e39,0.5,1,1],
        "baseColorTexture":{"index":0,"extensions":{"KHR_texture_transform":
        {"offset":[0,-1e39],"scale":[2,2]}}}},"emissiveFactor":[0,1e300,0]}])");
    const Asset asset = load_glb(builder);
    CHECK(any_contains(asset.warnings, "/materials/0: 3 numbers too large for a float, reset"));
    const Material& material = asset.materials.at(0);
    CHECK(material.base_color == Vec4f{1, 0.5f, 1, 1});
    CHECK(material.emissive == Vec3f{0, 0, 0});
    CHECK(material.base_color_texture.offset == Vec2f{0, 0});
    CHECK(material.base_color_texture.scale == Vec2f{2, 2});
}
