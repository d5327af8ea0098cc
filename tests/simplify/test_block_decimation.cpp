#include "faqem/detail/simplify/block_decimation.hpp"

#include <algorithm>
#include <set>
#include <stdexcept>
#include <thread>

#include "faqem/detail/simplify/spatial_order.hpp"
#include "faqem/engine/engine.hpp"
#include "faqem/engine/queue/sweep_queue.hpp"
#include "faqem/engine/tracking/tracked_metric.hpp"
#include "faqem/options.hpp"
#include "support/catch.hpp"
#include "support/original.hpp"

using namespace faqem;
using namespace faqem::detail;
using namespace faqem::engine;

namespace {

// A preprocessed and reordered surface with blocks of 500 vertices.
struct Fixture {
    explicit Fixture(const TriangleMesh& mesh)
        : reordered(reorder(preprocess(mesh.view(), settings({})))), locked(reordered.positions.size(), 0) {
        loop.rules = {LinkCondition::by_size, 0.2, 1e-8, -0.9};
        loop.distance_weight = 1e-4;
    }
    BlockInput input() const { return {reordered.positions, reordered.triangles, locked, 500}; }
    BlockSteps steps(std::size_t least, const RunContext& context = 2) const {
        return simplify_in_blocks(input(), loop, least, nullptr, Recording::on, context);
    }
    std::size_t faces() const { return reordered.triangles.size(); }

    ReorderedMesh reordered;
    std::vector<std::uint8_t> locked;
    LoopOptions loop;
};

// Recorder that stores collapses as block steps.
struct Steps {
    void before_collapse(const CollapseMesh&, Index survivor, Index gone, const Candidate& to) {
        steps.push_back({survivor, gone, to.point});
    }
    void before_deletion(Index) {}

    std::vector<BlockStep> steps;
};

TriangleMesh triple(const TriangleMesh& mesh) { return test::both(test::both(mesh, mesh), mesh); }

// The collapses of one engine without blocks, if `wanted` faces are to be kept of three copies of the mesh.
std::vector<BlockStep> single_engine_steps(const TriangleMesh& mesh, const LoopOptions& loop,
                                           std::size_t wanted, TrackedMetric metric) {
    CollapseMesh collapse_mesh = test::collapse_mesh_of(mesh);
    PairTable pairs(collapse_mesh, {});
    Wedges wedges;
    std::vector<std::uint8_t> free(mesh.positions.size(), 0);
    const std::size_t faces = collapse_mesh.face_count();
    const double share = spare_share * static_cast<double>(wanted) / static_cast<double>(3 * faces);
    Steps steps;
    Engine<TrackedMetric, SweepQueue, Steps>(collapse_mesh, pairs, wedges, free, metric, steps)
        .run(block_options(loop, faces, 0, share));
    return steps.steps;
}

// Checks that the steps found for three copies of a mesh are, for each copy, the steps of a single engine.
// \param size  number of vertices of one copy
void check_copies_match(const std::vector<BlockStep>& one, const BlockSteps& found, Index size) {
    REQUIRE(found.steps.size() % 3 == 0);
    const std::size_t each = found.steps.size() / 3;
    REQUIRE(each > 80);
    REQUIRE(one.size() >= each);
    for (std::size_t i = 0; i < each; ++i) {
        for (const Index copy : {0u, 1u, 2u}) {
            const BlockStep& step = found.steps[copy * each + i];
            REQUIRE(step.survivor == one[i].survivor + copy * size);
            REQUIRE(step.gone == one[i].gone + copy * size);
            REQUIRE(step.to == one[i].to);
        }
    }
}

TriangleMesh bumpy_sphere() { return test::shaken(test::icosphere(4), 0.01, 7); }  // 2562 vertices

}  // namespace

TEST_CASE("blocks: small surfaces are one block, larger ones a multiple of four blocks of equal size") {
    for (const std::size_t few : {0u, 1u, 32768u}) CHECK(vertices_per_block(few) == few);
    CHECK(vertices_per_block(8192, 8192) == 8192);
    CHECK(vertices_per_block(8193, 8192) == 2049);
    for (const std::size_t many : {32769u, 100000u, 131072u, 131073u, 1000000u}) {
        const std::size_t size = vertices_per_block(many);
        const std::size_t blocks = (many + size - 1) / size;
        CHECK(size <= 32768);
        CHECK(blocks % 4 == 0);
        CHECK(many > (blocks - 1) * size);
        CHECK(many > (blocks - 4) * 32768);
    }
}

