#include "asset/formats/obj_tiles.hpp"

#include "asset/formats/formats.hpp"
#include "support/catch.hpp"
#include "support/format_support.hpp"

using namespace faqem;
using namespace faqem::detail;
using namespace faqem::testing;

namespace {

const std::string corner_lines = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

// A folder with a material library and images of one pixel. `tile` makes a face in a unit square of the UV plane.
struct TiledModel {
    TemporaryFolder folder;
    std::string faces;

    explicit TiledModel(const std::string& mtl, const std::vector<std::string>& images) {
        put(folder / "a.mtl", "newmtl skin\nKd 1 1 1\n" + mtl);
        for (const std::string& image : images) save_image(image);
    }
    void save_image(const std::string& name) const {
        const auto encoded = encode_png({1, 1, {10, 20, 30, 255}, false}, "").encoded;
        put(folder / name, std::string(encoded.begin(), encoded.end()));
    }
    void tile(int u, int v) {
        for (const auto& [s, t] : {std::pair{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}})
            faces += "vt " + std::to_string(u + s) + " " + std::to_string(v + t) + "\n";
        faces += "f -3/-3 -2/-2 -1/-1\n";
    }
    Asset read() const {
        put(folder / "a.obj", "mtllib a.mtl\n" + corner_lines + "usemtl skin\n" + faces);
        return load(folder / "a.obj");
    }
};

// The UVs of a corner, v pointing up, by the texture's placement.
Vec2f shown(const Asset& asset, std::size_t face, std::size_t corner, const TextureRef& texture) {
    const Part& part = asset.parts[0];
    const Vec2f uv = part.uvs[0].at(part.triangles.at(face)[corner]);
    return {uv[0] * texture.scale[0] + texture.offset[0], 1 - (uv[1] * texture.scale[1] + texture.offset[1])};
}

const Material& material_of(const Asset& asset, std::size_t face) {
    return asset.materials.at(asset.parts[0].face_material.at(face));
}

}  // namespace

TEST_CASE("each UDIM tile has a material with its image, and UVs from 0 to 1", "[obj]") {
    TiledModel model("map_Kd -o 0 0 skin.<UDIM>.png\n", {"skin.1001.png", "skin.1002.png", "skin.1100.png"});
    model.tile(0, 0);
    model.tile(1, 0);
    model.tile(9, 9);
    model.tile(1, 0);
    const Asset asset = model.read();
    CHECK(asset.warnings.empty());
    REQUIRE(asset.materials.size() == 3);
    const std::vector<std::string> numbers = {"1001", "1002", "1100", "1002"};
    for (std::size_t f = 0; f < 4; ++f) {
        const Material& material = material_of(asset, f);
        CHECK(material.name == "skin." + numbers[f]);
        CHECK(asset.images.at(material.base_color_texture.image).uri == "skin." + numbers[f] + ".png");
        CHECK(material.base_color_texture.wrap_u == Wrap::clamp);
        CHECK(material.base_color_texture.offset == Vec2f{0, 0});
        CHECK(shown(asset, f, 0, {}) == Vec2f{0, 0});
        CHECK(shown(asset, f, 1, {}) == Vec2f{1, 0});
        CHECK(shown(asset, f, 2, {}) == Vec2f{0, 1});
    }
    std::uint64_t bytes = 0;
    for (const char* name : {"a.obj", "a.mtl", "skin.1001.png", "skin.1002.png", "skin.1100.png"})
        bytes += std::filesystem::file_size(model.folder / name);
    CHECK(asset.file_bytes == bytes);
}

TEST_CASE("the marks of tiles have several spellings", "[obj]") {
    CHECK(tile_file_name("a.<udim>.png", 1012) == "a.1012.png");
    CHECK(tile_file_name("<UDIM>/a.<Udim>.png", 1100) == "1100/a.1100.png");
    CHECK(tile_file_name("a.%(UDIM)d.png", 1001) == "a.1001.png");
    CHECK(tile_file_name("a.<UVTILE>.png", 1001) == "a.u1_v1.png");
    CHECK(tile_file_name("a.<uvtile>.png", 1020) == "a.u10_v2.png");
    CHECK(tile_file_name("a.1001.png", 1002) == "a.1001.png");
}

TEST_CASE("other textures of a material with tiles show the same, and their placements hold", "[obj]") {
    // The face is in column 1 of the tiles, at u from 0.5 to 1 of the file. The tileable texture repeats 3 times.
    TiledModel model("map_Kd -s 2 2 1 skin.<UDIM>.png\nmap_Ke -s 3 3 1 -o 0.25 0 glow.png\n",
                     {"skin.1002.png", "glow.png"});
    model.faces = "vt 0.5 0\nvt 1 0\nvt 0.5 0.5\nf 1/1 2/2 3/3\n";
    const Asset asset = model.read();
    CHECK(asset.warnings.empty());
    const Material& material = material_of(asset, 0);
    CHECK(material.name == "skin.1002");
    CHECK(shown(asset, 0, 0, material.base_color_texture)[0] == Approx(0).margin(1e-6));
    CHECK(shown(asset, 0, 1, material.base_color_texture)[0] == Approx(1));
    CHECK(shown(asset, 0, 2, material.base_color_texture)[1] == Approx(1));
    const float glow = shown(asset, 0, 0, material.emissive_texture)[0] - (3 * 0.5f + 0.25f);
    CHECK(glow == Approx(std::round(glow)).margin(1e-6));  // a whole number of repetitions
}
