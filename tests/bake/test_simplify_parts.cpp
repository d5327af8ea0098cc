#include <catch2/catch.hpp>
#include <cmath>

#include "scenes.hpp"

using namespace faqem;
using namespace faqem::test;

namespace {

// 2 n^2 faces.
Part bumpy(Index n) {
    return sheet(n, [](double x, double y) { return Vec3{x, y, std::sin(x * 0.9) * std::cos(y * 0.7)}; });
}

}  // namespace

TEST_CASE("faces go where they show: none to speak of stay on a flat sheet") {
    Asset asset;
    asset.parts = {bumpy(20), bumpy(20), Part{}};
    for (Vec3& p : asset.parts[1].positions) p[2] = 0;
    Options options;
    options.target = GENERATE(ratio(0.25), faces(400));
    const SmallParts small = simplify_parts(asset, options);
    CHECK(small.report.target_faces == 400);
    CHECK(small.report.faces_out <= 400);
    CHECK(small.report.stop == StopReason::reached_target);
    CHECK(small.parts[0].mesh.triangles.size() > 385);
    CHECK(small.parts[1].mesh.triangles.size() <= 12);
    CHECK(small.parts[2].mesh.triangles.empty());
}

TEST_CASE("one sheet cut in two gets about what it got whole") {
    // Cut across the rows: two thirds of the faces are in the first part.
    Asset whole, cut;
    whole.parts = {bumpy(30)};
    cut.parts = {bumpy(30), bumpy(30)};
    cut.parts[0].triangles.resize(1200);
    cut.parts[1].triangles.erase(cut.parts[1].triangles.begin(), cut.parts[1].triangles.begin() + 1200);
    Options options;
    options.target = ratio(0.3);
    options.topology.border = Border::locked;
    const SimplifyResult one = simplify_parts(whole, options).parts[0];
    const SmallParts two = simplify_parts(cut, options);
    const auto low =
        std::count_if(one.face_origin.begin(), one.face_origin.end(), [](Index f) { return f < 1200; });
    CHECK(two.report.faces_out <= 540);
    CHECK(std::abs(double(two.parts[0].mesh.triangles.size()) - double(low)) < 0.1 * 540);
}

TEST_CASE("a face count is shared out by size, and tiny parts keep their faces") {
    Asset asset;
    asset.parts = {bumpy(20), bumpy(10), square(), Part{}};
    asset.parts[2].face_material.clear();
    Options options;
    options.target = faces(500);
    options.budget = Budget::mesh;
    const SmallParts small = simplify_parts(asset, options);
    REQUIRE(small.parts.size() == 4);
    // The square keeps its 2 faces; 498 for 800 and 200 faces are 398.4 and 99.6.
    CHECK(small.parts[0].report.target_faces == 398);
    CHECK(small.parts[1].report.target_faces == 100);
    CHECK(small.parts[2].mesh.triangles.size() == 2);
    CHECK(small.parts[3].mesh.triangles.empty());
    CHECK(small.report.faces_in == 1002);
    CHECK(small.report.target_faces == 500);
    CHECK(small.report.faces_out <= 500);
    CHECK(small.report.stop == StopReason::reached_target);
    CHECK(small.report.collapses == small.parts[0].report.collapses + small.parts[1].report.collapses);
    for (std::size_t p = 0; p < 3; ++p) {
        CHECK(small.parts[p].history.kept_faces.size() == small.parts[p].mesh.triangles.size());
    }
}

TEST_CASE("a ratio holds for every part where the budget is per mesh") {
    Asset asset;
    asset.parts = {bumpy(20), bumpy(10)};
    Options options;
    options.target = ratio(0.25);
    options.budget = Budget::mesh;
    const SmallParts small = simplify_parts(asset, options);
    CHECK(small.parts[0].mesh.triangles.size() <= 200);
    CHECK(small.parts[1].mesh.triangles.size() <= 50);
    CHECK(small.report.target_faces == 250);
}

TEST_CASE("a part of many small components keeps them all") {
    // Twelve labels in one part, beside a sheet of 800 faces that can pay for them.
    Asset asset;
    asset.parts = {bumpy(20), Part{}};
    Part& labels = asset.parts[1];
    for (Index i = 0; i < 12; ++i) {
        for (Vec3 p : square().positions) labels.positions.push_back({p[0], p[1] + 2 * i, p[2]});
        labels.triangles.push_back({4 * i, 4 * i + 1, 4 * i + 2});
        labels.triangles.push_back({4 * i, 4 * i + 2, 4 * i + 3});
    }
    Options options;
    options.budget = Budget::mesh;
    options.target = GENERATE(ratio(0.1), faces(82));
    const SmallParts small = simplify_parts(asset, options);
    CHECK(small.parts[1].mesh.triangles.size() == 24);
    CHECK(small.report.components_deleted == 0);
    CHECK(small.report.target_faces == 82);
    CHECK(small.report.faces_out <= 82);

    // No room for them: every part goes down in proportion, but keeps 4 faces.
    options.target = faces(20);
    const SmallParts smaller = simplify_parts(asset, options);
    CHECK(smaller.parts[0].report.target_faces == 16);
    CHECK(smaller.parts[1].report.target_faces == 4);
}

