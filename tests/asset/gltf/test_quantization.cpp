// Writing of KHR_mesh_quantization.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "asset/gltf/accessor.hpp"
#include "asset/scene/affine.hpp"
#include "support/catch.hpp"
#include "support/gltf_builder.hpp"
#include "support/largest_difference.hpp"

using namespace faqem;
using namespace faqem::testing;

namespace {

constexpr double step = 0x1p-6;

/// All positions of the scene, instance by instance.
std::vector<Vec3> world_positions(const Asset& asset) {
    std::vector<Vec3> positions;
    for (const Instance& instance : instances(asset))
        for (const Vec3& p : asset.parts[instance.part].positions)
            positions.push_back(detail::transformed_point(instance.transform, p));
    return positions;
}

/// The square, moved and turned a little so that no position is on the grid.
std::vector<Vec3f> tilted_square(float shift = 0) {
    std::vector<Vec3f> positions = square;
    for (Vec3f& p : positions) p = {0.93f * p[0] + shift, 0.97f * p[1] + 0.31f * p[0], 0.11f * p[0]};
    return positions;
}

GltfBuilder tilted_gltf(float shift = 0) {
    GltfBuilder builder;
    builder.triangles(tilted_square(shift), square_corners);
    return builder;
}

Asset quantized(const GltfBuilder& builder, double spacing = step) {
    Asset asset = load_glb(builder);
    for (Part& part : asset.parts) part.position_spacing = spacing;
    return asset;
}

Asset rewritten(const Asset& asset) { return load_glb(saved(asset)); }

/// The world positions before and after are within half a step, and those that are read and written again are equal.
void check_world(const GltfBuilder& builder, double scale = 1) {
    const Asset asset = quantized(builder), once = rewritten(asset), twice = rewritten(once);
    CHECK(largest_difference(world_positions(asset), world_positions(once)) <= scale * (step / 2 + 1e-6));
    CHECK(once.parts[0].position_spacing > 0);
    CHECK(once.parts[0].positions == twice.parts[0].positions);
    CHECK(world_positions(once) == world_positions(twice));
}

}  // namespace

TEST_CASE("quantised positions are 16-bit integers, and the extension is required") {
    const WrittenGltf written = write_gltf_of(quantized(tilted_gltf()));
    CHECK(written.json["extensionsUsed"] == Json({"KHR_mesh_quantization"}));
    CHECK(written.json["extensionsRequired"] == Json({"KHR_mesh_quantization"}));
    CHECK(written.positions()["componentType"] == i16);
    CHECK_FALSE(written.positions().contains("normalized"));
    CHECK(written.positions()["max"] == Json({60, 82, 7}));
    CHECK(written.positions()["min"] == Json({0, 0, 0}));
    CHECK(written.json["nodes"] == Json::array({{{"mesh", 0}, {"scale", {step, step, step}}}}));
    check_world(tilted_gltf());
}

TEST_CASE("integers start at an offset if the mesh is far from the origin") {
    GltfBuilder builder = tilted_gltf(3000);
    const WrittenGltf written = write_gltf_of(quantized(builder));
    CHECK(written.positions()["componentType"] == u16);
    CHECK(written.positions()["min"] == Json({0, 0, 0}));
    CHECK(written.json["nodes"][0]["translation"] == Json({3000.0, 0.0, 0.0}));
    check_world(builder);
}

