#include <cmath>

#include "support/catch.hpp"
#include "support/scenes.hpp"

using namespace faqem;
using namespace faqem::test;

namespace {

// Three curved parts with a texture each, which need a page of their own because of their alpha modes.
Asset three_pages() {
    Asset asset = textured_square(ramp(64));
    asset.materials.resize(1);
    asset.parts.clear();
    const AlphaMode modes[] = {AlphaMode::opaque, AlphaMode::mask, AlphaMode::blend};
    for (Index p = 0; p < 3; ++p) {
        const auto height = [&](double x, double y) {
            return Vec3{x, y, 5.0 * p + std::sin(3 * x + p) * std::cos(2 * y)};
        };
        asset.parts.push_back(uv_mapped(sheet(12, height)));
        asset.parts[p].face_material.assign(asset.parts[p].triangles.size(), p);
        if (p > 0) asset.materials.push_back(asset.materials[0]);
        asset.materials[p].alpha_mode = modes[p];
    }
    return asset;
}

}  // namespace

TEST_CASE("several pages and parts do not depend on the number of threads") {
    const Asset asset = three_pages();
    Options options = lossless();
    options.bake.kind = Bake::atlas;
    options.target = faces(240);
    const SimplifiedParts simplified = simplify_parts(asset, options);
    options.threads = 1;
    const SimplifiedAsset first = bake(asset, simplified, options);
    REQUIRE(first.asset.materials.size() == 3);
    const std::vector<Image>& images = first.asset.images;  // of colours and normals
    REQUIRE(images.size() >= 3);
    for (const std::uint32_t threads : {2u, 5u}) {
        options.threads = threads;
        const SimplifiedAsset again = bake(asset, simplified, options);
        REQUIRE(again.asset.images.size() == images.size());
        for (std::size_t i = 0; i < images.size(); ++i)
            CHECK(again.asset.images[i].encoded == images[i].encoded);
        for (std::size_t i = 0; i < 3; ++i) {
            CHECK(again.asset.parts[i].normals == first.asset.parts[i].normals);
            CHECK(again.asset.parts[i].uvs == first.asset.parts[i].uvs);
        }
    }
}

TEST_CASE("if the charts of one of several pages do not fit, all colours become vertex colours") {
    Asset asset = three_pages();
    Part& part = asset.parts[1];
    for (int i = 0; i < 70 * 70; ++i) part.triangles.push_back(part.triangles[i % 2]);
    part.face_material.assign(part.triangles.size(), 1);
    Options options = lossless();
    options.bake.kind = Bake::atlas;
    options.bake.texture_size = 64;
    for (const std::uint32_t threads : {1u, 3u}) {
        options.threads = threads;
        const SimplifiedAsset baked = bake(asset, unchanged(asset), options);
        CHECK(baked.asset.images.empty());
        for (const Part& to : baked.asset.parts) CHECK(to.colors.size() == to.positions.size());
    }
}
