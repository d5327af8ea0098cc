#include "faqem/detail/simplify/prune_components.hpp"

#include <limits>

#include "faqem/compare.hpp"
#include "faqem/error.hpp"
#include "faqem/simplify.hpp"
#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace faqem;
using detail::prune;
using detail::PruneResult;

namespace {

constexpr Triangle no_face = {no_index, no_index, no_index};

// Tetrahedra of these sizes in a row; the bounding box of one of size s has the diagonal s sqrt(3).
TriangleMesh tetrahedra(const std::vector<double>& sizes) {
    TriangleMesh mesh;
    double x = 0;
    for (const double size : sizes) {
        mesh = test::both(mesh, test::moved(test::scaled(test::tetrahedron(), size), {x, 0, 0}));
        x += 2 * size;
    }
    return mesh;
}

// Indices of the tetrahedra that are kept.
std::vector<std::size_t> left(const std::vector<double>& sizes, const Length& size,
                              const std::vector<std::uint8_t>& locked = {}) {
    const TriangleMesh mesh = tetrahedra(sizes);
    std::vector<Triangle> triangles = mesh.triangles;
    const PruneResult pruned = prune(mesh.positions, locked, size, triangles);
    std::vector<std::size_t> result;
    for (std::size_t i = 0; i < sizes.size(); ++i) {
        const bool is_removed = triangles[4 * i] == no_face;
        for (std::size_t k = 1; k < 4; ++k) CHECK((triangles[4 * i + k] == no_face) == is_removed);
        if (!is_removed) result.push_back(i);
    }
    CHECK(pruned.components == sizes.size() - result.size());
    CHECK(pruned.faces.size() == 4 * pruned.components);
    for (const detail::PrunedFace& face : pruned.faces) CHECK(face.corners == mesh.triangles[face.face]);
    return result;
}

using Which = std::vector<std::size_t>;

Options pruning(const Length& size, double keep = 1) {
    return {.target = ratio(keep), .topology = {.prune = size}};
}

// A sphere with two small components beside it, a tetrahedron and a quad.
TriangleMesh dusty() {
    const TriangleMesh speck = test::moved(test::scaled(test::tetrahedron(), 0.01), {1.5, 0, 0});
    const TriangleMesh scrap = test::moved(test::scaled(test::quad(), 0.02), {0, 0, 3});
    return test::both(test::both(speck, test::icosphere(3)), scrap);
}

}  // namespace

TEST_CASE("components whose bounding box has a smaller diagonal than the size are pruned") {
    const double root = std::sqrt(3.0);
    CHECK(left({1, 4, 2, 0.5}, model_units(1.01 * root)) == Which{1, 2});
    CHECK(left({1, 4, 2, 0.5}, model_units(0.99 * root)) == Which{0, 1, 2});
    CHECK(left({1, 4, 2, 0.5}, model_units(0.1)) == Which{0, 1, 2, 3});
}

TEST_CASE("a prune size of_diagonal refers to the bounding box of the whole mesh") {
    // The tetrahedra of sizes 1 and 3 extend from 0 to 5 along x, and over 3 along y and z.
    const double share = std::sqrt(3.0) / std::sqrt(25.0 + 9 + 9);
    CHECK(left({1, 3}, of_diagonal(0.99 * share)) == Which{0, 1});
    CHECK(left({1, 3}, of_diagonal(1.01 * share)) == Which{1});
}

TEST_CASE("the largest component is never pruned and of equal ones the first is kept") {
    CHECK(left({1, 4, 2, 4}, model_units(1e300)) == Which{1});
    CHECK(left({1, 1}, of_diagonal(10)) == Which{0});
    CHECK(left({}, model_units(1)).empty());
}

TEST_CASE("components with a locked vertex are not pruned") {
    std::vector<std::uint8_t> locked(12, 0);
    locked[9] = 1;
    CHECK(left({1, 4, 2}, model_units(1e3), locked) == Which{1, 2});
}

TEST_CASE("pruning works for coordinates from 1e-300 to 1e307") {
    for (const double scale : {1e-300, 1e-150, 1e150, 1e307}) {
        CAPTURE(scale);
        CHECK(left({scale, 3 * scale}, of_diagonal(0.3)) == Which{1});
        CHECK(left({scale, 3 * scale}, model_units(scale)) == Which{0, 1});
    }
}

