#include "faqem/engine/constraints/feature_curves.hpp"

#include <functional>
#include <map>
#include <set>

#include "faqem/simplify.hpp"
#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace faqem;
using namespace faqem::engine;

namespace {

// A mesh with groups and the curves between them.
struct Map {
    Map(TriangleMesh m, std::vector<Index> g, const std::vector<std::pair<Index, Index>>& extra = {})
        : mesh(std::move(m)),
          groups(std::move(g)),
          collapse_mesh(test::collapse_mesh_of(mesh)),
          pairs(collapse_mesh, extra),
          curves(collapse_mesh, groups) {}
    Map(const Map&) = delete;

    AllowedPosition allowed_position(Index u, Index v) {
        return curves.allowed_position(collapse_mesh, pairs, u, v);
    }

    TriangleMesh mesh;
    std::vector<Index> groups;
    CollapseMesh collapse_mesh;
    PairTable pairs;
    FeatureCurves curves;
};

// Groups of the faces of grid(n) by square. Vertex (x, y) has the index x + (n + 1) y; square (x, y)
// consists of the faces 2 (x + n y) and the next one.
std::vector<Index> squares(Index n, const std::function<Index(Index x, Index y)>& group) {
    std::vector<Index> groups;
    for (Index y = 0; y < n; ++y) {
        for (Index x = 0; x < n; ++x) groups.insert(groups.end(), 2, group(x, y));
    }
    return groups;
}

// Group 1 for face `f`, group 0 for the others.
std::vector<Index> one_of(std::size_t faces, std::size_t f) {
    std::vector<Index> groups(faces, 0);
    groups[f] = 1;
    return groups;
}

// Edges between different groups, by the positions of their vertices.
using Curves = std::set<std::pair<Vec3, Vec3>>;

Curves curves_of(const TriangleMesh& mesh) {
    std::map<std::pair<Vec3, Vec3>, std::set<Index>> groups;
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 &a = mesh.positions[mesh.triangles[f][k]],
                       &b = mesh.positions[mesh.triangles[f][(k + 1) % 3]];
            groups[std::minmax(a, b)].insert(mesh.face_groups[f]);
        }
    }
    Curves curves;
    for (const auto& [edge, found] : groups) {
        if (found.size() > 1) curves.insert(edge);
    }
    return curves;
}

// Number of vertices on curves by their number of curve edges, except for inner vertices of a curve, which
// have two.
std::map<std::size_t, int> nodes_by_degree(const TriangleMesh& mesh) {
    std::map<Vec3, std::size_t> degree;
    for (const auto& [a, b] : curves_of(mesh)) ++degree[a], ++degree[b];
    std::map<std::size_t, int> nodes;
    for (const auto& [position, count] : degree) nodes[count] += count != 2;
    nodes.erase(2);
    return nodes;
}

double area_of(const TriangleMesh& mesh, Index group) {
    double sum = 0;
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
        if (mesh.face_groups[f] != group) continue;
        const Vec3 n = test::normal(mesh, mesh.triangles[f]);
        sum += 0.5 * std::hypot(n[0], n[1], n[2]);
    }
    return sum;
}

Options keeping(double keep, Preset preset = Preset::balanced) {
    Options options{.target = ratio(keep)};
    options.preset = preset;
    options.topology.group_boundaries = GroupBoundaries::preserved;
    return options;
}

// A sphere with one group per octant.
TriangleMesh octants(int level) {
    TriangleMesh mesh = test::icosphere(level);
    for (const Triangle& t : mesh.triangles) {
        Vec3 c = {};
        for (const Index v : t) {
            for (std::size_t i = 0; i < 3; ++i) c[i] += mesh.positions[v][i];
        }
        mesh.face_groups.push_back((c[0] > 0) + 2 * (c[1] > 0) + 4 * (c[2] > 0));
    }
    return mesh;
}

}  // namespace