TEST_CASE("seams between vertices at one place do not make components") {
    // The grid as a soup of single triangles: its share is its part of the whole, not all its faces.
    Asset asset;
    asset.parts = {bumpy(20), bumpy(10)};
    Part soup;
    for (const Triangle& t : asset.parts[1].triangles) {
        const Index n = static_cast<Index>(soup.positions.size());
        for (Index v : t) soup.positions.push_back(asset.parts[1].positions[v]);
        soup.triangles.push_back({n, n + 1, n + 2});
    }
    asset.parts[1] = soup;
    Options options;
    options.budget = Budget::mesh;
    options.target = ratio(0.25);
    CHECK(simplify_parts(asset, options).parts[1].report.target_faces == 50);
}

TEST_CASE("the counts of the report are sums over the parts") {
    Asset asset;
    asset.parts = {bumpy(20), bumpy(10)};
    Options options;
    options.preset = Preset::best;
    const SmallParts small = simplify_parts(asset, options);
    const Report &sum = small.report, &a = small.parts[0].report, &b = small.parts[1].report;
    CHECK(sum.faces_in == a.faces_in + b.faces_in);
    CHECK(sum.vertices_out == a.vertices_out + b.vertices_out);
    CHECK(sum.collapses == a.collapses + b.collapses);
    CHECK(sum.vertices_relaxed == a.vertices_relaxed + b.vertices_relaxed);
    CHECK(sum.vertices_relaxed > 0);
}

TEST_CASE("cancelling the first stage leaves the second nothing to do") {
    Asset asset;
    asset.parts = {bumpy(20), bumpy(20)};
    Options options;
    options.budget = GENERATE(Budget::scene, Budget::mesh);
    options.progress = [](Phase, double) { return Continue::cancel; };
    const LightAsset light = simplify(asset, options);
    CHECK(light.report.stop == StopReason::cancelled);
    CHECK(light.asset.parts.empty());
}

TEST_CASE("progress over several parts goes from 0 to 1 and never back") {
    Asset asset;
    asset.parts = {bumpy(60), bumpy(40)};
    Options options;
    options.budget = GENERATE(Budget::scene, Budget::mesh);
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

TEST_CASE("the result of the whole way shows the source's colours") {
    // A bumpy sheet whose texture is a ramp over its plan: colour tells place.
    Asset asset = textured_square(ramp(128));
    asset.parts = {bumpy(24)};
    Part& part = asset.parts[0];
    part.uvs.resize(1);
    for (const Vec3& p : part.positions) {
        part.uvs[0].push_back({static_cast<float>(p[0] / 24), static_cast<float>(p[1] / 24)});
    }
    part.face_material.assign(part.triangles.size(), 0);
    Options options;
    options.target = ratio(0.2);
    options.bake.texture_size = 512;
    options.bake.mapping = GENERATE(Mapping::projection, Mapping::lineage);
    options.history = Recording::on;
    const LightAsset light = simplify(asset, options);
    REQUIRE(light.asset.parts[0].triangles.size() <= part.triangles.size() / 5);
    CHECK(light.histories.size() == 1);
    const Pixels atlas = decode(light.asset.images[0]), painted = ramp(128);
    const Part& out = light.asset.parts[0];
    double error = 0, count = 0;
    for (std::size_t f = 0; f < out.triangles.size(); ++f) {
        for (const Vec3& w : spread(8)) {
            const auto p = blend(out.positions, out.triangles[f], w);
            const auto expected = read(painted, p[0] / 24, p[1] / 24), got = look(out, atlas, f, w);
            for (std::size_t k = 0; k < 2; ++k) error += std::abs(expected[k] - got[k]);
            count += 2;
        }
    }
    // The ramp spans 180 levels over 24 cells, 7.5 a cell. Lineage ends at vertices, about a cell away;
    // projection hardly errs at all.
    CHECK(error / count < (options.bake.mapping == Mapping::projection ? 2.5 : 7.5));
    CHECK(light.report.seconds.bake > 0);
}
