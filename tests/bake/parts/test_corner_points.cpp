#include "bake/parts/corner_points.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bake/parts/corner_normals.hpp"
#include "faqem/simplify.hpp"
#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace faqem;
using namespace faqem::test;

namespace {

// A mesh and its simplified mesh, as input of make_normals().
struct Simplified {
    Simplified(const TriangleMesh& mesh, double share) {
        part.positions = mesh.positions;
        part.triangles = mesh.triangles;
        Options options{.target = ratio(share)};
        options.history = Recording::on;
        result = simplify(mesh.view(), options);
    }

    detail::CornerNormals normals(bool with_map, std::uint32_t threads = 1) const {
        detail::BakePart bake_part{0, &part, &result, nullptr};
        if (with_map) bake_part.map = std::make_unique<const detail::HistoryMap>(SurfaceMap(result.history));
        return detail::make_normals(bake_part, {}, threads);
    }

    Part part;
    SimplifyResult result;
};

// Mean angle in degrees between the normals with and without a map, over the corners.
double mean_angle(const Simplified& simplified) {
    const auto exact = simplified.normals(true).normals, fast = simplified.normals(false).normals;
    REQUIRE(exact.size() == 3 * simplified.result.mesh.triangles.size());
    REQUIRE(fast.size() == exact.size());
    double sum = 0;
    for (std::size_t c = 0; c < exact.size(); ++c) {
        double cosine = 0;
        for (std::size_t k = 0; k < 3; ++k) cosine += double(exact[c][k]) * fast[c][k];
        sum += std::acos(std::clamp(cosine, -1.0, 1.0));
    }
    return sum / static_cast<double>(exact.size()) * 180 / std::numbers::pi;
}

}  // namespace

TEST_CASE("corner points: normals differ little from those of the map") {
    for (const double share : {0.5, 0.1, 0.02}) {
        CHECK(mean_angle({lump(5), share}) < 0.5);
        CHECK(mean_angle({icosphere(5), share}) < 0.5);
    }
}

TEST_CASE("corner points: normals are those of the source all over the faces, not only at the corners") {
    // A flat square with the normals of a wave. Its simplified mesh is too coarse for them.
    const auto normal_at = [](double x) {
        const double slope = 0.8 * std::cos(7 * x), length = std::sqrt(1 + slope * slope);
        return Vec3{slope / length, 0, 1 / length};
    };
    Simplified square(faqem::test::square(48, 1, 0), 0.05);
    for (const Vec3& p : square.part.positions) {
        const Vec3 n = normal_at(p[0]);
        square.part.normals.push_back({float(n[0]), float(n[1]), float(n[2])});
    }
    const TriangleMesh& mesh = square.result.mesh;
    REQUIRE(mesh.triangles.size() > 20);
    for (const bool with_map : {false, true}) {
        const auto normals = square.normals(with_map).normals;
        double fitted = 0, at_corners = 0;
        for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
            const double area = detail::triangle_area(mesh.positions, mesh.triangles[f]);
            for (const Vec3& w : detail::quarter_points) {
                double x = 0;
                Vec3 here{}, corners{};
                for (std::size_t c = 0; c < 3; ++c) {
                    const double corner_x = mesh.positions[mesh.triangles[f][c]][0];
                    x += w[c] * corner_x;
                    for (std::size_t k = 0; k < 3; ++k) {
                        here[k] += w[c] * normals[3 * f + c][k];
                        corners[k] += w[c] * normal_at(corner_x)[k];
                    }
                }
                for (std::size_t k = 0; k < 3; ++k) {
                    fitted += area * std::pow(here[k] - normal_at(x)[k], 2);
                    at_corners += area * std::pow(corners[k] - normal_at(x)[k], 2);
                }
            }
        }
        CHECK(fitted < 0.6 * at_corners);
    }
}

TEST_CASE("corner points: creases are kept") {
    const Simplified cube(fine_cube(12), 0.05);
    REQUIRE(cube.result.mesh.triangles.size() < 100);
    for (const Vec3f& n : cube.normals(false).normals) {
        const float largest = std::max({std::abs(n[0]), std::abs(n[1]), std::abs(n[2])});
        CHECK(largest == Approx(1));
    }
}

TEST_CASE("corner points: a thin wall has the normals of each side") {
    TriangleMesh wall = fine_cube(12);
    for (Vec3& p : wall.positions) p[2] *= 1e-3;
    const Simplified thin(wall, 0.1);
    const TriangleMesh& mesh = thin.result.mesh;
    const auto normals = thin.normals(false).normals;
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
        const Triangle& t = mesh.triangles[f];
        for (const double z : {0.0, 1e-3}) {
            if (std::any_of(t.begin(), t.end(), [&](Index v) { return mesh.positions[v][2] != z; })) continue;
            for (std::size_t c = 0; c < 3; ++c) CHECK(normals[3 * f + c][2] == Approx(z > 0 ? 1 : -1));
        }
    }
}

TEST_CASE("corner points: normals are the same for every number of threads") {
    const Simplified simplified(lump(4), 0.2);
    CHECK(simplified.normals(false, 1).normals == simplified.normals(false, 5).normals);
}

TEST_CASE("corner points: the normals around a vertex of many faces are those of the map") {
    // A flat cone with its tip in the middle of n faces.
    constexpr Index n = 3000;
    TriangleMesh cone;
    cone.positions.push_back({0, 0, 0.1});
    for (Index i = 0; i < n; ++i) {
        const double angle = 2 * std::numbers::pi * i / n;
        cone.positions.push_back({std::cos(angle), std::sin(angle), 0});
        cone.triangles.push_back({0, i + 1, (i + 1) % n + 1});
    }
    const Simplified simplified(cone, 0.5);
    CHECK(mean_angle(simplified) < 0.5);
}
