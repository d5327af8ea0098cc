#include <cmath>

#include "support/catch.hpp"
#include "support/scenes.hpp"

using namespace faqem;
using namespace faqem::test;

namespace {

// A wavy grid with 2 n^2 faces.
Part bumpy(Index n) {
    return sheet(n, [](double x, double y) { return Vec3{x, y, std::sin(x * 0.9) * std::cos(y * 0.7)}; });
}

// Adds a triangle with legs of length 1 at (x, 0, 0), and removes the materials.
Part with_speck(Part part, double x) {
    const auto first = static_cast<Index>(part.positions.size());
    for (const Vec3& p : {Vec3{x, 0, 0}, {x + 1, 0, 0}, {x, 1, 0}}) part.positions.push_back(p);
    part.triangles.push_back({first, first + 1, first + 2});
    part.face_material.clear();
    return part;
}

}  // namespace

TEST_CASE("the budget by error gives a flat part few faces") {
    Asset asset = asset_with({bumpy(20), bumpy(20), Part{}});
    for (Vec3& p : asset.parts[1].positions) p[2] = 0;
    const SimplifiedParts simplified = simplify_parts(asset, {.target = GENERATE(ratio(0.25), faces(400))});
    CHECK(simplified.report.target_faces == 400);
    CHECK(simplified.report.faces_out <= 400);
    CHECK(simplified.report.stop == StopReason::reached_target);
    CHECK(simplified.parts[0].mesh.triangles.size() > 385);
    CHECK(simplified.parts[1].mesh.triangles.size() <= 12);
    CHECK(simplified.parts[2].mesh.triangles.empty());
}

TEST_CASE("a part keeps 65% of its share, however small it is beside another one") {
    Asset asset = asset_with({bumpy(20), bumpy(20)});
    const double size = GENERATE(30.0, 1e3, 1e6);
    for (Vec3& p : asset.parts[1].positions)
        for (double& x : p) x *= size;
    const SimplifiedParts simplified = simplify_parts(asset, {.target = ratio(0.25)});
    CHECK(simplified.report.faces_out <= 400);
    CHECK(simplified.report.faces_out > 390);
    CHECK(simplified.report.warnings.empty());
    CHECK(simplified.parts[0].mesh.triangles.size() >= 129);  // the last collapse removes up to two faces
    CHECK(simplified.parts[0].mesh.triangles.size() <= 135);
}

TEST_CASE("within an error, a small part keeps only what the error needs") {
    Asset asset = asset_with({bumpy(20), bumpy(20)});
    for (Vec3& p : asset.parts[1].positions)
        for (double& x : p) x *= 1000;
    const SimplifiedParts simplified = simplify_parts(asset, {.max_error = model_units(100)});
    CHECK(simplified.parts[1].mesh.triangles.size() > 100);
    CHECK(simplified.parts[0].mesh.triangles.size() <= 4);
    CHECK(simplified.report.warnings.empty());
}

TEST_CASE("a warning names a flat part that keeps less than a tenth of its share") {
    Asset asset = asset_with({bumpy(20), bumpy(20)});
    for (Vec3& p : asset.parts[1].positions) p[2] = 0;
    asset.parts[1].name = "floor";
    const SimplifiedParts simplified = simplify_parts(asset, {.target = ratio(0.5)});
    REQUIRE(simplified.report.warnings.size() == 1);
    CHECK(simplified.report.warnings[0].find("part 'floor' (") != std::string::npos);
}

TEST_CASE("a surface split into two parts gets about as many faces as one part") {
    // Split across the rows: two thirds of the faces are in the first part.
    Asset whole, cut;
    whole.parts = {bumpy(30)};
    cut.parts = {bumpy(30), bumpy(30)};
    cut.parts[0].triangles.resize(1200);
    cut.parts[1].triangles.erase(cut.parts[1].triangles.begin(), cut.parts[1].triangles.begin() + 1200);
    Options options{.target = ratio(0.3), .topology = {.boundary = Boundary::locked}};
    const SimplifyResult one = simplify_parts(whole, options).parts[0];
    const SimplifiedParts two = simplify_parts(cut, options);
    const auto low =
        std::count_if(one.face_origin.begin(), one.face_origin.end(), [](Index f) { return f < 1200; });
    CHECK(two.report.faces_out <= 540);
    CHECK(std::abs(double(two.parts[0].mesh.triangles.size()) - double(low)) < 0.1 * 540);
}

