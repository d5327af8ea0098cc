// Writes the seed inputs of all fuzz targets: `fuzz_seeds FOLDER` creates FOLDER/NAME for each target.

#include <fstream>
#include <iostream>
#include <random>
#include <sstream>
#include <string_view>

#include "faqem/bake.hpp"
#include "support/gltf_compressed_builder.hpp"
#include "support/scenes.hpp"

using namespace faqem;

namespace fs = std::filesystem;

namespace {

fs::path root;

void put(const std::string& target, const std::string& name, std::string_view content) {
    fs::create_directories(root / target);
    std::ofstream(root / target / name, std::ios::binary) << content;
}

Asset scene() {
    Asset asset = test::textured_square(test::ramp(4));
    asset.parts[0].colors.assign(4, {1, 0.5f, 0.25f, 1});
    asset.parts[0].normals.assign(4, {0, 0, 1});
    asset.parts.push_back(test::part_of(test::icosphere(1)));
    return asset;
}

/// A glTF document with all attributes of a primitive, a skin, an animation, morph targets, sparse data and
/// images.
testing::GltfBuilder rich_gltf() {
    using namespace testing;
    GltfBuilder b = square_gltf();
    const std::vector<Vec2f> uvs = {{0, 0}, {1, 0}, {0, 1}, {1, 1}};
    const std::vector<std::array<std::uint8_t, 4>> joints(4), colours(4, {255, 128, 0, 255});
    b.attribute("TEXCOORD_0", uvs, f32, "VEC2");
    b.attribute("NORMAL", std::vector<Vec3f>(4, {0, 0, 1}), f32, "VEC3");
    b.attribute("TANGENT", std::vector<Vec4f>(4, {1, 0, 0, 1}), f32, "VEC4");
    b.attribute("JOINTS_0", joints, u8, "VEC4");
    b.attribute("WEIGHTS_0", std::vector<Vec4f>(4, {1, 0, 0, 0}), f32, "VEC4");
    b.json["accessors"][b.attribute("COLOR_0", colours, u8, "VEC4")]["normalized"] = true;
    const auto target = b.accessor(square, f32, "VEC3");
    b.primitive()["targets"] = {{{"POSITION", target}}};
    b.json["accessors"][target]["sparse"] = {
        {"count", 1},
        {"indices",
         {{"bufferView", b.view(std::vector<std::uint16_t>{2})}, {"componentType", u16}, {"byteOffset", 0}}},
        {"values", {{"bufferView", b.view(std::vector<Vec3f>{{0, 0, 2}})}}}};
    const auto png = small_png();
    const auto view = b.view(png.encoded);
    b.json["images"] = {{{"bufferView", view}, {"mimeType", "image/png"}},
                        {{"uri", "data:image/png;base64,iVBORw0KGgo="}}};
    b.json["samplers"] = {{{"wrapS", 33071}, {"magFilter", 9728}}};
    b.json["textures"] = {{{"source", 0}, {"sampler", 0}}, {{"source", 1}}};
    b.json["materials"] = {
        {{"pbrMetallicRoughness",
          {{"baseColorTexture",
            {{"index", 0}, {"extensions", {{"KHR_texture_transform", {{"offset", {0.5, 0}}}}}}}}}},
         {"normalTexture", {{"index", 1}, {"scale", 2}}},
         {"alphaMode", "MASK"},
         {"extensions", {{"KHR_materials_unlit", Json::object()}}}}};
    b.primitive()["material"] = 0;
    b.json["extensionsUsed"] = {"KHR_texture_transform", "KHR_materials_unlit"};
    b.json["nodes"][0]["children"] = {1};
    b.json["nodes"][0]["skin"] = 0;
    b.json["nodes"].push_back({{"rotation", {0, 0, 0, 1}}, {"scale", {1, -1, 1}}, {"camera", 0}});
    b.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}}};
    b.json["skins"] = {{{"joints", {1}}}};
    const auto times = b.accessor(std::vector<float>{0, 1}, f32, "SCALAR");
    const auto moves = b.accessor(std::vector<Vec3f>{{0, 0, 0}, {1, 0, 0}}, f32, "VEC3");
    b.json["animations"] = {
        {{"samplers", {{{"input", times}, {"output", moves}}}},
         {"channels", {{{"sampler", 0}, {"target", {{"node", 1}, {"path", "translation"}}}}}}}};
    return b;
}

