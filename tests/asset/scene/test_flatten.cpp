#include "asset/scene/flatten.hpp"

#include <cmath>

#include "support/catch.hpp"
#include "support/format_support.hpp"

using namespace faqem;
using namespace faqem::detail;
using namespace faqem::testing;

namespace {

using Transform = std::array<double, 16>;

constexpr Transform identity = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

Transform scaled(double x, double y, double z) { return {x, 0, 0, 0, 0, y, 0, 0, 0, 0, z, 0, 0, 0, 0, 1}; }

/// A triangle in the plane x + y + z = 1, facing away from the origin, with its normal.
Asset slope() {
    Asset asset = one_part({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2}});
    const float n = 1 / std::sqrt(3.0f);
    asset.parts[0].normals.assign(3, {n, n, n});
    return asset;
}

Vec3 face_normal(const Part& part) {
    const Triangle& t = part.triangles[0];
    const Vec3 &a = part.positions[t[0]], &b = part.positions[t[1]], &c = part.positions[t[2]];
    Vec3 n;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
        n[k] = (b[i] - a[i]) * (c[j] - a[j]) - (b[j] - a[j]) * (c[i] - a[i]);
    }
    const double length = std::hypot(n[0], n[1], n[2]);
    return {n[0] / length, n[1] / length, n[2] / length};
}

}  // namespace

TEST_CASE("an instance with the identity transform is copied bit for bit", "[flatten]") {
    Asset asset = slope();
    asset.parts[0].name = "slope";
    asset.parts[0].positions[0] = {0.1, -0.0, 1e-300};
    asset.parts[0].normals[0] = {0, 0, 5};
    const Part flat = flatten(asset, {{0, identity}});
    CHECK(flat.positions == asset.parts[0].positions);
    CHECK(std::signbit(flat.positions[0][1]));
    CHECK(flat.normals == asset.parts[0].normals);
    CHECK(flat.name == "slope");
}

TEST_CASE("transformed normals match the face normals, also under mirroring", "[flatten]") {
    const Transform shear = {1, 0, 0, 0, 0.5, 2, 0, 0, -0.25, 0.5, 3, 0, 7, 8, 9, 1};
    for (const Transform& m :
         {identity, scaled(2, 1, 0.25), scaled(-1, 1, 1), scaled(-2, -1, 1), scaled(-1, -1, -1), shear}) {
        const Part flat = flatten(slope(), {{0, m}});
        const Vec3 expected = face_normal(flat);
        for (std::size_t k = 0; k < 3; ++k) CHECK(flat.normals[0][k] == Approx(expected[k]).margin(1e-6));
    }
}

TEST_CASE("positions are transformed by the column-major matrix", "[flatten]") {
    // u = x + 2 y + 10, v = 3 y + 20, w = z + 30
    const Transform m = {1, 0, 0, 0, 2, 3, 0, 0, 0, 0, 1, 0, 10, 20, 30, 1};
    const Part flat = flatten(slope(), {{0, m}});
    CHECK(flat.positions == std::vector<Vec3>{{11, 20, 30}, {12, 23, 30}, {10, 20, 31}});
}

TEST_CASE("the winding of mirrored instances is reversed", "[flatten]") {
    CHECK(flatten(slope(), {{0, scaled(1, 1, 1)}}).triangles[0] == Triangle{0, 1, 2});
    CHECK(flatten(slope(), {{0, scaled(-1, 1, 1)}}).triangles[0] == Triangle{0, 2, 1});
    CHECK(flatten(slope(), {{0, scaled(-1, -1, 1)}}).triangles[0] == Triangle{0, 1, 2});
}

TEST_CASE("a singular transform gives finite normals", "[flatten]") {
    const Part planar = flatten(slope(), {{0, scaled(1, 1, 0)}});
    CHECK(planar.normals[0] == Vec3f{0, 0, 1});
    const Part point = flatten(slope(), {{0, scaled(0, 0, 0)}});
    CHECK(point.normals[0] == Vec3f{0, 0, 0});
    CHECK(point.triangles.size() == 1);
}

TEST_CASE("attributes that some parts lack get neutral values", "[flatten]") {
    Asset asset = slope();
    asset.parts.push_back(one_part({{5, 0, 0}, {6, 0, 0}, {5, 1, 0}}, {{2, 1, 0}}).parts[0]);
    asset.parts[1].colors.assign(3, {0.5f, 0, 0, 1});
    asset.parts[1].uvs = {std::vector<Vec2f>(3, {0.25f, 0.75f})};
    asset.parts[1].face_material = {3};
    const Part flat = flatten(asset, {{0, identity}, {1, identity}, {0, scaled(-1, 1, 1)}});
    CHECK(flat.positions.size() == 9);
    CHECK(flat.triangles == std::vector<Triangle>{{0, 1, 2}, {5, 4, 3}, {6, 8, 7}});
    CHECK(flat.face_material == std::vector<Index>{no_index, 3, no_index});
    CHECK(flat.normals[3] == Vec3f{0, 0, 0});
    CHECK(flat.colors[0] == Vec4f{1, 1, 1, 1});
    CHECK(flat.colors[4] == Vec4f{0.5f, 0, 0, 1});
    CHECK(flat.uvs.at(0)[0] == Vec2f{0, 0});
    CHECK(flat.uvs[0][5] == Vec2f{0.25f, 0.75f});
    CHECK(flat.name.empty());
}

TEST_CASE("is_float_representable is true only if all coordinates are floats", "[flatten]") {
    CHECK(is_float_representable({{0.5, -3, 1e30f}, {0.1f, 0, 0}}));
    CHECK(!is_float_representable({{0.5, -3, 0.1}}));
    CHECK(!is_float_representable({{0.5, -3, 1e300}}));
}