TEST_CASE("the transform of a node, its children, cameras and animations are not scaled") {
    GltfBuilder builder = tilted_gltf();
    const double s = std::sin(0.3), c = std::cos(0.3);
    SECTION("translation, rotation and scale") {
        builder.json["nodes"][0]["translation"] = {1, 2, 3};
        builder.json["nodes"][0]["rotation"] = {0, s, 0, c};
        builder.json["nodes"][0]["scale"] = {2, -3, 0.5};
        check_world(builder, 5);
        CHECK(json_of(saved(quantized(builder)))["nodes"].size() == 1);
    }
    SECTION("matrix") {
        builder.json["nodes"][0]["matrix"] = {0, 2, 0, 0, -2, 0, 0, 0, 0, 0, 1, 0, 7, 8, 9, 1};
        check_world(builder, 4);
    }
    SECTION("child with the same mesh, beside a camera") {
        builder.json["cameras"] =
            Json::array({{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}}});
        builder.json["nodes"][0]["camera"] = 0;
        builder.json["nodes"][0]["children"] = {1};
        builder.json["nodes"][0]["translation"] = {1, 2, 3};
        builder.add("nodes", {{"mesh", 0}, {"translation", {5, 0, 0}}});
        std::vector<Vec3> before = world_positions(quantized(builder));
        std::rotate(before.begin(), before.begin() + 4, before.end());  // the new child is the last
        CHECK(largest_difference(before, world_positions(rewritten(quantized(builder)))) <= step / 2 + 1e-6);
        const Json json = json_of(saved(quantized(builder)));
        REQUIRE(json["nodes"].size() == 3);
        CHECK_FALSE(json["nodes"][0].contains("mesh"));
        CHECK_FALSE(json["nodes"][0].contains("scale"));
        CHECK(json["nodes"][0]["children"] == Json({1, 2}));
    }
    SECTION("animated transform and morph weights") {
        builder.primitive()["targets"] =
            Json::array({{{"POSITION", builder.accessor(tilted_square(0.5f), f32, "VEC3")}}});
        const auto times = builder.accessor<float>({0, 1}, f32, "SCALAR");
        builder.json["accessors"][times]["min"] = {0};
        builder.json["accessors"][times]["max"] = {1};
        const auto scales = builder.accessor<Vec3f>({{1, 1, 1}, {2, 2, 2}}, f32, "VEC3");
        const auto weights = builder.accessor<float>({0, 1}, f32, "SCALAR");
        builder.json["animations"] = Json::array(
            {{{"samplers", {{{"input", times}, {"output", scales}}, {{"input", times}, {"output", weights}}}},
              {"channels",
               {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "scale"}}}},
                {{"sampler", 1}, {"target", {{"node", 0}, {"path", "weights"}}}}}}}});
        check_world(builder);
        const WrittenGltf written = write_gltf_of(quantized(builder));
        const Json& channels = written.json["animations"][0]["channels"];
        CHECK(channels[0]["target"]["node"] == 0);
        CHECK(channels[1]["target"]["node"] == 1);
        CHECK(written.json["nodes"][1]["scale"] == Json({step, step, step}));
        CHECK(written.accessor(written.primitive()["targets"][0]["POSITION"])["componentType"] == i16);
        const Asset read = load_glb(written.glb);
        for (std::size_t v = 0; v < 4; ++v)
            for (std::size_t k = 0; k < 3; ++k)
                CHECK(std::abs(read.parts[0].morph_targets[0].positions[v][k] * step -
                               tilted_square(0.5f)[v][k]) <= step / 2);
    }
}

