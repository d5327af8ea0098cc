// Rounds as in simplify(), without and with distance tracking, on surfaces that are smaller than those for which
// simplify() uses them.

#include <map>
#include <utility>

#include "faqem/detail/rounds/rounds.hpp"
#include "faqem/detail/simplify/presets.hpp"
#include "faqem/detail/simplify/run_state.hpp"
#include "faqem/options.hpp"
#include "fuzz/fuzz.hpp"
#include "support/applied_steps.hpp"

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
void expect_steps(const RoundInput& input, const RoundSteps& found, const CompactedMesh& left) {
    CollapseMesh collapse_mesh(input.positions, input.triangles);
    expect(found.patch_begin.size() == found.steps.size(), "a patch for every step");
    for (std::size_t i = 0; i < found.steps.size(); ++i) {
        const auto& [survivor, gone, to] = found.steps[i];
        expect(survivor < input.positions.size() && gone < input.positions.size(), "slots in range");
        expect(collapse_mesh.degree(survivor) > 0 && collapse_mesh.degree(gone) > 0,
               "vertices that have not been removed");
        expect(!input.locked[survivor] && !input.locked[gone], "locked vertices stay");
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
    expect(left.triangles.size() == collapse_mesh.face_count(), "the same number of faces");
    expect(left.positions.size() == left.vertices.size() &&
               left.source_slots.size() == left.vertices.size() &&
               left.vertex_map.size() == input.positions.size() && left.faces.size() == left.triangles.size(),
           "arrays of matching sizes");
    for (std::size_t f = 0; f < left.faces.size(); ++f) {
        expect(collapse_mesh.is_alive(left.faces[f]), "faces that have not been removed");
        for (std::size_t k = 0; k < 3; ++k) {
            const Index v = left.triangles[f][k];
            expect(v < left.vertices.size(), "vertices in range");
            expect(left.vertices[v] == collapse_mesh.triangle(left.faces[f])[k], "the same corners");
            expect(left.positions[v] == collapse_mesh.position(left.vertices[v]), "the same positions");
        }
    }
    for (const Index v : left.vertex_map)
        expect(v == no_index || v < left.vertices.size(), "vertex map in range");
}

/// Rounds on one thread and on more, with checks.
void reduce_in_rounds(RunState& state, std::size_t least, const RoundTracking* tracking) {
    const auto reduce = [&](std::uint32_t threads, auto&& check) {
        std::vector<engine::Vector3> positions = state.mesh().positions;
        std::vector<Triangle> triangles = state.mesh().triangles;
        std::vector<Links> links;
        RoundSteps found;
        std::optional<CompactedMesh> left = simplify_in_rounds(
            {positions, triangles, links, state.locked(), {}, nullptr, Recording::on, tracking}, least,
            Recording::on, threads, found);
        if (left) check(found, *left);
        return left;
    };
    RoundSteps one;
    std::optional<CompactedMesh> left = reduce(1, [&](RoundSteps& found, const CompactedMesh& found_left) {
        one = std::move(found);
        std::vector<engine::Vector3> positions = state.mesh().positions;
        std::vector<Triangle> triangles = state.mesh().triangles;
        std::vector<Links> links;
        expect_steps({positions, triangles, links, state.locked()}, one, found_left);
    });
    if (!left) return;
    for (const std::uint32_t threads : {2u, 3u}) {
        reduce(threads, [&](const RoundSteps& found, const CompactedMesh& found_left) {
            expect(test::same_steps(one, found) && one.refusals == found.refusals &&
                       left->bound_faces == found_left.bound_faces,
                   "the same steps with any number of threads");
        });
    }
    expect(left->triangles.size() >= least, "at least the requested number of faces");
    for (const Index f : left->bound_faces)
        expect(f == no_index || f < left->triangles.size(), "faces in range");
    if (is_closed_manifold(state.mesh().triangles)) {
        expect(is_closed_manifold(left->triangles), "a closed manifold stays one");
        expect(euler(left->triangles) == euler(state.mesh().triangles), "the same topology");
    }
    state.advance_to(std::move(*left));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzz::Input in(fuzz::Bytes(data, size));
    const double share = (1 + in.byte()) / 512.0;
    const double weight = in.byte() / 16.0;
    const std::uint8_t bits = in.byte();
    const TriangleMesh mesh = surface_of(in);
    try {
        const PreprocessedMesh prepared = preprocess(mesh.view(), settings({}));
        std::vector<std::uint8_t> locked(prepared.positions.size(), 0);
        if (bits & 1)
            for (std::uint8_t& l : locked) l = in.byte() < 32;
        RunState state(prepared, locked, bits & 2 ? Boundary::locked : Boundary::free);
        state.track_original();
        const auto least = [&](double of) {
            return static_cast<std::size_t>(of * static_cast<double>(state.mesh().triangles.size()));
        };
        if (!(bits & 4)) reduce_in_rounds(state, least(std::sqrt(share)), nullptr);
        const RoundTracking tracking{state.original(), state.vertex_map(), least(bits & 8 ? 1 : 0.5), weight};
        reduce_in_rounds(state, least(share), &tracking);
    } catch (const InputError&) {
    }
    return 0;
}
