#include "scene/motion.hpp"

#include <algorithm>
#include <cmath>

#include "faqem/bake.hpp"
#include "faqem/bake_levels.hpp"
#include "support/catch.hpp"
#include "support/scenes.hpp"

using namespace faqem;

namespace {

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

TEST_CASE("a sheet that is flat at rest keeps its shape in a morph target") {
    Asset asset;
    asset.parts = {bending_sheet()};
    Options options{.target = ratio(0.15)};
    const SimplifiedAsset result = simplify(asset, options);
    const Part& part = result.asset.parts[0];
    CHECK(part.triangles.size() <= 172);
    CHECK(part.triangles.size() >= 130);
    REQUIRE(part.morph_targets.size() == 1);
    CHECK(largest_error(part) < 1);
    for (const Vec3& p : part.positions) CHECK(std::abs(p[2]) < 1e-5);
}

TEST_CASE("beside a bumpy part, a flat part with a shape in a morph target gets faces") {
    Asset asset;
    asset.parts = {bending_sheet(), test::sheet(cells, [](double x, double y) {
                       return Vec3{x, y, height(x, y)};
                   })};
    asset.parts[1].face_material.clear();
    Options options{.target = ratio(0.2)};
    const SimplifiedParts result = simplify_parts(asset, options);
    CHECK(result.parts[0].mesh.triangles.size() > 140);
    CHECK(result.report.faces_out <= 460);
}

TEST_CASE("all levels of a sheet keep its shape") {
    Asset asset;
    asset.parts = {bending_sheet()};
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
