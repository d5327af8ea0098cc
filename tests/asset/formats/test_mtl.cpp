#include "asset/formats/mtl.hpp"

#include "asset/formats/formats.hpp"
#include "asset/image/srgb.hpp"
#include "support/catch.hpp"
#include "support/format_support.hpp"

using namespace faqem;
using namespace faqem::detail;
using namespace faqem::testing;

namespace {

const std::string textured_triangle = "v 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nf 1/1 2/1 3/1\n";

/// Reads a library with exactly one material.
MtlMaterial one(const std::string& text, std::vector<std::string>* warnings = nullptr) {
    std::vector<std::string> own;
    IgnoredStatements ignored;
    const auto materials = read_mtl(bytes_of(text), "a.mtl", warnings ? *warnings : own, ignored);
    REQUIRE(materials.size() == 1);
    return materials[0];
}

float linear(double display) { return static_cast<float>(linear_from_srgb(display)); }

}  // namespace

TEST_CASE("Kd is read as sRGB and the default metallic factor is 0", "[mtl]") {
    const Material m = one("newmtl a b\nKd 0.5 0.25 1\nKa 1 1 1\nKs 0 0 0\nNi 1.45\nillum 2\n").values;
    CHECK(m.name == "a b");
    CHECK(m.base_color == Vec4f{linear(0.5), linear(0.25), 1, 1});
    CHECK(m.metallic == 0);
    CHECK(m.roughness == 1);
    CHECK(m.alpha_mode == AlphaMode::opaque);
    CHECK(one("newmtl a\n").values.base_color == Vec4f{1, 1, 1, 1});
    CHECK(one("newmtl a\nKd 0.5\n").values.base_color == Vec4f{linear(0.5), linear(0.5), linear(0.5), 1});
}

TEST_CASE("d takes precedence over Tr", "[mtl]") {
    CHECK(one("newmtl a\nd 1\nTr 1\n").values.base_color[3] == 1);
    CHECK(one("newmtl a\nd -halo 0.25\nTr 0.25\n").values.base_color[3] == 0.25f);
    CHECK(one("newmtl a\nTr 0.999\n").values.alpha_mode == AlphaMode::blend);
}

TEST_CASE("texture statements may have options, and file names with blanks or like numbers", "[mtl]") {
    const auto texture = [](const std::string& statement) {
        return one("newmtl a\nmap_Kd " + statement + "\n").color;
    };
    CHECK(texture("my wood.png ").file == "my wood.png");
    const MtlTexture all = texture(
        "-blendu on -blendv off -cc on -clamp on -mm 0 1 -texres 512 -bm 0.5 -imfchan l -boost 2 -type "
        "sphere a b.png");
    CHECK(all.file == "a b.png");
    CHECK(all.wrap == Wrap::clamp);
    const MtlTexture moved = texture("-s 2 3 1 -o 0.1 0.2 -t 1 1 1 a.png");
    CHECK(moved.file == "a.png");
    CHECK(moved.scale == Vec2f{2, 3});
    CHECK(moved.offset == Vec2f{0.1f, 0.2f});
    const MtlTexture one_number = texture("-s 2 2048");
    CHECK(one_number.scale == Vec2f{2, 1});
    CHECK(one_number.file == "2048");
    CHECK(texture("-o 1 2 3 4.png").file == "4.png");
    CHECK(texture("-clamp off a.png").wrap == Wrap::repeat);
    CHECK(texture("-unknown.png").file == "-unknown.png");
    CHECK(texture("").file.empty());
    CHECK(texture("-s").file == "-s");
}

