#include "bake/scene/visibility.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "faqem/bake.hpp"
#include "support/meshes.hpp"

using namespace faqem;
using detail::min_visibility;
using detail::vertex_visibility;
using detail::VertexVisibility;
using test::icosphere;
using test::inside_out;
using test::moved;
using test::scaled;

namespace {

Part part_of(const TriangleMesh& mesh, Index material = no_index) {
    Part part;
    part.positions = mesh.positions;
    part.triangles = mesh.triangles;
    part.face_material.assign(mesh.triangles.size(), material);
    return part;
}

// A sphere in a sphere, twice as large, of a material that may be changed.
Asset shell_around(const TriangleMesh& inner, int level = 2) {
    Asset asset;
    asset.materials.resize(1);
    asset.parts = {part_of(inner), part_of(scaled(icosphere(level), 2), 0)};
    return asset;
}

float least(const std::vector<float>& weights) { return *std::min_element(weights.begin(), weights.end()); }
float most(const std::vector<float>& weights) { return *std::max_element(weights.begin(), weights.end()); }

}  // namespace

TEST_CASE("all of a convex solid is seen, turned out or in, coarse or fine") {
    const int level = GENERATE(0, 2, 6);
    Asset asset;
    asset.parts = {part_of(GENERATE_COPY(icosphere(level), inside_out(icosphere(level))))};
    const VertexVisibility seen = vertex_visibility(asset);
    CHECK(seen.hidden_vertices == 0);
    REQUIRE(seen.weights.size() == 1);
    CHECK(seen.weights[0].size() == asset.parts[0].positions.size());
    CHECK(least(seen.weights[0]) == 1);
}

TEST_CASE("a sheet is seen, from both sides no more than from one") {
    Asset asset;
    asset.parts = {part_of(test::grid(4))};
    CHECK(vertex_visibility(asset).weights[0] == std::vector<float>(25, 1));
}

TEST_CASE("what is in a closed shell is hidden, and the shell is not") {
    const Asset asset = shell_around(icosphere(GENERATE(1, 5)), GENERATE(2, 5));
    const VertexVisibility seen = vertex_visibility(asset);
    CHECK(seen.hidden_vertices == asset.parts[0].positions.size());
    CHECK(most(seen.weights[0]) == min_visibility);
    CHECK(least(seen.weights[1]) == 1);
}

TEST_CASE("a shell that can be looked through hides nothing") {
    Asset asset = shell_around(icosphere(2));
    Material& material = asset.materials[0];
    SECTION("blended") { material.alpha_mode = AlphaMode::blend; }
    SECTION("with holes in its texture") { material.alpha_mode = AlphaMode::mask; }
    SECTION("of glass") { material.extensions = {"KHR_materials_ior", "KHR_materials_transmission"}; }
    CHECK(vertex_visibility(asset).hidden_vertices == 0);
    CHECK(least(vertex_visibility(asset).weights[0]) == 1);
}

TEST_CASE("a shell that shows its back only hides nothing, unless it has two sides") {
    Asset asset = shell_around(icosphere(2));
    asset.parts[1] = part_of(scaled(inside_out(icosphere(2)), 2), 0);
    CHECK(vertex_visibility(asset).hidden_vertices == 0);
    asset.materials[0].double_sided = true;
    CHECK(vertex_visibility(asset).hidden_vertices == asset.parts[0].positions.size());
}

TEST_CASE("of the floor of a well, as much is seen as its rim leaves open") {
    // The cosine-weighted share of a disc of radius 1 at height h is 1 / (1 + h^2). The floor is a cross of
    // small faces in its middle; from below it is hidden by a lid.
    const double height = GENERATE(0.5, 1.0, 2.0, 4.0);
    Asset asset;
    asset.materials.resize(1);
    asset.materials[0].double_sided = true;
    asset.parts = {part_of(moved(scaled(test::square(1, 0.02, 0), 1), {-0.01, -0.01, 0.01})),
                   part_of(test::cylinder(64, 1, height), 0),
                   part_of(moved(test::square(1, 4, 0), {-2, -2, 0}), 0)};
    const VertexVisibility seen = vertex_visibility(asset);
    for (const float share : seen.weights[0]) CHECK(share == Approx(1 / (1 + height * height)).margin(0.12));
}

