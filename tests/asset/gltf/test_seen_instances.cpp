#include "asset/scene/source_traits.hpp"

#include <cmath>

#include "support/catch.hpp"
#include "support/gltf_builder.hpp"

using namespace faqem;
using namespace faqem::testing;
using detail::seen_instances;

namespace {

// The scale along an axis of the instances of a file.
double scale_of(const Instance& instance, std::size_t axis) { return instance.transform[4 * axis + axis]; }

// The square at a node of scale 1e-4, and an animation of its scale.
GltfBuilder growing_square(const std::vector<Vec3f>& scales, const std::string& interpolation,
                           const Json& target) {
    GltfBuilder builder = square_gltf();
    builder.json["nodes"][0]["scale"] = {1e-4, 1e-4, 4};
    const auto times = builder.accessor(std::vector<float>{0, 1}, f32, "SCALAR");
    const auto output = builder.accessor(scales, f32, "VEC3");
    builder.add("animations",
                {{"samplers", {{{"input", times}, {"output", output}, {"interpolation", interpolation}}}},
                 {"channels", {{{"sampler", 0}, {"target", target}}}}});
    return builder;
}

// The square, skinned to two joints at nodes 1 and 2, in centimetres: the joints scale by 0.01. The skin's own node
// scales by 7.
GltfBuilder skinned_square() {
    GltfBuilder builder = square_gltf();
    builder.attribute("JOINTS_0", std::vector<std::array<std::uint8_t, 4>>(4, {0, 1, 0, 0}), u8, "VEC4");
    builder.attribute("WEIGHTS_0", std::vector<Vec4f>(4, {0.75f, 0.25f, 0, 0}), f32, "VEC4");
    const float c = 0.01f;
    const std::array<float, 16> matrix = {c, 0, 0, 0, 0, c, 0, 0, 0, 0, c, 0, 0, 0, 0, 1};
    const auto inverse = builder.accessor(std::vector{matrix, matrix}, f32, "MAT4");
    builder.add("skins", {{"joints", {1, 2}}, {"inverseBindMatrices", inverse}});
    builder.json["nodes"][0]["skin"] = 0;
    builder.json["nodes"][0]["scale"] = {7, 7, 7};
    builder.add("nodes", {{"children", {2}}});
    builder.add("nodes", {{"scale", {3, 3, 3}}});
    builder.json["scenes"][0]["nodes"] = {0, 1};
    return builder;
}

}  // namespace

TEST_CASE("animated nodes are seen at their largest scale per axis") {
    const Json node = {{"node", 0}, {"path", "scale"}};
    const Json pointer = {{"path", "pointer"},
                          {"extensions", {{"KHR_animation_pointer", {{"pointer", "/nodes/0/scale"}}}}}};
    const Json target = GENERATE_COPY(node, pointer);
    const Asset asset = load_glb(growing_square({{1, -2, 0}, {0.5f, 1, 3}}, "LINEAR", target));
    const std::vector<Instance> seen = seen_instances(asset);
    REQUIRE(seen.size() == 1);
    CHECK(seen[0].part == 0);
    CHECK(scale_of(seen[0], 0) == 1);
    CHECK(scale_of(seen[0], 1) == 2);
    CHECK(scale_of(seen[0], 2) == 4);
    CHECK(scale_of(instances(asset)[0], 0) == 1e-4);
}

TEST_CASE("tangents of a spline and other channels are no scales") {
    const std::vector<Vec3f> keyframes = {{9, 9, 9}, {1, 1, 1}, {9, 9, 9}, {9, 9, 9}, {2, 2, 2}, {9, 9, 9}};
    CHECK(scale_of(seen_instances(load_glb(
                       growing_square(keyframes, "CUBICSPLINE", {{"node", 0}, {"path", "scale"}})))[0],
                   0) == 2);
    CHECK(scale_of(seen_instances(load_glb(
                       growing_square(keyframes, "LINEAR", {{"node", 0}, {"path", "translation"}})))[0],
                   0) == 1e-4);
}

TEST_CASE("skinned meshes are seen at the scale of their joints, not at that of their node") {
    const std::vector<Instance> seen = seen_instances(load_glb(skinned_square()));
    REQUIRE(seen.size() == 1);
    // 0.75 of the weight is at a joint of scale 1, 0.25 at one of scale 3.
    const double expected = 0.01 * std::sqrt(0.75 + 0.25 * 9);
    for (const std::size_t axis : {0u, 1u, 2u}) CHECK(scale_of(seen[0], axis) == Approx(expected));
}

TEST_CASE("a skin without matrices or weights that are in the scene is seen at its node or its joints") {
    GltfBuilder builder = skinned_square();
    builder.json["skins"][0].erase("inverseBindMatrices");
    CHECK(scale_of(seen_instances(load_glb(builder))[0], 0) == Approx(std::sqrt(3.0)));
    Json& attributes = builder.primitive()["attributes"];
    attributes.erase("JOINTS_0");
    attributes.erase("WEIGHTS_0");
    CHECK(scale_of(seen_instances(load_glb(builder))[0], 0) == 7);
}

TEST_CASE("without a scene graph every part is seen as it is") {
    Asset asset;
    asset.parts.resize(2);
    const std::vector<Instance> seen = seen_instances(asset);
    REQUIRE(seen.size() == 2);
    CHECK(scale_of(seen[1], 1) == 1);
}

TEST_CASE("instances move with their skin and the nearest animated node above them") {
    GltfBuilder builder = growing_square({{1, 1, 1}, {2, 2, 2}}, "LINEAR", {{"node", 0}, {"path", "scale"}});
    builder.json["nodes"][0]["children"] = {1};
    for (int node = 1; node <= 2; ++node) builder.add("nodes", {{"mesh", 0}});
    builder.json["scenes"][0]["nodes"] = {0, 2};
    const auto motions = detail::instance_motions(load_glb(builder)).at(0);
    REQUIRE(motions.size() == 3);
    for (std::size_t i = 0; i < 3; ++i) CHECK(motions[i].animated_node == (i < 2 ? 0 : no_index));
    CHECK(motions[0].transform == motions[1].transform);
    CHECK(motions[2].skin == no_index);
    CHECK(detail::instance_motions(load_glb(skinned_square())).at(0).at(0).skin == 0);
}
