#include "scene/resolved_options.hpp"
#include "support/catch.hpp"
#include "support/scenes.hpp"

using namespace faqem;

namespace {

// A plate of 12 x 12 squares whose vertices have the colour by column.
template <class ColorOf>
Asset plate(const ColorOf& color_of) {
    Asset asset = test::asset_with({test::part_of(test::grid(12))});
    for (Index v = 0; v < 13 * 13; ++v) asset.parts[0].colors.push_back(color_of(v % 13));
    return asset;
}

constexpr Vec4f red = {1, 0, 0, 1}, blue = {0, 0, 1, 1};

Bake kind_for(ModelFormat format, const Asset& asset) {
    Options options{.format = format};
    return detail::resolved_options(asset, options).bake.kind;
}

// Two plates side by side, each of one colour.
Asset two_classes() {
    const TriangleMesh grid = test::grid(12);
    Asset asset = test::asset_with({test::part_of(test::both(grid, test::moved(grid, {12, 0, 0})))});
    asset.parts[0].colors.assign(13 * 13, red);
    asset.parts[0].colors.resize(2 * 13 * 13, blue);
    return asset;
}

}  // namespace

TEST_CASE("resolved options: colours that are classes are kept in PLY, others are baked") {
    CHECK(kind_for(ModelFormat::ply, two_classes()) == Bake::keep);
    CHECK(kind_for(ModelFormat::ply, plate([](Index x) {
                       return Vec4f{static_cast<float>(x) / 12, 0, 0, 1};
                   })) == Bake::vertex);
    CHECK(kind_for(ModelFormat::ply, plate([](Index x) { return x % 2 ? red : blue; })) == Bake::vertex);
    CHECK(kind_for(ModelFormat::glb, two_classes()) == Bake::automatic);
}

TEST_CASE("resolved options: meshes without materials keep their UVs in OBJ and PLY, and get no material") {
    Asset asset = two_classes();
    asset.parts[0].colors.clear();
    CHECK(kind_for(ModelFormat::obj, asset) == Bake::none);
    asset.parts[0].uvs.emplace_back(asset.parts[0].positions.size());
    CHECK(kind_for(ModelFormat::obj, asset) == Bake::keep);
    CHECK(kind_for(ModelFormat::ply, asset) == Bake::keep);
    CHECK(kind_for(ModelFormat::stl, asset) == Bake::none);
    CHECK(kind_for(ModelFormat::glb, asset) == Bake::automatic);
}
