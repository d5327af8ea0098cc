// Degenerate, non-manifold and otherwise difficult meshes, simplified with every preset.

#include <sys/mman.h>

#include <cmath>

#include "faqem/compare.hpp"
#include "faqem/simplify.hpp"
#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace faqem;

namespace {

Options to_ratio(Preset preset, double share) {
    Options o{.target = ratio(share), .preset = preset};
    o.topology.weld_distance = 0;  // the distance of preset paper is in model units
    return o;
}

/// Checks that positions are finite, corners distinct and in range, and that the report fits the mesh.
void check_sound(const SimplifyResult& result) {
    for (const Vec3& p : result.mesh.positions)
        for (const double x : p) REQUIRE(std::isfinite(x));
    for (const Triangle& t : result.mesh.triangles) {
        REQUIRE((t[0] != t[1] && t[1] != t[2] && t[2] != t[0]));
        for (const Index v : t) REQUIRE(v < result.mesh.positions.size());
    }
    CHECK(result.report.faces_out == result.mesh.triangles.size());
    CHECK((result.report.faces_out <= result.report.target_faces) ==
          (result.report.stop == StopReason::reached_target));
}

/// Calls check(result) for the result of every preset.
template <class Check>
void every_preset(const TriangleMesh& mesh, double share, Check check) {
    for (const Preset preset : all_presets) {
        INFO(name(preset));
        const SimplifyResult result = simplify(mesh.view(), to_ratio(preset, share));
        check_sound(result);
        check(result);
    }
}

/// Hausdorff distance of the surfaces (sampled), relative to the diagonal.
double relative_distance(const TriangleMesh& a, const TriangleMesh& b) {
    const Comparison c = compare(a.view(), b.view(), {.samples = 1000});
    return c.hausdorff / c.diagonal;
}

/// m by n quads along a curve that turns around while it goes around the origin: the cross-section `curve(t)`, t from 0
/// to 1, is (x, y) = -curve(1 - t), so that the ends of the surface fit.
template <class Curve>
TriangleMesh turned_surface(Index m, Index n, bool is_closed, Curve curve) {
    TriangleMesh mesh;
    const Index ring = is_closed ? n : n + 1;
    for (Index i = 0; i < m; ++i)
        for (Index j = 0; j < ring; ++j) {
            const double u = 2 * test::pi * i / m, c = std::cos(u / 2), s = std::sin(u / 2);
            const auto [x, y] = curve(double(j) / n);
            const double r = 2 + c * x - s * y;
            mesh.positions.push_back({r * std::cos(u), r * std::sin(u), s * x + c * y});
        }
    const auto at = [&](Index i, Index j) { return i < m ? i * ring + j % ring : (n - j) % ring; };
    for (Index i = 0; i < m; ++i)
        for (Index j = 0; j < n; ++j) {
            mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    return mesh;
}

/// A Klein bottle (figure-eight immersion): closed, non-orientable and self-intersecting.
TriangleMesh klein_bottle(Index m, Index n) {
    return turned_surface(m, n, true, [](double t) {
        return std::pair(std::sin(2 * test::pi * t), std::sin(4 * test::pi * t));
    });
}

TriangleMesh some_reversed(TriangleMesh mesh, double share, std::uint32_t seed) {
    test::Random random(seed);
    for (Triangle& t : mesh.triangles)
        if (random.unit() < share) std::swap(t[1], t[2]);
    return mesh;
}

/// A curved grid of faces on both sides, over the same vertices.
TriangleMesh two_sided_grid(Index n) {
    TriangleMesh front = test::grid(n);
    for (Vec3& p : front.positions) p[2] = 0.1 * std::sin(p[0]) * n / 4;
    TriangleMesh both = front;
    for (const auto [a, b, c] : front.triangles) both.triangles.push_back({a, c, b});
    return both;
}

double share_of_nonmanifold_edges(const TriangleMesh& mesh) {
    const test::Edges edges = test::edges(mesh.triangles);
    const auto many = std::count_if(edges.begin(), edges.end(), [](const auto& e) { return e.second > 2; });
    return static_cast<double>(many) / static_cast<double>(edges.size());
}

}  // namespace

TEST_CASE("degenerate input: a thin surface with faces on both sides keeps its shape") {
    const TriangleMesh mesh = two_sided_grid(16);
    every_preset(mesh, 0.1, [&](const SimplifyResult& result) {
        CHECK(result.report.stop == StopReason::reached_target);
        const bool holds_outlines = result.report.preset >= Preset::fast;
        CHECK(relative_distance(mesh, result.mesh) < (holds_outlines ? 0.1 : 0.3));
    });
}

TEST_CASE("degenerate input: a two-sided thin surface with 30% reversed faces keeps its shape") {
    const TriangleMesh mesh = some_reversed(two_sided_grid(16), 0.3, 7);
    every_preset(mesh, 0.1, [&](const SimplifyResult& result) {
        CHECK(result.report.stop == StopReason::reached_target);
        CHECK(relative_distance(mesh, result.mesh) < 0.3);
    });
}

TEST_CASE("degenerate input: a sphere with mixed or inverted winding keeps its shape") {
    for (const TriangleMesh& mesh :
         {some_reversed(test::icosphere(3), 0.3, 3), test::inside_out(test::icosphere(3))})
        every_preset(mesh, 0.1, [&](const SimplifyResult& result) {
            CHECK(relative_distance(mesh, result.mesh) < 0.1);
        });
}

TEST_CASE("degenerate input: non-orientable surfaces keep their topology under the link condition") {
    for (const TriangleMesh& mesh : {test::moebius(40, 6), klein_bottle(40, 16)}) {
        REQUIRE(test::euler(mesh.triangles) == 0);
        every_preset(mesh, 0.2, [](const SimplifyResult&) {});
        Options options = to_ratio(Preset::qem, 0.2);
        options.topology.link = LinkCondition::strict;
        const SimplifyResult result = simplify(mesh.view(), options);
        CHECK(result.report.stop == StopReason::reached_target);
        CHECK(test::euler(result.mesh.triangles) == 0);
        CHECK(test::closed_manifold(result.mesh.triangles) == test::closed_manifold(mesh.triangles));
    }
}

TEST_CASE("degenerate input: the target is reached with fins and bow-tie vertices") {
    TriangleMesh mesh = test::icosphere(2);
    // For every tenth face a fin on one of its edges, and a triangle attached to one of its vertices.
    for (std::size_t f = 0; f < 320; f += 10) {
        const auto [a, b, c] = mesh.triangles[f];
        const auto first = static_cast<Index>(mesh.positions.size());
        for (const double r : {1.2, 1.3, 1.4}) {
            const Vec3 p = mesh.positions[c];
            mesh.positions.push_back({r * p[0], r * p[1], r * p[2] + 0.1 * r});
        }
        mesh.triangles.push_back({a, b, first});
        mesh.triangles.push_back({c, first + 1, first + 2});
    }
    every_preset(mesh, 0.2, [](const SimplifyResult& result) {
        CHECK(result.report.stop == StopReason::reached_target);
    });
}

TEST_CASE("degenerate input: the target is reached with 28% non-manifold edges") {
    const TriangleMesh mesh = test::soup(5, 40, 700);
    REQUIRE(share_of_nonmanifold_edges(mesh) > 0.28);
    every_preset(mesh, 0.1, [](const SimplifyResult& result) {
        CHECK(!result.mesh.triangles.empty());
        CHECK(result.report.stop == StopReason::reached_target);
        CHECK(result.mesh.triangles.size() <= 70);
    });
}

TEST_CASE("degenerate input: the target is reached with thousands of components") {
    TriangleMesh mesh;
    for (int i = 0; i < 2000; ++i) {
        const double size = 1 + i % 7;
        mesh = test::both(std::move(mesh), test::moved(test::scaled(test::tetrahedron(), size),
                                                       {20.0 * (i % 45), 20.0 * (i / 45), 0}));
    }
    every_preset(mesh, 0.1, [](const SimplifyResult& result) { CHECK(result.report.faces_out <= 800); });
}

TEST_CASE("degenerate input: coincident and touching boxes with virtual edges give valid results") {
    TriangleMesh mesh = test::both(test::cube(), test::inside_out(test::cube()));
    mesh = test::both(mesh, test::moved(test::cube(), {1, 0, 0}));
    mesh = test::both(mesh, test::moved(test::cube(), {2.001, 0, 0}));
    for (const Preset preset : all_presets) {
        for (const Weld weld : {Weld::by_position, Weld::none}) {
            INFO(name(preset));
            Options options = to_ratio(preset, 0.3);
            options.topology.weld = weld;
            options.topology.virtual_edges = VirtualEdges::on;
            const SimplifyResult result = simplify(mesh.view(), options);
            check_sound(result);
            CHECK(!result.mesh.triangles.empty());
        }
    }
}

TEST_CASE("degenerate input: the result is finite with one vertex at 1e38 and others at 1") {
    TriangleMesh mesh = test::icosphere(2);
    mesh.positions[5] = {1e38, -1e38, 1e38};
    every_preset(mesh, 0.1, [](const SimplifyResult& result) { CHECK(!result.mesh.triangles.empty()); });
}

TEST_CASE("degenerate input: faces of zero area have little effect on the shape") {
    TriangleMesh mesh = test::shaken(test::grid(12), 0.2, 1);
    for (Index f = 0; f < 100; f += 7) {
        // Two needle-shaped faces of area 0 and 1e-16 on an edge.
        const auto [a, b, c] = mesh.triangles[f];
        const auto middle = static_cast<Index>(mesh.positions.size());
        const Vec3 p = mesh.positions[a], q = mesh.positions[b];
        mesh.positions.push_back({(p[0] + q[0]) / 2, (p[1] + q[1]) / 2, (p[2] + q[2]) / 2});
        mesh.positions.push_back({(p[0] + q[0]) / 2, (p[1] + q[1]) / 2, (p[2] + q[2]) / 2 + 1e-16});
        mesh.triangles.push_back({a, b, middle});
        mesh.triangles.push_back({a, b, middle + 1});
    }
    every_preset(mesh, 0.1, [&](const SimplifyResult& result) {
        // The paper divides by areas, so that a needle has more weight than the faces around it.
        CHECK(relative_distance(mesh, result.mesh) < (result.report.preset == Preset::paper ? 0.5 : 0.2));
    });
    Options options = to_ratio(Preset::paper, 0.1);
    options.weights.plane_area = 2;
    check_sound(simplify(mesh.view(), options));
}

TEST_CASE("degenerate input: nearly parallel planes do not move vertices far outside the bounding box") {
    // Vertices were ten times the length of the tube away when the minimum of the quadric was used without a
    // limit.
    const TriangleMesh mesh = test::shaken(test::cylinder(10, 10, 10), 0.001, 35);
    every_preset(mesh, 0.01, [](const SimplifyResult& result) {
        for (const auto [x, y, z] : result.mesh.positions) {
            CHECK(std::abs(x) < 3);
            CHECK(std::abs(y) < 3);
            CHECK(std::abs(z - 5) < 7);
        }
    });
}

TEST_CASE("degenerate input: coincident vertices give an empty mesh and a warning") {
    TriangleMesh mesh = test::icosphere(1);
    for (Vec3& p : mesh.positions) p = {1, 2, 3};
    every_preset(mesh, 0.1, [](const SimplifyResult& result) {
        CHECK(result.mesh.triangles.empty());
        CHECK(result.report.faces_dropped == 80);
        REQUIRE(!result.report.warnings.empty());
        CHECK(result.report.warnings.back() == "the result is empty: all remaining faces are degenerate");
    });
}

TEST_CASE("meshes too large for 32-bit indices are refused before their arrays are read") {
    // The memory is reserved without access rights, so that reading it would end the test.
    const std::size_t count = std::size_t{1} << 32, bytes = count * sizeof(Vec3f);
    void* const memory =
        ::mmap(nullptr, bytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    REQUIRE(memory != MAP_FAILED);
    MeshView view{std::span(static_cast<const Vec3f*>(memory), count), {}};
    CHECK_THROWS_WITH(simplify(view), "positions: has 4294967296 vertices, more than 2^32 - 2");
    view.positions = {};
    view.triangles = std::span(static_cast<const Triangle*>(memory), count);
    CHECK_THROWS_WITH(simplify(view), StartsWith("triangles: has 4294967296 faces, more than "));
    ::munmap(memory, bytes);
}
