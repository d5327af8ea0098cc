#include "scene/motion.hpp"

#include <algorithm>
#include <cmath>

#include "faqem/bake.hpp"
#include "faqem/bake_levels.hpp"
#include "support/catch.hpp"
#include "support/scenes.hpp"

using namespace faqem;
using detail::motion_rounding;
using detail::welded_by_motion;

namespace {

// Two sheets of 2 n^2 faces that touch at y = 0, with vertices of their own: above (y >= 0) comes first.
Part touching_sheets(Index n) {
    const auto wave = [](double x, double y) { return Vec3{x, y, 0.3 * x * std::sin(0.5 * y)}; };
    Part part = test::sheet(n, wave);
    const Part below = test::sheet(n, [&](double x, double y) {
        const Vec3 p = wave(x, -y);
        return Vec3{p[0], p[1], -p[2]};
    });
    const auto first = static_cast<Index>(part.positions.size());
    part.positions.insert(part.positions.end(), below.positions.begin(), below.positions.end());
    for (const Triangle& t : below.triangles)
        part.triangles.push_back({t[0] + first, t[2] + first, t[1] + first});
    part.face_material.clear();
    return part;
}

// The sheets follow joints 0 and 1.
Part skinned_sheets(Index n) {
    Part part = touching_sheets(n);
    const std::size_t half = part.positions.size() / 2;
    part.joints.resize(2 * half, {0, 0, 0, 0});
    part.weights.resize(2 * half, {1, 0, 0, 0});
    for (std::size_t v = half; v < 2 * half; ++v) part.joints[v] = {1, 0, 0, 0};
    return part;
}

// A morph target lifts the upper sheet.
Part opening_sheets(Index n) {
    Part part = touching_sheets(n);
    part.morph_targets.resize(1);
    part.morph_targets[0].positions.resize(part.positions.size(), {0, 0, 0});
    for (std::size_t v = 0; v < part.positions.size() / 2; ++v)
        part.morph_targets[0].positions[v] = {0, 2, 0};
    return part;
}

std::vector<Triangle> welded(const Part& part) {
    return welded_by_motion(part, motion_rounding(Asset{}, part), 0);
}

constexpr Index cells = 24;

double height(double x, double y) { return 4 * std::sin(0.3 * x) * std::cos(0.25 * y); }

// A flat sheet of 1,152 faces that a morph target bends.
Part bending_sheet() {
    Part part = test::sheet(cells, [](double x, double y) { return Vec3{x, y, 0}; });
    part.face_material.clear();
    part.morph_targets.resize(1);
    for (const Vec3& p : part.positions)
        part.morph_targets[0].positions.push_back({0, 0, static_cast<float>(height(p[0], p[1]))});
    return part;
}

// The largest vertical distance of the posed result from the surface, over the centroids and edge midpoints of its
// faces.
double largest_error(const Part& part) {
    double most = 0;
    for (const Triangle& t : part.triangles) {
        for (const Vec3& w : {Vec3{0.5, 0.5, 0}, {0, 0.5, 0.5}, {0.5, 0, 0.5}, {1.0 / 3, 1.0 / 3, 1.0 / 3}}) {
            const auto rest = test::blend(part.positions, t, w);
            const auto shift = test::blend(part.morph_targets[0].positions, t, w);
            most = std::max(most, std::abs(rest[2] + shift[2] - height(rest[0], rest[1])));
        }
    }
    return most;
}

}  // namespace

TEST_CASE("vertices at one position with different joints or displacements are not welded") {
    for (const Part& part : {skinned_sheets(3), opening_sheets(3)}) CHECK(welded(part) == part.triangles);
}

TEST_CASE("a part of which all vertices at one position move together has no weld of its own") {
    CHECK(welded(touching_sheets(2)).empty());
    Part same = skinned_sheets(2);
    std::fill(same.joints.begin(), same.joints.end(), std::array<std::uint16_t, 4>{0, 0, 0, 0});
    CHECK(welded(same).empty());
    // The same weights in another order, and split into two entries of one joint.
    for (std::size_t v = 0; v < same.positions.size(); ++v) {
        same.joints[v] =
            v % 2 ? std::array<std::uint16_t, 4>{5, 7, 5, 0} : std::array<std::uint16_t, 4>{7, 5, 0, 0};
        same.weights[v] = v % 2 ? Vec4f{0.5f, 0.25f, 0.25f, 0} : Vec4f{0.25f, 0.75f, 0, 0};
    }
    CHECK(welded(same).empty());
}

TEST_CASE("differences by the rounding of the file do not separate vertices") {
    Part part = skinned_sheets(2);
    const std::size_t half = part.positions.size() / 2;
    const float by = GENERATE(0.5f, 2.0f) / 255;
    for (std::size_t v = 0; v < part.positions.size(); ++v) {
        part.joints[v] = {0, 1, 0, 0};
        part.weights[v] = {0.5f, 0.5f, 0, 0};
        if (v >= half) part.weights[v] = {0.5f + by, 0.5f - by, 0, 0};
    }
    detail::MotionRounding rounding;
    rounding.weight = 1.0 / 255;
    CHECK(welded_by_motion(part, rounding, 0).empty() == (by < 1.0f / 255));
}

