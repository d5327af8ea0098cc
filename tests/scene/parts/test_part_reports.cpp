// The report of a scene as the sum over its parts, with the components that were removed.

#include <string>
#include <vector>

#include "scene/parts/part_reports.hpp"
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

TEST_CASE("part reports: a part with UVs has its own counts and warnings, but not a target of its own") {
    Asset source;
    source.parts.resize(2);
    source.parts[0].name = "a", source.parts[1].name = "b";
    SimplifiedParts simplified;
    simplified.parts.resize(2), simplified.with_uvs.resize(2);
    for (std::size_t p = 0; p < 2; ++p) {
        Report &without = simplified.parts[p].report, &with = simplified.with_uvs[p].report;
        without.faces_in = with.faces_in = 100;
        without.target_faces = without.faces_out = 12;
        with.target_faces = with.faces_out = 11;
        without.refusals.fill(3), with.refusals.fill(5);
        without.rungs.fill(1), with.rungs.fill(0);
        without.warnings = {"one"}, with.warnings = {"two"};
        detail::add_part_report(simplified.report, without, p == 0 ? "part 'a'" : "part 'b'");
    }
    simplified.report.warnings.push_back("of the whole");
    const Report report = detail::report_with_uvs(source, simplified, std::vector<Index>{1});
    CHECK(report.faces_in == 200);
    CHECK(report.faces_out == 23);
    CHECK(report.target_faces == 24);
    CHECK(report.refusals[0] == 8);
    CHECK(report.rungs[0] == 1);
    CHECK(report.warnings == std::vector<std::string>{"part 'a': one", "of the whole", "part 'b': two"});
}

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