TEST_CASE("options may follow the file name of a texture, and keywords may have any letter case", "[mtl]") {
    const auto texture = [](const std::string& statement) {
        return one("NEWMTL a\nmap_kd " + statement + "\n").color;
    };
    const MtlTexture trailing = texture("my wood.png -clamp on  -s 2 3 1 -bm 0.5");
    CHECK(trailing.file == "my wood.png");
    CHECK(trailing.wrap == Wrap::clamp);
    CHECK(trailing.scale == Vec2f{2, 3});
    CHECK(trailing.multiplier == 0.5f);
    CHECK(texture("a -s 1.png").file == "a -s 1.png");
    CHECK(texture("a -clamp it.png").file == "a -clamp it.png");
    CHECK(texture("a -mine.png -o 1").file == "a -mine.png");
    CHECK(texture("-imfchan g a.png").channel == ScalarChannel::green);
    CHECK(texture("a.png -imfchan m").channel == ScalarChannel::alpha);
    CHECK(texture("-imfchan l a.png").channel == ScalarChannel::luminance);
    CHECK(texture("a.png").channel == ScalarChannel::automatic);
    CHECK(one("newmtl a\nKD 0 0 1\npr 0.5\n").values.roughness == 0.5f);
}

TEST_CASE("a map_Ka is not used by the next material", "[mtl]") {
    std::vector<std::string> warnings;
    IgnoredStatements ignored;
    const auto two = read_mtl(bytes_of("newmtl a\nmap_Ka k.png\nnewmtl b\n"), "a.mtl", warnings, ignored);
    CHECK(two[0].color.file == "k.png");
    CHECK(two[1].color.file.empty());
}

TEST_CASE("statements and options of MTL without an equivalent are counted", "[mtl]") {
    std::vector<std::string> warnings;
    IgnoredStatements ignored;
    read_mtl(bytes_of("newmtl a\nKs 1 1 1\nNi 1\nmap_Kd -mm 0 1 -s 2 2 -blendu on a.png\n"
                      "newmtl b\nKs 1 1 1\nmap_Kd a -cc b.png -boost 2\nmap_Ke c -boost 1.png\n"),
             "a.mtl", warnings, ignored);
    CHECK(warnings.empty());
    CHECK(ignored_messages(ignored) ==
          std::vector<std::string>{"'Ks': 2 statements", "'Ni': 1 statement", "option '-blendu': 1 statement",
                                   "option '-boost': 1 statement", "option '-mm': 1 statement"});
}

TEST_CASE("invalid numbers are errors, and colours that are none are repaired", "[mtl]") {
    std::vector<std::string> warnings;
    CHECK(contains(message_of([] { one("newmtl a\nKd 1,0 0 0\n"); }), "a.mtl: line 2: '1,0'"));
    CHECK(one("newmtl a\nKd 2 -1 nan\n", &warnings).values.base_color == Vec4f{1, 0, 1, 1});
    CHECK(any_contains(warnings, "line 2"));
    // A material named xyz does not change the colour space of Kd.
    CHECK(one("newmtl xyz\nKd 1 0 0\n").values.base_color == Vec4f{1, 0, 0, 1});
}

TEST_CASE("used materials and images are loaded once in the order of use", "[mtl]") {
    const TemporaryFolder folder;
    fs::create_directories(folder / "tex");
    put(folder / "tex/wood.png", png_signature);
    put(folder / "tex/stone.dat", jpeg_signature);
    put(folder / "my lib.mtl",
        "newmtl unused\nmap_Kd tex/none.png\nnewmtl wood\nmap_Kd tex\\wood.png\nmap_d tex\\wood.png\n"
        "newmtl wood again\nmap_Kd ./tex/wood.png\n");
    put(folder / "other.mtl", "newmtl stone\nmap_Kd tex/stone.dat\nmap_d mask.png\n");
    put(folder / "a.obj",
        "mtllib my lib.mtl\nmtllib other.mtl\n" + textured_triangle +
            "usemtl stone\nf 1/1 2/1 3/1\nusemtl wood\nf 1/1 2/1 3/1\nusemtl wood again\nf 1/1 2/1 3/1\n");
    const Asset asset = load(folder / "a.obj");
    CHECK(asset.parts[0].face_material == std::vector<Index>{no_index, 0, 1, 2});
    REQUIRE(asset.materials.size() == 3);
    CHECK(asset.materials[0].name == "stone");
    CHECK(asset.materials[1].name == "wood");
    CHECK(asset.materials[1].alpha_mode == AlphaMode::blend);
    REQUIRE(asset.images.size() == 2);
    CHECK(asset.images[0].mime_type == "image/jpeg");
    CHECK(asset.images[0].uri == "tex/stone.dat");
    CHECK(asset.images[1].mime_type == "image/png");
    CHECK(std::string(asset.images[1].encoded.begin(), asset.images[1].encoded.end()) == png_signature);
    CHECK(asset.materials[2].base_color_texture.image == 1);
    CHECK(asset.warnings.size() == 1);
    CHECK(any_contains(asset.warnings, "mask.png"));
}