TEST_CASE("blocks: applying the steps one by one gives the mesh and patches of apply_steps") {
    const Fixture fixture(bumpy_sphere());
    const BlockSteps found = fixture.steps(1000);
    REQUIRE(found.steps.size() > 1000);
    CollapseMesh collapse_mesh(fixture.reordered.positions, fixture.reordered.triangles);
    bool patches_agree = true;
    for (std::size_t i = 0; i < found.steps.size(); ++i) {
        const auto& [survivor, gone, to] = found.steps[i];
        REQUIRE(collapse_mesh.degree(survivor) > 0);
        REQUIRE(collapse_mesh.degree(gone) > 0);
        std::set<Index> patch;
        collapse_mesh.for_each_face_around(survivor, gone, [&](Index f, unsigned) { patch.insert(f); });
        const std::size_t end =
            i + 1 < found.steps.size() ? found.patch_begin[i + 1] : found.patch_faces.size();
        patches_agree = patches_agree && patch == std::set<Index>(&found.patch_faces[found.patch_begin[i]],
                                                                  found.patch_faces.data() + end);
        collapse_mesh.collapse(survivor, gone, to);
    }
    CHECK(patches_agree);
    const CompactedMesh compacted = apply_steps(fixture.input(), found.steps);
    CHECK(compacted.triangles.size() == collapse_mesh.face_count());
    bool agree = true;
    for (std::size_t f = 0; f < compacted.faces.size(); ++f) {
        const Index slot = compacted.faces[f];
        for (std::size_t k = 0; k < 3 && agree; ++k) {
            const Index v = compacted.triangles[f][k];
            agree = collapse_mesh.is_alive(slot) &&
                    compacted.vertices[v] == collapse_mesh.triangle(slot)[k] &&
                    compacted.positions[v] == collapse_mesh.position(compacted.vertices[v]);
        }
    }
    CHECK(agree);
    CHECK(test::closed_manifold(compacted.triangles));
    CHECK(test::euler(compacted.triangles) == 2);
}

TEST_CASE("blocks: the number of remaining faces is at least the requested number") {
    // All collapses of the flat grid have the same cost: each block keeps the same share of them.
    for (const TriangleMesh& mesh : {bumpy_sphere(), test::grid(50)}) {
        const Fixture fixture(mesh);
        for (const std::size_t least : {100u, 800u, 2000u}) {
            const BlockSteps found = fixture.steps(least);
            const std::size_t left = apply_steps(fixture.input(), found.steps).triangles.size();
            CHECK(left >= least);
            CHECK(left < 0.9 * static_cast<double>(fixture.faces()));
        }
    }
}

TEST_CASE("blocks: there are no steps for at most two blocks or if few faces are to be removed") {
    CHECK(Fixture(test::icosphere(3)).steps(10).steps.empty());  // 642 vertices
    CHECK(Fixture(bumpy_sphere()).steps(4000).steps.empty());    // of 5120 faces
}

TEST_CASE("blocks: the steps do not depend on the number of threads") {
    const Fixture fixture(bumpy_sphere());
    const BlockSteps one = fixture.steps(600, 1);
    for (const std::uint32_t threads : {2u, 3u, 16u}) {
        const BlockSteps more = fixture.steps(600, threads);
        REQUIRE(more.steps.size() == one.steps.size());
        bool same = more.patch_faces == one.patch_faces;
        for (std::size_t i = 0; i < one.steps.size(); ++i) {
            const auto &a = one.steps[i], &b = more.steps[i];
            same = same && a.survivor == b.survivor && a.gone == b.gone && a.to == b.to;
        }
        CHECK(same);
        CHECK(more.refusals == one.refusals);
    }
}

TEST_CASE("blocks: locked vertices and vertices with faces in two blocks do not move") {
    Fixture fixture(bumpy_sphere());
    for (Index v = 0; v < fixture.locked.size(); v += 5) fixture.locked[v] = 1;
    const BlockInput input = fixture.input();
    std::set<Index> staying;
    for (Index v = 0; v < fixture.locked.size(); v += 5) staying.insert(v);
    for (const Triangle& t : input.triangles) {
        if (input.is_between_blocks(t)) staying.insert(t.begin(), t.end());
    }
    const BlockSteps found = fixture.steps(1500);
    REQUIRE_FALSE(found.steps.empty());
    for (const auto& [survivor, gone, to] : found.steps) {
        REQUIRE(staying.count(gone) == 0);
        if (staying.count(survivor)) REQUIRE(to == input.positions[survivor]);
    }
}

