#include <cmath>
#include <limits>

#include "asset/gltf/scene.hpp"
#include "asset/scene/flatten.hpp"
#include "asset/scene/measured_instances.hpp"
#include "support/catch.hpp"
#include "support/gltf_builder.hpp"

using namespace faqem;
using namespace faqem::testing;
using Vec3s = std::vector<Vec3f>;

namespace {

const std::string where = "/nodes/0/extensions/EXT_mesh_gpu_instancing/attributes/";

/// The square, with the instances of the given attributes.
GltfBuilder instanced(GltfBuilder builder, const Json& attributes) {
    builder.json["nodes"][0]["extensions"][detail::instancing_name]["attributes"] = attributes;
    builder.json["extensionsUsed"] = {detail::instancing_name};
    return builder;
}

/// The square three times: as it is, turned by 90 degrees about z and stretched, and mirrored.
GltfBuilder three_squares() {
    GltfBuilder builder = square_gltf();
    const float half = std::sqrt(0.5f);
    const auto t = builder.accessor(Vec3s{{0, 0, 0}, {5, 0, 0}, {10, 1, 0}}, f32, "VEC3");
    const auto r =
        builder.accessor(std::vector<Vec4f>{{0, 0, 0, 1}, {0, 0, half, half}, {0, 0, 0, 1}}, f32, "VEC4");
    const auto s = builder.accessor(Vec3s{{1, 1, 1}, {2, 1, 1}, {-1, 1, 1}}, f32, "VEC3");
    return instanced(builder, {{"TRANSLATION", t}, {"ROTATION", r}, {"SCALE", s}});
}

/// Positions of the corner (1, 0, 0) of all squares.
std::vector<Vec3> corners(const Asset& asset) {
    std::vector<Vec3> result;
    const Part flat = detail::flatten(asset);
    for (std::size_t v = 1; v < flat.positions.size(); v += 4) result.push_back(flat.positions[v]);
    return result;
}

void check_near(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    REQUIRE(a.size() == b.size());
    for (std::size_t i = 0; i < a.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k) CHECK(a[i][k] == Approx(b[i][k]).margin(1e-6));
}

}  // namespace

TEST_CASE("instances are posed by their translation, rotation and scale") {
    GltfBuilder builder = three_squares();
    check_near(corners(load_glb(builder)), {{1, 0, 0}, {5, 2, 0}, {9, 1, 0}});
    builder.json["nodes"][0]["translation"] = {0, 0, 7};
    builder.json["nodes"][0]["scale"] = {10, 10, 10};
    check_near(corners(load_glb(builder)), {{10, 0, 7}, {50, 20, 7}, {90, 10, 7}});
}

TEST_CASE("instances may have some of the attributes, as integers and without a buffer view") {
    SECTION("rotations as normalised bytes") {
        GltfBuilder builder = square_gltf();
        using Bytes = std::vector<std::array<std::int8_t, 4>>;
        const auto r = builder.accessor(Bytes{{0, 0, 127, 0}, {0, 0, 90, 90}}, i8, "VEC4");
        builder.json["accessors"][r]["normalized"] = true;
        check_near(corners(load_glb(instanced(builder, {{"ROTATION", r}}))), {{-1, 0, 0}, {0, 1, 0}});
    }
    SECTION("custom attributes only") {
        GltfBuilder builder = square_gltf();
        const auto id = builder.accessor(std::vector<float>{4, 5}, f32, "SCALAR");
        check_near(corners(load_glb(instanced(builder, {{"_ID", id}}))), {{1, 0, 0}, {1, 0, 0}});
    }
    SECTION("zeros without a buffer view") {
        GltfBuilder builder = square_gltf();
        const auto t = builder.add("accessors", {{"componentType", f32}, {"type", "VEC3"}, {"count", 2}});
        check_near(corners(load_glb(instanced(builder, {{"TRANSLATION", t}}))), {{1, 0, 0}, {1, 0, 0}});
    }
    SECTION("no attributes") {
        check_near(corners(load_glb(instanced(square_gltf(), Json::object()))), {{1, 0, 0}});
    }
}

