#include "faqem/detail/rounds/rounds.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <optional>
#include <set>

#include "faqem/detail/simplify/spatial_order.hpp"
#include "faqem/engine/mesh/boundary_edges.hpp"
#include "faqem/engine/mesh/vector.hpp"
#include "faqem/simplify.hpp"
#include "support/applied_steps.hpp"
#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace faqem;
using namespace faqem::detail;

namespace {

// 10,242 vertices, which are several cells.
const TriangleMesh& lump() {
    static const TriangleMesh mesh = test::shaken(test::icosphere(5), 0.002, 3);
    return mesh;
}

// The collapses in rounds on two threads, and what they leave.
struct Rounds {
    Rounds(const TriangleMesh& mesh, std::size_t least, const RunContext& context = 2, Index lock_every = 0,
           bool has_groups = false)
        : input(reorder(preprocess(mesh.view(), settings({})))), locked(input.positions.size(), 0) {
        for (std::size_t v = 0; lock_every && v < locked.size(); v += lock_every) locked[v] = 1;
        for (std::size_t f = 0; has_groups && f < input.triangles.size(); ++f)
            groups.push_back(is_above(f) ? 7 : 3);
        ReorderedMesh copy = input;
        std::vector<Links> links;
        left = simplify_in_rounds(
            {copy.positions, copy.triangles, links, locked, groups, nullptr, Recording::on}, least,
            Recording::on, context, found);
        if (!left) CHECK((copy.positions == input.positions && copy.triangles == input.triangles));
    }

    // Whether a face of the input is above the plane z = 0.
    bool is_above(std::size_t f) const {
        double z = 0;
        for (const Index v : input.triangles[f]) z += input.positions[v].z();
        return z > 0;
    }

    ReorderedMesh input;
    std::vector<std::uint8_t> locked;
    std::vector<Index> groups;
    RoundSteps found;
    std::optional<CompactedMesh> left;
};

Options fast(double share) { return {.target = ratio(share), .preset = Preset::fast}; }

}  // namespace

TEST_CASE("rounds: 1, 2 and 8 threads find the same collapses in the same order") {
    const RoundSteps one = Rounds(lump(), 2560, 1).found;
    for (const std::uint32_t threads : {2u, 8u}) {
        const RoundSteps more = Rounds(lump(), 2560, threads).found;
        CHECK(test::same_steps(more, one));
    }
}

