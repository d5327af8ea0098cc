// Textures of MTL files that need the pixels of their images, and files that are named as on another computer.

#include "asset/formats/mtl.hpp"

#include <cmath>

#include "asset/formats/formats.hpp"
#include "asset/model_files.hpp"
#include "support/catch.hpp"
#include "support/format_support.hpp"
#include "support/scenes.hpp"

using namespace faqem;
using namespace faqem::detail;
using namespace faqem::testing;
using faqem::test::paint;
using faqem::test::Rgba;

namespace {

const std::string one_triangle = "v 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nusemtl m\nf 1/1 2/1 3/1\n";

void put_image(const fs::path& file, const Pixels& pixels) {
    const Image image = encode_png(pixels, "");
    put(file, std::string(image.encoded.begin(), image.encoded.end()));
}

Pixels uniform(const Rgba& color) {
    return paint(4, 4, [&](std::uint32_t, std::uint32_t) { return color; });
}

// An image of two halves.
Pixels halves(const Rgba& left, const Rgba& right) {
    return paint(4, 4, [&](std::uint32_t x, std::uint32_t) { return x < 2 ? left : right; });
}

/// A folder with images and a model whose only material has the given statements.
struct Model {
    TemporaryFolder folder;

    Model() {
        put_image(folder / "color.png", uniform({200, 100, 50, 255}));
        put_image(folder / "mask.png", halves({255, 255, 255, 255}, {0, 0, 0, 255}));
        put_image(folder / "black.png", uniform({0, 0, 0, 255}));
        put_image(folder / "orm.png", halves({1, 60, 200, 255}, {2, 70, 210, 255}));
        put(folder / "m.obj", "mtllib m.mtl\n" + one_triangle);
    }

    Asset read(const std::string& statements) const {
        put(folder / "m.mtl", "newmtl m\n" + statements);
        return load(folder / "m.obj");
    }
};

Rgba texel(const Asset& asset, const TextureRef& ref, std::size_t i) {
    const Pixels pixels = decode(asset.images.at(ref.image));
    return {pixels.rgba.at(4 * i), pixels.rgba.at(4 * i + 1), pixels.rgba.at(4 * i + 2),
            pixels.rgba.at(4 * i + 3)};
}

}  // namespace

TEST_CASE("a mask of its own becomes the alpha of the base colour", "[mtl]") {
    const Model model;
    const std::string option = GENERATE("", "-imfchan l ", "-imfchan g ");
    Asset asset = model.read("map_Kd color.png\nmap_d " + option + "mask.png\n");
    CHECK(asset.warnings.empty());
    const Material& m = asset.materials.at(0);
    CHECK(m.alpha_mode == AlphaMode::blend);
    REQUIRE(asset.images.size() == 1);
    CHECK(asset.images[0].uri.empty());
    CHECK(asset.images[0].name == "color");
    CHECK(texel(asset, m.base_color_texture, 0) == Rgba{200, 100, 50, 255});
    CHECK(texel(asset, m.base_color_texture, 3) == Rgba{200, 100, 50, 0});
    asset = model.read("d 0\nmap_d " + option + "mask.png\n");  // without a colour image
    CHECK(texel(asset, asset.materials[0].base_color_texture, 3) == Rgba{255, 255, 255, 0});
    CHECK(asset.materials[0].base_color[3] == 1);
}

TEST_CASE("a texture that is no image is left out with a warning", "[mtl]") {
    const Model model;
    put(model.folder / "page.png", "<html><body>Not found</body></html>");
    put(model.folder / "empty.png", "");
    put(model.folder / "one.png", "x");
    for (const std::string name : {"page.png", "empty.png", "one.png"}) {
        const Asset asset = model.read("map_Kd " + name + "\n");
        REQUIRE(asset.warnings.size() == 1);
        CHECK(contains(asset.warnings[0], "texture left out: " + name + ": is "));
        CHECK(!asset.materials.at(0).base_color_texture);
    }
}

TEST_CASE("bump with heights becomes a normal map, and a flat one or a damaged file has no effect", "[mtl]") {
    const Model model;
    const Asset asset = model.read("bump -bm 16 mask.png\n");
    const Material& m = asset.materials.at(0);
    REQUIRE(m.normal_texture);
    CHECK(m.normal_scale == 1);
    // White on the left, black on the right: the second texel falls to the right with a slope of 16/64 * 1/2 * 4.
    const Rgba n = texel(asset, m.normal_texture, 1);
    CHECK(n[0] / 127.5 - 1 == Approx(0.5 / std::sqrt(1.25)).margin(0.01));
    CHECK(n[2] / 127.5 - 1 == Approx(1 / std::sqrt(1.25)).margin(0.01));
    CHECK(!model.read("bump black.png\n").materials.at(0).normal_texture);
    put(model.folder / "damaged.png", png_signature);
    const Asset damaged = model.read("bump damaged.png\n");
    CHECK(!damaged.materials.at(0).normal_texture);
    CHECK(damaged.warnings.size() == 1);
}