TEST_CASE("one mtllib statement may name several libraries", "[mtl]") {
    const TemporaryFolder folder;
    put(folder / "a.mtl", "newmtl a\nKd 1 0 0\n");
    put(folder / "b c.mtl", "newmtl b\nKd 0 1 0\n");
    put(folder / "a.obj", "mtllib a.mtl b c.mtl\nusemtl a\n" + textured_triangle + "usemtl b\nf 1 2 3\n");
    const Asset asset = load(folder / "a.obj");
    CHECK(asset.materials.at(0).base_color == Vec4f{1, 0, 0, 1});
    CHECK(asset.materials.at(1).base_color == Vec4f{0, 1, 0, 1});
    CHECK(asset.warnings.empty());
}

TEST_CASE("textures and libraries outside the folder are not read", "[mtl]") {
    const TemporaryFolder folder;
    fs::create_directories(folder / "in/lib");
    put(folder / "secret.png", png_signature);
    put(folder / "secret.mtl", "newmtl m\nKd 1 0 0\n");
    put(folder / "in/inside.png", png_signature);
    fs::create_symlink("../secret.png", folder / "in/link.png");
    const std::vector<std::string> names = {
        "../secret.png",  "..\\secret.png", (folder / "secret.png").string(),
        "C:\\secret.png", "link.png",       "lib/../../secret.png"};
    for (const std::string& name : names) {
        CAPTURE(name);
        put(folder / "in/a.mtl", "newmtl m\nmap_Kd " + name + "\n");
        put(folder / "in/a.obj", "mtllib a.mtl\nusemtl m\n" + textured_triangle);
        const Asset asset = load(folder / "in/a.obj");
        CHECK(asset.images.empty());
        CHECK(asset.warnings.size() == 1);
    }
    put(folder / "in/a.obj", "mtllib ../secret.mtl\nusemtl m\n" + textured_triangle);
    CHECK(load(folder / "in/a.obj").materials.at(0).base_color == Vec4f{1, 1, 1, 1});
    // A library in a subfolder may refer to files above it that are inside the folder of the model.
    put(folder / "in/lib/a.mtl", "newmtl m\nmap_Kd ../inside.png\n");
    put(folder / "in/a.obj", "mtllib lib/a.mtl\nusemtl m\n" + textured_triangle);
    const Asset asset = load(folder / "in/a.obj");
    REQUIRE(asset.images.size() == 1);
    CHECK(asset.images[0].uri == "inside.png");
    CHECK(asset.warnings.empty());
}

TEST_CASE("a material library without used materials gives a warning", "[mtl]") {
    const TemporaryFolder folder;
    put(folder / "a.mtl", "newmtl m\nKd 1 0 0\n");
    put(folder / "a.obj", "mtllib a.mtl\n" + textured_triangle);
    const Asset asset = load(folder / "a.obj");
    CHECK(asset.materials.empty());
    REQUIRE(asset.warnings.size() == 1);
    CHECK_THAT(asset.warnings[0], ContainsSubstring("no face uses a material"));
}