TEST_CASE("both faces of a thin plate on a block are told apart") {
    // A plate of 1 x 1 x 0.001 lies on a block of 4 x 4 x 2: only its lower corners are hidden.
    TriangleMesh plate = test::cube(), block = test::cube();
    const auto stretched = [](TriangleMesh mesh, const Vec3& low, const Vec3& size) {
        Vec3 least = mesh.positions[0], most = least;
        for (const Vec3& p : mesh.positions)
            for (std::size_t i = 0; i < 3; ++i) {
                least[i] = std::min(least[i], p[i]);
                most[i] = std::max(most[i], p[i]);
            }
        for (Vec3& p : mesh.positions)
            for (std::size_t i = 0; i < 3; ++i)
                p[i] = low[i] + size[i] * (p[i] - least[i]) / (most[i] - least[i]);
        return mesh;
    };
    Asset asset;
    asset.parts = {part_of(stretched(plate, {-0.5, -0.5, 0}, {1, 1, 0.005})),
                   part_of(stretched(block, {-2, -2, -2}, {4, 4, 2}))};
    const VertexVisibility seen = vertex_visibility(asset);
    for (std::size_t v = 0; v < asset.parts[0].positions.size(); ++v) {
        if (asset.parts[0].positions[v][2] > 0) CHECK(seen.weights[0][v] == 1);
    }
    CHECK(least(seen.weights[1]) == 1);
}

TEST_CASE("vertices without faces, faces without area and empty parts are left alone") {
    Asset asset;
    asset.parts = {part_of(test::make({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {5, 5, 5}}, {{0, 1, 2}})), Part{}};
    const VertexVisibility seen = vertex_visibility(asset);
    CHECK(seen.weights[0] == std::vector<float>(4, 1));
    CHECK(seen.weights[1].empty());
    CHECK(seen.hidden_vertices == 0);
    CHECK(vertex_visibility(Asset{}).weights.empty());
}

TEST_CASE("what is seen does not depend on the number of threads") {
    const Asset asset = shell_around(test::shaken(scaled(icosphere(3), 1.95), 0.2, 5), 4);
    const VertexVisibility one = vertex_visibility(asset, {1}), four = vertex_visibility(asset, {4});
    CHECK(one.weights == four.weights);
    CHECK(one.hidden == four.hidden);
    const auto is_hidden = [](float weight) { return weight == min_visibility; };
    const std::vector<float>& inner = one.weights[0];
    CHECK(std::any_of(inner.begin(), inner.end(), is_hidden));
    CHECK_FALSE(std::all_of(inner.begin(), inner.end(), is_hidden));
}

TEST_CASE("where hidden surfaces weigh less, faces go to what is seen") {
    const Asset asset = shell_around(test::shaken(icosphere(4), 0.02, 3), 4);
    Options options;
    options.target = ratio(0.1);
    const SimplifiedParts all = simplify_parts(asset, options);
    CHECK(all.report.vertices_hidden == 0);
    options.visibility = Visibility::weighted;
    const SimplifiedParts seen = simplify_parts(asset, options);
    CHECK(seen.report.vertices_hidden == asset.parts[0].positions.size());
    CHECK(seen.report.faces_out <= seen.report.target_faces);
    CHECK(seen.report.target_faces == all.report.target_faces);
    const auto faces = [](const SimplifiedParts& small, std::size_t p) {
        return small.parts[p].mesh.triangles.size();
    };
    CHECK(2 * faces(seen, 0) < faces(all, 0));
    CHECK(faces(seen, 1) > faces(all, 1));
    CHECK(seen.report.warnings.empty());
}

TEST_CASE("a scene that moves is looked at as it stands, with a warning") {
    Asset asset = shell_around(icosphere(1));
    CHECK(detail::visibility_warning(asset).empty());
    asset.parts[0].morph_targets.resize(1);
    asset.parts[0].morph_targets[0].positions.resize(asset.parts[0].positions.size());
    Options options;
    options.visibility = Visibility::weighted;
    const SimplifiedParts small = simplify_parts(asset, options);
    CHECK(std::count(small.report.warnings.begin(), small.report.warnings.end(),
                     detail::visibility_warning(asset)) == 1);
}

TEST_CASE("looking can be cancelled") {
    const Asset asset = shell_around(icosphere(5), 5);
    Options options;
    options.visibility = Visibility::weighted;
    int asked = 0;
    options.progress = [&](Phase, double) { return ++asked == 3 ? Continue::cancel : Continue::yes; };
    const SimplifiedParts small = simplify_parts(asset, options);
    CHECK(small.report.stop == StopReason::cancelled);
    CHECK(asked == 3);
}
