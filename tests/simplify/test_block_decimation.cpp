#include "faqem/detail/simplify/block_decimation.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <set>
#include <stdexcept>
#include <thread>

#include "faqem/detail/simplify/spatial_order.hpp"
#include "faqem/engine/engine.hpp"
#include "faqem/engine/queue/sweep_queue.hpp"
#include "faqem/engine/tracking/tracked_metric.hpp"
#include "support/original.hpp"

using namespace faqem;
using namespace faqem::detail;
using namespace faqem::engine;

namespace {

// A surface in slots, its blocks of 500 vertices.
struct Ground {
    explicit Ground(const TriangleMesh& mesh)
        : arranged(reorder(preprocess(mesh.view(), settings({})))), locked(arranged.positions.size(), 0) {
        loop.rules = {LinkCondition::by_size, 0.2, 1e-8, -0.9};
        loop.distance_weight = 1e-4;
    }
    BlockInput input() const { return {arranged.positions, arranged.triangles, locked, 500}; }
    BlockSteps steps(std::size_t least, std::uint32_t threads = 2) const {
        return simplify_in_blocks(input(), loop, least, nullptr, Recording::on, threads);
    }
    std::size_t faces() const { return arranged.triangles.size(); }

    ReorderedMesh arranged;
    std::vector<std::uint8_t> locked;
    LoopOptions loop;
};

struct Steps {
    void before_collapse(const CollapseMesh&, Index survivor, Index gone, const Candidate& to) {
        steps.push_back({survivor, gone, to.point});
    }
    void before_deletion(Index) {}

