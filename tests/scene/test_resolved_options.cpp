#include "scene/resolved_options.hpp"
#include "support/catch.hpp"

using namespace faqem;

namespace {

// A plate of 12 x 12 squares whose vertices have the colour by column.
template <class ColorOf>
Asset plate(const ColorOf& color_of) {
    constexpr Index n = 12;
    Asset asset;
    Part& part = asset.parts.emplace_back();
    for (Index y = 0; y <= n; ++y) {
        for (Index x = 0; x <= n; ++x) {
            part.positions.push_back({double(x), double(y), 0});
            part.colors.push_back(color_of(x));
        }
    }
    for (Index y = 0; y < n; ++y) {
        for (Index x = 0; x < n; ++x) {
            const Index a = y * (n + 1) + x;
            part.triangles.push_back({a, a + 1, a + n + 2});
            part.triangles.push_back({a, a + n + 2, a + n + 1});
        }
    }
    return asset;
}

constexpr Vec4f red = {1, 0, 0, 1}, blue = {0, 0, 1, 1};

Bake kind_for(ModelFormat format, const Asset& asset) {
    Options options{.format = format};
    return detail::resolved_options(asset, options).bake.kind;
}

// Two plates side by side, each of one colour.
Asset two_classes() {
    Asset asset = plate([](Index) { return red; });
    const Part other = plate([](Index) { return blue; }).parts[0];
    Part& part = asset.parts[0];
    const auto first = static_cast<Index>(part.positions.size());
    for (const Vec3& p : other.positions) part.positions.push_back({p[0] + 12, p[1], p[2]});
    part.colors.insert(part.colors.end(), other.colors.begin(), other.colors.end());
    for (const Triangle& t : other.triangles)
        part.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
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
