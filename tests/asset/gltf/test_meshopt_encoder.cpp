// Writing of EXT_meshopt_compression.

#include <algorithm>
#include <array>
#include <cmath>

#include "asset/gltf/write/meshopt_encoder.hpp"
#include "support/catch.hpp"
#include "support/gltf_builder.hpp"

using namespace faqem;
using namespace faqem::testing;

namespace {

/// A curved grid with normals, tangents and texture coordinates.
Asset curved_grid(FileOrder order) {
    constexpr Index n = 24;
    Asset asset = one_part({}, {});
    Part& part = asset.parts[0];
    part.file_order = order;
    part.uvs.resize(1);
    for (Index i = 0; i < (n + 1) * (n + 1); ++i) {
        const double x = static_cast<double>(i % (n + 1)) / 7, y = static_cast<double>(i / (n + 1)) / 11;
        part.positions.push_back(
            {static_cast<float>(x), static_cast<float>(y), static_cast<float>(std::sin(x * y))});
        const double length = std::sqrt(1 + x * x + y * y);
        part.normals.push_back({static_cast<float>(x / length), static_cast<float>(-y / length),
                                static_cast<float>(1 / length)});
        part.tangents.push_back({static_cast<float>(std::cos(x)), static_cast<float>(std::sin(x)), 0, 1});
        part.uvs[0].push_back({static_cast<float>(x / 3), static_cast<float>(1.7 - y)});
    }
    for (Index i = 0; i < n * n; ++i) {
        const Index v = i / n * (n + 1) + i % n;
        part.triangles.push_back({v, v + 1, v + n + 1});
        part.triangles.push_back({v + 1, v + n + 2, v + n + 1});
    }
    part.face_material.assign(part.triangles.size(), no_index);
    return asset;
}

template <std::size_t N>
double largest_difference(const std::vector<std::array<float, N>>& a,
                          const std::vector<std::array<float, N>>& b) {
    REQUIRE(a.size() == b.size());
    double result = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        for (std::size_t k = 0; k < N; ++k) result = std::max(result, std::abs(double{a[i][k]} - b[i][k]));
    return result;
}

/// The triangle with its least corner first, which compression does not change.
Triangle rotated(Triangle t) {
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    return t;
}

Asset reread(const Asset& asset) { return load_glb(saved(asset)); }

}  // namespace

TEST_CASE("compressed geometry is smaller, has exact positions, and directions and UVs within half a step") {
    if (!detail::can_encode_meshopt()) return;
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
    if (!detail::can_encode_meshopt()) return;
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

TEST_CASE(
    "a compressed document requires the extension and has a buffer without bytes, an uncompressed one has "
    "not") {
    if (!detail::can_encode_meshopt()) return;
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
    if (!detail::can_encode_meshopt()) return;
    Asset asset = curved_grid(FileOrder::for_gpu);
    for (Vec2f& uv : asset.parts[0].uvs[0]) uv[0] += 4096;
    const Asset plain = reread(asset);
    asset.compression = Compression::meshopt;
    CHECK(plain.parts[0].uvs == reread(asset).parts[0].uvs);
}

TEST_CASE("quantised geometry is smaller still, and is read and written again with equal values") {
    if (!detail::can_encode_meshopt()) return;
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
