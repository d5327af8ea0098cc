// Writing of EXT_meshopt_compression.

#include <algorithm>
#include <cmath>

#include "asset/gltf/write/meshopt_encoder.hpp"
#include "asset/scene/position_rounding.hpp"
#include "support/catch.hpp"
#include "support/curved_grid.hpp"
#include "support/gltf_builder.hpp"
#include "support/largest_difference.hpp"

using namespace faqem;
using namespace faqem::testing;

namespace {

/// The triangle with its least corner first, which compression does not change.
Triangle rotated(Triangle t) {
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    return t;
}

Asset reread(const Asset& asset) { return load_glb(saved(asset)); }

}  // namespace

TEST_CASE("compressed geometry is smaller, has exact positions, and directions and UVs within half a step") {
    if (!detail::has_codec(detail::meshopt_name)) return;
    Asset asset = curved_grid(FileOrder::for_gpu);
    const Asset plain = reread(asset);
    const std::size_t plain_size = saved(asset).size();
    asset.compression = Compression::meshopt;
    CHECK(saved(asset).size() < plain_size / 2);
    const Asset read = reread(asset);
    CHECK(read.compression == Compression::meshopt);
    const Part &a = plain.parts[0], &b = read.parts[0];
    CHECK(a.positions == b.positions);
    CHECK(largest_difference(a.normals, b.normals) <= 0x1p-12);
    CHECK(largest_difference(a.tangents, b.tangents) <= 0x1p-12);
    CHECK(largest_difference(a.uvs[0], b.uvs[0]) <= 0x1p-16);
    CHECK(largest_difference(a.uvs[0], b.uvs[0]) > 0);
    REQUIRE(a.triangles.size() == b.triangles.size());
    for (std::size_t f = 0; f < a.triangles.size(); ++f)
        REQUIRE(rotated(a.triangles[f]) == rotated(b.triangles[f]));
}

TEST_CASE("a compressed file that is read and written again has the same values") {
    if (!detail::has_codec(detail::meshopt_name)) return;
    Asset asset = curved_grid(FileOrder::for_gpu);
    asset.compression = Compression::meshopt;
    const Asset once = reread(asset), twice = reread(once);
    CHECK(once.parts[0].positions == twice.parts[0].positions);
    CHECK(once.parts[0].normals == twice.parts[0].normals);
    CHECK(once.parts[0].tangents == twice.parts[0].tangents);
    CHECK(once.parts[0].uvs == twice.parts[0].uvs);
    CHECK(once.parts[0].triangles == twice.parts[0].triangles);
}

TEST_CASE("compression changes nothing of a part that is written as it is") {
    Asset asset = curved_grid(FileOrder::given);
    const Asset plain = reread(asset);
    asset.compression = Compression::meshopt;
    const Asset read = reread(asset);
    CHECK(plain.parts[0].normals == read.parts[0].normals);
    CHECK(plain.parts[0].tangents == read.parts[0].tangents);
    CHECK(plain.parts[0].uvs == read.parts[0].uvs);
    CHECK(plain.parts[0].triangles == read.parts[0].triangles);
}

TEST_CASE("only a compressed document requires the extension and has a buffer without bytes") {
    if (!detail::has_codec(detail::meshopt_name)) return;
    Asset asset = curved_grid(FileOrder::for_gpu);
    CHECK(json_of(saved(asset)).value("extensionsUsed", Json()) == Json());
    asset.compression = Compression::meshopt;
    const Json json = json_of(saved(asset));
    CHECK(json["extensionsUsed"] == Json({"EXT_meshopt_compression"}));
    CHECK(json["extensionsRequired"] == Json({"EXT_meshopt_compression"}));
    REQUIRE(json["buffers"].size() == 2);
    CHECK(json["buffers"][1]["extensions"]["EXT_meshopt_compression"]["fallback"] == true);
    CHECK_FALSE(json["buffers"][1].contains("uri"));
    for (const Json& view : json["bufferViews"]) {
        CHECK(view["buffer"] == 1);
        CHECK(view["byteOffset"].get<std::uint64_t>() + view["byteLength"].get<std::uint64_t>() <=
              json["buffers"][1]["byteLength"].get<std::uint64_t>());
    }
}

TEST_CASE("values that are no multiples of the steps within 24 bits are compressed without rounding") {
    if (!detail::has_codec(detail::meshopt_name)) return;
    Asset asset = curved_grid(FileOrder::for_gpu);
    for (Vec2f& uv : asset.parts[0].uvs[0]) uv[0] += 4096;
    const Asset plain = reread(asset);
    asset.compression = Compression::meshopt;
    CHECK(plain.parts[0].uvs == reread(asset).parts[0].uvs);
}

TEST_CASE("quantised geometry is smaller still, and is read and written again with equal values") {
    if (!detail::has_codec(detail::meshopt_name)) return;
    Asset asset = curved_grid(FileOrder::for_gpu);
    const Asset plain = reread(asset);
    asset.compression = Compression::meshopt;
    const std::size_t size = saved(asset).size();
    asset.parts[0].position_spacing = 0x1p-12;
    asset.normal_bits = 10;
    asset.uv_bits = 12;
    CHECK(saved(asset).size() < size * 3 / 4);
    const Asset once = reread(asset), twice = reread(once);
    const Part &a = plain.parts[0], &b = once.parts[0], &c = twice.parts[0];
    CHECK(largest_difference(a.normals, b.normals) <= 0x1p-8);
    CHECK(largest_difference(a.tangents, b.tangents) <= 0x1p-8);
    CHECK(largest_difference(a.uvs[0], b.uvs[0]) <= 0x1p-13);
    for (std::size_t v = 0; v < a.positions.size(); ++v)
        for (std::size_t k = 0; k < 3; ++k)
            REQUIRE(std::abs(a.positions[v][k] - b.positions[v][k] * 0x1p-12) <= 0x1p-13);
    CHECK(b.positions == c.positions);
    CHECK(b.normals == c.normals);
    CHECK(b.tangents == c.tangents);
    CHECK(b.uvs == c.uvs);
}

TEST_CASE("vertices that are rounded before have the positions and UVs of a file that rounds them") {
    if (!detail::has_codec(detail::meshopt_name)) return;
    for (const std::uint32_t bits : {0u, 9u}) {
        CAPTURE(bits);
        Asset asset = curved_grid(FileOrder::for_gpu);
        asset.compression = Compression::meshopt;
        asset.parts[0].position_spacing = 0x1p-7;
        asset.uv_bits = bits;
        const Asset file = reread(asset);
        CHECK(detail::round_vertices(asset));
        asset.compression = Compression::none;
        asset.parts[0].position_spacing = 0;
        asset.uv_bits = 0;
        CHECK_FALSE(detail::round_vertices(asset));
        Part rounded = reread(asset).parts[0];
        for (Vec3& position : rounded.positions)
            for (double& x : position) x /= 0x1p-7;
        CHECK(rounded.positions == file.parts[0].positions);
        CHECK(rounded.uvs == file.parts[0].uvs);
    }
}
