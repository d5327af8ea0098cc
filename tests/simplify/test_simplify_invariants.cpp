// Invariants of simplify() for seeded random triangle soups and surfaces, with every preset and three ratios.

#include <set>
#include <thread>

#include "faqem/simplify.hpp"
#include "support/catch.hpp"
#include "support/meshes.hpp"
#include "support/results.hpp"

using namespace faqem;
using test::same_bits;
using test::taken;

namespace {

constexpr double ratios[] = {0.5, 0.1, 0.01};

SimplifyResult run(const TriangleMesh& mesh, Preset preset, double share) {
    Options o{.target = ratio(share), .preset = preset};
    o.topology.weld_distance = 0;  // the distance of preset paper is in model units
    return simplify(mesh.view(), o);
}

// Calls check(mesh, result) for a mesh with every preset and ratio.
template <class Check>
void everywhere(const TriangleMesh& mesh, Check check) {
    for (const Preset preset : all_presets) {
        for (const double share : ratios) {
            INFO(name(preset) << " to " << share << ", " << mesh.triangles.size() << " faces");
            check(mesh, run(mesh, preset, share));
        }
    }
}

// Triangle soups of 40 to 370 faces over 60 vertices.
std::vector<TriangleMesh> soups() {
    std::vector<TriangleMesh> meshes;
    for (std::uint32_t seed = 0; seed < 12; ++seed) meshes.push_back(test::soup(seed, 60, 40 + 30 * seed));
    return meshes;
}

// Open and closed surfaces, and meshes of several components that touch.
std::vector<TriangleMesh> surfaces() {
    std::vector<TriangleMesh> meshes;
    for (std::uint32_t seed = 0; seed < 3; ++seed) {
        meshes.push_back(test::shaken(test::grid(9), 0.3, seed));
        meshes.push_back(test::shaken(test::cylinder(11, 8, 3), 0.1, seed));
        meshes.push_back(test::shaken(test::icosphere(2), 0.05, seed));
        meshes.push_back(test::shaken(test::torus(14, 9), 0.05, seed));
        // Grids on a common lattice are partly welded; one of them is reversed.
        TriangleMesh mix = test::both(test::grid(5), test::moved(test::grid(5), {5, 0, 0}));
        mix = test::both(mix, test::inside_out(test::moved(test::grid(5), {0, 2, 0})));
        meshes.push_back(test::both(mix, test::moved(test::soup(seed, 20, 60), {3, 3, 3})));
    }
    return meshes;
}

std::vector<TriangleMesh> all_sorts() {
    std::vector<TriangleMesh> meshes = soups();
    for (TriangleMesh& mesh : surfaces()) meshes.push_back(std::move(mesh));
    return meshes;
}

bool finite(const TriangleMesh& mesh) {
    return std::all_of(mesh.positions.begin(), mesh.positions.end(), [](const Vec3& p) {
        return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
    });
}

bool indices_valid_and_used(const TriangleMesh& mesh) {
    std::set<Index> used;
    for (const Triangle& t : mesh.triangles) {
        if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) return false;
        used.insert(t.begin(), t.end());
    }
    return used.size() == mesh.positions.size() && (used.empty() || *used.rbegin() < mesh.positions.size());
}

// True if the height of every face is more than 1e-12 of its longest edge.
bool has_area(const TriangleMesh& mesh) {
    return std::all_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const Triangle& t) {
        double longest = 0;
        for (unsigned i = 0; i < 3; ++i) {
            const Vec3 e = test::minus(mesh.positions[t[(i + 1) % 3]], mesh.positions[t[i]]);
            longest = std::max(longest, e[0] * e[0] + e[1] * e[1] + e[2] * e[2]);
        }
        const Vec3 n = test::normal(mesh, t);
        return std::hypot(n[0], n[1], n[2]) > 0.99e-12 * longest;
    });
}

template <class T>
bool ascending(const std::vector<T>& values) {
    return std::adjacent_find(values.begin(), values.end(), std::greater_equal<>()) == values.end();
}

bool climbed(const Report& report) {
    for (std::size_t i = 1; i < rung_kinds; ++i) {
        if (report.rungs[i] > 0) return true;
    }
    return false;
}

