#include "scene/removed_components.hpp"

#include "support/catch.hpp"
#include "support/scenes.hpp"

using namespace faqem;
using namespace faqem::test;

namespace {

// Separate triangles in a row; `size` is the length of their legs.
Part triangles(Index count, double size) {
    Part part;
    for (Index i = 0; i < count; ++i) {
        for (const Vec3& p : {Vec3{2.0 * i, 0, 0}, {2.0 * i + size, 0, 0}, {2.0 * i, size, 0}})
            part.positions.push_back(p);
        part.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    return part;
}

}  // namespace

TEST_CASE("removed components of a scene are named with their part, and the shares are those of the scene") {
    Asset asset;
    asset.parts = {triangles(5, 1), triangles(4, 2)};
    asset.parts[0].name = "small";
    Options options{.target = faces(8), .budget = Budget::mesh, .preset = Preset::fast};
    const SimplifiedParts result = simplify_parts(asset, options);
    REQUIRE(result.report.faces_out == 8);
    REQUIRE(result.report.removed_components.size() == 1);
    const RemovedComponent& removed = result.report.removed_components[0];
    CHECK(removed.part == "part 'small'");
    CHECK(removed.faces == 1);
    CHECK(removed.area_share == Approx(1.0 / 21));
    CHECK(
        result.report.warnings.back().starts_with("a visible component was removed: 1 face in part 'small'"));
}

TEST_CASE("no component of a scene is listed if all have faces in the result") {
    Asset asset;
    asset.parts = {triangles(4, 1), triangles(4, 2)};
    const SimplifiedParts result = simplify_parts(asset, {});
    CHECK(result.report.removed_components.empty());
}