TEST_CASE("feature curves: preferred ones are kept while the target can be reached, and given up for it") {
    const TriangleMesh mesh = octants(4);
    Options options = keeping(0.1);
    const SimplifyResult kept = simplify({mesh.positions, mesh.triangles, mesh.face_groups}, options);
    options.topology.group_boundaries = GroupBoundaries::preferred;
    const SimplifyResult preferred = simplify({mesh.positions, mesh.triangles, mesh.face_groups}, options);
    CHECK(preferred.mesh.positions == kept.mesh.positions);
    CHECK(preferred.report.rungs[static_cast<std::size_t>(Rung::group_boundaries)] == 0);
    // A triangle for each octant is the least that keeps them; without curves four faces are possible.
    options.target = faces(4);
    const SimplifyResult few = simplify({mesh.positions, mesh.triangles, mesh.face_groups}, options);
    CHECK(few.mesh.triangles.size() == 4);
    CHECK(few.report.rungs[static_cast<std::size_t>(Rung::group_boundaries)] == 1);
    options.topology.group_boundaries = GroupBoundaries::preserved;
    CHECK(simplify({mesh.positions, mesh.triangles, mesh.face_groups}, options).mesh.triangles.size() == 8);
}

TEST_CASE("feature curves: without adjacent faces of different groups there are no curves") {
    FeatureCurves none;
    CHECK(none.empty());
    CHECK(!none.has_vertex(0));
    CHECK(!none.are_different_groups(0, 1));
    Map one(test::grid(2), std::vector<Index>(8, 7));
    CHECK(one.curves.empty());
    CHECK(one.allowed_position(0, 1) == AllowedPosition::anywhere);
    // Groups of separate components have no curve, either.
    Map apart(test::both(test::quad(), test::moved(test::quad(), {2, 0, 0})), {0, 0, 1, 1});
    CHECK(apart.curves.empty());
}

TEST_CASE("feature curves: a pair of an inner vertex and a curve vertex collapses to the curve vertex") {
    // A 4 x 4 grid with one group in the two left columns and one in the right ones: the curve is x = 2.
    Map map(test::grid(4), squares(4, [](Index x, Index) { return x / 2; }));
    for (Index v = 0; v < 25; ++v) CHECK(map.curves.has_vertex(v) == (v % 5 == 2));
    CHECK(map.allowed_position(11, 12) == AllowedPosition::at_second);
    CHECK(map.allowed_position(12, 13) == AllowedPosition::at_first);
    CHECK(map.allowed_position(10, 11) == AllowedPosition::anywhere);
    CHECK(map.allowed_position(7, 12) == AllowedPosition::anywhere);
}

TEST_CASE("feature curves: the end of a curve at the boundary does not move") {
    Map map(test::grid(4), squares(4, [](Index x, Index) { return x / 2; }));
    CHECK(map.allowed_position(2, 7) == AllowedPosition::at_first);
    CHECK(map.allowed_position(7, 2) == AllowedPosition::at_second);
    CHECK(map.allowed_position(1, 2) == AllowedPosition::at_second);
}

TEST_CASE("feature curves: a vertex at which three or four curves meet does not move") {
    // T: left, upper right and lower right. X: a checkerboard of 2 x 2.
    for (const bool cross : {false, true}) {
        CAPTURE(cross);
        Map map(test::grid(4), squares(4, [&](Index x, Index y) {
                    const Index right = x / 2, upper = y / 2;
                    return cross ? (right + upper) % 2 : right + right * upper;
                }));
        CHECK(map.allowed_position(12, 17) == AllowedPosition::at_first);
        CHECK(map.allowed_position(7, 12) == AllowedPosition::at_second);
        CHECK(map.allowed_position(12, 13) == AllowedPosition::at_first);
    }
}

TEST_CASE("feature curves: two curves are not merged") {
    // Three stripes of one square each.
    Map stripes(test::grid(3), squares(3, [](Index x, Index) { return x; }));
    CHECK(stripes.allowed_position(5, 6) == AllowedPosition::nowhere);
    CHECK(stripes.allowed_position(6, 5) == AllowedPosition::nowhere);
    CHECK(stripes.allowed_position(5, 9) == AllowedPosition::anywhere);
}

TEST_CASE("feature curves: the last triangle of a group is not collapsed") {
    // The group is the lower right triangle of the middle square of 3 x 3.
    Map map(test::grid(3), one_of(18, 8));
    for (const auto& [u, v] : {std::pair<Index, Index>{5, 6}, {6, 10}, {5, 10}}) {
        CHECK(map.allowed_position(u, v) == AllowedPosition::nowhere);
        CHECK(map.allowed_position(v, u) == AllowedPosition::nowhere);
    }
    CHECK(map.allowed_position(1, 5) == AllowedPosition::at_second);
}

