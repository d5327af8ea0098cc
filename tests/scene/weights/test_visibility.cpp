#include "scene/weights/visibility.hpp"

#include <algorithm>

#include "asset/gltf/source_document.hpp"
#include "faqem/bake.hpp"
#include "scene/weights/hidden_surface.hpp"
#include "support/catch.hpp"
#include "support/scenes.hpp"

using namespace faqem;
using detail::Json;
using detail::min_visibility;
using detail::vertex_visibility;
using detail::VertexVisibility;
using test::icosphere;
using test::inside_out;
using test::moved;
using test::part_of;
using test::scaled;

namespace {

// A mesh inside a sphere of radius 2. The sphere has a material.
Asset shell_around(const TriangleMesh& inner, int level = 2) {
    Asset asset;
    asset.materials.resize(1);
    asset.parts = {part_of(inner), part_of(scaled(icosphere(level), 2), 0)};
    return asset;
}

float least(const std::vector<float>& weights) { return *std::min_element(weights.begin(), weights.end()); }
float most(const std::vector<float>& weights) { return *std::max_element(weights.begin(), weights.end()); }

}  // namespace

TEST_CASE("a convex solid is fully visible at any winding and resolution") {
    const int level = GENERATE(0, 2, 6);
    Asset asset = test::asset_with({part_of(GENERATE_COPY(icosphere(level), inside_out(icosphere(level))))});
    const VertexVisibility seen = vertex_visibility(asset);
    CHECK(seen.hidden_vertices == 0);
    REQUIRE(seen.weights.size() == 1);
    CHECK(seen.weights[0].size() == asset.parts[0].positions.size());
    CHECK(least(seen.weights[0]) == 1);
}

TEST_CASE("an open surface that is visible from both sides has visibility 1") {
    Asset asset = test::asset_with({part_of(test::grid(4))});
    CHECK(vertex_visibility(asset).weights[0] == std::vector<float>(25, 1));
}

TEST_CASE("surface inside a closed shell is hidden and the shell is visible") {
    const Asset asset = shell_around(icosphere(GENERATE(1, 5)), GENERATE(2, 5));
    const VertexVisibility seen = vertex_visibility(asset);
    CHECK(seen.hidden_vertices == asset.parts[0].positions.size());
    CHECK(most(seen.weights[0]) == min_visibility);
    CHECK(least(seen.weights[1]) == 1);
}

TEST_CASE("a transparent shell does not occlude") {
    Asset asset = shell_around(icosphere(2));
    Material& material = asset.materials[0];
    SECTION("alpha blending") { material.alpha_mode = AlphaMode::blend; }
    SECTION("alpha mask") { material.alpha_mode = AlphaMode::mask; }
    SECTION("transmission") { material.extensions = {"KHR_materials_ior", "KHR_materials_transmission"}; }
    CHECK(vertex_visibility(asset).hidden_vertices == 0);
    CHECK(least(vertex_visibility(asset).weights[0]) == 1);
}

TEST_CASE("back faces occlude only if their material is double-sided") {
    Asset asset = shell_around(icosphere(2));
    asset.parts[1] = part_of(scaled(inside_out(icosphere(2)), 2), 0);
    CHECK(vertex_visibility(asset).hidden_vertices == 0);
    asset.materials[0].double_sided = true;
    CHECK(vertex_visibility(asset).hidden_vertices == asset.parts[0].positions.size());
}

