#include "faqem/detail/simplify/virtual_edges.hpp"

#include <set>

#include "faqem/engine/mesh/components.hpp"
#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace faqem;
using detail::virtual_edges;
using engine::Vector3;

namespace {

using Edge = std::pair<Index, Index>;

std::vector<Edge> between(const TriangleMesh& mesh, double distance, double least = 1e-8) {
    return virtual_edges(test::collapse_mesh_of(mesh), mesh.face_groups, distance, least);
}

// Two unit squares side by side in one plane, `gap` apart: vertices 1 and 2 are opposite vertices 4 and 7.
TriangleMesh two_quads(double gap) {
    return test::both(test::quad(), test::moved(test::quad(), {1 + gap, 0, 0}));
}

// Brute force over all pairs: the four nearest vertices of other components, both vertices on a boundary,
// mean normals with a positive dot product, a common group.
std::vector<Edge> naive(const TriangleMesh& mesh, double distance, double least) {
    const engine::CollapseMesh collapse_mesh = test::collapse_mesh_of(mesh);
    std::vector<Index> part(collapse_mesh.vertex_slots(), no_index);
    std::vector<Index> rank(collapse_mesh.vertex_slots(),
                            no_index);  // order by component, face and corner: breaks ties
    Index number = 0, next_rank = 0;
    for (const engine::Component& c : engine::components(collapse_mesh)) {
        for (const Index f : c.faces) {
            for (const Index v : collapse_mesh.triangle(f)) {
                if (part[v] == no_index) rank[v] = next_rank++;
                part[v] = number;
            }
        }
        ++number;
    }
    const auto facts = [&](Index v) {
        std::pair<Vector3, std::set<Index>> result = {Vector3::Zero(), {}};
        for (Index f = 0; f < mesh.triangles.size(); ++f) {
            if (!collapse_mesh.has_corner(f, v)) continue;
            result.first += collapse_mesh.area_vector(f);
            if (!mesh.face_groups.empty()) result.second.insert(mesh.face_groups[f]);
        }
        return result;
    };
    std::set<Index> boundary;
    for (const auto& [edge, faces] : test::edges(mesh.triangles)) {
        if (faces == 1) boundary.insert({edge.first, edge.second});
    }
    std::set<std::tuple<double, Index, Index>> edges;
    const std::ptrdiff_t unused = std::count(part.begin(), part.end(), no_index);
    const std::size_t used = part.size() - static_cast<std::size_t>(unused);
    for (const Index v : boundary) {
        std::set<std::tuple<double, Index, Index>> near;
        for (Index w = 0; w < part.size(); ++w) {
            if (part[w] == no_index || part[w] == part[v]) continue;
            const double squared = (collapse_mesh.position(v) - collapse_mesh.position(w)).squaredNorm();
            if (squared <= distance * distance) near.insert({squared, rank[w], w});
        }
        std::size_t taken = 0;
        for (const auto& [squared, order, w] : near) {
            static_cast<void>(order);
            if (++taken > 4) break;
            const auto a = facts(v), b = facts(w);
            bool common = mesh.face_groups.empty();
            for (const Index group : a.second) common = common || b.second.count(group);
            if (squared >= least * least && common && boundary.count(w) && a.first.dot(b.first) > 0)
                edges.insert({squared, std::min(v, w), std::max(v, w)});
        }
    }
    std::set<Edge> result;
    for (const auto& [squared, a, b] : edges) {
        if (result.size() < used) result.insert({a, b});
    }
    return {result.begin(), result.end()};
}

}  // namespace

TEST_CASE("virtual edges connect close boundary vertices of two components") {
    CHECK(between(two_quads(0.1), 0.2) == std::vector<Edge>{{1, 4}, {2, 7}});
    // Including the diagonals of the gap: 1-7 and 2-4 have length sqrt(1.01).
    CHECK(between(two_quads(0.1), 1.006) == std::vector<Edge>{{1, 4}, {1, 7}, {2, 4}, {2, 7}});
}