TEST_CASE("feature curves: a triangle between a curve and the boundary is not collapsed") {
    // The group is the triangle 0 1 5 of grid(3): collapsing its inner edge would move the end of the
    // curve.
    Map map(test::grid(3), one_of(18, 0));
    CHECK(map.allowed_position(0, 1) == AllowedPosition::nowhere);
    CHECK(map.allowed_position(1, 5) == AllowedPosition::nowhere);
    CHECK(map.allowed_position(0, 5) == AllowedPosition::nowhere);
}

TEST_CASE("feature curves: surface patches back to back have no curve between their groups") {
    // A 4 x 4 grid and its reverse side, in two groups; then with a third group on the right half of the
    // reverse side.
    const TriangleMesh front = test::grid(4);
    TriangleMesh mesh = front;
    for (const auto& [a, b, c] : front.triangles) mesh.triangles.push_back({a, c, b});
    std::vector<Index> groups(32, 0);
    Map two(mesh, [&] {
        std::vector<Index> all = groups;
        all.insert(all.end(), 32, 1);
        return all;
    }());
    CHECK(two.allowed_position(6, 7) == AllowedPosition::anywhere);
    CHECK(two.allowed_position(12, 18) == AllowedPosition::anywhere);
    const std::vector<Index> back = squares(4, [](Index x, Index) { return 1 + x / 2; });
    groups.insert(groups.end(), back.begin(), back.end());
    Map three(mesh, groups);
    CHECK(three.allowed_position(6, 7) == AllowedPosition::at_second);
    CHECK(three.allowed_position(7, 12) == AllowedPosition::anywhere);
    CHECK(three.allowed_position(8, 13) == AllowedPosition::anywhere);
    std::size_t seen = 0;
    three.curves.for_each_curve_edge(three.collapse_mesh, 12, [&](Index, Index n) {
        CHECK((n == 7 || n == 17));
        ++seen;
    });
    CHECK(seen == 8);
}

TEST_CASE("feature curves: virtual pairs connect neither different groups nor curve vertices") {
    const TriangleMesh mesh = test::both(test::grid(2), test::moved(test::quad(), {3, 0, 0}));
    std::vector<Index> groups = squares(2, [](Index x, Index) { return x; });
    groups.insert(groups.end(), 2, Index{1});
    Map map(mesh, groups, {{5, 9}, {3, 9}, {4, 9}});
    CHECK(map.allowed_position(5, 9) == AllowedPosition::anywhere);
    CHECK(map.allowed_position(3, 9) == AllowedPosition::nowhere);
    CHECK(map.allowed_position(4, 9) == AllowedPosition::nowhere);
}

TEST_CASE("feature curves: a vertex merged with a curve vertex is on the curve") {
    Map map(test::grid(2), squares(2, [](Index x, Index) { return x; }));
    map.curves.before_collapse(0, 1);
    CHECK(map.curves.has_vertex(0));
    map.curves.before_collapse(2, 5);
    CHECK(!map.curves.has_vertex(2));
}

TEST_CASE("feature curves: every face of a curve edge is visited") {
    const Map map(test::grid(2), squares(2, [](Index x, Index) { return x; }));
    std::multiset<std::pair<Index, Index>> seen;
    map.curves.for_each_curve_edge(map.collapse_mesh, 4, [&](Index f, Index n) { seen.insert({f, n}); });
    // The edges up and down from the centre, with one face on each side.
    CHECK(seen == std::multiset<std::pair<Index, Index>>{{0, 1}, {3, 1}, {4, 7}, {7, 7}});
}

