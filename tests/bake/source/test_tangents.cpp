#include "bake/source/tangents.hpp"

#include <cmath>

#include "support/catch.hpp"

using namespace faqem;
using detail::mikk_tangents;
using detail::TangentCorner;

namespace {

void check(const Vec4f& got, const Vec4f& expected) {
    for (std::size_t k = 0; k < 4; ++k) CHECK(got[k] == Approx(expected[k]).margin(2e-6));
}

// A square of two triangles at z = 0; u goes from u0 to u1 along x, and v from v0 to v1 along y.
std::vector<TangentCorner> mapped_square(float u0, float u1, float v0, float v1) {
    const auto corner = [&](float x, float y) {
        return TangentCorner{{x, y, 0}, {0, 0, 1}, {x > 0 ? u1 : u0, y > 0 ? v1 : v0}};
    };
    return {corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 0), corner(1, 1), corner(0, 1)};
}

}  // namespace

TEST_CASE("tangents are along u and w is the sign of the bitangent") {
    for (const Vec4f& t : mikk_tangents(mapped_square(0, 1, 1, 0))) check(t, {1, 0, 0, 1});
    for (const Vec4f& t : mikk_tangents(mapped_square(1, 0, 1, 0))) check(t, {-1, 0, 0, -1});
    for (const Vec4f& t : mikk_tangents(mapped_square(0, 1, 0, 1))) check(t, {1, 0, 0, -1});
}

TEST_CASE("tangents agree with the reference implementation on a curved fan") {
    // Expected: npm mikktspace 1.1.1, w negated as three.js does for glTF.
    const std::vector<TangentCorner> v = {{{0, 0, 0.5f}, {0, 0, 1}, {0.5f, 0.5f}},
                                          {{1, 0, 0}, {0.6f, 0, 0.8f}, {0.75f, 0.625f}},
                                          {{0.25f, 1.5f, 0}, {0, 0.6f, 0.8f}, {0.5f, 0.125f}},
                                          {{-1, 0.25f, 0.125f}, {-0.6f, 0, 0.8f}, {0.25f, 0.5f}},
                                          {{0, -0.75f, 0}, {0, -0.6f, 0.8f}, {0.625f, 0.875f}}};
    const std::vector<Vec4f> expected = {{0.999609f, 0.027954f, 0, 1},
                                         {0.758064f, 0.319518f, -0.568548f, 1},
                                         {0.991753f, 0.102534f, -0.076901f, 1},
                                         {0.777216f, -0.236956f, 0.582912f, 1},
                                         {0.999936f, 0.009050f, 0.006788f, 1}};
    std::vector<std::size_t> order;
    for (std::size_t i = 1; i <= 4; ++i) order.insert(order.end(), {0, i, i % 4 + 1});
    std::vector<TangentCorner> corners;
    for (std::size_t i : order) corners.push_back(v[i]);
    const std::vector<Vec4f> got = mikk_tangents(corners);
    REQUIRE(got.size() == order.size());
    for (std::size_t c = 0; c < order.size(); ++c) check(got[c], expected[order[c]]);
}

TEST_CASE("mirrored UVs have separate tangents along the mirror line") {
    // u increases from x = 0 in both directions.
    std::vector<TangentCorner> corners = mapped_square(0, 1, 1, 0);
    for (TangentCorner c : mapped_square(0, 1, 1, 0)) {
        c.position[0] = -c.position[0];
        corners.push_back(c);
    }
    std::swap(corners[7], corners[8]);
    std::swap(corners[10], corners[11]);
    const std::vector<Vec4f> got = mikk_tangents(corners);
    for (std::size_t c = 0; c < 6; ++c) check(got[c], {1, 0, 0, 1});
    for (std::size_t c = 6; c < 12; ++c) check(got[c], {-1, 0, 0, -1});
}

TEST_CASE("triangles without UV area use a neighbour's tangent or any perpendicular to the normal") {
    std::vector<TangentCorner> corners = mapped_square(0, 1, 1, 0);
    corners[5].uv = corners[3].uv;  // the UVs of the second triangle are collinear now
    corners[5].position = {0.5f, 1, 0};
    const std::vector<Vec4f> got = mikk_tangents(corners);
    check(got[3], {1, 0, 0, 1});
    check(got[4], {1, 0, 0, 1});
    for (TangentCorner& c : corners) {
        c.uv = {0.5f, 0.5f};
        c.normal = {1, 0, 0};
    }
    for (const Vec4f& t : mikk_tangents(corners)) {
        CHECK(t[0] == Approx(0).margin(1e-6));
        CHECK(std::hypot(t[1], t[2]) == Approx(1));
        CHECK(t[3] == 1);
    }
    CHECK(mikk_tangents({}).empty());
}

TEST_CASE("degenerate triangles use the tangents at their vertices") {
    std::vector<TangentCorner> corners = mapped_square(1, 0, 1, 0);
    corners.insert(corners.end(), {corners[0], corners[0], corners[1]});
    const std::vector<Vec4f> got = mikk_tangents(corners);
    for (std::size_t c = 6; c < 9; ++c) check(got[c], {-1, 0, 0, -1});
}
