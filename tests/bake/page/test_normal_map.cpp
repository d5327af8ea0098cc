#include <cmath>
#include <numbers>

#include "support/catch.hpp"
#include "support/lit.hpp"

using namespace faqem;
using namespace faqem::test;

namespace {

Options with(NormalMap choice, double share = 1) {
    Options options = lossless();
    options.target = ratio(share);
    options.bake.normal_map = choice;
    options.bake.texture_size = 512;
    return options;
}

const Pixels normal_image(const SimplifiedAsset& simplified) {
    return decode(simplified.asset.images[simplified.asset.materials[0].normal_texture.image]);
}

// A square with a constant normal map: (0.6, 0.48, 0.64) in tangent space.
Asset normal_mapped_square() {
    Asset asset = textured_square(ramp(16));
    asset.parts[0].normals.assign(4, {0, 0, 1});
    asset.materials[0].normal_texture.image =
        add_texture(asset, paint(8, 8, [](std::uint32_t, std::uint32_t) {
                        return Rgba{204, 189, 209, 255};
                    }));
    return asset;
}

void check_lit(const SimplifiedAsset& simplified, const Direction& expected) {
    REQUIRE(simplified.asset.materials[0].normal_texture);
    CHECK(simplified.asset.materials[0].normal_scale == 1);
    const Pixels map = normal_image(simplified);
    const Part& part = simplified.asset.parts[0];
    REQUIRE(part.tangents.size() == part.positions.size());
    for (std::size_t f = 0; f < part.triangles.size(); ++f) {
        for (const Vec3& w : spread(6)) {
            CHECK(degrees_between(lit_normal(part, map, f, w), unit(expected)) < 1);
        }
    }
}

// A wavy surface that 2% of its faces cannot approximate well.
Part steep_waves(bool normals) {
    Part part = sheet(64, [](double x, double y) { return Vec3{x, y, 0.4 * std::sin(x) * std::cos(y)}; });
    for (const Vec3& p : part.positions) {
        const Direction n =
            unit({-0.4 * std::cos(p[0]) * std::cos(p[1]), 0.4 * std::sin(p[0]) * std::sin(p[1]), 1});
        if (normals) part.normals.push_back({float(n[0]), float(n[1]), float(n[2])});
    }
    return part;
}

}  // namespace

TEST_CASE("baking preserves the shading of a normal map") {
    const Asset asset = normal_mapped_square();
    check_lit(bake(asset, unchanged(asset), with(NormalMap::automatic)), {0.6, 0.48, 0.64});
}

TEST_CASE("normal maps with mirrored UVs are baked with mirrored tangents") {
    Asset asset = normal_mapped_square();
    for (Vec2f& uv : asset.parts[0].uvs[0]) uv[0] = 1 - uv[0];
    check_lit(bake(asset, unchanged(asset), with(NormalMap::automatic)), {-0.6, 0.48, 0.64});
    for (Vec2f& uv : asset.parts[0].uvs[0]) uv = {1 - uv[0], 1 - uv[1]};
    check_lit(bake(asset, unchanged(asset), with(NormalMap::automatic)), {0.6, -0.48, 0.64});
}

TEST_CASE("scale and texture rotation of a normal map are applied") {
    Asset asset = normal_mapped_square();
    asset.materials[0].normal_scale = 0.5f;
    check_lit(bake(asset, unchanged(asset), with(NormalMap::automatic)), {0.3, 0.24, 0.64});
    // With a rotation by 90 degrees, the direction of u on the square is along y.
    asset.materials[0].normal_scale = 1;
    asset.materials[0].normal_texture.rotation = float(std::numbers::pi / 2);
    check_lit(bake(asset, unchanged(asset), with(NormalMap::automatic)), {0.48, -0.6, 0.64});
}

TEST_CASE("tangents of the source take precedence over computed ones") {
    Asset asset = normal_mapped_square();
    asset.parts[0].tangents.assign(4, {0, 1, 0, -1});
    // The bitangent is cross(z, y) * -1 = x.
    check_lit(bake(asset, unchanged(asset), with(NormalMap::automatic)), {0.48, 0.6, 0.64});
}

TEST_CASE("a normal map from geometry restores the shading of removed faces") {
    Asset asset;
    asset.parts = {steep_waves(true)};
    const SimplifiedAsset simplified = simplify(asset, with(NormalMap::on, 0.02));
    const Pixels map = normal_image(simplified);
    const Part& part = simplified.asset.parts[0];
    double plain = 0, mapped = 0;
    std::size_t count = 0;
    for (std::size_t f = 0; f < part.triangles.size(); ++f) {
        for (const Vec3& w : {Vec3{0.6, 0.2, 0.2}, Vec3{0.2, 0.6, 0.2}, Vec3{0.2, 0.2, 0.6}}) {
            const auto p = blend(part.positions, part.triangles[f], w);
            const Direction truth =
                unit({-0.4 * std::cos(p[0]) * std::cos(p[1]), 0.4 * std::sin(p[0]) * std::sin(p[1]), 1});
            plain += degrees_between(unit(blend(part.normals, part.triangles[f], w)), truth);
            mapped += degrees_between(lit_normal(part, map, f, w), truth);
            ++count;
        }
    }
    CHECK(plain / double(count) > 5);
    CHECK(mapped < 0.35 * plain);
}