TEST_CASE("the budget per mesh is proportional to face counts and tiny parts keep their faces") {
    Asset asset = asset_with({bumpy(20), bumpy(10), square(), Part{}});
    asset.parts[2].face_material.clear();
    const SimplifiedParts simplified = simplify_parts(asset, {.target = faces(500), .budget = Budget::mesh});
    REQUIRE(simplified.parts.size() == 4);
    // The square keeps its 2 faces. In proportion to 800 and 200 faces, the other 498 are 398.4 and 99.6.
    CHECK(simplified.parts[0].report.target_faces == 398);
    CHECK(simplified.parts[1].report.target_faces == 100);
    CHECK(simplified.parts[2].mesh.triangles.size() == 2);
    CHECK(simplified.parts[3].mesh.triangles.empty());
    CHECK(simplified.report.faces_in == 1002);
    CHECK(simplified.report.target_faces == 500);
    CHECK(simplified.report.faces_out <= 500);
    CHECK(simplified.report.stop == StopReason::reached_target);
    CHECK(simplified.report.collapses ==
          simplified.parts[0].report.collapses + simplified.parts[1].report.collapses);
    for (std::size_t p = 0; p < 3; ++p) {
        CHECK(simplified.parts[p].history.remaining_faces.size() ==
              simplified.parts[p].mesh.triangles.size());
    }
}

TEST_CASE("a part with many small components keeps all of them") {
    // Twelve squares in one part, and another part of 800 faces, at the expense of which they are kept.
    Asset asset = asset_with({bumpy(20), Part{}});
    Part& labels = asset.parts[1];
    for (Index i = 0; i < 12; ++i) {
        for (Vec3 p : square().positions) labels.positions.push_back({p[0], p[1] + 2 * i, p[2]});
        labels.triangles.push_back({4 * i, 4 * i + 1, 4 * i + 2});
        labels.triangles.push_back({4 * i, 4 * i + 2, 4 * i + 3});
    }
    Options options{.target = GENERATE(ratio(0.1), faces(82)), .budget = Budget::mesh};
    const SimplifiedParts simplified = simplify_parts(asset, options);
    CHECK(simplified.parts[1].mesh.triangles.size() == 24);
    CHECK(simplified.report.components_deleted == 0);
    CHECK(simplified.report.target_faces == 82);
    CHECK(simplified.report.faces_out <= 82);

    // The target is too small to keep all components: it is distributed in proportion, with at least 4 faces
    // each.
    options.target = faces(20);
    const SimplifiedParts smaller = simplify_parts(asset, options);
    CHECK(smaller.parts[0].report.target_faces == 16);
    CHECK(smaller.parts[1].report.target_faces == 4);
}

TEST_CASE("components are counted after welding equal positions") {
    // The second grid is a triangle soup: its budget is in proportion to its faces, not all of them.
    const Part part = bumpy(10);
    Asset asset = asset_with({bumpy(20), part_of(separated(make(part.positions, part.triangles)))});
    Options options{.target = ratio(0.25), .budget = Budget::mesh};
    CHECK(simplify_parts(asset, options).parts[1].report.target_faces == 50);
}

TEST_CASE("report counts are sums over the parts") {
    Asset asset = asset_with({bumpy(20), bumpy(10)});
    const SimplifiedParts simplified = simplify_parts(asset, {.preset = Preset::best});
    const Report &sum = simplified.report, &a = simplified.parts[0].report, &b = simplified.parts[1].report;
    CHECK(sum.faces_in == a.faces_in + b.faces_in);
    CHECK(sum.vertices_out == a.vertices_out + b.vertices_out);
    CHECK(sum.collapses == a.collapses + b.collapses);
    CHECK(sum.vertices_fitted == a.vertices_fitted + b.vertices_fitted);
    CHECK(sum.vertices_fitted > 0);
    CHECK(sum.edges_flipped == a.edges_flipped + b.edges_flipped);
}

