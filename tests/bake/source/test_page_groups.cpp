#include "bake/source/page_groups.hpp"

#include "support/catch.hpp"
#include "support/scenes.hpp"

using namespace faqem;
using namespace faqem::test;
using faqem::detail::MaterialGroups;
using faqem::detail::page_groups;

namespace {

constexpr std::uint32_t image_side = 64;

// Squares with a material and an image of `image_side` each.
Asset tiled_scan(std::size_t tiles) {
    Asset asset;
    Part part;
    for (std::size_t k = 0; k < tiles; ++k) {
        const Part one = square();
        for (const Vec3& p : one.positions)
            part.positions.push_back({p[0] + static_cast<double>(k), p[1], p[2]});
        for (const Triangle& t : one.triangles) {
            const auto first = static_cast<Index>(4 * k);
            part.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
            part.face_material.push_back(static_cast<Index>(k));
        }
        part.uvs.resize(1);
        for (const Vec2f& uv : {Vec2f{0, 1}, Vec2f{1, 1}, Vec2f{1, 0}, Vec2f{0, 0}})
            part.uvs[0].push_back(uv);
        Material material;
        material.name = "tile " + std::to_string(k);
        material.base_color_texture.image = add_texture(asset, ramp(image_side));
        asset.materials.push_back(material);
    }
    asset.parts = {part};
    return asset;
}

// Numbers of materials of all groups.
std::vector<std::size_t> sizes(const MaterialGroups& groups) {
    std::vector<std::size_t> result;
    for (const auto& group : groups.groups) result.push_back(group.materials.size());
    return result;
}

BakeOptions pages_of(std::uint32_t side) {
    BakeOptions bake;
    bake.texture_size = side;
    return bake;
}

}  // namespace

TEST_CASE("textures that fit on a page share it") {
    CHECK(sizes(page_groups(tiled_scan(4), pages_of(2 * image_side))) == std::vector<std::size_t>{4});
}

TEST_CASE("textures with four times the texels of a page are on four pages of consecutive materials") {
    const MaterialGroups groups = page_groups(tiled_scan(16), pages_of(2 * image_side));
    REQUIRE(sizes(groups) == std::vector<std::size_t>{4, 4, 4, 4});
    for (Index m = 0; m < 16; ++m) CHECK(groups.group_of(m) == m / 4);
    CHECK(groups.group_of(no_index) == no_index);
    for (std::size_t g = 0; g < 4; ++g)
        CHECK(groups.groups[g].material.name == "tile " + std::to_string(4 * g));
}

TEST_CASE("a requested texel density counts in the number of pages") {
    BakeOptions bake = pages_of(2 * image_side);
    bake.texel_density = 0.5;
    CHECK(sizes(page_groups(tiled_scan(16), bake)).size() == 1);
}

TEST_CASE("an image is never on two pages, and one that is repeated counts once") {
    Asset asset = tiled_scan(16);
    for (Material& material : asset.materials) material.base_color_texture.image = 0;
    CHECK(page_groups(asset, pages_of(image_side / 2)).groups.size() == 1);
    asset = tiled_scan(2);
    for (Vec2f& uv : asset.parts[0].uvs[0]) uv = {uv[0] * 8, uv[1] * 8};
    CHECK(page_groups(asset, pages_of(2 * image_side)).groups.size() == 1);
}

TEST_CASE("materials without texture and the default material join a page of the others") {
    Asset asset = tiled_scan(4);
    asset.materials[1].base_color_texture = {};
    asset.parts[0].face_material.back() = no_index;
    asset.parts[0].face_material[6] = no_index;
    const MaterialGroups groups = page_groups(asset, pages_of(image_side));
    std::size_t materials = 0;
    for (const auto& group : groups.groups) materials += group.materials.size();
    CHECK(groups.groups.size() == 2);  // images 0 and 2
    CHECK(materials == 4);
    CHECK(groups.group_of(no_index) != no_index);
}

TEST_CASE("parts that are not on a page do not count") {
    Asset asset = tiled_scan(16);
    asset.parts.push_back(asset.parts[0]);
    asset.parts[1].face_material.assign(asset.parts[1].triangles.size(), 3);
    const std::vector<std::uint8_t> skipped = {1, 0};
    CHECK(sizes(page_groups(asset, pages_of(image_side), skipped)) == std::vector<std::size_t>{1});
}

TEST_CASE("sixteen textures keep their texels, on pages that do not have more than they") {
    const Asset asset = tiled_scan(16);
    Options options{.target = ratio(1)};
    options.bake.kind = Bake::atlas;
    options.bake.untouched = UntouchedParts::baked;
    options.bake.texture_size = 2 * image_side;
    const SimplifiedAsset result = simplify(asset, options);
    REQUIRE(result.report.pages.size() == 4);
    for (const BakedPage& page : result.report.pages) {
        CHECK(page.density > 0.6);
        CHECK(page.width * page.height <= 4 * image_side * image_side);
    }
    CHECK(result.asset.materials.size() == 4);
}
