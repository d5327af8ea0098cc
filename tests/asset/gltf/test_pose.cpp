#include "asset/gltf/scene.hpp"

#include <cmath>
#include <limits>

#include "asset/scene/flatten.hpp"
#include "support/catch.hpp"
#include "support/gltf_builder.hpp"

using namespace faqem;
using namespace faqem::testing;
using detail::flatten;

namespace {

using JointWeights = std::vector<std::array<float, 4>>;

using Matrix = std::array<float, 16>;

Matrix translation_matrix(float x, float y, float z) {
    return {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x, y, z, 1};
}

// The square with normals along y. Its left side is bound to a joint at the origin, which the pose moves up by 5; the
// right side to a joint at (1, 0, 0), which the pose turns by 90 degrees about z. The node of the mesh is far away.
GltfBuilder posed_square(const JointWeights& weights = {
                             {1, 0, 0, 0}, {0, 1, 0, 0}, {1, 0, 0, 0}, {0, 1, 0, 0}}) {
    GltfBuilder builder = square_gltf();
    builder.attribute("JOINTS_0", std::vector<std::array<std::uint8_t, 4>>(4, {0, 1, 0, 0}), u8, "VEC4");
    builder.attribute("WEIGHTS_0", weights, f32, "VEC4");
    builder.attribute("NORMAL", std::vector<Vec3f>(4, {0, 1, 0}), f32, "VEC3");
    const std::vector<Matrix> matrices = {translation_matrix(0, 0, 0), translation_matrix(-1, 0, 0)};
    const auto inverse = builder.accessor(matrices, f32, "MAT4");
    builder.add("skins", {{"joints", {1, 2}}, {"inverseBindMatrices", inverse}});
    builder.json["nodes"][0]["skin"] = 0;
    builder.json["nodes"][0]["translation"] = {100, 200, 300};
    builder.add("nodes", {{"translation", {0, 0, 5}}});
    const double half = std::sqrt(0.5);
    builder.add("nodes", {{"translation", {1, 0, 0}}, {"rotation", {0, 0, half, half}}});
    builder.json["scenes"][0]["nodes"] = {0, 1, 2};
    return builder;
}

// The positions of the posed square.
const std::vector<Vec3> posed = {{0, 0, 5}, {1, 0, 0}, {0, 1, 5}, {0, 0, 0}};

void check_points(const std::vector<Vec3>& points, const std::vector<Vec3>& expected) {
    REQUIRE(points.size() == expected.size());
    for (std::size_t v = 0; v < points.size(); ++v)
        for (std::size_t k = 0; k < 3; ++k) CHECK(points[v][k] == Approx(expected[v][k]).margin(1e-6));
}

// The square with a morph target that lifts its upper side by 2 and has a normal displacement.
GltfBuilder morphed_square(const Json& of_mesh, const Json& of_node) {
    GltfBuilder builder = square_gltf();
    Json& primitive = builder.primitive();
    primitive["attributes"]["NORMAL"] = builder.accessor(std::vector<Vec3f>(4, {0, 0, 1}), f32, "VEC3");
    const std::vector<Vec3f> lift = {{0, 0, 0}, {0, 0, 0}, {0, 0, 2}, {0, 0, 2}}, tilt(4, {0, -2, 0});
    primitive["targets"] = {
        {{"POSITION", builder.accessor(lift, f32, "VEC3")}, {"NORMAL", builder.accessor(tilt, f32, "VEC3")}}};
    if (!of_mesh.is_null()) builder.json["meshes"][0]["weights"] = of_mesh;
    if (!of_node.is_null()) builder.json["nodes"][0]["weights"] = of_node;
    builder.json["nodes"][0]["translation"] = {10, 0, 0};
    return builder;
}

std::vector<Vec3> lifted(double height) { return {{10, 0, 0}, {11, 0, 0}, {10, 1, height}, {11, 1, height}}; }

}  // namespace