TEST_CASE("small components are pruned from every part except its largest one") {
    // Two grids of side 20, each with a small triangle of side 1; the second part is scaled by 10.
    const Part dusty = with_speck(bumpy(20), 30);
    const Part speck = part_of(make({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}));
    Asset asset = asset_with({dusty, dusty, speck});
    for (Vec3& p : asset.parts[1].positions) p = {10 * p[0], 10 * p[1], 10 * p[2]};
    Options options{.bake = {.kind = Bake::none}};
    options.topology.prune = GENERATE(model_units(5), of_diagonal(0.015));
    options.budget = GENERATE(Budget::scene, Budget::mesh);
    const SimplifiedParts simplified = simplify_parts(asset, options);
    CHECK(simplified.report.components_pruned == 1);
    CHECK(simplified.report.faces_pruned == 1);
    CHECK(simplified.parts[0].report.components_pruned == 1);
    CHECK(simplified.parts[1].report.components_pruned == 0);
    CHECK(simplified.parts[2].mesh.triangles.size() == 1);
    CHECK(simplified.report.faces_out <= simplified.report.target_faces);
}

TEST_CASE("cancelling the simplification returns an asset without parts") {
    Asset asset = asset_with({bumpy(20), bumpy(20)});
    Options options{.budget = GENERATE(Budget::scene, Budget::mesh)};
    options.progress = [](Phase, double) { return Continue::cancel; };
    const SimplifiedAsset simplified = simplify(asset, options);
    CHECK(simplified.report.stop == StopReason::cancelled);
    CHECK(simplified.asset.parts.empty());
}

TEST_CASE("progress over several parts never decreases") {
    Asset asset = asset_with({bumpy(60), bumpy(40)});
    Options options{.budget = GENERATE(Budget::scene, Budget::mesh)};
    std::vector<double> seen = {0};
    options.progress = [&](Phase, double fraction) {
        seen.push_back(fraction);
        return Continue::yes;
    };
    simplify_parts(asset, options);
    CHECK(seen.size() > 3);
    CHECK(std::is_sorted(seen.begin(), seen.end()));
    CHECK(seen.back() <= 1);
    CHECK(seen.back() > 0.75);
}

TEST_CASE("invalid assets are rejected with the name of the part or material") {
    const Asset good = test::textured_square(test::ramp(4));
    REQUIRE_NOTHROW(simplify(good, {}));
    const auto refused = [&](const std::function<void(Asset&, Part&)>& spoil, const std::string& why) {
        Asset asset = good;
        spoil(asset, asset.parts[0]);
        for (const Bake kind :
             {Bake::automatic, Bake::atlas, Bake::per_triangle, Bake::vertex, Bake::keep, Bake::none}) {
            CHECK_THROWS_WITH(simplify(asset, {.bake = {.kind = kind}}), why);
        }
    };
    const std::string part = "part 'square': ";
    const float nan = std::nanf("");
    refused([](Asset&, Part& p) { p.triangles[1][2] = 4; }, part + "face 1: vertex index out of range: 4");
    refused([](Asset&, Part& p) { p.uvs[0].pop_back(); },
            part + "uvs 0: has 3 entries, expected one for each of 4 vertices");
    refused([](Asset&, Part& p) { p.normals.resize(5); },
            part + "normals: has 5 entries, expected one for each of 4 vertices");
    refused([](Asset&, Part& p) { p.joints.resize(1); },
            part + "joints: has 1 entries, expected one for each of 4 vertices");
    refused(
        [](Asset&, Part& p) {
            p.morph_targets.push_back({{{0, 0, 0}}, {}});
        },
        part + "positions of a morph target: has 1 entries, expected one for each of 4 vertices");
    refused([&](Asset&, Part& p) { p.uvs[0][2][1] = nan; }, part + "uvs 0, vertex 2: is not finite");
    refused([&](Asset&, Part& p) { p.positions[3][0] = nan; }, part + "positions, vertex 3: is not finite");
    refused([](Asset&, Part& p) { p.face_material.pop_back(); },
            part + "face_material: needs one entry per face or none");
    refused([](Asset&, Part& p) { p.face_material[1] = 7; }, part + "face 1: material index out of range: 7");
    refused([](Asset& a, Part&) { a.images.clear(); }, "material 'paint': image index out of range");
    refused([&](Asset& a, Part&) { a.materials[0].base_color_texture.rotation = nan; },
            "material 'paint': the transform of a texture is not finite");
    refused([&](Asset& a, Part&) { a.materials[0].roughness = nan; },
            "material 'paint': a factor is not finite");
}

