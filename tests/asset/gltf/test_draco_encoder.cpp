// Writing of KHR_draco_mesh_compression.

#include "asset/gltf/write/draco_encoder.hpp"

#include <algorithm>
#include <array>

#include "support/catch.hpp"
#include "support/curved_grid.hpp"
#include "support/gltf_builder.hpp"
#include "support/largest_difference.hpp"

using namespace faqem;
using namespace faqem::testing;

namespace {

/// The curved grid, with a joint for each vertex, whose number tells which it is.
Asset numbered_grid() {
    Asset asset = curved_grid(FileOrder::for_gpu);
    Part& part = asset.parts[0];
    for (std::size_t v = 0; v < part.positions.size(); ++v) {
        part.joints.push_back({static_cast<std::uint16_t>(v), 0, 0, 0});
        part.weights.push_back({1, 0, 0, 0});
    }
    return asset;
}

/// The vertices of each triangle by their joint, which is not rounded, least first; the triangles sorted.
std::vector<std::array<std::uint16_t, 3>> numbered_triangles(const Part& part) {
    std::vector<std::array<std::uint16_t, 3>> result;
    for (const Triangle& t : part.triangles) {
        std::array<std::uint16_t, 3> own = {part.joints[t[0]][0], part.joints[t[1]][0], part.joints[t[2]][0]};
        std::rotate(own.begin(), std::min_element(own.begin(), own.end()), own.end());
        result.push_back(own);
    }
    std::sort(result.begin(), result.end());
    return result;
}

/// The vertices in the order of their joints.
Part in_order(const Part& part) {
    Part result = part;
    for (std::size_t v = 0; v < part.positions.size(); ++v) {
        const std::size_t to = part.joints[v][0];
        result.positions[to] = part.positions[v];
        result.normals[to] = part.normals[v];
        result.tangents[to] = part.tangents[v];
        result.uvs[0][to] = part.uvs[0][v];
    }
    return result;
}

Asset through_draco(Asset asset) {
    asset.compression = Compression::draco;
    return load_glb(saved(asset));
}

}  // namespace

TEST_CASE("draco data without quantisation has exact values, and the same triangles") {
    if (!detail::has_codec(detail::draco_name)) return;
    const Asset asset = numbered_grid(), read = through_draco(asset);
    CHECK(read.compression == Compression::draco);
    const Part &a = asset.parts[0], b = in_order(read.parts[0]);
    CHECK(numbered_triangles(a) == numbered_triangles(read.parts[0]));
    CHECK(a.positions == b.positions);
    CHECK(largest_difference(a.normals, b.normals) <= 1e-6);
    CHECK(a.uvs == b.uvs);
}

TEST_CASE("quantised draco data is small, within half a step, and equal when it is written again") {
    if (!detail::has_codec(detail::draco_name)) return;
    Asset asset = numbered_grid();
    const std::size_t plain = saved(asset).size();
    asset.parts[0].position_spacing = 0x1p-12;
    asset.normal_bits = 10;
    asset.uv_bits = 12;
    asset.compression = Compression::draco;
    CHECK(saved(asset).size() < plain / 3);
    Asset once = through_draco(asset);
    const Part &a = asset.parts[0], b = in_order(once.parts[0]);
    CHECK(numbered_triangles(a) == numbered_triangles(once.parts[0]));
    CHECK(largest_difference(a.positions, b.positions) <= 0x1p-13);
    CHECK(largest_difference(a.normals, b.normals) <= 0x1p-8);
    CHECK(largest_difference(a.tangents, b.tangents) <= 0x1p-12);
    CHECK(largest_difference(a.uvs[0], b.uvs[0]) <= 0x1p-13);
    once.parts[0].position_spacing = 0x1p-12;
    once.normal_bits = 10;
    once.uv_bits = 12;
    const Part c = in_order(through_draco(once).parts[0]);
    CHECK(b.positions == c.positions);
    CHECK(b.uvs == c.uvs);
    CHECK(largest_difference(b.normals, c.normals) <= 1e-6);
    CHECK(largest_difference(b.tangents, c.tangents) <= 1e-6);
}

TEST_CASE("the extension is required, and accessors have the counts of the data and no views") {
    if (!detail::has_codec(detail::draco_name)) return;
    Asset asset = numbered_grid();
    asset.compression = Compression::draco;
    const Json json = json_of(saved(asset));
    CHECK(json["extensionsUsed"] == Json({"KHR_draco_mesh_compression"}));
    CHECK(json["extensionsRequired"] == Json({"KHR_draco_mesh_compression"}));
    const Json& primitive = json["meshes"][0]["primitives"][0];
    CHECK(primitive["extensions"]["KHR_draco_mesh_compression"]["bufferView"] == 0);
    CHECK(primitive["extensions"]["KHR_draco_mesh_compression"]["attributes"].size() == 6);
    REQUIRE(json["bufferViews"].size() == 1);
    for (const Json& accessor : json["accessors"]) CHECK_FALSE(accessor.contains("bufferView"));
    CHECK(json["accessors"][primitive["attributes"]["POSITION"].get<int>()]["count"] == 625);
    CHECK(json["accessors"][primitive["indices"].get<int>()]["count"] == 3456);
}

TEST_CASE("vertices and triangles of unchanged parts keep their order in draco data, with morph targets") {
    if (!detail::has_codec(detail::draco_name)) return;
    Asset asset = numbered_grid();
    Part& part = asset.parts[0];
    part.file_order = FileOrder::given;
    part.morph_targets.resize(1);
    for (std::size_t v = 0; v < part.positions.size(); ++v)
        part.morph_targets[0].positions.push_back({0, 0, static_cast<float>(v)});
    const Part read = through_draco(asset).parts[0];
    CHECK(read.positions == part.positions);
    CHECK(read.morph_targets[0].positions == part.morph_targets[0].positions);
    CHECK(read.joints == part.joints);
    CHECK(read.triangles == part.triangles);
}

TEST_CASE("steps begin at a multiple of their length, so that equal values stay equal in all primitives") {
    const auto rounding = detail::rounding_to_steps({0.3f, 7, -0.6f, 8.2f}, 2, 0.25);
    REQUIRE(rounding);
    CHECK(rounding->origin == std::vector<float>{-0.5f, 7});
    CHECK(rounding->bits == 3);  // 5 steps of the second component
    CHECK(rounding->range == 7 * 0.25f);
    CHECK_FALSE(detail::rounding_to_steps({1e20f}, 1, 0.25));
    CHECK_FALSE(detail::rounding_to_steps({1}, 1, 0));
}
