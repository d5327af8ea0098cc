// Scenes of which people see what is wrong: what they look like after the plain call of simplify() is known.

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "support/catch.hpp"
#include "support/lit.hpp"
#include "support/rays.hpp"
#include "support/scenes.hpp"

using namespace faqem;
using namespace faqem::test;

namespace {

// The point of a surface at (u, v) in [-1, 1]^2 for r = 1; r = 0 is the middle of the body, or its axis.
using Place = std::function<Vec3(double u, double v, double r)>;

Vec3 on_globe(double u, double v, double r) {
    const double x = r / std::hypot(1, 0.5 * u, 0.5 * v);
    return {x, 0.5 * u * x, 0.5 * v * x};
}

Vec3 on_cylinder(double u, double v, double r) {
    return {r * std::cos(0.6 * u), r * std::sin(0.6 * u), 1 + 0.5 * v};
}

Vec3 on_vase(double u, double v, double r) {
    const double radius = r * (0.5 + 0.15 * std::sin(3 * v));
    return {radius * std::cos(pi * u), radius * std::sin(pi * u), v};
}

// Share of rays from the middle that meet a surface of material 0 once, where it was, outside those of material 1.
double share_in_order(Asset source, const Place& place, double share, AlphaMode mode = AlphaMode::opaque) {
    source.materials.resize(2);
    source.materials[0].base_color = {1, 0, 0, 0.3f};
    for (Material& material : source.materials) material.alpha_mode = mode;
    std::array<TriangleMesh, 2> layers;
    for (const Part& part : simplify(source, {.target = ratio(share)}).asset.parts)
        for (std::size_t f = 0; f < part.triangles.size(); ++f) {
            const auto& [a, b, c] = part.triangles[f];
            TriangleMesh& layer = layers.at(part.face_material[f]);
            layer = both(std::move(layer),
                         make({part.positions[a], part.positions[b], part.positions[c]}, {{0, 1, 2}}));
        }
    constexpr int rays = 400;
    Random random(1);
    int found = 0;
    for (int i = 0; i < rays; ++i) {
        const double u = random.between(-0.95, 0.95), v = random.between(-0.95, 0.95);
        const Vec3 from = place(u, v, 0), direction = minus(place(u, v, 1), from);
        const std::vector<double> outer = ray_hits(layers[0], from, direction),
                                  inner = ray_hits(layers[1], from, direction);
        found +=
            outer.size() == 1 && !inner.empty() && outer[0] > inner.back() && std::abs(outer[0] - 1) < 0.03;
    }
    return found / double(rays);
}

// A body and a decal close above it, of another material, in one mesh.
Asset with_decal(const TriangleMesh& body, const Place& place) {
    TriangleMesh decal = grid(24);
    for (Vec3& p : decal.positions) p = place(p[0] / 12 - 1, p[1] / 12 - 1, 1.002);
    Asset asset = asset_with({part_of(both(decal, body), 0)});
    std::fill_n(asset.parts[0].face_material.rbegin(), body.triangles.size(), 1);
    return asset;
}

// The unit sphere with a flat dial instead of the cap above a ring of globe(); the normals of the dial are up.
void check_dial(Index ring) {
    constexpr Index rings = 36;
    const TriangleMesh sphere = globe(rings, 1);
    const auto [radius, zero, height] = sphere.positions[2 * rings * ring];  // on the rim
    const auto cap = sphere.triangles.begin() + 4 * rings * ring;
    TriangleMesh dial = make(sphere.positions, {sphere.triangles.begin(), cap});
    for (Vec3& p : dial.positions) p[2] = height;
    Part source = part_of(both(make(sphere.positions, {cap, sphere.triangles.end()}), dial));
    for (const auto& [x, y, z] : sphere.positions)
        source.normals.push_back({static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)});
    source.normals.resize(source.positions.size(), {0, 0, 1});
    const Part result = simplify(asset_with({source}), {.target = ratio(0.1)}).asset.parts.at(0);
    double area = 0, off_dial = 0, off_body = 0;
    for (const Triangle& t : result.triangles) {
        const Vec3 across = normal(make(result.positions, {}), t);
        const bool is_dial = degrees_between(across, {0, 0, 1}) < 90.0 * ring / rings;
        if (is_dial) area += std::hypot(across[0], across[1], across[2]) / 2;
        for (const Index v : t) {
            const auto& [x, y, z] = result.normals[v];
            double& largest = is_dial ? off_dial : off_body;
            largest =
                std::max(largest, degrees_between({x, y, z}, is_dial ? Vec3{0, 0, 1} : result.positions[v]));
        }
    }
    CAPTURE(ring, result.triangles.size());
    CHECK(area == Approx(pi * radius * radius).epsilon(0.05));
    CHECK(off_dial < 2);
    CHECK(off_body < 2);
}

}  // namespace