// A face, and copies of it: with another material, with the same material, with reversed winding, and with a
// material that has a page of its own.
TEST_CASE("coincident faces with different materials are kept although they share a page") {
    Asset asset;
    asset.materials.resize(3);
    asset.materials[2].double_sided = true;  // a page of its own
    Part part;
    part.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    part.triangles = {{0, 1, 2}, {4, 5, 3}, {3, 4, 5}, {0, 2, 1}, {3, 4, 2}};
    part.face_material = {0, 1, 0, 0, 2};
    asset.parts = {part};
    const SimplifiedParts simplified = simplify_parts(asset, {.target = ratio(1)});
    CHECK(simplified.parts[0].face_origin == std::vector<Index>{0, 1, 3, 4});
    CHECK(simplified.report.faces_dropped == 1);
    // They are one group for bake().
    CHECK(simplified.parts[0].history.face_groups == std::vector<Index>{0, 0, 0, 0, 1});
    CHECK(simplified.parts[0].mesh.face_groups == std::vector<Index>{0, 0, 0, 1});
}

// Two coincident spheres of one material: red with outward normals and blue with inward normals.
TEST_CASE("coincident layers with opposite normals are kept with any winding") {
    Asset asset = textured_square(paint(64, 64, [](std::uint32_t x, std::uint32_t) {
        return x < 32 ? Rgba{255, 0, 0, 255} : Rgba{0, 0, 255, 255};
    }));
    const bool wound_alike = GENERATE(false, true);
    CAPTURE(wound_alike);
    const TriangleMesh sphere = icosphere(3);
    const auto count = static_cast<Index>(sphere.positions.size());
    Part part;
    part.triangles = sphere.triangles;
    for (const auto& [a, b, c] : sphere.triangles) {
        part.triangles.push_back(wound_alike ? Triangle{a + count, b + count, c + count}
                                             : Triangle{a + count, c + count, b + count});
    }
    part.uvs.resize(1);
    for (const float side : {1.0f, -1.0f}) {
        for (const Vec3& p : sphere.positions) {
            part.positions.push_back(p);
            part.uvs[0].push_back({side > 0 ? 0.2f : 0.8f, 0.5f});
            part.normals.push_back({side * float(p[0]), side * float(p[1]), side * float(p[2])});
        }
    }
    part.face_material.assign(part.triangles.size(), 0);
    asset.parts = {part};
    const SimplifiedAsset simplified = simplify(asset, {.target = ratio(0.25)});
    CHECK(simplified.report.faces_dropped == 0);
    const Part& out = simplified.asset.parts[0];
    CHECK(out.triangles.size() <= part.triangles.size() / 4);
    const Pixels atlas = decode(simplified.asset.images[0]);
    std::size_t outside = 0;
    for (std::size_t f = 0; f < out.triangles.size(); ++f) {
        const Vec3& p = out.positions[out.triangles[f][0]];
        const Vec3f& n = out.normals[out.triangles[f][0]];
        const bool is_outside = p[0] * n[0] + p[1] * n[1] + p[2] * n[2] > 0;
        outside += is_outside;
        const auto color = look(out, atlas, f, {0.3, 0.3, 0.4});
        CHECK(color[0] == Approx(is_outside ? 255 : 0).margin(2));
        CHECK(color[2] == Approx(is_outside ? 0 : 255).margin(2));
    }
    CHECK(outside == out.triangles.size() / 2);
}

TEST_CASE("with images, a part that keeps few faces is fitted as by preset best") {
    Asset asset = asset_with({bumpy(20)});
    const auto positions = [&](std::uint64_t count, Preset preset) {
        return simplify_parts(asset, {.target = faces(count), .preset = preset}).parts[0].mesh.positions;
    };
    CHECK(positions(100, Preset::balanced) != positions(100, Preset::best));
    asset.images.emplace_back();
    CHECK(positions(100, Preset::balanced) == positions(100, Preset::best));
    CHECK(positions(100, Preset::fast) != positions(100, Preset::best));
}
