#include "faqem/engine/mesh/pair_table.hpp"

#include <map>
#include <set>

#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace faqem;
using namespace faqem::engine;
using test::Ends;
using test::ends;

namespace {

// Expected pairs by their vertices: the face count, and whether the pair is virtual.
struct Expected {
    std::uint32_t faces;
    bool is_virtual;
};
using Model = std::map<Ends, Expected>;

std::vector<Triangle> living(const CollapseMesh& collapse_mesh) {
    std::vector<Triangle> result;
    for (Index f = 0; f < collapse_mesh.face_slots(); ++f) {
        if (collapse_mesh.is_alive(f)) result.push_back(collapse_mesh.triangle(f));
    }
    return result;
}

// The expected pairs after v was merged into u, with the faces counted from the triangles.
Model after_collapse(const Model& before, const CollapseMesh& collapse_mesh, Index u, Index v) {
    Model model;
    for (const auto& [pair, what] : before) {
        const Ends renamed = ends(pair.first == v ? u : pair.first, pair.second == v ? u : pair.second);
        if (renamed.first == renamed.second) continue;
        const auto [at, fresh] = model.insert({renamed, {0, what.is_virtual}});
        if (!fresh) at->second.is_virtual = at->second.is_virtual && what.is_virtual;
    }
    const test::Edges edges = test::edges(living(collapse_mesh));
    for (auto at = model.begin(); at != model.end();) {
        const auto edge = edges.find(at->first);
        at->second.faces = edge == edges.end() ? 0 : edge->second;
        const bool lives =
            at->second.faces > 0 || (at->second.is_virtual && collapse_mesh.degree(at->first.first) &&
                                     collapse_mesh.degree(at->first.second));
        at = lives ? std::next(at) : model.erase(at);
    }
    return model;
}

// Whether faces(pair) are different faces that are alive and contain both vertices.
bool knows_its_faces(const PairTable& pairs, const CollapseMesh& collapse_mesh, Index pair) {
    const std::uint32_t count = pairs.face_count(pair);
    if (count > 2) return true;
    const auto [first, last] = pairs.faces(pair);
    const auto has = [&](Index f) {
        return f != no_index && collapse_mesh.is_alive(f) && collapse_mesh.has_corner(f, pairs.first(pair)) &&
               collapse_mesh.has_corner(f, pairs.second(pair));
    };
    return (count < 1 || has(first)) && (count < 2 || (has(last) && first != last));
}

bool agrees(const PairTable& pairs, const CollapseMesh& collapse_mesh, const Model& model) {
    Model found;
    std::vector<std::uint32_t> open(collapse_mesh.vertex_slots(), 0),
        nonmanifold(collapse_mesh.vertex_slots(), 0);
    for (Index p = 0; p < pairs.size(); ++p) {
        if (!pairs.is_alive(p)) continue;
        const Ends e = ends(pairs.first(p), pairs.second(p));
        if (!found.insert({e, {pairs.face_count(p), false}}).second) return false;
        if (!knows_its_faces(pairs, collapse_mesh, p)) return false;
        if (pairs.face_count(p) == 1) ++open[e.first], ++open[e.second];
        if (pairs.face_count(p) > 2) ++nonmanifold[e.first], ++nonmanifold[e.second];
    }
    if (found.size() != model.size()) return false;
    for (const auto& [pair, what] : model) {
        const auto at = found.find(pair);
        if (at == found.end() || at->second.faces != what.faces) return false;
    }
    for (Index v = 0; v < collapse_mesh.vertex_slots(); ++v) {
        std::set<Ends> listed, expected;
        bool good = true;
        pairs.for_each_pair(v, [&](Neighbour n) {
            good = good && pairs.is_alive(n.pair) && listed.insert(ends(v, n.vertex)).second &&
                   ends(pairs.first(n.pair), pairs.second(n.pair)) == ends(v, n.vertex);
        });
        for (const auto& entry : model) {
            if (entry.first.first == v || entry.first.second == v) expected.insert(entry.first);
        }
        if (!good || listed != expected || pairs.boundary_degree(v) != open[v] ||
            pairs.nonmanifold_degree(v) != nonmanifold[v])
            return false;
    }
    return true;
}

// Whether `changes` are the pairs of the survivor u and the neighbours that lost a boundary edge to it,
// with boundary_changed set for edges that were boundary edges at u or v, or are now.
bool changes_agree(const std::vector<PairTable::Change>& changes, const Model& before, const Model& after,
                   Index u, Index v, std::size_t vertices) {
    const auto open = [](const Model& model, Ends e) {
        const auto at = model.find(e);
        return at != model.end() && at->second.faces == 1;
    };
    std::map<Index, std::pair<bool, bool>> expected, found;  // by vertex: alive, changed
    for (Index n = 0; n < vertices; ++n) {
        if (n == u || n == v) continue;
        const bool lives = after.count(ends(u, n)) > 0;
        const bool changed = open(before, ends(u, n)) || open(before, ends(v, n)) || open(after, ends(u, n));
        if (lives || changed) expected[n] = {lives, changed};
    }
    for (const PairTable::Change& change : changes)
        found[change.neighbour.vertex] = {change.neighbour.pair != no_index, change.boundary_changed};
    return found == expected && found.size() == changes.size();
}

}  // namespace

