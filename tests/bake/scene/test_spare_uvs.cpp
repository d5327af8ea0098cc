// UVs that no texture of the model uses, as those of light maps that a program adds.

#include <cmath>

#include "support/catch.hpp"
#include "support/format_support.hpp"
#include "support/scenes.hpp"

using namespace faqem;
using namespace faqem::test;

namespace {

using Place = Vec2f (*)(const Vec3&);

Vec2f first_uv(const Vec3& p) { return {static_cast<float>(p[0]), static_cast<float>(1 - p[1])}; }
Vec2f second_uv(const Vec3& p) { return {static_cast<float>(p[1] / 2), static_cast<float>(p[0] / 3)}; }

// A curved sheet of 1152 faces, whose two UV sets are linear in x and y.
Part lit_sheet() {
    Part part = sheet(24, [](double x, double y) { return Vec3{x / 24, y / 24, 0.05 * std::sin(x / 8)}; });
    part.name = "sheet";
    part.face_material.assign(part.triangles.size(), 0);
    part.uvs.resize(2);
    for (const Vec3& p : part.positions) {
        part.uvs[0].push_back(first_uv(p));
        part.uvs[1].push_back(second_uv(p));
    }
    return part;
}

Asset plain_sheet() {
    Asset asset;
    asset.materials.resize(1);
    asset.materials[0].base_color = {1, 0, 0, 1};
    asset.parts = {lit_sheet()};
    return asset;
}

Options tenth() { return {.target = ratio(0.1)}; }

void check_uvs(const Part& part) {
    CHECK(part.triangles.size() <= 115);
    REQUIRE(part.uvs.size() == 2);
    const auto largest_error = [&](std::size_t set, Place place) {
        float error = 0;
        for (std::size_t v = 0; v < part.positions.size(); ++v)
            for (std::size_t k = 0; k < 2; ++k)
                error = std::max(error, std::abs(part.uvs[set][v][k] - place(part.positions[v])[k]));
        return error;
    };
    CHECK(largest_error(0, first_uv) < 0.01f);
    CHECK(largest_error(1, second_uv) < 0.01f);
}

}  // namespace

TEST_CASE("spare UVs: a mesh without textures keeps all sets") {
    const Asset asset = plain_sheet();
    Options options = tenth();
    options.bake.kind = GENERATE(Bake::automatic, Bake::atlas);
    const SimplifiedAsset result = simplify(asset, options);
    check_uvs(result.asset.parts[0]);
    CHECK(result.report.warnings.empty());
    CHECK(result.asset.images.empty());

    // A history has no UVs: they are transferred.
    SimplifiedParts parts = simplify_parts(asset, options);
    parts.parts[0].mesh.attributes = {};
    check_uvs(bake(asset, parts, options).asset.parts[0]);
}

TEST_CASE("spare UVs: a mesh without materials keeps them in formats that hold UVs") {
    Asset asset = plain_sheet();
    asset.materials.clear();
    asset.parts[0].face_material.assign(asset.parts[0].triangles.size(), no_index);
    Options options = tenth();
    for (const ModelFormat format : {ModelFormat::glb, ModelFormat::obj, ModelFormat::ply}) {
        options.format = format;
        check_uvs(simplify(asset, options).asset.parts[0]);
    }
    options.format = ModelFormat::stl;
    CHECK(simplify(asset, options).asset.parts[0].uvs.empty());
}

TEST_CASE("spare UVs: a plain mesh beside a textured one keeps them, whatever the pictures") {
    // Single texels at every vertex of the textured mesh, which gets a new page.
    Asset asset = textured_square(ramp(64));
    asset.parts[0] = lit_sheet();
    for (std::size_t v = 0; v < asset.parts[0].uvs[0].size(); ++v)
        asset.parts[0].uvs[0][v][0] += v % 2 == 0 ? 0.1f : -0.1f;
    asset.materials.emplace_back().base_color = {1, 0, 0, 1};
    asset.parts.push_back(lit_sheet());
    asset.parts[1].name = "plain";
    asset.parts[1].face_material.assign(asset.parts[1].triangles.size(), 1);
    const SimplifiedAsset result = simplify(asset, tenth());
    CHECK(result.report.kept_uvs == std::vector<std::string>{"part 'plain'"});
    REQUIRE(result.asset.parts[1].uvs.size() == 2);
    const Material& material = result.asset.materials[result.asset.parts[1].face_material[0]];
    CHECK(material.base_color == Vec4f{1, 0, 0, 1});
    // The first set of the textured mesh is replaced, the second one is dropped.
    CHECK(result.asset.parts[0].uvs.size() == 1);
    REQUIRE(result.report.warnings.size() == 1);
    CHECK(testing::contains(result.report.warnings[0],
                            "part 'sheet': texture coordinates that no texture uses were left out for a new "
                            "page: set 1"));
}

TEST_CASE("spare UVs: where vertex colours need a page, a warning names the sets") {
    Asset asset = plain_sheet();
    for (const Vec3& p : asset.parts[0].positions)
        asset.parts[0].colors.push_back({static_cast<float>(p[0]), 0, 0, 1});
    Options options = tenth();
    options.bake.kind = Bake::atlas;
    const SimplifiedAsset result = simplify(asset, options);
    CHECK(result.asset.parts[0].uvs.size() == 1);
    REQUIRE(result.report.warnings.size() == 1);
    CHECK(testing::contains(result.report.warnings[0], "new page: set 0, 1"));
    // White ones need none.
    asset.parts[0].colors.assign(asset.parts[0].positions.size(), {1, 1, 1, 1});
    check_uvs(simplify(asset, options).asset.parts[0]);
}