TEST_CASE("roughness and metal images become one texture and replace the factors", "[mtl]") {
    const Model model;
    Asset asset = model.read("Pr 0.25\nPm 0\nmap_Pr black.png\nmap_Pm mask.png\n");
    CHECK(asset.warnings.empty());
    const Material& both = asset.materials.at(0);
    CHECK(both.roughness == 1);
    CHECK(both.metallic == 1);
    CHECK(texel(asset, both.metallic_roughness_texture, 0) == Rgba{255, 0, 255, 255});
    CHECK(texel(asset, both.metallic_roughness_texture, 3) == Rgba{255, 0, 0, 255});
    asset = model.read("map_Pr orm.png\nmap_Pm orm.png\n");
    CHECK(asset.images.at(0).uri == "orm.png");
    asset = model.read("map_Pr -imfchan b orm.png\nmap_Pm -imfchan r orm.png\n");
    CHECK(texel(asset, asset.materials.at(0).metallic_roughness_texture, 0) == Rgba{255, 200, 1, 255});
    CHECK(model.read("Pr 0.5\nmap_Pr none.png\n").materials.at(0).roughness == 0.5f);
}

TEST_CASE("images that several materials use are in the asset once", "[mtl]") {
    const Model model;
    const std::string same =
        "map_Kd color.png\nmap_d mask.png\nbump mask.png\nmap_Pr mask.png\nmap_Ke color.png\n";
    put(model.folder / "m.mtl", "newmtl m\n" + same + "newmtl n\n" + same);
    put(model.folder / "m.obj", "mtllib m.mtl\n" + one_triangle + "usemtl n\nf 1/1 2/1 3/1\n");
    const Asset asset = load(model.folder / "m.obj");
    CHECK(asset.images.size() == 4);
    const Material &a = asset.materials.at(0), &b = asset.materials.at(1);
    CHECK(a.base_color_texture == b.base_color_texture);
    CHECK(a.normal_texture == b.normal_texture);
    CHECK(a.metallic_roughness_texture == b.metallic_roughness_texture);
    CHECK(a.emissive_texture == b.emissive_texture);
}

TEST_CASE("textures and libraries named as on another computer are found with a warning", "[mtl]") {
    const Model model;
    for (const std::string name : {"C:\\job 7\\Color.PNG", "/home/x/color.png", "COLOR.png"}) {
        const Asset asset = model.read("map_Kd " + name + "\nmap_Ke " + name + "\n");
        REQUIRE(asset.images.size() == 1);
        REQUIRE(asset.warnings.size() == 1);
        CHECK(contains(asset.warnings[0], "was not found; the file 'color.png' is read"));
    }
    CHECK(model.read("map_Kd \"color.png\"\n").warnings.empty());
    put(model.folder / "m.obj", "mtllib D:\\x\\M.MTL\n" + one_triangle);
    const Asset asset = load(model.folder / "m.obj");
    CHECK(asset.images.size() == 1);
    CHECK(any_contains(asset.warnings, "the file 'm.mtl' is read"));
    const auto references = referenced_files(model.folder / "m.obj", References::readable);
    REQUIRE(references.size() == 2);
    CHECK(references[0].filename() == "m.mtl");
    CHECK(references[1].filename() == "color.png");
}

TEST_CASE("the only library of a folder is read in place of a missing one", "[mtl]") {
    const Model model;
    model.read("Kd 1 0 0\n");
    put(model.folder / "scan.obj", "mtllib lost.mtl\n" + one_triangle);
    fs::rename(model.folder / "m.obj", model.folder / "n.obj");
    const Asset asset = load(model.folder / "scan.obj");
    CHECK(asset.materials.at(0).base_color == Vec4f{1, 0, 0, 1});
    CHECK(any_contains(asset.warnings, "'lost.mtl' was not found; the file 'm.mtl' is read"));
    CHECK(referenced_files(model.folder / "scan.obj", References::readable).size() == 1);
    // Not if it belongs to another model, or is one of several.
    fs::rename(model.folder / "n.obj", model.folder / "m.obj");
    CHECK(any_contains(load(model.folder / "scan.obj").warnings, "material library ignored"));
    fs::remove(model.folder / "m.obj");
    put(model.folder / "other.mtl", "");
    CHECK(any_contains(load(model.folder / "scan.obj").warnings, "material library ignored"));
    CHECK(referenced_files(model.folder / "scan.obj", References::readable).empty());
}