TEST_CASE("blocks: edges between blocks are not treated as boundary edges") {
    // Otherwise these edges would get boundary quadrics, or costs for the removal of a boundary.
    const Fixture fixture(test::grid(60));
    const BlockSteps found = fixture.steps(500);
    const CompactedMesh compacted = apply_steps(fixture.input(), found.steps);
    // The area is still that of the square.
    double area = 0;
    for (const Triangle& t : compacted.triangles) {
        area +=
            area_vector(compacted.positions[t[0]], compacted.positions[t[1]], compacted.positions[t[2]]).z();
    }
    double whole = 0;
    for (const Triangle& t : fixture.reordered.triangles) {
        whole += area_vector(fixture.reordered.positions[t[0]], fixture.reordered.positions[t[1]],
                             fixture.reordered.positions[t[2]])
                     .z();
    }
    CHECK(area == Approx(whole));
}

TEST_CASE("blocks: the progress callback runs on the calling thread and can cancel or throw") {
    Fixture fixture(test::shaken(test::icosphere(5), 0.01, 7));
    const std::thread::id here = std::this_thread::get_id();
    int calls = 0;
    double last = 0;
    const auto ask = [&](Phase, double done) {
        CHECK(std::this_thread::get_id() == here);
        CHECK(done >= last);
        CHECK(done <= 1);
        last = done;
        return ++calls == 2 ? Continue::cancel : Continue::yes;
    };
    CHECK(fixture.steps(2000, {3, ask}).is_cancelled);
    CHECK(calls == 2);
    const auto fail = [](Phase, double) -> Continue { throw std::runtime_error("enough"); };
    CHECK_THROWS_WITH(fixture.steps(2000, {3, fail}), "enough");
}

TEST_CASE("blocks: with distance tracking each block gets the same collapses as from a single engine") {
    // Three spheres at the same position, one block each, that were simplified from a finer sphere.
    const TriangleMesh coarse = test::shaken(test::icosphere(2), 0.01, 7);
    const TriangleMesh fine = test::icosphere(3);
    std::vector<Index> into;
    for (const Vec3& p : fine.positions) {
        const auto distance = [&](const Vec3& q) { return to_eigen(test::minus(p, q)).squaredNorm(); };
        const auto nearest =
            std::min_element(coarse.positions.begin(), coarse.positions.end(),
                             [&](const Vec3& a, const Vec3& b) { return distance(a) < distance(b); });
        into.push_back(static_cast<Index>(nearest - coarse.positions.begin()));
    }
    std::vector<Index> into_all;
    const auto size = static_cast<Index>(coarse.positions.size());
    for (const Index copy : {0u, 1u, 2u}) {
        for (const Index v : into) into_all.push_back(v + copy * size);
    }
    const test::OriginalOf original(fine), originals(triple(fine));
    const test::OriginalOf now(triple(coarse));
    LoopOptions loop{.rules = {LinkCondition::by_size, 0.2, 1e-8, -0.9}, .distance_weight = 0.05};
    const std::vector<std::uint8_t> locked(3 * size, 0);
    const BlockInput input{now.positions, now.triangles, locked, size};
    const BlockTracking tracking{originals.surface, into_all};
    const BlockSteps found = simplify_in_blocks(input, loop, 300, &tracking, Recording::off, 2);
    const std::vector<BlockStep> one = single_engine_steps(
        coarse, loop, 300, TrackedMetric({}, original.surface, TrackedVertices(into), 320, 0.05));
    check_copies_match(one, found, size);
}

TEST_CASE("blocks: with boundary tracking each block gets the same collapses as from a single engine") {
    // Three tubes at the same position, one block each.
    const TriangleMesh tube = test::shaken(test::cylinder(16, 12, 2), 0.01, 7);
    const test::OriginalOf original(tube), now(triple(tube));
    LoopOptions loop{.rules = {LinkCondition::by_size, 0.2, 1e-8, -0.9}, .distance_weight = 0.05};
    const auto size = static_cast<Index>(tube.positions.size());
    const std::vector<std::uint8_t> locked(3 * size, 0);
    const BlockInput input{now.positions, now.triangles, locked, size};
    const auto found = [&](const BlockTracking* tracking) {
        return simplify_in_blocks(input, loop, 500, tracking, Recording::off, 2);
    };
    const BlockTracking borders{now.surface, now.tracked.current, Watched::borders};
    const BlockSteps held = found(&borders);
    check_copies_match(
        single_engine_steps(tube, loop, 500, TrackedMetric({}, original.surface, original.tracked, 0, 0.05)),
        held, size);
    const BlockSteps free = found(nullptr);
    REQUIRE(free.steps.size() == held.steps.size());
    CHECK_FALSE(std::equal(free.steps.begin(), free.steps.end(), held.steps.begin(),
                           [](const BlockStep& a, const BlockStep& b) { return a.to == b.to; }));
}