TEST_CASE("pairs are numbered by their smaller vertex, then in corner order, virtual pairs last") {
    // Faces at vertex 0 of the quad: (0 1 2), then (0 2 3).
    const CollapseMesh collapse_mesh = test::collapse_mesh_of(test::both(test::quad(), test::quad()));
    const std::vector<Ends> extra = {{2, 7}};
    const PairTable pairs(collapse_mesh, extra);
    REQUIRE(pairs.size() == 11);
    const std::vector<Ends> expected = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {2, 3}, {4, 5},
                                        {4, 6}, {4, 7}, {5, 6}, {6, 7}, {2, 7}};
    for (Index p = 0; p < pairs.size(); ++p) {
        CHECK(Ends(pairs.first(p), pairs.second(p)) == expected[p]);
        CHECK(pairs.face_count(p) == (p == 10 ? 0u : p == 1 || p == 6 ? 2u : 1u));
        CHECK(pairs.is_alive(p));
    }
    CHECK(pairs.boundary_degree(0) == 2);
}

TEST_CASE("the faces of a non-manifold edge are counted") {
    const CollapseMesh collapse_mesh = test::collapse_mesh_of(test::book());
    const PairTable pairs(collapse_mesh, {});
    CHECK(pairs.size() == 7);
    CHECK(pairs.face_count(0) == 3);
    CHECK(pairs.boundary_degree(0) == 3);
    CHECK(pairs.boundary_degree(2) == 2);
}

TEST_CASE("after the removal of a face its edges have the remaining faces") {
    // The edge (0, 1) of the book has three faces; without one of them it has two.
    CollapseMesh collapse_mesh = test::collapse_mesh_of(test::book());
    PairTable pairs(collapse_mesh, {});
    const Triangle page = collapse_mesh.triangle(1);
    collapse_mesh.remove_face(1);
    pairs.after_face_removal(collapse_mesh, page);
    const Index spine = test::pair_of(pairs, 0, 1);
    REQUIRE(pairs.face_count(spine) == 2);
    CHECK(pairs.faces(spine) == std::array<Index, 2>{0, 2});
    CHECK(pairs.nonmanifold_degree(0) == 0);
}

TEST_CASE("a virtual pair that becomes an edge is no longer virtual and dies with its last face") {
    // Faces 0 1 2 and 3 4 5, virtual pairs 0-3 and 1-3: collapsing 0-3 to 0 turns 1-3 into the edge 0-1.
    const TriangleMesh mesh = test::make({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}},
                                         {{0, 1, 2}, {3, 4, 5}});
    CollapseMesh collapse_mesh = test::collapse_mesh_of(mesh);
    const std::vector<Ends> extra = {{0, 3}, {1, 3}};
    PairTable pairs(collapse_mesh, extra);
    std::vector<Index> killed;
    std::vector<PairTable::Change> changes;
    collapse_mesh.collapse(0, 3, Vector3::Zero());
    pairs.merge(collapse_mesh, 0, 3, killed, changes);
    CHECK(killed == std::vector<Index>{6, 7});
    CHECK(changes.size() == 4);
    killed.clear();
    collapse_mesh.collapse(1, 2, Vector3::Zero());
    pairs.merge(collapse_mesh, 1, 2, killed, changes);
    // Vertex 0, into which 3 was merged, lost its boundary edges to 1 and 2.
    REQUIRE(changes.size() == 1);
    CHECK(changes[0].neighbour.vertex == 0);
    CHECK(changes[0].neighbour.pair == no_index);
    CHECK(std::set<Index>(killed.begin(), killed.end()) == std::set<Index>{0, 1, 2});
}

TEST_CASE("after every collapse the pairs agree with those counted from the triangles") {
    for (std::uint32_t seed = 0; seed < 40; ++seed) {
        const std::size_t vertices = 5 + seed;
        // With few faces there are many boundaries, with many faces non-manifold edges.
        TriangleMesh mesh = test::soup(seed, vertices, seed % 2 ? vertices : 4 * vertices);
        CollapseMesh collapse_mesh = test::collapse_mesh_of(mesh);
        Model model;
        for (const auto& [edge, faces] : test::edges(mesh.triangles)) model[edge] = {faces, false};
        test::Random random(seed);
        std::vector<Ends> extra;
        for (int i = 0; i < 8; ++i) {
            const Ends e = ends(random.below(vertices), random.below(vertices));
            if (e.first == e.second || !collapse_mesh.degree(e.first) || !collapse_mesh.degree(e.second))
                continue;
            if (model.insert({e, {0, true}}).second) extra.push_back(e);
        }
        PairTable pairs(collapse_mesh, extra);
        bool good = agrees(pairs, collapse_mesh, model);
        while (!model.empty() && good) {
            auto at = model.begin();
            std::advance(at, random.below(model.size()));
            auto [u, v] = at->first;
            if (random.unit() < 0.5) std::swap(u, v);
            std::set<Index> before;
            for (Index p = 0; p < pairs.size(); ++p) {
                if (pairs.is_alive(p)) before.insert(p);
            }
            const Model old = model;
            collapse_mesh.collapse(u, v, Vector3::Zero());
            model = after_collapse(model, collapse_mesh, u, v);
            std::vector<Index> killed;
            std::vector<PairTable::Change> changes;
            pairs.merge(collapse_mesh, u, v, killed, changes);
            for (const Index p : killed) good = good && before.erase(p) == 1 && !pairs.is_alive(p);
            good = good && before.size() == model.size() && agrees(pairs, collapse_mesh, model) &&
                   changes_agree(changes, old, model, u, v, vertices);
        }
        INFO("seed " << seed);
        CHECK(good);
    }
}