/// A mesh that a joint with an inverse bind matrix and default morph weights pose.
testing::GltfBuilder posed_gltf() {
    testing::GltfBuilder b = rich_gltf();
    const std::array<float, 16> matrix = {2, 0, 0, 0, 0, 2, 0, 0, 0, 0, -2, 0, 1, 0, 0, 1};
    b.json["skins"][0]["inverseBindMatrices"] = b.accessor(std::vector{matrix}, testing::f32, "MAT4");
    b.json["meshes"][0]["weights"] = {0.5};
    b.json["nodes"][0]["weights"] = {1e9};
    return b;
}

/// Extensions that refer to vertices, triangles, textures and buffer views.
testing::GltfBuilder numbered_gltf() {
    testing::GltfBuilder b = testing::square_gltf();
    testing::Json& mesh = b.json["meshes"][0];
    testing::Json& primitive = mesh["primitives"][0];
    primitive["attributes"]["_FEATURE_ID_0"] =
        b.accessor(std::vector<float>{0, 1, 1, 0}, testing::f32, "SCALAR");
    const auto outline = b.accessor(std::vector<std::uint16_t>{0, 1}, testing::u16, "SCALAR");
    testing::Json manifold = {{"indices", 1}, {"attributes", {{"POSITION", 0}}}};
    mesh["extensions"]["EXT_mesh_manifold"] = {
        {"manifoldPrimitive", manifold}, {"mergeIndices", outline}, {"mergeValues", outline}};
    testing::Json ids = {{{"featureCount", 2}, {"attribute", 0}, {"propertyTable", 0}},
                         {{"featureCount", 4}}};
    primitive["extensions"] = {{"CESIUM_primitive_outline", {{"indices", outline}}},
                               {"FB_ngon_encoding", testing::Json::object()},
                               {"EXT_mesh_features", {{"featureIds", ids}}},
                               {"EXT_structural_metadata", {{"propertyAttributes", {0}}}}};
    const auto values = b.view(std::vector<float>{1, 2});
    testing::Json table = {{"count", 2},
                           {"properties", {{"a", {{"values", values}, {"stringOffsets", values}}}}}};
    testing::Json attributes = {{"properties", {{"a", {{"attribute", "_FEATURE_ID_0"}}}}}};
    b.json["extensions"]["EXT_structural_metadata"] = {
        {"propertyTables", testing::Json::array({table})},
        {"propertyAttributes", testing::Json::array({attributes})}};
    return b;
}

/// Vertices that are integers, with a morph target, and a node that restores their size.
testing::GltfBuilder quantized_gltf() {
    testing::GltfBuilder b = testing::square_gltf();
    testing::Json& primitive = b.json["meshes"][0]["primitives"][0];
    const auto add = [&](const auto& values, int component, const char* type, bool normalized) {
        const auto accessor = b.accessor(values, component, type);
        b.json["accessors"][accessor]["normalized"] = normalized;
        return accessor;
    };
    using Bytes = std::array<std::int8_t, 4>;
    using Shorts = std::array<std::int16_t, 4>;
    const std::vector<Shorts> corners = {{0, 0, 0, 0}, {100, 0, 0, 0}, {0, 100, 7, 0}, {100, 100, 0, 0}};
    const std::vector<Bytes> normals(4, {0, 0, 127, 0}), tangents(4, {127, 0, 0, 127});
    const std::vector<std::array<std::uint16_t, 2>> uvs = {{0, 0}, {65535, 0}, {0, 65535}, {65535, 65535}};
    const auto vectors = [&](const auto& values, int component, bool normalized) {
        const auto accessor = add(values, component, "VEC3", normalized);
        const auto view = b.json["accessors"][accessor]["bufferView"].template get<std::size_t>();
        b.json["bufferViews"][view]["byteStride"] = sizeof(values[0]);
        return accessor;
    };
    primitive["attributes"] = {{"POSITION", vectors(corners, testing::i16, false)},
                               {"NORMAL", vectors(normals, testing::i8, true)},
                               {"TANGENT", add(tangents, testing::i8, "VEC4", true)},
                               {"TEXCOORD_0", add(uvs, testing::u16, "VEC2", true)}};
    primitive["targets"] = {{{"POSITION", vectors(corners, testing::i16, false)}}};
    b.json["nodes"][0].update({{"scale", {0.01, 0.01, 0.01}}, {"translation", {1, 2, 3}}});
    b.json["extensionsUsed"] = b.json["extensionsRequired"] = {"KHR_mesh_quantization"};
    return b;
}

