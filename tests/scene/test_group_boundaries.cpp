// Boundaries between the materials of an asset.

#include <cmath>

#include "support/catch.hpp"
#include "support/scenes.hpp"

using namespace faqem;
using namespace faqem::test;

TEST_CASE("boundaries between materials that stay are preserved without being asked for") {
    // A flat grid of 4 x 4 cells in two materials.
    Asset asset;
    asset.parts = {sheet(20, [](double x, double y) { return Vec3{x, y, 0}; })};
    asset.materials.resize(2);
    asset.materials[1].base_color = {1, 0, 0, 1};
    asset.parts[0].face_material.clear();
    const auto cell = [](Index square) { return (square % 20 / 5 + square / 20 / 5) % 2; };
    for (Index f = 0; f < 800; ++f) asset.parts[0].face_material.push_back(cell(f / 2));
    Options options{.target = ratio(0.1)};
    options.bake.kind = GENERATE(Bake::automatic, Bake::keep, Bake::none);
    const SimplifiedParts simplified = simplify_parts(asset, options);
    const SimplifyResult& part = simplified.parts[0];
    CHECK(part.report.faces_out <= 80);
    double area[2] = {0, 0};
    for (std::size_t f = 0; f < part.mesh.triangles.size(); ++f) {
        const Vec3 n = normal(part.mesh, part.mesh.triangles[f]);
        area[asset.parts[0].face_material[part.face_origin[f]]] += 0.5 * std::hypot(n[0], n[1], n[2]);
    }
    CHECK(area[0] == Approx(200));
    CHECK(area[1] == Approx(200));
    // Fewer faces than the cells have are possible.
    options.target = faces(8);
    const SimplifiedParts few = simplify_parts(asset, options);
    CHECK(few.report.faces_out <= 8);
    CHECK(few.report.rungs[static_cast<std::size_t>(Rung::group_boundaries)] == 1);
}

TEST_CASE("group boundaries are preserved even if the materials share a page") {
    // A flat grid with two materials: the boundary between them has no geometric error, so that only the
    // option preserves it.
    Asset asset;
    asset.parts = {sheet(20, [](double x, double y) { return Vec3{x, y, 0}; })};
    asset.materials.resize(2);
    asset.parts[0].face_material.clear();
    for (Index f = 0; f < 800; ++f) asset.parts[0].face_material.push_back(f / 2 % 20 / 10);
    Options options{.target = ratio(0.05)};
    options.bake.kind = GENERATE(Bake::atlas, Bake::per_triangle, Bake::vertex, Bake::keep, Bake::none);
    options.topology.group_boundaries = GroupBoundaries::preserved;
    const SimplifiedParts simplified = simplify_parts(asset, options);
    const SimplifyResult& part = simplified.parts[0];
    CHECK(part.report.faces_out <= 40);
    double area[2] = {0, 0};
    for (std::size_t f = 0; f < part.mesh.triangles.size(); ++f) {
        bool left = false, right = false;
        for (const Index v : part.mesh.triangles[f]) {
            left |= part.mesh.positions[v][0] < 10 - 1e-6;
            right |= part.mesh.positions[v][0] > 10 + 1e-6;
        }
        CHECK(left != right);
        const Index material = asset.parts[0].face_material[part.face_origin[f]];
        CHECK(right == (material == 1));
        const Vec3 n = normal(part.mesh, part.mesh.triangles[f]);
        area[material] += 0.5 * std::hypot(n[0], n[1], n[2]);
    }
    CHECK(area[0] == Approx(200));
    CHECK(area[1] == Approx(200));
    // Materials that are baked into one page are one group for bake().
    const bool merged = options.bake.kind != Bake::keep && options.bake.kind != Bake::none;
    CHECK(part.mesh.face_groups.empty() == merged);
    CHECK(part.history.face_groups.empty() == merged);
}