    std::vector<BlockStep> steps;
};

TriangleMesh triple(const TriangleMesh& mesh) { return test::both(test::both(mesh, mesh), mesh); }

// What an engine without blocks does to the mesh, where so many faces of three such are wanted.
std::vector<BlockStep> alone(const TriangleMesh& mesh, const LoopOptions& loop, std::size_t wanted,
                             TrackedMetric metric) {
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

// Three meshes in one place, of so many vertices: what was found for all does the same to each.
void check_that_each_goes_like(const std::vector<BlockStep>& one, const BlockSteps& found, Index size) {
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

TriangleMesh lump() { return test::shaken(test::icosphere(4), 0.01, 7); }  // 2562 vertices

}  // namespace

TEST_CASE("blocks: few vertices are one, more are four, eight and so on of one size") {
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

TEST_CASE("blocks: the steps can be done one after the other, and leave what apply_steps() says") {
    const Ground ground(lump());
    const BlockSteps found = ground.steps(1000);
    REQUIRE(found.steps.size() > 1000);
    CollapseMesh collapse_mesh(ground.arranged.positions, ground.arranged.triangles);
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
    const CompactedMesh compacted = apply_steps(ground.input(), found.steps);
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

TEST_CASE("blocks: no fewer faces are left than wanted, whatever they cost") {
    // Of the flat one every collapse costs nothing: ties are kept in equal shares.
    for (const TriangleMesh& mesh : {lump(), test::grid(50)}) {
        const Ground ground(mesh);
        for (const std::size_t least : {100u, 800u, 2000u}) {
            const BlockSteps found = ground.steps(least);
            const std::size_t left = apply_steps(ground.input(), found.steps).triangles.size();
            CHECK(left >= least);
            CHECK(left < 0.9 * static_cast<double>(ground.faces()));
        }
    }
}

TEST_CASE("blocks: one or two, or next to nothing to do, are left to the engine of the whole") {
    CHECK(Ground(test::icosphere(3)).steps(10).steps.empty());  // 642 vertices
    CHECK(Ground(lump()).steps(4000).steps.empty());            // of 5120 faces
}

TEST_CASE("blocks: the steps do not depend on the number of threads") {
    const Ground ground(lump());
    const BlockSteps one = ground.steps(600, 1);
    for (const std::uint32_t threads : {2u, 3u, 16u}) {
        const BlockSteps more = ground.steps(600, threads);
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

TEST_CASE("blocks: vertices that are locked, or have faces in two blocks, stay") {
    Ground ground(lump());
    for (Index v = 0; v < ground.locked.size(); v += 5) ground.locked[v] = 1;
    const BlockInput input = ground.input();
    std::set<Index> staying;
    for (Index v = 0; v < ground.locked.size(); v += 5) staying.insert(v);
    for (const Triangle& t : input.triangles) {
        if (input.is_between_blocks(t)) staying.insert(t.begin(), t.end());
    }
    const BlockSteps found = ground.steps(1500);
    REQUIRE_FALSE(found.steps.empty());
    for (const auto& [survivor, gone, to] : found.steps) {
        REQUIRE(staying.count(gone) == 0);
        if (staying.count(survivor)) REQUIRE(to == input.positions[survivor]);
    }
}

TEST_CASE("blocks: a hole between blocks is no border that could end") {
    // Without the rule, edges that only seem open would hold the surface beside them, or their end be priced.
    const Ground ground(test::grid(60));
    const BlockSteps found = ground.steps(500);
    const CompactedMesh compacted = apply_steps(ground.input(), found.steps);
    // The outline is still that of the square.
    double area = 0;
    for (const Triangle& t : compacted.triangles) {
        area +=
            area_vector(compacted.positions[t[0]], compacted.positions[t[1]], compacted.positions[t[2]]).z();
    }
    double whole = 0;
    for (const Triangle& t : ground.arranged.triangles) {
        whole += area_vector(ground.arranged.positions[t[0]], ground.arranged.positions[t[1]],
                             ground.arranged.positions[t[2]])
                     .z();
    }
    CHECK(area == Approx(whole));
}

TEST_CASE("blocks: who cancels is obeyed, and who throws is heard, on the calling thread") {
    Ground ground(test::shaken(test::icosphere(5), 0.01, 7));
    const std::thread::id here = std::this_thread::get_id();
    int calls = 0;
    double last = 0;
    ground.loop.progress = [&](double done) {
        CHECK(std::this_thread::get_id() == here);
        CHECK(done >= last);
        CHECK(done <= 1);
        last = done;
        return ++calls == 2 ? Continue::cancel : Continue::yes;
    };
    CHECK(ground.steps(2000, 3).is_cancelled);
    CHECK(calls == 2);
    ground.loop.progress = [&](double) -> Continue { throw std::runtime_error("enough"); };
    CHECK_THROWS_WITH(ground.steps(2000, 3), "enough");
}

TEST_CASE("blocks: each does what an engine alone would do, with the original vertices that are its own") {
    // Three spheres in one place, one block each; each was a finer one before.
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
    LoopOptions loop;
    loop.rules = {LinkCondition::by_size, 0.2, 1e-8, -0.9};
    loop.distance_weight = 0.05;
    const std::vector<std::uint8_t> locked(3 * size, 0);
    const BlockInput input{now.positions, now.triangles, locked, size};
    const BlockTracking tracking{originals.surface, into_all};
    const BlockSteps found = simplify_in_blocks(input, loop, 300, &tracking, Recording::off, 2);
    const std::vector<BlockStep> one =
        alone(coarse, loop, 300, TrackedMetric({}, original.surface, TrackedVertices(into), 320, 0.05));
    check_that_each_goes_like(one, found, size);
}

TEST_CASE("blocks: where only borders are watched, each holds its own as an engine alone would") {
    // Three tubes in one place, one block each.
    const TriangleMesh tube = test::shaken(test::cylinder(16, 12, 2), 0.01, 7);
    const test::OriginalOf original(tube), now(triple(tube));
    LoopOptions loop;
    loop.rules = {LinkCondition::by_size, 0.2, 1e-8, -0.9};
    loop.distance_weight = 0.05;
    const auto size = static_cast<Index>(tube.positions.size());
    const std::vector<std::uint8_t> locked(3 * size, 0);
    const BlockInput input{now.positions, now.triangles, locked, size};
    const auto found = [&](const BlockTracking* tracking) {
        return simplify_in_blocks(input, loop, 500, tracking, Recording::off, 2);
    };
    const BlockTracking borders{now.surface, now.tracked.current, Watched::borders};
    const BlockSteps held = found(&borders);
    check_that_each_goes_like(
        alone(tube, loop, 500, TrackedMetric({}, original.surface, original.tracked, 0, 0.05)), held, size);
    const BlockSteps free = found(nullptr);
    REQUIRE(free.steps.size() == held.steps.size());
    CHECK_FALSE(std::equal(free.steps.begin(), free.steps.end(), held.steps.begin(),
                           [](const BlockStep& a, const BlockStep& b) { return a.to == b.to; }));
}