TEST_CASE("visibility inside an open cylinder agrees with the exact value") {
    // The cosine-weighted visible fraction through a disc of radius 1 at height h is 1 / (1 + h^2). It is
    // measured on a small square in the centre of the floor, which is occluded from below.
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

TEST_CASE("the free side of a thin plate on a block is fully visible") {
    // A plate of 1 x 1 x 0.005 on a block of 4 x 4 x 2: only the lower corners of the plate are hidden.
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
    Asset asset = test::asset_with({part_of(stretched(plate, {-0.5, -0.5, 0}, {1, 1, 0.005})),
                                    part_of(stretched(block, {-2, -2, -2}, {4, 4, 2}))});
    const VertexVisibility seen = vertex_visibility(asset);
    for (std::size_t v = 0; v < asset.parts[0].positions.size(); ++v) {
        if (asset.parts[0].positions[v][2] > 0) CHECK(seen.weights[0][v] == 1);
    }
    CHECK(least(seen.weights[1]) == 1);
}

TEST_CASE("unreferenced vertices and vertices of degenerate faces have weight 1") {
    Asset asset = test::asset_with(
        {part_of(test::make({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {5, 5, 5}}, {{0, 1, 2}})), Part{}});
    const VertexVisibility seen = vertex_visibility(asset);
    CHECK(seen.weights[0] == std::vector<float>(4, 1));
    CHECK(seen.weights[1].empty());
    CHECK(seen.hidden_vertices == 0);
    CHECK(vertex_visibility(Asset{}).weights.empty());
}

TEST_CASE("visibility does not depend on the number of threads") {
    const Asset asset = shell_around(test::shaken(scaled(icosphere(3), 1.95), 0.2, 5), 4);
    const VertexVisibility one = vertex_visibility(asset, {1}), four = vertex_visibility(asset, {4});
    CHECK(one.weights == four.weights);
    CHECK(one.hidden_vertices == four.hidden_vertices);
    const auto is_hidden = [](float weight) { return weight == min_visibility; };
    const std::vector<float>& inner = one.weights[0];
    CHECK(std::any_of(inner.begin(), inner.end(), is_hidden));
    CHECK_FALSE(std::all_of(inner.begin(), inner.end(), is_hidden));
}

TEST_CASE("weighted visibility moves faces from hidden to visible surface") {
    const Asset asset = shell_around(test::shaken(icosphere(4), 0.02, 3), 4);
    Options options{.target = ratio(0.1), .visibility = Visibility::ignored};
    const SimplifiedParts all = simplify_parts(asset, options);
    CHECK(all.report.vertices_hidden == 0);
    options.visibility = Visibility::weighted;
    const SimplifiedParts seen = simplify_parts(asset, options);
    CHECK(seen.report.vertices_hidden == asset.parts[0].positions.size());
    CHECK(seen.report.faces_out <= seen.report.target_faces);
    CHECK(seen.report.target_faces == all.report.target_faces);
    const auto faces = [](const SimplifiedParts& simplified, std::size_t p) {
        return simplified.parts[p].mesh.triangles.size();
    };
    CHECK(2 * faces(seen, 0) < faces(all, 0));
    CHECK(faces(seen, 1) > faces(all, 1));
    CHECK(seen.report.warnings.empty());
}

TEST_CASE("surface deep inside what hides it counts a tenth") {
    Asset asset = shell_around(test::shaken(scaled(icosphere(4), GENERATE(1.2, 1.9)), 0.02, 3), 4);
    std::vector<std::vector<float>> weights = {{}, std::vector<float>(asset.parts[1].positions.size(), 2)};
    const std::uint64_t inner = asset.parts[0].positions.size();
    CHECK(detail::lower_hidden_weights(asset, 0.2, weights, {}) == inner);
    CHECK(weights[0] == std::vector<float>(inner, 0.1f));
    CHECK(least(weights[1]) == 2);
    CHECK(simplify_parts(asset, {.target = ratio(0.2)}).report.vertices_hidden == 0);  // has no texture
    test::add_texture(asset, test::ramp(4));
    const SimplifiedParts by_default = simplify_parts(asset, {.target = ratio(0.2)});
    const SimplifiedParts ignored =
        simplify_parts(asset, {.target = ratio(0.2), .visibility = Visibility::ignored});
    CHECK(by_default.report.vertices_hidden == inner);
    CHECK(by_default.report.faces_out <= by_default.report.target_faces);
    CHECK(by_default.parts[1].mesh.triangles.size() > ignored.parts[1].mesh.triangles.size());
}

TEST_CASE("surface that may be seen keeps its weight") {
    Asset asset = shell_around(scaled(icosphere(3), 1.9), 3);
    double share = 0.5;
    SECTION("close behind what is seen") { asset = shell_around(scaled(icosphere(3), 1.98), 3); }
    SECTION("behind transparent surface") { asset.materials[0].alpha_mode = AlphaMode::blend; }
    SECTION("behind the backs of faces") { asset.parts[1] = part_of(scaled(inside_out(icosphere(2)), 2), 0); }
    SECTION("in a scene that moves") { asset.parts[1].morph_targets.resize(1); }
    SECTION("in another instance") {
        asset = from_glb(to_glb(asset));
        SourceDocument source = *asset.source;
        Json& nodes = source.document["nodes"];
        source.document["scenes"][0]["nodes"].push_back(nodes.size());
        nodes.push_back({{"mesh", 0}, {"translation", {9, 0, 0}}});
        asset.source = std::make_shared<SourceDocument>(source);
    }
    SECTION("so close that the faces of the result are as far from the source") { share = 0.001; }
    std::vector<std::vector<float>> weights(2);
    CHECK(detail::lower_hidden_weights(asset, share, weights, {}) == 0);
    CHECK(weights == std::vector<std::vector<float>>(2));
}

TEST_CASE("visibility of a dynamic scene causes a warning") {
    Asset asset = shell_around(icosphere(1));
    CHECK(detail::visibility_warning(asset).empty());
    asset.parts[0].morph_targets.resize(1);
    asset.parts[0].morph_targets[0].positions.resize(asset.parts[0].positions.size());
    const SimplifiedParts simplified = simplify_parts(asset, {.visibility = Visibility::weighted});
    CHECK(std::count(simplified.report.warnings.begin(), simplified.report.warnings.end(),
                     detail::visibility_warning(asset)) == 1);
}

TEST_CASE("the visibility computation can be cancelled") {
    const Asset asset = shell_around(icosphere(5), 5);
    Options options{.visibility = Visibility::weighted};
    int asked = 0;
    options.progress = [&](Phase, double) { return ++asked == 3 ? Continue::cancel : Continue::yes; };
    const SimplifiedParts simplified = simplify_parts(asset, options);
    CHECK(simplified.report.stop == StopReason::cancelled);
    CHECK(asked == 3);
}