TEST_CASE("automatic normal maps of textured models are made only if normals deviate") {
    Asset asset = textured_square(ramp(16));
    const auto uv_of = [](const Vec3& p) { return std::array{p[0] / 7, p[1] / 7}; };
    asset.parts = {uv_mapped(steep_waves(false), uv_of)};
    CHECK(simplify(asset, with(NormalMap::automatic, 0.02)).asset.materials[0].normal_texture);
    for (Vec3& p : asset.parts[0].positions) p[2] = 0;
    const SimplifiedAsset flat = simplify(asset, with(NormalMap::automatic, 0.02));
    CHECK_FALSE(flat.asset.materials[0].normal_texture);
    CHECK(flat.asset.parts[0].tangents.empty());
}

TEST_CASE("an automatic normal map depends on the mean squared error of shading") {
    // Normals that are wrong by 30 degrees on 10% and 1% of the surface: root mean squares of 9.4 and 3 degrees.
    for (const auto& [share, has_map] : {std::pair(0.1, true), std::pair(0.01, false)}) {
        Asset asset = textured_square(ramp(16));
        Part& part = asset.parts[0];
        for (const double x : {0.0, share / (1 - share)})
            for (const double y : {0.0, 1.0}) {
                part.positions.push_back({2 + x, y, 0});
                part.uvs[0].push_back({0, 0});
            }
        part.triangles.insert(part.triangles.end(), {{4, 6, 7}, {4, 7, 5}});
        part.face_material.resize(4, 0);
        part.normals.assign(4, {0, 0, 1});
        part.normals.resize(8, {0.5f, 0, float(std::sqrt(0.75))});
        Options options = with(NormalMap::automatic);
        options.bake.normals = Normals::smooth;
        const SimplifiedAsset baked = bake(asset, unchanged(asset), options);
        CHECK(bool(baked.asset.materials[0].normal_texture) == has_map);
    }
}

TEST_CASE("models without textures get a normal map only if it is requested") {
    Asset asset;
    asset.parts = {steep_waves(false)};
    CHECK(simplify(asset, with(NormalMap::automatic, 0.02)).asset.images.empty());
    CHECK(simplify(asset, with(NormalMap::on, 0.02)).asset.images.size() == 1);
    for (const Vec3& p : asset.parts[0].positions)
        asset.parts[0].colors.push_back({static_cast<float>(p[0] / 64), 0, 0, 1});
    Options colored = with(NormalMap::automatic, 0.02);
    colored.bake.kind = Bake::atlas;
    CHECK(simplify(asset, colored).asset.images.size() == 1);
}

TEST_CASE("normal maps are omitted for unlit materials and with a warning if they are off") {
    Asset asset = normal_mapped_square();
    const SimplifiedAsset off = bake(asset, unchanged(asset), with(NormalMap::off));
    CHECK_FALSE(off.asset.materials[0].normal_texture);
    CHECK(off.asset.parts[0].tangents.empty());
    REQUIRE(off.report.warnings.size() == 1);
    CHECK(off.report.warnings[0].find("'paint': the normal map") != std::string::npos);
    asset.materials[0].unlit = true;
    CHECK_FALSE(bake(asset, unchanged(asset), with(NormalMap::on)).asset.materials[0].normal_texture);
}

TEST_CASE("faces with reversed winding are shaded on the visible side") {
    Asset asset = normal_mapped_square();
    asset.parts[0].normals.clear();
    SimplifiedParts parts = unchanged(asset);
    for (Triangle& t : asset.parts[0].triangles) std::swap(t[0], t[1]);
    // The history has the original winding, with normals up. The faces of the source have normals down now.
    const SimplifiedAsset simplified = bake(asset, parts, with(NormalMap::on));
    const Pixels map = normal_image(simplified);
    for (std::size_t f = 0; f < 2; ++f) {
        CHECK(lit_normal(simplified.asset.parts[0], map, f, {0.3, 0.3, 0.4})[2] > 0.5);
    }
}

TEST_CASE("kept UVs get tangents if there is a normal map") {
    Asset asset = normal_mapped_square();
    Options options = with(NormalMap::automatic);
    options.bake.kind = Bake::keep;
    options.bake.untouched = UntouchedParts::baked;
    const SimplifiedAsset simplified = simplify(asset, options);
    const Part& part = simplified.asset.parts[0];
    REQUIRE(part.tangents.size() == part.positions.size());
    for (const Vec4f& t : part.tangents) CHECK(t == Vec4f{1, 0, 0, 1});
    asset.materials[0].normal_texture = {};
    CHECK(simplify(asset, options).asset.parts[0].tangents.empty());
}