/// Textures whose images are not decoded: of extensions, and as a core source; and a texture of features.
testing::GltfBuilder passed_gltf() {
    testing::GltfBuilder b = testing::square_gltf();
    const std::string ktx = "\xabKTX 20\xbb\r\n\x1a\n", avif = std::string("\0\0\0\x1c", 4) + "ftypavif";
    const auto image = [&](const std::string& bytes, const char* type) {
        return b.add("images", {{"bufferView", b.view(std::vector<char>(bytes.begin(), bytes.end()))},
                                {"mimeType", type}});
    };
    const auto first = image(ktx, "image/ktx2"), second = image(avif, "image/avif");
    b.add("textures", {{"source", first}});
    b.add("textures", {{"extensions", {{"EXT_texture_avif", {{"source", second}}}}}});
    testing::add_texture(b, 9);
    b.json["materials"] = testing::Json::parse(
        R"([{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}},"emissiveTexture":{"index":1}}])");
    testing::Json& primitive = b.json["meshes"][0]["primitives"][0];
    primitive["material"] = 0;
    primitive["attributes"]["TEXCOORD_0"] =
        b.accessor<Vec2f>({{0, 0}, {1, 0}, {0, 1}, {1, 1}}, testing::f32, "VEC2");
    primitive["extensions"] = testing::Json::parse(
        R"({"EXT_mesh_features":{"featureIds":[{"featureCount":2,"texture":{"index":2,"channels":[0]}}]},
            "EXT_structural_metadata":{"propertyTextures":[0]}})");
    b.json["extensions"] = testing::Json::parse(
        R"({"EXT_structural_metadata":{"propertyTextures":[{"properties":{"a":{"index":2,"channels":[0]}}}]}})");
    b.json["extensionsUsed"] = {"KHR_texture_basisu", "EXT_texture_avif", "EXT_mesh_features",
                                "EXT_structural_metadata"};
    return b;
}

void gltf_seeds() {
    const auto write = [](const std::string& name, const testing::GltfBuilder& b) {
        put("glb", name + ".glb", b.glb());
        put("glb", name + ".gltf", b.text());
        put("gltf", name, b.text() + std::string(1, '\0') + b.bin);
    };
    write("square", testing::square_gltf());
    write("rich", rich_gltf());
    write("posed", posed_gltf());
    write("numbered", numbered_gltf());
    write("quantized", quantized_gltf());
    write("passed", passed_gltf());
    testing::GltfBuilder strip = testing::square_gltf();
    strip.primitive()["mode"] = 5;
    strip.json["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", 0}}}, {"mode", 6}});
    strip.json["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", 0}}}, {"mode", 1}});
    write("strip", strip);
    write("webp", testing::webp_square());
    testing::GltfBuilder instances = testing::square_gltf();
    const std::vector<Vec3f> moves = {{0, 0, 0}, {2, 0, 0}};
    const std::vector<std::array<std::int8_t, 4>> turns = {{0, 0, 0, 127}, {0, 0, 90, 90}};
    const auto turn = instances.accessor(turns, testing::i8, "VEC4");
    instances.json["accessors"][turn]["normalized"] = true;
    instances.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
        {"TRANSLATION", instances.accessor(moves, testing::f32, "VEC3")}, {"ROTATION", turn}};
    instances.json["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
    write("instances", instances);
    testing::GltfBuilder levels = rich_gltf();
    levels.json["meshes"].push_back(levels.json["meshes"][0]);
    const std::size_t first = levels.json["nodes"].size();
    levels.json["nodes"].push_back({{"mesh", 1}, {"name", "coarser"}, {"children", {first + 1}}});
    levels.json["nodes"].push_back(testing::Json::object());
    levels.json["nodes"][0]["extensions"]["MSFT_lod"]["ids"] = {first};
    levels.json["nodes"][0]["extras"] = {{"MSFT_screencoverage", {0.5, 0}}};
    levels.json["materials"].push_back(testing::Json::object());
    levels.json["materials"][0]["extensions"]["MSFT_lod"]["ids"] = {levels.json["materials"].size() - 1};
    levels.json["extensionsUsed"].push_back("MSFT_lod");
    write("levels", levels);
#ifdef FAQEM_WITH_DRACO
    for (const testing::Method method : {testing::Method::edgebreaker, testing::Method::sequential})
        for (const int bits : {0, 11})
            write("draco-" + std::to_string(int(method)) + "-" + std::to_string(bits),
                  testing::draco_square(method, bits));
#endif
#ifdef FAQEM_WITH_MESHOPT
    write("meshopt", testing::packed_square());
#endif
}

