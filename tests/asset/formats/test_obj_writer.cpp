#include <algorithm>
#include <cmath>
#include <random>
#include <sstream>

#include "asset/formats/formats.hpp"
#include "asset/image/srgb.hpp"
#include "support/catch.hpp"
#include "support/format_support.hpp"

using namespace faqem;
using namespace faqem::detail;
using namespace faqem::testing;

namespace {

Image image(const std::string& type, const std::string& bytes) {
    Image result;
    result.mime_type = type;
    result.encoded.assign(bytes.begin(), bytes.end());
    return result;
}

/// Two triangles with two materials that share an edge, with a UV seam along it.
Asset textured() {
    Asset asset =
        one_part({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {3, 4, 5}});
    Part& part = asset.parts[0];
    part.name = "leaf";
    part.face_material = {1, 0};
    part.normals.assign(6, {0, 0, 1});
    part.uvs = {{{0, 0.25f}, {0.5f, 1}, {0.125f, 0}, {0.75f, 0}, {1, 1}, {0, 0.5f}}};
    asset.images = {image("image/png", png_signature), image("image/jpeg", jpeg_signature)};
    asset.materials.resize(2);
    asset.materials[0].name = "same name";
    asset.materials[0].base_color = {0.5f, 0.25f, 0.125f, 0.5f};
    asset.materials[0].base_color_texture.image = 0;
    asset.materials[0].alpha_mode = AlphaMode::blend;
    asset.materials[0].roughness = 0.3f;
    asset.materials[0].metallic = 0.1f;
    asset.materials[1].name = "same name";
    asset.materials[1].base_color_texture.image = 1;
    asset.materials[1].base_color_texture.wrap_u = asset.materials[1].base_color_texture.wrap_v = Wrap::clamp;
    asset.materials[1].emissive = {0.5f, 1, 0};
    asset.materials[1].emissive_texture.image = 0;
    asset.materials[1].normal_texture.image = 0;
    return asset;
}

std::size_t count_lines(const std::string& text, const std::string& start) {
    std::istringstream in(text);
    std::size_t count = 0;
    for (std::string line; std::getline(in, line);) count += line.rfind(start, 0) == 0;
    return count;
}

}  // namespace

TEST_CASE("an OBJ file is written with its material library and images", "[obj_writer]") {
    const TemporaryFolder folder;
    CHECK(save(textured(), folder / "my model.obj", Overwrite::no).empty());
    const std::string obj = get(folder / "my model.obj");
    CHECK(contains(obj, "mtllib my model.mtl\no leaf\n"));
    CHECK(count_lines(obj, "v ") == 4);  // positions are shared across the seam
    CHECK(count_lines(obj, "vt ") == 6);
    CHECK(count_lines(obj, "vn ") == 1);
    CHECK(contains(obj, "vt 0 0.75\n"));  // v points up
    CHECK(contains(obj, "usemtl same name\nf 1/1/1 2/2/1 3/3/1\nusemtl same name_2\nf 1/4/1 3/5/1 4/6/1\n"));
    CHECK(get(folder / "my model_0.jpg") == jpeg_signature);
    CHECK(get(folder / "my model_1.png") == png_signature);
    const std::string mtl = get(folder / "my model.mtl");
    CHECK(contains(mtl, "map_Kd -clamp on my model_0.jpg\nmap_Ke my model_1.png\nnorm my model_1.png\n"));
    CHECK(contains(mtl, "d 0.5\nPr 0.3\nPm 0.1\nmap_Kd my model_1.png\nmap_d my model_1.png\n"));
    CHECK(contains(mtl, "Kd 0.735357 0.537099 0.388573\n"));  // the sRGB of 1/2, 1/4, 1/8
}

TEST_CASE("a textured OBJ file is unchanged by reading and writing", "[obj_writer]") {
    const TemporaryFolder first, second;
    const Asset asset = textured();
    save(asset, first / "a.obj", Overwrite::no);
    const Asset back = load(first / "a.obj");
    CHECK(back.warnings.empty());
    const Part &part = back.parts.at(0), &original = asset.parts[0];
    CHECK(part.name == "leaf");
    REQUIRE(part.triangles.size() == 2);
    for (std::size_t f = 0; f < 2; ++f)
        for (std::size_t c = 0; c < 3; ++c) {
            const Index v = part.triangles[f][c], w = original.triangles[f][c];
            CHECK(part.positions[v] == original.positions[w]);
            CHECK(part.uvs[0][v] == original.uvs[0][w]);
            CHECK(part.normals[v] == original.normals[w]);
        }
    CHECK(part.face_material == std::vector<Index>{0, 1});
    const Material &m = back.materials.at(1), &expected = asset.materials[0];
    for (std::size_t k = 0; k < 4; ++k)
        CHECK(m.base_color[k] == Approx(expected.base_color[k]).epsilon(1e-5));
    CHECK(m.roughness == expected.roughness);
    CHECK(m.metallic == expected.metallic);
    CHECK(m.alpha_mode == AlphaMode::blend);
    CHECK(back.images.at(m.base_color_texture.image).encoded == asset.images[0].encoded);
    CHECK(back.materials[0].base_color_texture.wrap_u == Wrap::clamp);
    CHECK(back.materials[0].emissive_texture.image == m.base_color_texture.image);
    CHECK(back.materials[0].normal_texture.image == m.base_color_texture.image);
    save(back, second / "a.obj", Overwrite::no);
    for (const char* name : {"a.obj", "a.mtl", "a_0.jpg", "a_1.png"})
        CHECK(get(first / name) == get(second / name));
}

