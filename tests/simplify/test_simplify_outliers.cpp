// Meshes whose bounding box says nothing about the size of what is visible: specks and stray faces, as in scans.
#include <cmath>

#include "faqem/compare.hpp"
#include "faqem/simplify.hpp"
#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace faqem;

namespace {

// The faces of a mesh whose first corner is nearer than 3 to (x, 0, 0), moved to the origin.
TriangleMesh unit_ball_at(double x, const TriangleMesh& mesh) {
    TriangleMesh out = test::moved(mesh, {-x, 0, 0});
    std::erase_if(out.triangles, [&](const Triangle& t) {
        const Vec3& p = out.positions[t[0]];
        return !(std::hypot(p[0], p[1], p[2]) < 3);
    });
    return out;
}

TriangleMesh simplified(const TriangleMesh& mesh, Preset preset, std::uint64_t target) {
    return simplify(mesh.view(), {.target = faces(target), .preset = preset}).mesh;
}

// The unit ball at (x, 0, 0) in `result` has at least 90% of the faces of the unit ball simplified alone, and at
// most 1.1 times its Chamfer distance.
void check_ball(const TriangleMesh& result, double x, const TriangleMesh& ball, const TriangleMesh& alone) {
    const TriangleMesh left = unit_ball_at(x, result);
    REQUIRE(left.triangles.size() >= 0.9 * static_cast<double>(alone.triangles.size()));
    CompareOptions options{.samples = 20'000, .tolerance = std::numeric_limits<double>::infinity()};
    const double distance = compare(ball.view(), left.view(), options).chamfer;
    CHECK(distance <= 1.1 * compare(ball.view(), alone.view(), options).chamfer);
}

}  // namespace

TEST_CASE("outliers: a dense speck does not use up the faces of a ball") {
    const TriangleMesh ball = test::globe(34, 1);
    for (const double size : {1e-7, 1e-12}) {
        const TriangleMesh mesh = test::both(ball, test::moved(test::scaled(ball, size), {0.1, 0.2, 0.3}));
        for (const Preset preset : all_presets) {
            CAPTURE(size, name(preset));
            const std::uint64_t target = mesh.triangles.size() / 10;
            TriangleMesh result = simplified(mesh, preset, target);
            std::erase_if(result.triangles, [&](const Triangle& t) {
                const Vec3& p = result.positions[t[0]];
                return std::hypot(p[0] - 0.1, p[1] - 0.2, p[2] - 0.3) < 1e-3;
            });
            check_ball(result, 0, ball, simplified(ball, preset, target));
        }
    }
}

TEST_CASE("outliers: a stray face does not destroy a ball far away from it") {
    const TriangleMesh ball = test::globe(34, 1);
    for (const double distance : {1e4, 1e8, 1e10}) {
        const TriangleMesh mesh = test::both(
            ball, test::make({{distance, 0, 0}, {distance + 1, 0, 0}, {distance, 1, 0}}, {{0, 1, 2}}));
        for (const Preset preset : all_presets) {
            CAPTURE(distance, name(preset));
            const std::uint64_t target = mesh.triangles.size() / 10;
            check_ball(simplified(mesh, preset, target), 0, ball, simplified(ball, preset, target));
        }
    }
}

TEST_CASE("outliers: a vertex far away does not destroy the ball it belongs to") {
    TriangleMesh ball = test::globe(34, 1);
    const TriangleMesh alone = ball;
    ball.positions.back() = {1e9, 0, 0};
    for (const Preset preset : {Preset::qem, Preset::stmw, Preset::fast, Preset::balanced, Preset::best}) {
        CAPTURE(name(preset));
        const std::uint64_t target = ball.triangles.size() / 10;
        const TriangleMesh result = simplified(ball, preset, target);
        CHECK(unit_ball_at(0, result).triangles.size() >= 0.8 * static_cast<double>(target));
    }
}

TEST_CASE("outliers: of two balls far apart, each keeps its share of the faces") {
    const TriangleMesh ball = test::globe(48, 1);  // large enough for rounds by itself
    for (const double distance : {1e3, 1e6, 1e9}) {
        const TriangleMesh mesh = test::both(ball, test::moved(ball, {distance, 0, 0}));
        for (const Preset preset : all_presets) {
            CAPTURE(distance, name(preset));
            const std::uint64_t target = ball.triangles.size() / 10;
            const TriangleMesh alone = simplified(ball, preset, target);
            const TriangleMesh result = simplified(mesh, preset, 2 * target);
            check_ball(result, 0, ball, alone);
            check_ball(result, distance, ball, alone);
        }
    }
}
