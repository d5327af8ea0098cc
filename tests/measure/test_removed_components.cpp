#include "faqem/detail/measure/removed_components.hpp"

#include <vector>

#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace faqem;

namespace {

// removed_components() of a mesh, of which a result has these components, scaled.
detail::FoundComponents removed_of(const TriangleMesh& mesh, const std::vector<Vec3>& scales) {
    const detail::FaceComponents components = detail::face_components(mesh.positions, mesh.triangles);
    REQUIRE(components.count == scales.size());
    std::vector<detail::PlacedFace> source, result;
    detail::append_placed_faces(source, mesh.triangles, components.component,
                                [&](Index v) { return mesh.positions[v]; });
    for (detail::PlacedFace face : source) {
        for (Vec3& p : face.corners)
            for (int axis = 0; axis < 3; ++axis) p[axis] *= scales[face.component][axis];
        if (scales[face.component] != Vec3{}) result.push_back(face);
    }
    return detail::removed_components(source, result, scales.size());
}

constexpr Vec3 left = {1, 1, 1}, gone = {};

// A square of side 1 at z = 0 and one of the given side beside it.
TriangleMesh two_squares(double side) {
    return test::both(test::quad(), test::moved(test::scaled(test::quad(), side), {1.5, 0, 0}));
}

}  // namespace

TEST_CASE("removed components: faces at equal positions are one component, also without common vertices") {
    const TriangleMesh split = test::make(
        {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {1, 1, 0}, {0, 1, 0}, {5, 0, 0}, {6, 0, 0}, {6, 1, 0}},
        {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}});
    const detail::FaceComponents found = detail::face_components(split.positions, split.triangles);
    CHECK(found.count == 2);
    CHECK(found.component == std::vector<Index>{0, 0, 1});
}

TEST_CASE("removed components: nothing is listed if every component is left") {
    CHECK(removed_of(two_squares(1), {left, left}).removed.empty());
}

TEST_CASE("removed components: the share of the area is that of the removed square") {
    const auto found = removed_of(two_squares(1), {left, gone}).removed;
    REQUIRE(found.size() == 1);
    CHECK(found[0].component == 1);
    CHECK(found[0].removed.faces == 2);
    CHECK(found[0].removed.area_share == Approx(0.5));
    CHECK(found[0].removed.box_min == Vec3{1.5, 0, 0});
    CHECK(found[0].removed.box_max == Vec3{2.5, 1, 0});
}

TEST_CASE("removed components: components up to 0.5% of the area are not listed") {
    CHECK(removed_of(two_squares(0.07), {left, gone}).removed.empty());
    CHECK(removed_of(two_squares(0.075), {left, gone}).removed.size() == 1);
}

TEST_CASE("removed components: a warning tells of small ones that had more than 2% of the area together") {
    const auto warnings_without = [](std::size_t count) {
        TriangleMesh mesh = test::quad();
        for (std::size_t i = 0; i < count; ++i)
            mesh =
                test::both(mesh, test::moved(test::scaled(test::quad(), 0.07), {2 + 0.1 * double(i), 0, 0}));
        std::vector<Vec3> scales(count + 1, gone);
        scales[0] = left;
        const detail::FoundComponents found = removed_of(mesh, scales);
        CHECK(found.small == count);
        CHECK(found.small_share == Approx(0.0049 * double(count) / (1 + 0.0049 * double(count))));
        Report report;
        detail::warn_of_removed_components(report, found);
        return report.warnings;
    };
    CHECK(warnings_without(4).empty());
    const std::vector<std::string> warnings = warnings_without(5);
    REQUIRE(warnings.size() == 1);
    CHECK(warnings[0].starts_with("5 small components were removed, together 2.4% of the area;"));
}

TEST_CASE("removed components: the largest share comes first, and shares do not depend on the scale") {
    for (const double scale : {1e-300, 1.0, 1e300}) {
        const TriangleMesh mesh =
            test::both(two_squares(0.5), test::moved(test::scaled(test::quad(), 0.8), {0, 2, 0}));
        const auto found = removed_of(test::scaled(mesh, scale), {left, gone, gone}).removed;
        REQUIRE(found.size() == 2);
        CHECK(found[0].component == 2);
        CHECK(found[1].component == 1);
        CHECK(found[0].removed.area_share == Approx(0.64 / 1.89));
    }
}

TEST_CASE("removed components: one whose box lost more than a fifth of its longest side has shrunk") {
    CHECK(removed_of(two_squares(1), {left, {1, 0.81, 1}}).shrunk.empty());
    const auto found = removed_of(two_squares(1), {left, {1, 0.79, 1}}).shrunk;
    REQUIRE(found.size() == 1);
    CHECK(found[0].component == 1);
    CHECK(found[0].removed.box_max == Vec3{2.5, 1, 0});
    CHECK(removed_of(two_squares(0.07), {left, {1, 0.5, 1}}).shrunk.empty());  // too small to be seen
}

TEST_CASE("removed components: a rod that is cut in half is named in the report") {
    const TriangleMesh rod = test::moved(test::scaled(test::icosphere(0), 0.1), {3, 0, 0});
    SimplifyResult result = simplify(test::both(test::icosphere(2), rod).view(), {.target = ratio(1.0)});
    CHECK(result.report.shrunk_components.empty());
    for (Vec3& p : result.mesh.positions) p[0] = std::min(p[0], 3.0);
    result.report.warnings.clear();
    detail::report_removed_components(test::both(test::icosphere(2), rod).view(), result);
    REQUIRE(result.report.shrunk_components.size() == 1);
    CHECK(result.report.shrunk_components[0].faces == 20);
    REQUIRE(result.report.warnings.size() == 1);
    CHECK(result.report.warnings[0].starts_with(
        "a visible component lost more than a fifth of its length: 20 faces, "));
}

TEST_CASE("removed components: a visible component that is collapsed is named in the report") {
    // Five separate triangles. At four faces, one of them has vanished.
    const TriangleMesh triangle = test::make({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
    TriangleMesh mesh = triangle;
    for (int i = 1; i < 5; ++i) mesh = test::both(mesh, test::moved(triangle, {1.5 * i, 0, 0}));
    const SimplifyResult result = simplify(mesh.view(), {.target = faces(4), .preset = Preset::fast});
    REQUIRE(result.mesh.triangles.size() == 4);
    CHECK(result.report.components_collapsed + result.report.components_deleted == 1);
    REQUIRE(result.report.removed_components.size() == 1);
    CHECK(result.report.removed_components[0].faces == 1);
    CHECK(result.report.removed_components[0].area_share == Approx(0.2));
    REQUIRE_FALSE(result.report.warnings.empty());
    CHECK(result.report.warnings.back().starts_with(
        "a visible component was removed: 1 face, 20% of the area"));
}

TEST_CASE("removed components: a run that removes none reports none") {
    Options options{.target = ratio(0.5)};
    const SimplifyResult result = simplify(test::icosphere(2).view(), options);
    CHECK(result.report.components_collapsed == 0);
    CHECK(result.report.removed_components.empty());
    CHECK(result.report.warnings.empty());
}
