// Surfaces that lie close to others keep their side.

#include "faqem/bake.hpp"
#include "scene/layers.hpp"
#include "support/catch.hpp"
#include "support/meshes.hpp"
#include "support/rays.hpp"
#include "support/scenes.hpp"

using namespace faqem;
using namespace faqem::test;

namespace {

// A sphere of radius 1, and one with other faces that is shifted along x.
Asset spheres(double radius, double shift) {
    return asset_with({part_of(icosphere(4)), part_of(moved(globe(40, radius), {shift, 0, 0}))});
}

SimplifiedParts simplified(const Asset& asset, Preset preset) {
    return simplify_parts(asset, {.target = ratio(0.03), .preset = preset});
}

// Share of directions in which the outer sphere is inside the inner one.
double share_crossed(const SimplifiedParts& result) {
    const TriangleMesh directions = icosphere(4);
    double crossed = 0;
    for (const Vec3& d : directions.positions)
        crossed +=
            !(ray_hits(result.parts[0].mesh, {}, d).at(0) < ray_hits(result.parts[1].mesh, {}, d).at(0));
    return crossed / static_cast<double>(directions.positions.size());
}

}  // namespace

TEST_CASE("a surface close around another one stays outside") {
    const Asset asset = spheres(1.005, 0);
    CHECK(share_crossed(simplified(asset, Preset::fast)) > 0.2);
    for (const Preset preset : {Preset::balanced, Preset::best})
        CHECK(share_crossed(simplified(asset, preset)) < 0.02);
}

TEST_CASE("surfaces that are not close to others do not move") {
    CHECK(simplified(spheres(1.005, 0), Preset::balanced).report.vertices_fitted > 0);
    CHECK(simplified(spheres(1.005, 3), Preset::balanced).report.vertices_fitted == 0);
    CHECK(simplified(spheres(2, 0), Preset::balanced).report.vertices_fitted == 0);
}

TEST_CASE("layers are not separated if distances to the source are limited") {
    const Asset asset = spheres(1.005, 0);
    CHECK(detail::separates_layers(asset, {}));
    CHECK_FALSE(detail::separates_layers(asset, {.max_error = MaxError{}}));
    CHECK_FALSE(detail::separates_layers(asset, {.preset = Preset::fast}));
}