/// Files of the other formats, as faqem writes them and with variants that other programs write.
void text_seeds() {
    const fs::path folder = root / "out";
    fs::create_directories(folder);
    for (const std::string format : {"obj", "ply", "stl"}) {
        save(scene(), folder / ("a." + format), Overwrite::yes);
        put(format, "written", testing::get(folder / ("a." + format)));
    }
    put("mtl", "written", testing::get(folder / "a.mtl"));
    fs::remove_all(folder);
    put("mtl", "all",
        "newmtl a\nKd 1 .5 0\nd 0.5\nTr 0.1\nNs 10\nPr 0.5\nPm 1\nKe 1 1 1\nmap_Kd -s 1 2 3 -o 1 -clamp on a "
        "b.png\n"
        "map_d a b.png\nmap_Ke e.png\nnorm n.png\nbump -bm 1 b.png\nnewmtl b\nKa 0 0 0\nillum 2\nKd spectral "
        "x\n");
    put("mtl", "names",
        "newmtl \"a b\"\nMAP_KD \"C:\\job\\Wood b.PNG\" -s 2 2\nmap_d /x/../../a.png\nmap_Bump -imfchan m "
        "-bm 2 "
        "a.tga\nmap_Pr a.bmp -o 1\nmap_Pm \"a.gif\nmap_Ka 'b.tif'\nnewmtl a b\nTr 1\nd 0\n");
    put("obj", "objects",
        "mtllib \"my lib.mtl\" C:\\a.mtl\no a\nv 0 0 0\nv 1 0 0\nv 1 1 0\ng x y\nusemtl m n\nf 1 2 3\no b\n"
        "v 0 1 0\nusemtl \"q\"\nf 1 3 4\no a\nf 3 2 1\n");
    put("obj", "all",
        "\xEF\xBB\xBFmtllib a.mtl\r\no a\nv 0 0 0 1 0 0\nv 1e0 -0 +0\rv 1 1 \\\n 0\nv 0 nan 0\nvt 0 .5\nvn 0 "
        "0 1\n"
        "usemtl m\nf 1/1/1 2/1/1 3/1/1\nf -4//-1 2//1 3//1\nv 0 1 0\nf 1 2 3 5\nl 1 2\ns off\ng x\n");
    put("obj", "concave", "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 1 1 0\nv 0 2 0\nf 1 2 3 4 5\nf -1 -2 -3\n");
    const std::string header =
        " 1.0\ncomment x\nobj_info y\nelement vertex 3\nproperty float x\nproperty float y\n"
        "property float z\nproperty list uchar ushort l\nproperty uchar red\nproperty uchar "
        "green\nproperty uchar blue\nelement face 1\nproperty list uchar int vertex_indices\n";
    put("ply", "ascii",
        "ply\nformat ascii" + header +
            "end_header\n0 0 0 0 1 2 3\n1.5 0 0 1 7 1 2 3\n1 1e1 nan 2 1 2 1 2 3\n3 0 1 2\n");
    std::string binary = "ply\nformat binary_little_endian" + header +
                         "element tristrips 1\nproperty list int int vertex_indices\nend_header\n";
    for (int v = 0; v < 3; ++v)
        binary += std::string(12, static_cast<char>(v)) + std::string("\1\5\0\xFF\x80\0", 6);
    binary +=
        std::string("\3\0\0\0\0\1\0\0\0\2\0\0\0", 13) + std::string("\3\0\0\0\0\0\0\0\1\0\0\0\2\0\0\0", 16);
    put("ply", "binary", binary);
    put("ply", "big-endian",
        "ply\nformat binary_big_endian" + header + "end_header\n" + std::string(70, '\1'));
    put("ply", "textured",
        "ply\nformat ascii 1.0\ncomment TextureFile a.png\nelement vertex 3\nproperty float x\nproperty "
        "float y\n"
        "property float z\nproperty float red\nproperty float green\nproperty float blue\nelement face 1\n"
        "property list uchar int vertex_indices\nproperty list uchar float texcoord\nproperty int texnumber\n"
        "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n"
        "0 0 0 0 0 255\n1 0 0 1 1 1\n1 1 0 1 1 1\n3 0 1 2 6 0 0 1 0 1 1 0 1 2 3\n");
    put("ply", "two-textures",
        "ply\nformat ascii 1.0\ncomment TextureFile a.png\ncomment TextureFile \"b c.jpg\"\nelement vertex "
        "4\n"
        "property float x\nproperty float y\nproperty float z\nproperty float s\nproperty float t\n"
        "element face 2\nproperty list uchar int vertex_indices\nproperty int texnumber\n"
        "property list uchar float texcoord\nend_header\n0 0 0 0 0\n1 0 0 1 0\n1 1 0 1 1\n0 1 0 0 1\n"
        "3 0 1 2 1 6 0 0 1 0 1 1\n4 0 1 2 3 -1 0\n");
    std::string facets(80, ' ');
    facets.replace(0, 10, "COLOR=\x10\x20\x30\xFF");
    facets += std::string("\2\0\0\0", 4);
    for (const std::string& bits : {std::string("\x1F\x80", 2), std::string("\xE0\3", 2)})
        facets += std::string("\0\0\0\0\0\0\0\0\0\0\x80\x3F\0\0\0\0\0\0\0\0\0\0\0\0", 24) +
                  std::string("\0\0\x80\x3F\0\0\0\0\0\0\0\0\0\0\x80\x3F\0\0\x80\x3F\0\0\0\0", 24) + bits;
    put("stl", "magics", facets);
    put("stl", "viscam", std::string(80, '\0') + facets.substr(80) + "rest");
    put("stl", "solids",
        "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nendloop\n"
        "endfacet\nendsolid\nsolid b c\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 1 0\n"
        "vertex 0 1 0\nendloop\nendfacet\nendsolid\nrest\n");
    put("stl", "ascii",
        "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nendloop\n"
        "endfacet\nendsolid a\n");
    put("off", "all",
        "STCNOFF # c\n3 1 3\n0 0 0 0 0 1 255 0 0 0.5 0\n1 0 0 0 0 1 0.5 0 0 1 1 0\n"
        "1 1 0 0 0 1 0 0 0 1 1\n3 0 1 2 1 1 1\n");
    put("off", "plain", "OFF 4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 nan\n4 0 1 2 3\n");
}