// Checks that positions are finite, vertices referenced, faces not degenerate and origins in range, and that
// the target is reached or a reason reported.
void is_sound(const TriangleMesh& mesh, const SimplifyResult& result) {
    CHECK(finite(result.mesh));
    CHECK(indices_valid_and_used(result.mesh));
    CHECK(has_area(result.mesh));
    REQUIRE(result.face_origin.size() == result.mesh.triangles.size());
    REQUIRE(result.vertex_origin.size() == result.mesh.positions.size());
    CHECK(ascending(result.face_origin));
    CHECK(ascending(result.vertex_origin));
    CHECK((result.face_origin.empty() || result.face_origin.back() < mesh.triangles.size()));
    CHECK((result.vertex_origin.empty() || result.vertex_origin.back() < mesh.positions.size()));
    const Report& report = result.report;
    CHECK(report.faces_in == mesh.triangles.size());
    CHECK(report.faces_out == result.mesh.triangles.size());
    CHECK(report.vertices_out == result.mesh.positions.size());
    CHECK((report.faces_out <= report.target_faces) == (report.stop == StopReason::reached_target));
    CHECK(report.faces_out > 0);
    if (report.stop == StopReason::no_legal_collapse) CHECK(taken(report, Rung::flip_any) == 1);
}

}  // namespace

TEST_CASE("results of triangle soups are valid and reach the target or report a reason") {
    for (const TriangleMesh& mesh : soups()) everywhere(mesh, is_sound);
}

TEST_CASE("results of surfaces are valid and reach the target or report a reason") {
    for (const TriangleMesh& mesh : surfaces()) everywhere(mesh, is_sound);
}