TEST_CASE("joints pose a skinned mesh, and its own node does not move it") {
    const Part flat = flatten(load_glb(posed_square()));
    check_points(flat.positions, posed);
    CHECK(flat.triangles == std::vector<Triangle>{{0, 1, 2}, {2, 1, 3}});
    const std::vector<Vec3f> normals = {{0, 1, 0}, {-1, 0, 0}, {0, 1, 0}, {-1, 0, 0}};
    for (std::size_t v = 0; v < 4; ++v)
        for (std::size_t k = 0; k < 3; ++k) CHECK(flat.normals[v][k] == Approx(normals[v][k]).margin(1e-6));
    CHECK(flat.joints.empty());
}

TEST_CASE("OBJ, PLY and STL files have the pose, with a warning") {
    const Asset asset = load_glb(posed_square());
    const TemporaryFolder folder;
    for (const std::string name : {"OBJ", "PLY", "STL"}) {
        const auto file = folder / ("out." + name);
        CHECK_THAT(save(asset, file), Catch::Matchers::VectorContains(
                                          name + " cannot hold skins: the meshes are posed by their joints"));
        const Part written = load(file).parts.at(0);
        std::vector<Vec3> corners;
        for (const Triangle& t : written.triangles)
            for (const Index v : t) corners.push_back(written.positions[v]);
        check_points(corners, {posed[0], posed[1], posed[2], posed[2], posed[1], posed[3]});
    }
}

TEST_CASE("matrices are blended by weights, which are scaled to the sum 1") {
    JointWeights weights(4, {0.5f, 0.5f, 0, 0});
    weights[3] = {0.25f, 0.25f, 0, 0};
    const Part flat = flatten(load_glb(posed_square(weights)));
    check_points(flat.positions, {{0.5, -0.5, 2.5}, {1, 0, 2.5}, {0, 0, 2.5}, {0.5, 0.5, 2.5}});
}

TEST_CASE("the node places vertices without weights") {
    const Part flat =
        flatten(load_glb(posed_square({{1, 0, 0, 0}, {0, 0, 0, 0}, {1, 0, 0, 0}, {0, 1, 0, 0}})));
    check_points(flat.positions, {posed[0], {101, 200, 300}, posed[2], posed[3]});
}

TEST_CASE("joints that the skin lacks are ignored, and joints outside the scene pose") {
    GltfBuilder builder = posed_square();
    builder.json["skins"][0]["joints"] = {1};
    builder.json["scenes"][0]["nodes"] = {0};
    check_points(flatten(load_glb(builder)).positions,
                 {posed[0], {101, 200, 300}, posed[2], {101, 201, 300}});
}

TEST_CASE("a missing inverse bind matrix is the identity, as one that is not finite") {
    GltfBuilder builder = posed_square();
    SECTION("missing") { builder.json["skins"][0].erase("inverseBindMatrices"); }
    SECTION("not finite") {
        const float nan = std::numeric_limits<float>::quiet_NaN();
        builder.bin.replace(builder.bin.size() - sizeof nan, sizeof nan, reinterpret_cast<const char*>(&nan),
                            sizeof nan);
        CHECK_THAT(load_glb(builder).warnings.at(0),
                   Catch::Matchers::EndsWith(
                       "/skins/0: 1 inverse bind matrices that are not finite are taken as the "
                       "identity"));
    }
    check_points(flatten(load_glb(builder)).positions, {posed[0], {1, 1, 0}, posed[2], {0, 1, 0}});
}

TEST_CASE("a pose out of the range of double is rejected") {
    GltfBuilder builder = posed_square();
    builder.json["nodes"][1]["scale"] = {1e308, 1e308, 1e308};
    builder.json["nodes"][1]["translation"] = {1e308, 1e308, 1e308};
    CHECK_THAT(refusal(builder),
               ContainsSubstring("/meshes/0: its joints or default morph weights move it out of the range"));
}