TEST_CASE("invalid instances are rejected with the attribute") {
    GltfBuilder builder = three_squares();
    const Json attributes = builder.json["nodes"][0]["extensions"][detail::instancing_name]["attributes"];
    Json& t = builder.json["accessors"][attributes["TRANSLATION"].get<std::size_t>()];
    Json& r = builder.json["accessors"][attributes["ROTATION"].get<std::size_t>()];
    SECTION("different counts") {
        t["count"] = 2;
        CHECK(contains(refusal(builder), where + "TRANSLATION: has 2 elements, another attribute has 3"));
    }
    SECTION("types") {
        r["type"] = "VEC3";
        CHECK(contains(refusal(builder),
                       where + "ROTATION: is not a VEC4 of floats or of normalised signed bytes or shorts"));
        r["type"] = "VEC4";
        t["componentType"] = u32;
        CHECK(contains(refusal(builder), where + "TRANSLATION: is not a VEC3 of floats"));
    }
    SECTION("integers that are not normalised") {
        r["componentType"] = i16;
        CHECK(contains(refusal(builder), where + "ROTATION: is not a VEC4"));
    }
    SECTION("missing accessors") {
        CHECK(contains(refusal(instanced(builder, {{"SCALE", 99}})), where + "SCALE"));
    }
    SECTION("numbers that are not finite") {
        const float bad =
            GENERATE(std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN());
        const auto scale = builder.accessor(Vec3s{{1, 1, 1}, {1, bad, 1}}, f32, "VEC3");
        CHECK(contains(refusal(instanced(builder, {{"SCALE", scale}})),
                       where + "SCALE: instance 1 is not finite"));
    }
    SECTION("positions out of range") {
        builder.json["nodes"][0]["scale"] = {1e300, 1, 1};
        const auto scale = builder.accessor(Vec3s{{3e38f, 1, 1}}, f32, "VEC3");
        CHECK(
            contains(refusal(instanced(builder, {{"SCALE", scale}})), "moves it out of the range of double"));
    }
}

TEST_CASE("more instances than a file may have are unsupported before memory is allocated") {
    GltfBuilder builder = square_gltf();
    const auto zeros = builder.accessor(Vec3s(5000, {0, 0, 0}), f32, "VEC3");
    builder = instanced(builder, {{"TRANSLATION", zeros}});
    const Json node = builder.json["nodes"][0];
    while (builder.json["nodes"].size() < 3) builder.add("nodes", node);
    CHECK(refusal<UnsupportedError>(builder) == "accepted");
    while (builder.json["nodes"].size() < 900) builder.add("nodes", node);
    CHECK(
        contains(refusal<UnsupportedError>(builder), "/nodes/838: the file has more than 4194304 instances"));
}

TEST_CASE("measurements leave instances of very large scenes out") {
    GltfBuilder builder = square_gltf();
    const auto zeros = builder.accessor(Vec3s(17, {0, 0, 0}), f32, "VEC3");
    Asset asset = load_glb(instanced(builder, {{"TRANSLATION", zeros}}));
    CHECK(detail::measured_instances(asset).size() == 17);
    asset.parts[0].triangles.resize(1u << 20);
    const std::vector<Instance> all = instances(asset);
    CHECK(detail::shown_faces(asset, all) == 17u << 20);
    CHECK(detail::has_excessive_instances(asset, all));
    CHECK_FALSE(detail::has_excessive_instances(asset, {all.begin(), all.end() - 1}));
    CHECK(detail::measured_instances(asset).size() == 16);
    // A part with most of the faces is not copied often.
    asset.parts.push_back(asset.parts[0]);
    asset.parts[1].source = no_index;
    asset.parts[1].triangles.resize(5u << 20);
    CHECK(detail::measured_instances(asset).size() == 18);
}