TEST_CASE("components that share a vertex after welding are pruned as one component") {
    // Two tetrahedra with a vertex at the same position, and a separate one of the same size.
    const TriangleMesh pair = test::both(test::tetrahedron(), test::moved(test::tetrahedron(), {1, 0, 0}));
    const TriangleMesh mesh = test::both(pair, test::moved(test::tetrahedron(), {5, 0, 0}));
    Options options = pruning(model_units(2));
    const SimplifyResult result = simplify(mesh.view(), options);
    CHECK(result.report.components_pruned == 1);
    CHECK(result.mesh.triangles.size() == 8);
    options.topology.weld = Weld::none;
    CHECK(simplify(mesh.view(), options).report.components_pruned == 2);
}

TEST_CASE("pruned components are counted, reported and recorded in the history") {
    const TriangleMesh mesh = dusty();
    Options options = pruning(of_diagonal(0.02), 0.1);
    options.history = Recording::on;
    for (const Preset preset : all_presets) {
        CAPTURE(name(preset));
        options.preset = preset;
        const SimplifyResult result = simplify(mesh.view(), options);
        CHECK(result.report.components_pruned == 2);
        CHECK(result.report.faces_pruned == 6);
        CHECK(result.report.components_deleted == 0);
        CHECK(result.report.faces_dropped == 0);
        CHECK(result.report.faces_in == mesh.triangles.size());
        CHECK(result.report.faces_out <= result.report.target_faces);
        REQUIRE(result.report.warnings.size() == 1);
        CHECK(result.report.warnings[0].find("pruned") != std::string::npos);
        for (const Index f : result.face_origin) CHECK((f >= 4 && f < 4 + 1280));
        const CollapseHistory& history = result.history;
        CHECK_NOTHROW(validate(history));
        REQUIRE(history.deleted_faces.size() == 6);
        for (const DeletedFace& deleted : history.deleted_faces) CHECK(deleted.time == 0);
        for (std::size_t f = 0; f < mesh.triangles.size(); ++f) CHECK(history.triangles[f] != no_face);
        CHECK(replay(history).positions == result.mesh.positions);
        CHECK(replay(history).triangles == result.mesh.triangles);
    }
}

TEST_CASE("a pruned mesh is simplified like the mesh without its small components") {
    const TriangleMesh clean = test::icosphere(3);
    const TriangleMesh mesh = test::both(clean, test::scaled(test::tetrahedron(), 0.01));
    Options options{.target = faces(128)};
    const SimplifyResult without = simplify(clean.view(), options);
    options.topology.prune = of_diagonal(0.02);
    const SimplifyResult pruned = simplify(mesh.view(), options);
    CHECK(pruned.mesh.positions == without.mesh.positions);
    CHECK(pruned.mesh.triangles == without.mesh.triangles);
    CHECK(pruned.report.collapses == without.report.collapses);
}

TEST_CASE("max_error ignores pruned components") {
    Options options{.max_error = of_diagonal(0.01)};
    const TriangleMesh mesh = dusty();
    const double diagonal = info(mesh.view()).diagonal;
    options.topology.prune = of_diagonal(0.02);
    const SimplifyResult result = simplify(mesh.view(), options);
    REQUIRE(result.report.max_error);
    CHECK(result.report.components_pruned == 2);
    CHECK(result.report.max_error->allowed == Approx(0.01 * diagonal));
    CHECK(result.report.max_error->within());
    CHECK(result.report.faces_out < 640);
    CHECK(hausdorff(test::icosphere(3).view(), result.mesh.view()).value <= 0.01 * diagonal);
}

TEST_CASE("a prune size must be finite and positive") {
    for (const double bad :
         {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        CHECK_THROWS_WITH(simplify(dusty().view(), pruning(model_units(bad))),
                          ContainsSubstring("prune must be finite and > 0"));
        CHECK_THROWS_AS(simplify(dusty().view(), pruning(of_diagonal(bad))), OptionError);
    }
}