TEST_CASE("rounds: spare faces above a high target are left to the engine, and twice as many of a low one") {
    CHECK(faces_after_rounds(100'000, 25'000) == 125'000);
    CHECK(faces_after_rounds(4000, 200) == 6250);
    CHECK(faces_after_rounds(2000, 100) == 4000);
    CHECK(faces_after_rounds(10, 0) == 3000);
}

TEST_CASE("rounds: the faces asked for are left, and the surface stays a closed manifold") {
    const CompactedMesh left = *Rounds(lump(), 2560).left;
    CHECK(left.triangles.size() >= 2560);
    CHECK(left.triangles.size() <= 2650);
    CHECK(test::closed_manifold(left.triangles));
    CHECK(test::euler(left.triangles) == 2);
}

TEST_CASE("rounds: the surface that is left is that of the steps, applied one by one") {
    const Rounds rounds(lump(), 2560);
    CHECK(rounds.found.collapses == rounds.found.steps.size());
    const CompactedMesh& left = *rounds.left;
    const CompactedMesh applied =
        test::applied(rounds.input.positions, rounds.input.triangles, rounds.found.steps);
    CHECK(left.vertices == applied.vertices);
    CHECK(left.faces == applied.faces);
    CHECK(left.vertex_map == applied.vertex_map);
    CHECK(left.source_slots == applied.source_slots);
    CHECK(left.positions == applied.positions);
    CHECK(left.triangles == applied.triangles);
}

TEST_CASE("rounds: the patch of a collapse is the faces around its vertices just before it") {
    const Rounds rounds(lump(), 5120);
    const RoundSteps& found = rounds.found;
    std::vector<Triangle> faces = rounds.input.triangles;
    std::vector<std::set<Index>> around(rounds.input.positions.size());
    for (Index f = 0; f < faces.size(); ++f) {
        for (const Index v : faces[f]) around[v].insert(f);
    }
    bool same = true;
    for (std::size_t i = 0; i < found.steps.size(); ++i) {
        const auto& [survivor, gone, to] = found.steps[i];
        const std::size_t end =
            i + 1 < found.steps.size() ? found.patch_begin[i + 1] : found.patch_faces.size();
        const std::set<Index> patch(
            found.patch_faces.begin() + static_cast<std::ptrdiff_t>(found.patch_begin[i]),
            found.patch_faces.begin() + static_cast<std::ptrdiff_t>(end));
        std::set<Index> both = around[survivor];
        both.insert(around[gone].begin(), around[gone].end());
        same = same && patch == both && patch.size() == end - found.patch_begin[i];
        around[survivor].clear();
        for (const Index f : both) {
            const bool dies = std::count(faces[f].begin(), faces[f].end(), survivor) &&
                              std::count(faces[f].begin(), faces[f].end(), gone);
            for (Index& v : faces[f]) {
                if (dies) around[v].erase(f);
                if (v == gone) v = survivor;
            }
            if (!dies) around[survivor].insert(f);
        }
    }
    CHECK(same);
}

TEST_CASE("rounds: faces with reversed windings are simplified as the others, and stay reversed") {
    TriangleMesh turned = lump();
    for (std::size_t f = 0; f < turned.triangles.size(); f += 3)
        std::swap(turned.triangles[f][1], turned.triangles[f][2]);
    const Rounds rounds(turned, 2560);
    std::vector<Triangle> left = rounds.left->triangles;
    CHECK(left.size() >= 2560);
    CHECK(left.size() <= 2650);
    for (std::size_t i = 0; i < left.size(); ++i)
        if (rounds.input.face[rounds.left->faces[i]] % 3 == 0) std::swap(left[i][1], left[i][2]);
    CHECK(test::closed_manifold(left));
    CHECK(test::euler(left) == 2);
}

TEST_CASE("rounds: a strip that cannot be oriented keeps a border where its windings meet") {
    const CompactedMesh left = *Rounds(test::moebius(400, 23), 5000).left;
    CHECK(left.triangles.size() < 9000);
    CHECK(engine::find_boundary_edges(left.triangles, left.positions.size()).size() == 800);
    CHECK(test::euler(left.triangles) == 0);
}

TEST_CASE("rounds: vertices between two groups stay, the others move") {
    const Rounds rounds(lump(), 2560, 2, 0, true);
    std::vector<int> sides(rounds.input.positions.size(), 0);
    for (std::size_t f = 0; f < rounds.input.triangles.size(); ++f)
        for (const Index v : rounds.input.triangles[f]) sides[v] |= rounds.is_above(f) ? 1 : 2;
    bool stay = true;
    for (const RoundStep& step : rounds.found.steps)
        stay = stay && sides[step.survivor] != 3 && sides[step.gone] != 3;
    CHECK(stay);
    CHECK(rounds.left->triangles.size() < 5120);
    CHECK(test::closed_manifold(rounds.left->triangles));
}

TEST_CASE("rounds: a large surface with preserved groups keeps their areas, with fast and balanced") {
    TriangleMesh sphere = test::icosphere(5);
    for (const Triangle& t : sphere.triangles)
        sphere.face_groups.push_back(
            sphere.positions[t[0]][2] + sphere.positions[t[1]][2] + sphere.positions[t[2]][2] > 0.3);
    const auto areas = [](const TriangleMesh& mesh) {
        std::array<double, 2> result = {};
        for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
            const auto& [a, b, c] = mesh.triangles[f];
            const auto at = [&](Index v) { return engine::to_eigen(mesh.positions[v]); };
            result[mesh.face_groups[f]] += 0.5 * engine::area_vector(at(a), at(b), at(c)).norm();
        }
        return result;
    };
    for (const Preset preset : {Preset::fast, Preset::balanced}) {
        Options options = fast(0.05);
        options.preset = preset;
        options.topology.group_boundaries = GroupBoundaries::preserved;
        const SimplifyResult result = simplify(sphere.view(), options);
        CHECK(result.report.faces_out <= sphere.triangles.size() / 20);
        CHECK(test::closed_manifold(result.mesh.triangles));
        for (std::size_t g = 0; g < 2; ++g)
            CHECK(areas(result.mesh)[g] == Approx(areas(sphere)[g]).epsilon(0.01));
    }
}