void history_seeds() {
    std::uint32_t number = 0;
    for (const TriangleMesh& mesh : {test::grid(3), test::icosphere(1), test::soup(1, 12, 30)})
        for (const Preset preset : {Preset::paper, Preset::best}) {
            Options options{.target = ratio(0.3), .preset = preset, .history = Recording::on};
            std::ostringstream out;
            write(simplify(mesh.view(), options).history, out);
            put("history", std::to_string(number++), out.view());
        }
}

void image_seeds() {
    Pixels pixels = test::ramp(8);
    const auto write = [](const char* name, const Image& image) {
        put("image", name, {reinterpret_cast<const char*>(image.encoded.data()), image.encoded.size()});
    };
    write("opaque.png", encode_png(pixels, ""));
    pixels.has_alpha = true;
    write("alpha.png", encode_png(pixels, ""));
    write("color.jpg", encode_jpeg(pixels, "", 50, Content::color));
    write("data.jpg", encode_jpeg(pixels, "", 95, Content::data));
    write("lossy.webp", encode_webp(pixels, "", {WebpMode::lossy, 50, 4}));
    write("lossless.webp", encode_webp(pixels, "", {WebpMode::lossless, 0, 4}));
    // The headers of other kinds, which the plugin decodes.
    put("image", "header.bmp",
        std::string("BM\x46\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0\2\0\0\0\2\0\0\0\1\0\x18\0", 30) +
            std::string(40, '\0'));
    put("image", "header.gif", std::string("GIF89a\2\0\2\0\x80\0\0", 13) + std::string(20, '\0'));
    put("image", "header.tif",
        std::string("II\x2A\0\x08\0\0\0\2\0\0\1\3\0\1\0\0\0\2\0\0\0\1\1\3\0\1\0\0\0\2\0\0\0\0\0\0\0", 38));
    put("image", "header.tga",
        std::string("\0\0\2\0\0\0\0\0\0\0\0\0\2\0\2\0\x18\0", 18) + std::string(12, '\x40'));
    put("image", "small.webp",
        {reinterpret_cast<const char*>(testing::small_webp.data()), testing::small_webp.size()});
}

/// Random inputs for the targets that accept any bytes; the first byte selects the preset.
void drawn_seeds() {
    std::mt19937 random(1);
    for (const std::string target : {"simplify", "rounds", "bake"})
        for (char number = 0; number < 24; ++number) {
            std::string bytes(1, number);
            while (bytes.size() < 400) bytes.push_back(static_cast<char>(random() % 224));
            put(target, std::to_string(number), bytes);
        }
}

}  // namespace

int main(int count, char** arguments) try {
    if (count != 2) throw std::runtime_error("usage: fuzz_seeds FOLDER");
    root = arguments[1];
    gltf_seeds();
    text_seeds();
    history_seeds();
    image_seeds();
    drawn_seeds();
    return 0;
} catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 1;
}
