// Closed components stay closed: every edge has two faces of opposite
// direction, and no two faces the same corners.

#include <algorithm>
#include <array>
#include <set>

#include "faqem/levels.hpp"
#include "faqem/simplify.hpp"
#include "faqem/truncate.hpp"
#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace faqem;

namespace {

constexpr std::array presets = {Preset::qem, Preset::fast, Preset::balanced, Preset::best};

// The surface of a plate of n x n cubes, a third of whose inner ones are square
// holes: a handle for each hole.
TriangleMesh perforated_plate(int n) {
    const auto is_solid = [n](int x, int y, int z) {
        const bool is_hole = x % 2 == 1 && y % 2 == 1 && x < n - 1 && y < n - 1;
        return x >= 0 && y >= 0 && x < n && y < n && z == 0 && !is_hole;
    };
    TriangleMesh mesh;
    for (int z = 0; z < 2; ++z) {
        for (int y = 0; y <= n; ++y) {
            for (int x = 0; x <= n; ++x)
                mesh.positions.push_back({static_cast<double>(x), static_cast<double>(y), 0.7 * z});
        }
    }
    for (int i = 0; i < n * n; ++i) {
        const int at[] = {i % n, i / n, 0};
        if (!is_solid(at[0], at[1], at[2])) continue;
        for (int axis = 0; axis < 3; ++axis) {
            for (const int side : {0, 1}) {
                int beside[] = {at[0], at[1], at[2]};
                beside[axis] += 2 * side - 1;
                if (is_solid(beside[0], beside[1], beside[2])) continue;
                // The corners of the side, counter-clockwise as seen from outside.
                std::array<Index, 4> corner = {};
                for (int k = 0; k < 4; ++k) {
                    int p[] = {at[0], at[1], at[2]};
                    p[axis] += side;
                    p[(axis + 1) % 3] += k == 1 || k == 2;
                    p[(axis + 2) % 3] += k >= 2;
                    corner[static_cast<std::size_t>(side ? k : 3 - k)] =
                        static_cast<Index>((p[2] * (n + 1) + p[1]) * (n + 1) + p[0]);
                }
                mesh.triangles.push_back({corner[0], corner[1], corner[2]});
                mesh.triangles.push_back({corner[0], corner[2], corner[3]});
            }
        }
    }
    return mesh;
}

// Surfaces with handles, and with components that vanish.
std::vector<TriangleMesh> closed_surfaces() {
    std::vector<TriangleMesh> meshes = {test::shaken(perforated_plate(11), 0.1, 1),
                                        test::shaken(test::torus(30, 6), 0.1, 2),
                                        test::shaken(test::icosphere(3), 0.2, 3)};
    TriangleMesh parts;
    for (int i = 0; i < 20; ++i) {
        const TriangleMesh part = test::shaken(i % 2 ? test::torus(9, 5) : test::icosphere(1), 0.1, 4);
        parts = test::both(parts, test::moved(test::scaled(part, 0.3 + 0.1 * (i % 7)), {3.0 * i, 0, 0}));
    }
    meshes.push_back(parts);
    return meshes;
}

bool is_closed(const std::vector<Triangle>& triangles) {
    std::set<std::pair<Index, Index>> sides;
    std::set<Triangle> faces;
    for (Triangle t : triangles) {
        for (unsigned k = 0; k < 3; ++k) {
            if (!sides.insert({t[k], t[(k + 1) % 3]}).second) return false;
        }
        std::sort(t.begin(), t.end());
        if (!faces.insert(t).second) return false;
    }
    return std::all_of(sides.begin(), sides.end(), [&](const auto& side) {
        return sides.contains({side.second, side.first});
    });
}

Options options_of(Preset preset, LinkCondition link) {
    return {.preset = preset, .topology = {.link = link}};
}

// Calls check(mesh, options) for every surface, preset and link condition.
template <class Check>
void everywhere(Check check) {
    for (const TriangleMesh& mesh : closed_surfaces()) {
        REQUIRE(is_closed(mesh.triangles));
        for (const Preset preset : presets) {
            for (const LinkCondition link :
                 {LinkCondition::as_preset, LinkCondition::off, LinkCondition::on, LinkCondition::strict}) {
                INFO(name(preset) << ", link " << static_cast<int>(link) << ", " << mesh.triangles.size());
                check(mesh, options_of(preset, link));
            }
        }
    }
}

}  // namespace