TEST_CASE("roughness, metal and the scale of normals are unchanged by writing and reading", "[obj_writer]") {
    const TemporaryFolder folder;
    Asset asset = textured();
    Material& m = asset.materials[0];
    m.roughness = m.metallic = 1;
    m.metallic_roughness_texture.image = 0;
    m.normal_texture.image = 1;
    m.normal_scale = 0.25f;
    CHECK(save(asset, folder / "a.obj", Overwrite::no).empty());
    const Asset back = load(folder / "a.obj");
    CHECK(back.warnings.empty());
    const Material& read = back.materials.at(1);
    CHECK(back.images.at(read.metallic_roughness_texture.image).encoded == asset.images[0].encoded);
    CHECK(read.roughness == 1);
    CHECK(read.metallic == 1);
    CHECK(read.normal_scale == 0.25f);
}

TEST_CASE("OBJ files of random meshes are unchanged by reading and writing", "[obj_writer]") {
    const TemporaryFolder folder;
    std::mt19937 random(11);
    const auto number = [&] {
        const double mantissa = random() / 4294967296.0 - 0.5;
        return static_cast<float>(std::ldexp(mantissa, static_cast<int>(random() % 60) - 30));
    };
    for (int round = 0; round < 20; ++round) {
        std::vector<Vec3> positions;
        std::vector<Triangle> triangles;
        for (int i = 0; i < 60; ++i) positions.push_back({number(), number(), number()});
        for (int i = 0; i < 80; ++i)
            triangles.push_back({Index(random() % 50), Index(random() % 50), Index(random() % 50)});
        Asset asset = one_part(positions, triangles);
        Part& part = asset.parts[0];
        part.uvs.resize(1);
        asset.materials.resize(3);
        for (int i = 0; i < 60; ++i) {
            part.normals.push_back(i % 7 ? Vec3f{number(), number(), number()} : Vec3f{0, 0, 0});
            part.uvs[0].push_back({number(), number()});
            part.colors.push_back({std::min(std::abs(number()), 4.0f), 0.3f, random() / 4294967296.0f, 1});
        }
        for (Index& m : part.face_material) m = random() % 4 ? random() % 3 : no_index;
        if (round % 2) part.positions[3] = {0.1, 1e-17, 12345.678901234};
        save(asset, folder / "a.obj", Overwrite::yes);
        const std::string once = get(folder / "a.obj"), library = get(folder / "a.mtl");
        save(load(folder / "a.obj"), folder / "a.obj", Overwrite::yes);
        CHECK(get(folder / "a.obj") == once);
        CHECK(get(folder / "a.mtl") == library);
    }
}

TEST_CASE("OBJ positions have float precision if all are floats, else double precision", "[obj_writer]") {
    const TemporaryFolder folder;
    save(one_part({{0.1f, 0, 0}, {1, 0, 0}, {1, 1e10f, 0}}, {{0, 1, 2}}), folder / "a.obj", Overwrite::yes);
    CHECK(contains(get(folder / "a.obj"), "v 0.1 0 0\n"));
    const Asset precise = one_part({{0.1f, 0, 0}, {1. / 3, 0, 0}, {1, 1e-300, 0}}, {{0, 1, 2}});
    save(precise, folder / "a.obj", Overwrite::yes);
    CHECK(contains(get(folder / "a.obj"), "v 0.10000000149011612 0 0\nv 0.3333333333333333 0 0\n"));
    CHECK(load(folder / "a.obj").parts[0].positions == precise.parts[0].positions);
}