TEST_CASE("a decal on a curved body is outside at each point of its area") {
    CHECK(share_in_order(with_decal(globe(48, 1), on_globe), on_globe, 0.1) == 1);
    CHECK(share_in_order(with_decal(cylinder(200, 8, 2), on_cylinder), on_cylinder, 0.02) == 1);
}

TEST_CASE("the eyes of a head in the same mesh keep their size and place") {
    const std::array<Vec3, 2> eyes = {{{0.36, 0.27, 0.9}, {-0.36, 0.27, 0.9}}};
    TriangleMesh head = icosphere(5);
    for (const Vec3& eye : eyes) head = both(std::move(head), moved(globe(12, 0.1), eye));
    for (const auto& [share, allowed] : {std::pair{0.1, 0.05}, {0.03, 0.15}}) {
        const Part result = simplify(asset_with({part_of(head)}), {.target = ratio(share)}).asset.parts.at(0);
        double error = 0;
        for (const Vec3& eye : eyes)
            for (const Vec3& d : icosphere(2).positions) {
                if (d[0] * eye[0] + d[1] * eye[1] + d[2] * eye[2] < 0.3) continue;  // in the head
                const std::vector<double> hits = ray_hits(result, eye, d);
                error = std::max(error, hits.empty() ? 1 : std::abs(hits.back() / 0.1 - 1));
            }
        CHECK(error < allowed);
    }
}

TEST_CASE("a flat dial on a body keeps its normals, and its rim the crease") {
    for (const Index ring : {5, 12, 18}) check_dial(ring);
}

TEST_CASE("each rod of a rack that is lost or shorter is named, and the others have their length") {
    constexpr Index count = 64;
    const auto length = [](Index i) { return 2 + 0.5 * (i % 5); };
    TriangleMesh rack;
    for (Index i = 0; i < count; ++i)
        rack = both(std::move(rack), moved(scaled(cylinder(6, 12, 50 * length(i)), 0.02), {double(i), 0, 0}));
    const auto [asset, report, histories, origins] =
        simplify(asset_with({part_of(rack)}), {.target = ratio(0.01)});
    std::array<double, count> bottom{}, top{};
    bottom.fill(infinity);
    for (const Vec3& p : asset.parts.at(0).positions) {
        const auto i = static_cast<std::size_t>(std::lround(p[0]));
        bottom.at(i) = std::min(bottom[i], p[2]);
        top[i] = std::max(top[i], p[2]);
    }
    std::array<bool, count> is_named{};
    for (const auto* list : {&report.removed_components, &report.shrunk_components})
        for (const RemovedComponent& one : *list)
            is_named.at(static_cast<std::size_t>(std::lround(one.box_min[0]))) = true;
    for (Index i = 0; i < count; ++i) CHECK(is_named[i] == !(top[i] - bottom[i] >= 0.8 * length(i)));
    const auto begin = [](std::size_t number) { return std::to_string(number) + " visible components "; };
    REQUIRE(report.warnings.size() == 2);
    CHECK(report.warnings[0].starts_with(begin(report.removed_components.size()) + "were removed"));
    CHECK(report.warnings[1].starts_with(begin(report.shrunk_components.size()) + "lost"));
    CHECK(8 * std::ranges::count(is_named, false) > static_cast<std::ptrdiff_t>(report.faces_out));
}

TEST_CASE("two blended shells of a vase keep their order along rays") {
    Asset asset = asset_with({part_of(cylinder(96, 48, 2), 0), part_of(cylinder(70, 36, 2), 1)});
    for (Part& part : asset.parts)
        for (Vec3& p : part.positions)
            p = on_vase(std::atan2(p[1], p[0]) / pi, p[2] - 1, &part == &asset.parts[0] ? 1 : 0.996);
    CHECK(share_in_order(asset, on_vase, 0.1, AlphaMode::blend) == 1);
}