TEST_CASE("virtual edges have the given minimum and maximum length") {
    CHECK(between(two_quads(0.1), 0.0999).empty());
    CHECK(between(two_quads(0.25), 0.25) == std::vector<Edge>{{1, 4}, {2, 7}});
    CHECK(between(two_quads(0.1), 0.2, 0.15).empty());
}

TEST_CASE("a single component has no virtual edges") {
    CHECK(between(test::grid(4), 3).empty());
    CHECK(between({}, 1).empty());
}

TEST_CASE("virtual edges do not connect surfaces with opposite normals") {
    const TriangleMesh other = test::moved(test::quad(), {0, 0, 0.1});
    CHECK(between(test::both(test::quad(), other), 0.2).size() == 4);
    CHECK(between(test::both(test::quad(), test::inside_out(other)), 0.2).empty());
}

TEST_CASE("virtual edges do not connect faces of different groups") {
    TriangleMesh mesh = two_quads(0.1);
    mesh.face_groups = {0, 0, 1, 1};
    CHECK(between(mesh, 0.2).empty());
    // Vertex 1 belongs to face 0 only, 2 to both faces; 4 belongs to both faces, 7 to face 3 only.
    mesh.face_groups = {0, 5, 1, 5};
    CHECK(between(mesh, 0.2) == std::vector<Edge>{{2, 7}});
}

TEST_CASE("virtual edges connect boundary vertices only") {
    const TriangleMesh cube = test::cube();
    CHECK(between(test::both(cube, test::moved(cube, {1.1, 0, 0})), 3).empty());
    CHECK(between(test::both(cube, test::moved(test::quad(), {1.1, 0, 1})), 3).empty());
    // The centre vertex of the grid is closer, but an interior vertex.
    const TriangleMesh above = test::moved(test::quad(), {0.5, 0.5, 0.1});
    for (const auto& [a, b] : between(test::both(test::grid(2), above), 3)) {
        CHECK(a != 4);
        CHECK(b >= 9);
    }
}

TEST_CASE("there are at most as many virtual edges as vertices and the shortest ones are taken") {
    // Six parallel quads at distances of 0.1: each of 24 vertices has up to 4 candidates, 24 pairs are
    // allowed.
    TriangleMesh mesh;
    for (int i = 0; i < 6; ++i) mesh = test::both(mesh, test::moved(test::quad(), {0, 0, 0.1 * i}));
    const auto found = between(mesh, 0.45);
    CHECK(found.size() == 24);
    std::size_t neighbours = 0;
    for (const auto& [a, b] : found) neighbours += b - a == 4;
    CHECK(neighbours == 20);
}

TEST_CASE("virtual edges ignore unreferenced vertices") {
    TriangleMesh mesh = two_quads(0.1);
    mesh.positions.push_back({1.05, 0, 0});
    CHECK(between(mesh, 0.2) == std::vector<Edge>{{1, 4}, {2, 7}});
}

TEST_CASE("virtual edges agree with a brute-force search over all pairs") {
    for (std::uint32_t seed = 0; seed < 20; ++seed) {
        test::Random random(seed);
        TriangleMesh mesh;
        for (int part = 0; part < 8; ++part) {
            TriangleMesh patch = test::shaken(test::scaled(test::grid(3), 0.2), 0.05, 10 * seed + part);
            if (part % 3 == 2) patch = test::inside_out(patch);
            // Offsets on a lattice give equal distances.
            mesh = test::both(mesh, test::moved(patch, {0.25 * random.below(4), 0.25 * random.below(4),
                                                        0.125 * random.below(3)}));
        }
        if (seed % 2) {
            for (Vec3& p : mesh.positions) {
                for (double& x : p) x = std::round(8 * x) / 8;
            }
        }
        if (seed % 4 == 0) {
            for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
                mesh.face_groups.push_back(random.below(3));
        }
        INFO("seed " << seed);
        for (const double distance : {0.05, 0.15, 0.5})
            CHECK(between(mesh, distance) == naive(mesh, distance, 1e-8));
    }
}