TEST_CASE("closed surfaces: handles and components are removed without opening the surface") {
    everywhere([](const TriangleMesh& mesh, Options options) {
        for (const double share : {0.3, 0.1, 0.03, 0.01}) {
            options.target = ratio(share);
            const SimplifyResult result = simplify(mesh.view(), options);
            CHECK(is_closed(result.mesh.triangles));
            if (options.topology.link != LinkCondition::strict && share >= 0.03)
                CHECK(result.report.faces_out <= result.report.target_faces);
        }
    });
}

TEST_CASE("closed surfaces: locked vertices and preserved attributes stay, with the surface closed") {
    for (TriangleMesh mesh : closed_surfaces()) {
        std::vector<std::uint8_t> locks(mesh.positions.size(), 0);
        for (std::size_t v = 0; v < locks.size(); v += 29) locks[v] = 1;
        mesh.attributes.width = 1;
        for (const Triangle& t : mesh.triangles) {
            for (const Index v : t)
                mesh.attributes.values.push_back(
                    static_cast<float>(mesh.positions[v][0] > 1 || t[0] % 7 == 0));
        }
        for (const Preset preset : presets) {
            Options options = options_of(preset, LinkCondition::as_preset);
            options.target = ratio(0.03);
            MeshView view = mesh.view();
            CHECK(is_closed(simplify(view, options).mesh.triangles));
            view.vertex_locks = locks;
            const SimplifyResult result = simplify(view, options);
            CHECK(is_closed(result.mesh.triangles));
            const std::set<Vec3> left(result.mesh.positions.begin(), result.mesh.positions.end());
            for (std::size_t v = 0; v < locks.size(); v += 29) CHECK(left.contains(mesh.positions[v]));
        }
    }
}

TEST_CASE("closed surfaces: the torus of seven vertices has no smaller torus, and becomes a sphere") {
    TriangleMesh torus;
    for (Index i = 0; i < 7; ++i) {
        torus.positions.push_back({1.0 * i, 1.0 * (i * i % 7), 0.1 * i + i * i * i % 7});
        torus.triangles.push_back({i, (i + 1) % 7, (i + 3) % 7});
        torus.triangles.push_back({i, (i + 3) % 7, (i + 2) % 7});
    }
    REQUIRE(is_closed(torus.triangles));
    for (const Preset preset : presets) {
        Options options = options_of(preset, LinkCondition::as_preset);
        options.target = faces(13);
        const SimplifyResult result = simplify(torus.view(), options);
        CHECK(is_closed(result.mesh.triangles));
        CHECK(test::euler(result.mesh.triangles) == 2);
    }
}

TEST_CASE("closed surfaces: every level, and every truncation of its history, is closed") {
    for (const TriangleMesh& mesh : closed_surfaces()) {
        for (const Preset preset : presets) {
            Options options = options_of(preset, LinkCondition::as_preset);
            options.history = Recording::on;
            std::vector<CollapseHistory> histories;
            for (const SimplifiedLevel& level :
                 simplify_levels(mesh.view(), {ratio(0.3), ratio(0.1), ratio(0.02)}, options)) {
                CHECK(is_closed(level.result.mesh.triangles));
                histories.push_back(level.result.history);
            }
            const ChainHistory chain = join(histories);
            for (std::uint64_t faces = 4; faces < mesh.triangles.size(); faces += 1 + faces / 8)
                CHECK(is_closed(restore(truncate_to_faces(chain, faces)).mesh.triangles));
        }
    }
}