TEST_CASE("feature curves: nodes do not move at all and groups keep their area") {
    const TriangleMesh mesh = octants(4);
    const std::map<std::size_t, int> nodes = nodes_by_degree(mesh);
    const Curves before = curves_of(mesh);
    for (const Preset preset : all_presets) {
        CAPTURE(name(preset));
        const SimplifyResult result = simplify(mesh.view(), keeping(0.05, preset));
        CHECK(result.report.faces_out <= result.report.target_faces);
        CHECK(nodes_by_degree(result.mesh) == nodes);
        const Curves after = curves_of(result.mesh);
        CHECK(after.size() < before.size() / 2);
        for (const auto& [a, b] : before) {
            // A node of the original is one of the result.
            for (const Vec3& p : {a, b}) {
                const auto at = [&](const Curves& curves) {
                    return std::count_if(curves.begin(), curves.end(),
                                         [&](const auto& e) { return e.first == p || e.second == p; });
                };
                if (at(before) != 2) CHECK(at(after) == at(before));
            }
        }
        for (Index group = 0; group < 8; ++group) {
            CHECK(area_of(result.mesh, group) == Approx(area_of(mesh, group)).epsilon(0.1));
        }
    }
}

TEST_CASE("feature curves: a straight curve in a plane stays straight") {
    // In a plane all collapses cost nothing: without the constraint the group boundary would become
    // arbitrary.
    TriangleMesh mesh = test::grid(16);
    mesh.face_groups = squares(16, [](Index x, Index) { return x / 8; });
    for (const Preset preset : all_presets) {
        CAPTURE(name(preset));
        const SimplifyResult result = simplify(mesh.view(), keeping(0.05, preset));
        CHECK(result.report.faces_out <= result.report.target_faces);
        for (const auto& [a, b] : curves_of(result.mesh)) {
            CHECK(a[0] == Approx(8).margin(1e-6));
            CHECK(b[0] == Approx(8).margin(1e-6));
        }
        // The presets qem, paper and stmw do not preserve the corners of the mesh boundary.
        if (preset < Preset::fast) continue;
        CHECK(area_of(result.mesh, 0) == Approx(128).epsilon(1e-6));
        CHECK(area_of(result.mesh, 1) == Approx(128).epsilon(1e-6));
    }
}

TEST_CASE("feature curves: a target that the curves prevent is missed and reported") {
    // Every square has its own group: all inner vertices are nodes.
    TriangleMesh mesh = test::grid(8);
    mesh.face_groups = squares(8, [](Index x, Index y) { return x + 8 * y; });
    for (const Preset preset : all_presets) {
        CAPTURE(name(preset));
        const SimplifyResult result = simplify(mesh.view(), keeping(0.1, preset));
        CHECK(result.report.stop == StopReason::no_legal_collapse);
        CHECK(result.report.faces_out > result.report.target_faces);
        CHECK(result.report.refusals[static_cast<std::size_t>(Refusal::group)] > 0);
        CHECK(result.report.components_deleted == 0);
        // The corners of the grid are on no curve.
        for (Index group = 1; group < 63; ++group) {
            if (group != 7 && group != 56) CHECK(area_of(result.mesh, group) == Approx(1));
        }
    }
}

TEST_CASE("feature curves: preserving groups does not change a mesh without groups") {
    TriangleMesh mesh = test::icosphere(3);
    const SimplifyResult plain = simplify(mesh.view(), {.target = ratio(0.1)});
    CHECK(simplify(mesh.view(), keeping(0.1)).mesh.positions == plain.mesh.positions);
    mesh.face_groups.assign(mesh.triangles.size(), 3);
    CHECK(simplify(mesh.view(), keeping(0.1)).mesh.positions == plain.mesh.positions);
}

TEST_CASE("feature curves: curves on attribute seams are preserved together with the attributes") {
    TriangleMesh mesh = octants(3);
    mesh.attributes.width = 1;
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
        mesh.attributes.values.insert(mesh.attributes.values.end(), 3,
                                      static_cast<float>(mesh.face_groups[f]));
    const SimplifyResult result = simplify(mesh.view(), keeping(0.1));
    CHECK(result.report.faces_out <= result.report.target_faces);
    CHECK(nodes_by_degree(result.mesh) == nodes_by_degree(mesh));
    for (std::size_t f = 0; f < result.mesh.triangles.size(); ++f) {
        for (std::size_t k = 0; k < 3; ++k)
            CHECK(result.mesh.attributes.values[3 * f + k] == float(result.mesh.face_groups[f]));
    }
}
