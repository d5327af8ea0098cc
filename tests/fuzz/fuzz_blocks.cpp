// Block decimation as in simplify(), first with the memoryless metric and then with distance tracking, but
// with small blocks: a mesh that is large enough for the real block size would take seconds per input.

#include <map>
#include <utility>

#include "faqem/detail/simplify/block_decimation.hpp"
#include "faqem/detail/simplify/presets.hpp"
#include "faqem/detail/simplify/run_state.hpp"
#include "faqem/options.hpp"
#include "fuzz/fuzz.hpp"

using namespace faqem;
using namespace faqem::detail;
using engine::CollapseMesh;

namespace {

using fuzz::expect;

/// A surface of some hundred vertices, possibly with random vertices and faces added.
TriangleMesh surface_of(fuzz::Input& in) {
    TriangleMesh mesh;
    const int kind = in.byte() % 8;
    if (kind == 0) mesh = test::icosphere(3);
    if (kind == 1) mesh = test::grid(12 + in.below(20));
    if (kind == 2) mesh = test::torus(16 + in.below(24), 10 + in.below(16));
    if (kind == 3) mesh = test::globe(10 + in.below(10), 1);
    if (kind == 4) mesh = test::cylinder(16 + in.below(24), 10 + in.below(16), 2);
    if (kind == 5) mesh = test::soup(in.byte(), 300, 800);
    if (kind == 6) mesh = test::both(test::icosphere(2), test::grid(8 + in.below(16)));
    if (const std::uint8_t amount = in.byte() % 8)
        mesh = test::shaken(std::move(mesh), 0.01 * amount, amount);
    return in.flag() ? mesh : test::both(std::move(mesh), fuzz::mesh_of(in));
}

engine::LoopOptions loop_of(fuzz::Input& in, const RunState& state) {
    constexpr LinkCondition links[] = {LinkCondition::by_size, LinkCondition::on, LinkCondition::off};
    engine::LoopOptions loop;
    const std::uint8_t bits = in.byte();
    loop.rules = {links[bits % 3], bits & 4 ? 0.3 : -1, 1e-8, bits & 8 ? -0.9 : -1};
    if (bits & 16) loop.distance_weight = state.area() / (1 + in.byte());
    return loop;
}

/// True if every edge has two faces and the faces around each vertex form one closed fan.
bool is_closed_manifold(std::span<const Triangle> triangles) {
    std::map<Index, std::map<Index, std::vector<Index>>> rings;  // vertex -> neighbours on its ring
    for (const Triangle& t : triangles) {
        for (std::size_t i = 0; i < 3; ++i) {
            auto& ring = rings[t[i]];
            ring[t[(i + 1) % 3]].push_back(t[(i + 2) % 3]);
            ring[t[(i + 2) % 3]].push_back(t[(i + 1) % 3]);
        }
    }
    return std::all_of(rings.begin(), rings.end(), [](const auto& of_vertex) {
        const auto& ring = of_vertex.second;
        if (std::any_of(ring.begin(), ring.end(), [](const auto& at) { return at.second.size() != 2; }))
            return false;
        const Index first = ring.begin()->first;
        std::size_t steps = 1;
        for (Index before = first, now = ring.at(first)[0]; now != first; ++steps) {
            const auto& ends = ring.at(now);
            const Index next = ends[ends[0] == before ? 1 : 0];
            before = std::exchange(now, next);
        }
        return steps == ring.size();
    });
}

int euler(std::span<const Triangle> triangles) {
    return test::euler(std::vector<Triangle>(triangles.begin(), triangles.end()));
}

/// Applies the steps one by one to a CollapseMesh and compares the result.
void expect_steps(const BlockInput& input, const BlockSteps& found, const CompactedMesh& compacted) {
    CollapseMesh collapse_mesh({input.positions.begin(), input.positions.end()},
                               {input.triangles.begin(), input.triangles.end()});
    std::vector<std::uint8_t> is_fixed(input.locked.begin(), input.locked.end());
    for (const Triangle& t : input.triangles) {
        if (!input.is_between_blocks(t)) continue;
        for (const Index v : t) is_fixed[v] = 1;
    }
    expect(found.patch_begin.size() == found.steps.size(), "a patch for every step");
    for (std::size_t i = 0; i < found.steps.size(); ++i) {
        const auto& [survivor, gone, to] = found.steps[i];
        expect(survivor < input.positions.size() && gone < input.positions.size(), "slots in range");
        expect(collapse_mesh.degree(survivor) > 0 && collapse_mesh.degree(gone) > 0,
               "vertices that have not been removed");
        expect(!is_fixed[gone], "locked vertices and vertices between blocks are not removed");
        expect(!is_fixed[survivor] || to == collapse_mesh.position(survivor), "locked vertices do not move");
        expect(std::isfinite(to.squaredNorm()), "finite positions");
        std::vector<Index> patch;
        collapse_mesh.for_each_face_around(survivor, gone, [&](Index f, unsigned) { patch.push_back(f); });
        const std::size_t begin = found.patch_begin[i];
        const std::size_t end =
            i + 1 < found.steps.size() ? found.patch_begin[i + 1] : found.patch_faces.size();
        expect(begin <= end && end <= found.patch_faces.size(), "patches in order");
        std::vector<Index> recorded(found.patch_faces.begin() + static_cast<std::ptrdiff_t>(begin),
                                    found.patch_faces.begin() + static_cast<std::ptrdiff_t>(end));
        std::sort(patch.begin(), patch.end());
        std::sort(recorded.begin(), recorded.end());
        expect(patch == recorded, "the patch of a step has the faces around its vertices");
        collapse_mesh.collapse(survivor, gone, to);
    }
    expect(compacted.triangles.size() == collapse_mesh.face_count(), "the same number of faces");
    expect(compacted.positions.size() == compacted.vertices.size() &&
               compacted.source_slots.size() == compacted.vertices.size() &&
               compacted.vertex_map.size() == input.positions.size() &&
               compacted.faces.size() == compacted.triangles.size(),
           "arrays of matching sizes");
    for (std::size_t f = 0; f < compacted.faces.size(); ++f) {
        expect(collapse_mesh.is_alive(compacted.faces[f]), "faces that have not been removed");
        for (std::size_t k = 0; k < 3; ++k) {
            const Index v = compacted.triangles[f][k];
            expect(v < compacted.vertices.size(), "vertices in range");
            expect(compacted.vertices[v] == collapse_mesh.triangle(compacted.faces[f])[k],
                   "the same corners");
            expect(compacted.positions[v] == collapse_mesh.position(compacted.vertices[v]),
                   "the same positions");
        }
    }
    for (const Index v : compacted.vertex_map)
        expect(v == no_index || v < compacted.vertices.size(), "vertex map in range");
}

bool same_steps(const BlockSteps& a, const BlockSteps& b) {
    return std::equal(a.steps.begin(), a.steps.end(), b.steps.begin(), b.steps.end(),
                      [](const BlockStep& x, const BlockStep& y) {
                          return x.survivor == y.survivor && x.gone == y.gone && x.to == y.to;
                      }) &&
           a.patch_faces == b.patch_faces && a.patch_begin == b.patch_begin && a.refusals == b.refusals &&
           a.rungs == b.rungs;
}

/// One round of block decimation as in simplify(), with checks.
void reduce_in_blocks(RunState& state, const engine::LoopOptions& loop, std::size_t per_block,
                      std::size_t least, const BlockTracking* tracking) {
    const BlockInput input{state.mesh().positions, state.mesh().triangles, state.locked(), per_block};
    const auto steps = [&](std::uint32_t threads) {
        return simplify_in_blocks(input, loop, least, tracking, Recording::on, threads);
    };
    const BlockSteps found = steps(1);
    for (const std::uint32_t threads : {2u, 3u})
        expect(same_steps(found, steps(threads)), "the same steps with any number of threads");
    CompactedMesh compacted = apply_steps(input, found.steps);
    expect_steps(input, found, compacted);
    expect(found.steps.empty() || compacted.triangles.size() >= least,
           "at least the requested number of faces");
    if (loop.rules.link == LinkCondition::on && is_closed_manifold(input.triangles)) {
        expect(is_closed_manifold(compacted.triangles), "a closed manifold stays one");
        expect(euler(compacted.triangles) == euler(input.triangles), "the same topology");
    }
    state.advance_to(std::move(compacted));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzz::Input in(fuzz::Bytes(data, size));
    // In smaller blocks all vertices would be between blocks.
    const std::size_t per_block = 40u + in.byte() % 160;
    const double share = (1 + in.byte()) / 512.0;
    const std::uint8_t bits = in.byte();
    const TriangleMesh mesh = surface_of(in);
    try {
        const PreprocessedMesh prepared = preprocess(mesh.view(), settings({}));
        std::vector<std::uint8_t> locked(prepared.positions.size(), 0);
        if (bits & 1)
            for (std::uint8_t& l : locked) l = in.byte() < 32;
        RunState state(prepared, locked, bits & 2 ? Boundary::locked : Boundary::free);
        state.track_original();
        const engine::LoopOptions loop = loop_of(in, state);
        const auto least = [&] {
            return static_cast<std::size_t>(share * static_cast<double>(state.mesh().triangles.size()));
        };
        if (!(bits & 4)) reduce_in_blocks(state, loop, per_block, least(), nullptr);
        const BlockTracking tracking{*state.original(), state.vertex_map()};
        reduce_in_blocks(state, loop, per_block, least(), &tracking);
    } catch (const InputError&) {
    }
    return 0;
}