TEST_CASE("rounds: no locked vertex is in a collapse") {
    const Rounds rounds(lump(), 2560, 2, 100);
    CHECK(rounds.found.collapses > 5000);
    bool stay = true;
    for (const RoundStep& step : rounds.found.steps)
        stay = stay && !rounds.locked[step.survivor] && !rounds.locked[step.gone];
    CHECK(stay);
}

TEST_CASE("rounds: a border does not move, and 8 faces are left for each of its vertices") {
    const Rounds rounds(test::grid(100), 2000);
    const CompactedMesh& left = *rounds.left;
    CHECK(engine::find_boundary_edges(left.triangles, left.positions.size()).size() == 400);
    CHECK(left.triangles.size() >= 8 * 400);
    CHECK(left.triangles.size() <= 8 * 410);
}

TEST_CASE("rounds: the rim of a thin blade and the corners of narrow faces do not move") {
    const TriangleMesh blade = test::two_layers(80, 0.25);
    const auto on_rim = [](const Vec3& p) { return p[2] == 0; };
    const Rounds thin(blade, 2000);
    Index stay = 0;
    for (const Index v : thin.left->vertices) stay += on_rim(blade.positions[thin.input.vertex[v]]);
    CHECK(stay == 320);
    TriangleMesh narrow = lump();
    const Triangle t = narrow.triangles[1000];
    auto& p = narrow.positions;
    for (unsigned k = 0; k < 3; ++k) p[t[0]][k] = 0.5 * (p[t[1]][k] + p[t[2]][k]) + 1e-6 * p[t[0]][k];
    const Rounds rounds(narrow, 2560);
    const std::vector<engine::Vector3>& left = rounds.left->positions;
    const auto slot = [&](Index v) {
        const std::vector<Index>& vertex = rounds.input.vertex;
        return static_cast<Index>(std::find(vertex.begin(), vertex.end(), v) - vertex.begin());
    };
    for (const Index v : t) CHECK(std::count(left.begin(), left.end(), rounds.input.positions[slot(v)]) == 1);
}

TEST_CASE("rounds: surfaces with many vertices that cannot move are left to the engine") {
    CHECK(!Rounds(test::soup(7, 9000, 27000), 900).left);
    CHECK(!Rounds(lump(), 18'000).left);  // more than three quarters would remain
}

TEST_CASE("rounds: no collapse is made after the time limit, and the callback can cancel") {
    const RunContext late(2, {}, std::chrono::steady_clock::now() - std::chrono::seconds(1));
    const Rounds none(lump(), 2560, late);
    CHECK(none.found.collapses == 0);
    CHECK(none.left->positions == none.input.positions);
    const RunContext stopped(2, [](Phase, double) { return Continue::cancel; });
    CHECK_THROWS_AS(Rounds(lump(), 2560, stopped), engine::Cancelled);
}

TEST_CASE("rounds: powers of two scale the result bit by bit, and the target is met") {
    const TriangleMesh mesh = test::shaken(test::icosphere(6), 0.001, 3);
    const SimplifyResult result = simplify(mesh.view(), fast(0.1));
    CHECK(result.mesh.triangles.size() == 8192);
    const SimplifyResult small = simplify(test::scaled(mesh, 0x1p-20).view(), fast(0.1));
    CHECK(small.mesh.triangles == result.mesh.triangles);
    CHECK(small.mesh.positions == test::scaled(result.mesh, 0x1p-20).positions);
}

TEST_CASE("rounds: vertices that did not move have exactly their input position, far from the origin, too") {
    const TriangleMesh mesh = test::moved(test::shaken(test::icosphere(6), 0.001, 3), {1e7, -1e7, 1e7});
    Options options = fast(0.4);
    options.history = Recording::on;
    const SimplifyResult result = simplify(mesh.view(), options);
    const std::set<Vec3> input(mesh.positions.begin(), mesh.positions.end());
    std::size_t unmoved = 0, exact = 0;
    for (std::size_t v = 0; v < result.mesh.positions.size(); ++v) {
        if (result.history.remaining_versions[v] >= result.history.positions.size()) continue;
        ++unmoved;
        exact += input.count(result.mesh.positions[v]);
    }
    CHECK(unmoved > 1000);
    CHECK(exact == unmoved);
}