TEST_CASE("instances are scaled each, since their translations must not be") {
    GltfBuilder builder = tilted_gltf(3000);
    const auto translations = builder.accessor<Vec3f>({{0, 0, 0}, {5, 6, 7}}, f32, "VEC3");
    const float s = std::numbers::sqrt2_v<float> / 2;
    const auto rotations = builder.accessor<Vec4f>({{0, 0, 0, 1}, {0, s, 0, s}}, f32, "VEC4");
    const auto scales = builder.accessor<Vec3f>({{1, 1, 1}, {1, 2, 1}}, f32, "VEC3");
    Json attributes = {{"TRANSLATION", translations}};
    SECTION("translations only") {}
    SECTION("all") {
        attributes["ROTATION"] = rotations;
        attributes["SCALE"] = scales;
    }
    builder.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = attributes;
    builder.json["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
    const Asset asset = quantized(builder), once = rewritten(asset);
    // Floats near 6000 have steps of 5e-4.
    CHECK(largest_difference(world_positions(asset), world_positions(once)) <= 2 * (step / 2 + 2e-3));
    CHECK(once.parts[0].positions == rewritten(once).parts[0].positions);
}

TEST_CASE("skins restore the size of their meshes, and are copied for meshes with another grid") {
    GltfBuilder builder = tilted_gltf();
    builder.attribute<std::array<std::uint8_t, 4>>("JOINTS_0", {{0}, {1}, {0}, {1}}, u8, "VEC4");
    builder.attribute("WEIGHTS_0", std::vector<Vec4f>(4, {1, 0, 0, 0}), f32, "VEC4");
    Json other = builder.primitive();
    other["attributes"]["POSITION"] = builder.accessor(tilted_square(2000), f32, "VEC3");
    builder.mesh(other);
    std::vector<std::array<float, 16>> matrices(2, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
    matrices[1] = {0, 2, 0, 0, -2, 0, 0, 0, 0, 0, 1, 0, 3, 4, 5, 1};
    const auto bind = builder.accessor(matrices, f32, "MAT4");
    const auto root = builder.add("nodes", {{"translation", {1, 0, 0}}}),
               child = builder.add("nodes", Json::object());
    builder.json["scenes"][0]["nodes"].push_back(root);
    builder.json["scenes"][0]["nodes"].push_back(child);
    builder.json["skins"] = Json::array({{{"joints", {root, child}}}});
    SECTION("with inverse bind matrices") { builder.json["skins"][0]["inverseBindMatrices"] = bind; }
    SECTION("without") { matrices[1] = matrices[0]; }
    builder.json["nodes"][0]["skin"] = 0;
    builder.json["nodes"][1]["skin"] = 0;
    const Asset asset = quantized(builder);
    const WrittenGltf written = write_gltf_of(asset);
    REQUIRE(written.json["skins"].size() == 2);
    CHECK(written.json["nodes"].size() == 4);
    CHECK(written.json["nodes"][0]["skin"] == 0);
    CHECK(written.json["nodes"][1]["skin"] == 1);
    const Asset read = load_glb(written.glb);
    for (std::size_t mesh = 0; mesh < 2; ++mesh) {
        const auto accessor = written.json["skins"][mesh]["inverseBindMatrices"].get<Index>();
        const std::vector<std::uint8_t> bytes = detail::dense_bytes(*read.source, accessor);
        std::array<std::array<float, 16>, 2> stored;
        REQUIRE(bytes.size() == sizeof stored);
        std::memcpy(stored.data(), bytes.data(), sizeof stored);
        for (std::size_t v = 0; v < 4; ++v) {
            const std::size_t joint = v % 2;
            std::array<double, 16> before, after;
            std::copy(matrices[joint].begin(), matrices[joint].end(), before.begin());
            std::copy(stored[joint].begin(), stored[joint].end(), after.begin());
            const Vec3 expected = detail::transformed_point(before, asset.parts[mesh].positions[v]),
                       found = detail::transformed_point(after, read.parts[mesh].positions[v]);
            for (std::size_t k = 0; k < 3; ++k) CHECK(std::abs(expected[k] - found[k]) <= step + 2e-4);
        }
    }
}

TEST_CASE("positions that neighbouring meshes share stay equal") {
    GltfBuilder builder = tilted_gltf();
    std::vector<Vec3f> neighbour = tilted_square();
    for (Vec3f& p : neighbour) p[0] += 0.93f, p[1] += 0.31f, p[2] += 0.11f;
    neighbour[0] = tilted_square()[1];
    neighbour[2] = tilted_square()[3];
    builder.triangles(neighbour, square_corners);
    const Asset read = rewritten(quantized(builder));
    const std::vector<Vec3> world = world_positions(read);
    REQUIRE(world.size() == 8);
    CHECK(world[1] == world[4]);
    CHECK(world[3] == world[6]);
}

TEST_CASE("meshes whose positions cannot be integers stay floats, with a warning") {
    GltfBuilder builder = tilted_gltf();
    double spacing = step;
    std::string reason;
    SECTION("too many steps") {
        spacing = 1e-6;
        reason = "65536 steps";
    }
    SECTION("lines") {
        Json lines = builder.primitive();
        lines["mode"] = 1;
        builder.json["meshes"][0]["primitives"].push_back(lines);
        reason = "points or lines";
    }
    const Asset asset = quantized(builder, spacing);
    const TemporaryFolder folder;
    const std::vector<std::string> warnings = save(asset, folder / "a.glb");
    REQUIRE(warnings.size() == 1);
    CHECK(contains(warnings[0], reason));
    CHECK(load(folder / "a.glb").parts[0].positions == asset.parts[0].positions);
}

TEST_CASE("integers of a file are kept as they are, normalised or not, and at the scale of its nodes") {
    GltfBuilder builder;
    const auto indices = builder.accessor(square_corners, u16, "SCALAR");
    std::size_t positions = 0;
    SECTION("16 bits") {
        positions = builder.accessor<std::array<std::int16_t, 4>>(
            {{0, 0, 0}, {3000, 1, 0}, {-7, 2000, 0}, {3000, 2000, 9}}, i16, "VEC3");
    }
    SECTION("16 bits, normalised") {
        positions = builder.accessor<std::array<std::int16_t, 4>>(
            {{0, 0, 0}, {32767, 1, 0}, {-7, 2000, 0}, {3000, -32767, 9}}, i16, "VEC3");
        builder.json["accessors"][positions]["normalized"] = true;
    }
    SECTION("8 bits, normalised") {
        positions = builder.accessor<std::array<std::uint8_t, 4>>(
            {{0, 0, 0}, {255, 1, 0}, {0, 200, 0}, {77, 5, 9}}, u8, "VEC3");
        builder.json["accessors"][positions]["normalized"] = true;
    }
    const auto view = builder.json["accessors"][positions]["bufferView"].get<std::size_t>();
    builder.json["bufferViews"][view]["byteStride"] =
        builder.json["bufferViews"][view]["byteLength"].get<std::size_t>() / 4;
    builder.json["extensionsUsed"] = builder.json["extensionsRequired"] = {"KHR_mesh_quantization"};
    builder.mesh({{"attributes", {{"POSITION", positions}}}, {"indices", indices}});
    builder.json["nodes"][0]["scale"] = {0.01, 0.01, 0.01};
    const Asset asset = load_glb(builder);
    CHECK(asset.parts[0].position_spacing > 0);
    const WrittenGltf written = write_gltf_of(asset);
    CHECK(written.json["nodes"] == builder.json["nodes"]);
    CHECK(written.positions().value("normalized", false) ==
          builder.json["accessors"][positions].value("normalized", false));
    CHECK(rewritten(asset).parts[0].positions == asset.parts[0].positions);
}

TEST_CASE("quantised normals and texture coordinates are integers, and keep their values when rewritten") {
    Asset asset = load_glb(tilted_gltf());
    Part& part = asset.parts[0];
    for (std::size_t v = 0; v < 4; ++v) {
        const double a = 0.3 + static_cast<double>(v);
        part.normals.push_back({static_cast<float>(std::cos(a)), 0, static_cast<float>(std::sin(a))});
        part.tangents.push_back({0, 1, 0, v % 2 == 0 ? 1.0f : -1.0f});
    }
    part.uvs = {{{0, 0}, {1, 0.123f}, {0.7f, 1}, {0.5f, 0.5f}}, {{0, 0}, {1.5f, 0}, {0, 1}, {1, 1}}};
    asset.normal_bits = 10;
    asset.uv_bits = 12;
    for (const FileOrder order : {FileOrder::given, FileOrder::for_gpu}) {
        for (const Compression compression : {Compression::none, Compression::meshopt}) {
            part.file_order = order;
            asset.compression = compression;
            const WrittenGltf written = write_gltf_of(asset);
            const auto type_of = [&](const char* name) {
                return written.accessor(written.primitive()["attributes"][name])["componentType"].get<int>();
            };
            CHECK(type_of("NORMAL") == i16);
            CHECK(type_of("TANGENT") == i16);
            CHECK(type_of("TEXCOORD_0") == (compression == Compression::none ? u16 : f32));
            CHECK(type_of("TEXCOORD_1") == f32);
            const Asset once = rewritten(asset), twice = rewritten(once);
            const Part &a = once.parts[0], &b = twice.parts[0];
            CHECK(a.normals == b.normals);
            CHECK(a.tangents == b.tangents);
            CHECK(a.uvs == b.uvs);
            CHECK(a.uvs.size() == 2);
            CHECK(std::count_if(a.tangents.begin(), a.tangents.end(),
                                [](const Vec4f& t) { return t[3] == -1; }) == 2);
        }
    }
}