TEST_CASE("a mirrored skeleton reverses the winding, and normals follow") {
    GltfBuilder builder = posed_square(JointWeights(4, {1, 0, 0, 0}));
    builder.json["nodes"][1] = {{"scale", {-1, 1, 1}}};
    const Part flat = flatten(load_glb(builder));
    check_points(flat.positions, {{0, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {-1, 1, 0}});
    CHECK(flat.triangles == std::vector<Triangle>{{0, 2, 1}, {2, 3, 1}});
    CHECK(flat.normals[0] == Vec3f{0, 1, 0});
}

TEST_CASE("two nodes pose one mesh with their own skins") {
    GltfBuilder builder = posed_square();
    builder.add("skins", {{"joints", {2, 1}}});
    const auto second = builder.add("nodes", {{"mesh", 0}, {"skin", 1}});
    builder.json["scenes"][0]["nodes"].push_back(second);
    std::vector<Vec3> both = posed;
    both.insert(both.end(), {{1, 0, 0}, {1, 0, 5}, {0, 0, 0}, {1, 1, 5}});
    check_points(flatten(load_glb(builder)).positions, both);
}

TEST_CASE("flattened meshes have the morph weights of the node, else those of the mesh") {
    check_points(flatten(load_glb(morphed_square({0.5}, nullptr))).positions, lifted(1));
    check_points(flatten(load_glb(morphed_square({0.5}, {0.25}))).positions, lifted(0.5));
    check_points(flatten(load_glb(morphed_square({0.5}, {0}))).positions, lifted(0));
    check_points(flatten(load_glb(morphed_square({"1", 1}, nullptr))).positions, lifted(0));
    const Part flat = flatten(load_glb(morphed_square(nullptr, {0.5})));
    const float root = std::sqrt(0.5f);
    CHECK(flat.normals[0][1] == Approx(-root));
    CHECK(flat.normals[0][2] == Approx(root));
}

TEST_CASE("a warning says that default morph weights are applied, if there are any") {
    const TemporaryFolder folder;
    const auto losses = [&](const Json& weights, const std::string& name) {
        return save(load_glb(morphed_square(weights, nullptr)), folder / name);
    };
    CHECK_THAT(losses({1}, "a.obj"),
               Catch::Matchers::VectorContains(
                   std::string("OBJ cannot hold morph targets: the meshes have their default weights")));
    CHECK_THAT(losses({0}, "b.obj"),
               Catch::Matchers::VectorContains(std::string("OBJ cannot hold morph targets")));
}

TEST_CASE("morph targets displace a mesh before its joints move it") {
    GltfBuilder builder = posed_square();
    const std::vector<Vec3f> shift(4, {0, 1, 0});
    builder.primitive()["targets"] = {{{"POSITION", builder.accessor(shift, f32, "VEC3")}}};
    builder.json["nodes"][0]["weights"] = {1};
    check_points(flatten(load_glb(builder)).positions, {{0, 1, 5}, {0, 0, 0}, {0, 2, 5}, {-1, 0, 0}});
}

TEST_CASE("a tile of 3D Tiles is turned to z up and moved to its center, except in glTF files") {
    // The square, one unit above the ground (y), stands upright to the south after the turn.
    GltfBuilder builder = square_gltf();
    builder.json["nodes"][0]["translation"] = {0, 1, 0};
    builder.json["extensionsUsed"] = builder.json["extensionsRequired"] = {"CESIUM_RTC"};
    builder.json["extensions"]["CESIUM_RTC"]["center"] = {4000000.5, -2, 10};
    builder.attribute("NORMAL", std::vector<Vec3f>(4, Vec3f{0, 0, 1}), f32, "VEC3");
    const Asset asset = load_glb(builder);
    CHECK(asset.not_understood.empty());
    const Part flat = detail::flatten(asset);
    CHECK(flat.positions ==
          std::vector<Vec3>{
              {4000000.5, -2, 11}, {4000001.5, -2, 11}, {4000000.5, -2, 12}, {4000001.5, -2, 12}});
    CHECK(flat.normals[0] == Vec3f{0, -1, 0});
    CHECK(flat.triangles == std::vector<Triangle>{{0, 1, 2}, {2, 1, 3}});
    CHECK(load_glb(saved(asset)).parts[0].positions == asset.parts[0].positions);

    builder.json["extensions"]["CESIUM_RTC"]["center"] = {1, 2};
    CHECK(contains(refusal(builder), "/extensions/CESIUM_RTC/center"));
}