TEST_CASE("no collapse rotates a face normal by more than 90 degrees before the ladder allows it") {
    std::size_t turned = 0, checked = 0;
    for (const TriangleMesh& mesh : all_sorts()) {
        for (const Preset preset : all_presets) {
            Options o{.target = ratio(0.3), .preset = preset, .history = Recording::on};
            const SimplifyResult result = simplify(mesh.view(), o);
            if (taken(result.report, Rung::flip_half) > 0) continue;
            const CollapseHistory& h = result.history;
            std::vector<Triangle> now = h.triangles;
            const auto doubled_area = [&](const Triangle& t) {
                TriangleMesh one;
                one.positions = {h.position(t[0]), h.position(t[1]), h.position(t[2])};
                return test::normal(one, {0, 1, 2});
            };
            for (std::size_t k = 0; k < h.collapses.size(); ++k) {
                const auto made = static_cast<Index>(h.positions.size() + k);
                for (const Index f : h.patch(k)) {
                    const Triangle before = now[f];
                    std::replace(now[f].begin(), now[f].end(), h.collapses[k].first, made);
                    std::replace(now[f].begin(), now[f].end(), h.collapses[k].second, made);
                    if (std::count(now[f].begin(), now[f].end(), made) != 1) continue;
                    const Vec3 n = doubled_area(before), m = doubled_area(now[f]);
                    const double dot = n[0] * m[0] + n[1] * m[1] + n[2] * m[2];
                    // Positions in the history are rounded, hence the tolerance.
                    turned += !(dot >= -1e-6 * std::hypot(n[0], n[1], n[2]) * std::hypot(m[0], m[1], m[2]));
                    ++checked;
                }
            }
        }
    }
    CHECK(turned == 0);
    CHECK(checked > 10'000);
}

TEST_CASE("qem keeps closed surfaces closed and preserves their genus") {
    std::size_t tested = 0;
    for (std::uint32_t seed = 0; seed < 4; ++seed) {
        const std::pair<TriangleMesh, int> surfaces[] = {
            {test::shaken(test::icosphere(3), 0.01, seed), 2},
            {test::shaken(test::torus(20, 12), 0.01, seed), 0},
            {test::both(test::icosphere(2), test::moved(test::torus(16, 10), {4, 0, 0})), 2}};
        for (const auto& [mesh, characteristic] : surfaces) {
            for (const double share : ratios) {
                const SimplifyResult result = run(mesh, Preset::qem, share);
                if (climbed(result.report)) continue;
                ++tested;
                CHECK(test::closed_manifold(result.mesh.triangles));
                CHECK(test::euler(result.mesh.triangles) == characteristic);
            }
        }
    }
    CHECK(tested >= 24);
}

TEST_CASE("the link condition preserves the topology of surfaces with boundaries") {
    Options o{.preset = Preset::qem};
    for (const double share : {0.5, 0.2}) {
        o.target = ratio(share);
        for (const auto& [mesh, characteristic] :
             {std::pair(test::shaken(test::grid(12), 0.2, 1), 1), std::pair(test::cylinder(20, 10, 3), 0)}) {
            const SimplifyResult result = simplify(mesh.view(), o);
            REQUIRE_FALSE(climbed(result.report));
            CHECK(test::euler(result.mesh.triangles) == characteristic);
            for (const auto& edge : test::edges(result.mesh.triangles)) CHECK(edge.second <= 2);
        }
    }
}

TEST_CASE("scaling the input by a power of two scales the result exactly") {
    for (const TriangleMesh& mesh : {test::shaken(test::torus(14, 9), 0.05, 1),
                                     test::shaken(test::grid(9), 0.3, 1), test::soup(5, 60, 150)}) {
        for (const Preset preset : all_presets) {
            for (const double share : ratios) {
                const SimplifyResult plain = run(mesh, preset, share);
                for (const double by : {0x1p-40, 2.0, 0x1p100, 0x1p-100}) {
                    INFO(name(preset) << " to " << share << " times " << by);
                    const SimplifyResult scaled = run(test::scaled(mesh, by), preset, share);
                    CHECK(scaled.mesh.triangles == plain.mesh.triangles);
                    CHECK(same_bits(scaled.mesh.positions, test::scaled(plain.mesh, by).positions));
                }
            }
        }
    }
}

TEST_CASE("translating the input translates the result") {
    const TriangleMesh mesh = test::shaken(test::torus(14, 9), 0.05, 1);
    const Vec3 by = {1000, -2000, 500};
    for (const Preset preset : all_presets) {
        const TriangleMesh here = run(mesh, preset, 0.3).mesh;
        const TriangleMesh there = run(test::moved(mesh, by), preset, 0.3).mesh;
        CHECK(there.triangles == here.triangles);
        REQUIRE(there.positions.size() == here.positions.size());
        double farthest = 0;
        for (std::size_t v = 0; v < here.positions.size(); ++v) {
            const Vec3 d = test::minus(test::minus(there.positions[v], by), here.positions[v]);
            farthest = std::max(farthest, std::hypot(d[0], d[1], d[2]));
        }
        CHECK(farthest < 1e-7);
    }
}

TEST_CASE("the shape is preserved far from the origin") {
    const TriangleMesh sphere = test::icosphere(3);
    const Vec3 by = {1e7, 1e7, -1e7};
    for (const Preset preset : all_presets) {
        const SimplifyResult result = run(test::moved(sphere, by), preset, 0.1);
        CHECK(result.report.faces_out == 128);
        for (const Vec3& p : result.mesh.positions) {
            const Vec3 d = test::minus(p, by);
            CHECK(std::hypot(d[0], d[1], d[2]) == Approx(1).margin(0.1));
        }
    }
}

TEST_CASE("unreferenced vertices do not change the result") {
    const TriangleMesh mesh = test::shaken(test::torus(14, 9), 0.05, 1);
    TriangleMesh more;
    for (const Vec3& p : mesh.positions) {
        more.positions.push_back({1e6, 2, 3});
        more.positions.push_back(p);
        more.positions.push_back({-1e9, p[0], p[2]});
    }
    for (const auto [a, b, c] : mesh.triangles) more.triangles.push_back({3 * a + 1, 3 * b + 1, 3 * c + 1});
    for (const Preset preset : all_presets) {
        for (const double share : ratios) {
            const SimplifyResult plain = run(mesh, preset, share);
            const SimplifyResult result = run(more, preset, share);
            CHECK(same_bits(result.mesh.positions, plain.mesh.positions));
            CHECK(result.mesh.triangles == plain.mesh.triangles);
            CHECK(result.face_origin == plain.face_origin);
            for (std::size_t v = 0; v < plain.vertex_origin.size(); ++v)
                CHECK(result.vertex_origin[v] == 3 * plain.vertex_origin[v] + 1);
        }
    }
}

TEST_CASE("concurrent runs do not affect each other") {
    const std::vector<TriangleMesh> meshes = surfaces();
    const auto all = [&] {
        std::vector<TriangleMesh> results;
        for (const TriangleMesh& mesh : meshes)
            for (const Preset preset : all_presets) results.push_back(run(mesh, preset, 0.1).mesh);
        return results;
    };
    const std::vector<TriangleMesh> alone = all();
    std::vector<TriangleMesh> here, there;
    std::thread other([&] { there = all(); });
    here = all();
    other.join();
    for (std::size_t i = 0; i < alone.size(); ++i) {
        for (const TriangleMesh& mesh : {here[i], there[i]}) {
            CHECK(mesh.triangles == alone[i].triangles);
            CHECK(same_bits(mesh.positions, alone[i].positions));
        }
    }
}