TEST_CASE("vertices that move together are welded beside some that do not") {
    // Three vertices at the origin: the first and the last have the same joint.
    Part part;
    part.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {-1, 0, 0},
                      {0, 1, 0}, {0, 0, 0}, {0, 1, 1}, {1, 0, 0}};
    part.triangles = {{0, 1, 2}, {3, 5, 4}, {6, 7, 8}};
    part.joints.resize(9, {0, 0, 0, 0});
    part.weights.resize(9, {1, 0, 0, 0});
    for (const std::size_t v : {3u, 4u, 5u}) part.joints[v] = {1, 0, 0, 0};
    CHECK(welded(part) == std::vector<Triangle>{{0, 1, 2}, {3, 5, 4}, {0, 7, 1}});
}

TEST_CASE("what moves apart stays apart in the result, with its own joints") {
    Asset asset = test::asset_with({skinned_sheets(10)});
    const SimplifiedAsset result = simplify(asset, {.target = ratio(0.2)});
    const Part& part = result.asset.parts[0];
    REQUIRE(part.joints.size() == part.positions.size());
    REQUIRE(part.triangles.size() > 40);
    for (const Triangle& t : part.triangles) {
        double y = 0;
        for (const Index v : t) y += part.positions[v][1] / 3;
        for (const Index v : t) {
            CHECK(part.joints[v][0] == (y < 0 ? 1 : 0));
            CHECK(part.weights[v][0] == Approx(1));
        }
    }
}

TEST_CASE("closed lips can be opened by a morph target of the result") {
    Asset asset = test::asset_with({opening_sheets(10)});
    const SimplifiedAsset result = simplify(asset, {.target = ratio(0.2)});
    const Part& part = result.asset.parts[0];
    REQUIRE(part.morph_targets.size() == 1);
    for (const Triangle& t : part.triangles) {
        double y = 0;
        for (const Index v : t) y += part.positions[v][1] / 3;
        for (const Index v : t)
            CHECK(std::abs(part.morph_targets[0].positions[v][1] - (y > 0 ? 2 : 0)) < 1e-5);
    }
}

TEST_CASE("a sheet that is flat at rest keeps its shape in a morph target") {
    Asset asset = test::asset_with({bending_sheet()});
    const SimplifiedAsset result = simplify(asset, {.target = ratio(0.15)});
    const Part& part = result.asset.parts[0];
    CHECK(part.triangles.size() <= 172);
    CHECK(part.triangles.size() >= 130);
    REQUIRE(part.morph_targets.size() == 1);
    CHECK(largest_error(part) < 1);
    for (const Vec3& p : part.positions) CHECK(std::abs(p[2]) < 1e-5);
}

TEST_CASE("beside a bumpy part, a flat part with a shape in a morph target gets faces") {
    Asset asset = test::asset_with({bending_sheet(), test::sheet(cells, [](double x, double y) {
                                        return Vec3{x, y, height(x, y)};
                                    })});
    asset.parts[1].face_material.clear();
    const SimplifiedParts result = simplify_parts(asset, {.target = ratio(0.2)});
    CHECK(result.parts[0].mesh.triangles.size() > 140);
    CHECK(result.report.faces_out <= 460);
}

TEST_CASE("all levels of a sheet keep its shape") {
    Asset asset = test::asset_with({bending_sheet()});
    const auto levels = simplify_levels(asset, {Level{ratio(0.4)}, Level{ratio(0.15)}}, {});
    REQUIRE(levels.size() == 2);
    for (const auto& level : levels) CHECK(largest_error(level.result.asset.parts[0]) < 1);
}

TEST_CASE("only parts that are flat at rest and not in a morph target are bent, by a share of 2e-7") {
    const auto bent = [](const Part& part) {
        return detail::bent_positions(part, {part.positions, part.triangles}, {}, {}, 100);
    };
    Part part = bending_sheet();
    const std::vector<Vec3> found = bent(part);
    REQUIRE(found.size() == part.positions.size());
    double most = 0;
    for (std::size_t v = 0; v < found.size(); ++v) {
        most = std::max(most, std::abs(found[v][2]));
        CHECK(found[v][2] * part.morph_targets[0].positions[v][2] >= 0);
        CHECK(found[v][0] == part.positions[v][0]);
    }
    CHECK(most == Approx(2e-7 * cells * std::sqrt(2.0)));
    // A rigid motion has no shape.
    for (Vec3f& shift : part.morph_targets[0].positions) shift = {1, 2, 3};
    CHECK(bent(part).empty());
    for (Vec3f& shift : part.morph_targets[0].positions) shift = {0, 0, 0};
    CHECK(!detail::has_displacements(part));
    CHECK(detail::has_displacements(bending_sheet()));
    Part bumpy = bending_sheet();
    for (Vec3& p : bumpy.positions) p[2] = height(p[0], p[1]);
    CHECK(bent(bumpy).empty());
}