TEST_CASE("a mesh without materials has no library, a face without a material gets a default one",
          "[obj_writer]") {
    const TemporaryFolder folder;
    Asset asset = one_part({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, {{0, 1, 2}, {2, 1, 0}});
    save(asset, folder / "a.obj", Overwrite::no);
    CHECK(get(folder / "a.obj") == "o a\nv 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\nf 3 2 1\n");
    CHECK(!fs::exists(folder / "a.mtl"));
    asset.materials.resize(1);
    asset.materials[0].name = "default";
    asset.parts[0].face_material = {0, no_index};
    save(asset, folder / "b.obj", Overwrite::no);
    CHECK(contains(get(folder / "b.obj"), "usemtl default\nf 1 2 3\nusemtl default_2\nf 3 2 1\n"));
}

TEST_CASE("an OBJ file has an object for each mesh with a unique name", "[obj_writer]") {
    const TemporaryFolder folder;
    Asset asset = one_part({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, {{0, 1, 2}});
    asset.parts[0].name = "a";
    asset.parts.push_back(asset.parts[0]);
    asset.parts.push_back({});  // without faces
    asset.parts.push_back(asset.parts[0]);
    asset.parts[3].name = "a_2";
    const std::vector<std::string> losses = save(asset, folder / "m.obj", Overwrite::no);
    CHECK(any_contains(losses, "1 object without faces"));
    CHECK(get(folder / "m.obj") ==
          "v 0 0 0\nv 1 0 0\nv 1 1 0\no a\nf 1 2 3\no a_2\nf 1 2 3\no a_2_2\nf 1 2 3\n");
    CHECK(load(folder / "m.obj").parts.at(0).object_names == std::vector<std::string>{"a", "a_2", "a_2_2"});
}

TEST_CASE("an OBJ file with groups in objects is unchanged by reading and writing", "[obj_writer]") {
    const TemporaryFolder folder;
    const std::string text =
        "v 0 0 0\nv 1 0 0\nv 1 1 0\no a\nf 1 2 3\ng x y\nf 1 2 3\nf 2 3 1\ng default\nf 1 2 3\no b\ng z\nf 1 "
        "2 3\n";
    put(folder / "a.obj", text);
    save(load(folder / "a.obj"), folder / "b.obj", Overwrite::no);
    CHECK(get(folder / "b.obj") == text);
    Asset asset = one_part({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, {{0, 1, 2}, {1, 2, 0}});
    asset.parts[0].face_group = {1, 0};
    asset.parts[0].group_names = {"", "x\nf 1 2 3"};
    asset.parts.push_back(asset.parts[0]);
    save(asset, folder / "c.obj", Overwrite::no);
    CHECK(get(folder / "c.obj") ==
          "v 0 0 0\nv 1 0 0\nv 1 1 0\no c\ng x_f 1 2 3\nf 1 2 3\ng default\nf 2 3 1\no c_2\ng x_f 1 2 3\nf 1 "
          "2 3\n"
          "g default\nf 2 3 1\n");
}

TEST_CASE("names that are invalid in OBJ statements are replaced", "[obj_writer]") {
    const TemporaryFolder folder;
    Asset asset = textured();
    asset.parts[0].name = " a\nf 1 2 3\\ ";
    asset.materials[1].name = "x\r\nKd 0 0 0";
    save(asset, folder / "a.obj", Overwrite::no);
    CHECK(contains(get(folder / "a.obj"), "o a_f 1 2 3\n"));
    CHECK(load(folder / "a.obj").materials.at(0).name == "x__Kd 0 0 0");
}

TEST_CASE("the UV set and transform of the leading texture are applied to the UVs", "[obj_writer]") {
    const TemporaryFolder folder;
    Asset asset = textured();
    Part& part = asset.parts[0];
    part.uvs.push_back(std::vector<Vec2f>(6, {0.5f, 0.25f}));
    TextureRef& ref = asset.materials[1].base_color_texture;
    ref.uv_set = 1;
    ref.scale = {2, 4};
    ref.offset = {0.25f, 0.5f};
    ref.rotation = static_cast<float>(std::acos(-1.0) / 2);
    const auto losses = save(asset, folder / "a.obj", Overwrite::no);
    const Asset back = load(folder / "a.obj");
    // Scaling gives (1, 1). Rotation by 90 degrees, with v pointing down, maps (u, v) to (v, -u). Translation
    // gives (1.25, -0.5).
    const Vec2f uv = back.parts[0].uvs.at(0)[back.parts[0].triangles[0][0]];
    CHECK(uv[0] == Approx(1.25));
    CHECK(uv[1] == Approx(-0.5));
    CHECK(any_contains(losses, "different UVs for the textures of a material (1 material)"));
}

TEST_CASE("the OBJ writer reports what it leaves out", "[obj_writer]") {
    const TemporaryFolder folder;
    Asset asset = textured();
    Material& m = asset.materials[0];
    m.metallic_roughness_texture.image = m.occlusion_texture.image = 0;
    m.normal_texture.image = 0;
    m.normal_scale = 0.5f;
    m.alpha_mode = AlphaMode::mask;
    m.unlit = m.double_sided = true;
    m.extensions = {"KHR_materials_sheen"};
    m.base_color_texture.wrap_u = Wrap::mirror;
    asset.parts[0].colors.assign(6, {1, 1, 1, 0.5f});
    const auto losses = save(asset, folder / "a.obj", Overwrite::no);
    for (const char* what : {"factors of metallic-roughness", "occlusion", "cutoffs", "unlit", "double-sided",
                             "extensions", "mirrored", "alpha of vertex colours"}) {
        CAPTURE(what);
        CHECK(any_contains(losses, what));
    }
}
