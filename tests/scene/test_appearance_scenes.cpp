// Scenes of which people see what is wrong: what they look like after the plain call of simplify() is known.

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "support/catch.hpp"
#include "support/lit.hpp"
#include "support/meshes.hpp"
#include "support/rays.hpp"
#include "support/scenes.hpp"

using namespace faqem;
using namespace faqem::test;

namespace {

constexpr int rays = 400;

// A point above (u, v) in [-1, 1]^2: at distance r from the centre of a body, or from its axis.
using Place = std::function<Vec3(double u, double v, double r)>;

Vec3 on_globe(double u, double v, double r) {
    const double x = r / std::hypot(1, 0.5 * u, 0.5 * v);
    return {x, 0.5 * u * x, 0.5 * v * x};
}

Vec3 on_cylinder(double u, double v, double r) {
    return {r * std::cos(0.6 * u), r * std::sin(0.6 * u), 1 + 0.5 * v};
}

TriangleMesh faces_of(const Asset& asset, Index material) {
    TriangleMesh faces;
    for (const Part& part : asset.parts) {
        TriangleMesh own = make(part.positions, {});
        for (std::size_t f = 0; f < part.triangles.size(); ++f)
            if (part.face_material[f] == material) own.triangles.push_back(part.triangles[f]);
        faces = both(std::move(faces), own);
    }
    return faces;
}

// Simplifies a body of radius 1 with a decal above it; the decal has to be outside at each point of its area.
void check_decal(const TriangleMesh& body, const Place& place, double share) {
    TriangleMesh decal = grid(24);
    for (Vec3& p : decal.positions) p = place(p[0] / 12 - 1, p[1] / 12 - 1, 1.002);
    Part joined = part_of(both(body, decal), 0);
    std::fill(joined.face_material.begin() + static_cast<std::ptrdiff_t>(body.triangles.size()),
              joined.face_material.end(), 1);
    for (Asset asset : {asset_with({part_of(body, 0), part_of(decal, 1)}), asset_with({joined})}) {
        asset.materials.resize(2);
        asset.materials[1].base_color = {1, 0, 0, 1};
        const Asset result = simplify(asset, {.target = ratio(share)}).asset;
        const TriangleMesh below = faces_of(result, 0), above = faces_of(result, 1);
        Random random(1);
        int missing = 0, crossed = 0, loose = 0;
        for (int i = 0; i < rays; ++i) {
            const double u = random.between(-0.95, 0.95), v = random.between(-0.95, 0.95);
            const Vec3 from = place(u, v, 0), direction = minus(place(u, v, 1), from);
            const std::vector<double> hits = ray_hits(above, from, direction);
            missing += hits.size() != 1;
            if (hits.empty()) continue;
            crossed += !(hits[0] > ray_hits(below, from, direction).back());
            loose += !(hits[0] < 1.01);
        }
        CAPTURE(asset.parts.size(), below.triangles.size(), above.triangles.size());
        CHECK(missing == 0);
        CHECK(crossed == 0);
        CHECK(loose == 0);
    }
}

}  // namespace

TEST_CASE("a decal on a curved body stays on it, all over its area") {
    check_decal(globe(48, 1), on_globe, 0.1);
    check_decal(cylinder(200, 8, 2), on_cylinder, 0.02);
}
