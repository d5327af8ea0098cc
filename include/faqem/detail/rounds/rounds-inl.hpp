#pragma once

#include "faqem/detail/rounds/rounds.hpp"

#include <cmath>

#include "faqem/detail/base/buckets.hpp"
#include "faqem/detail/rounds/cell.hpp"
#include "faqem/detail/rounds/round_mesh.hpp"
#include "faqem/detail/rounds/tracking.hpp"

FAQEM_DETAIL_BEGIN
namespace rounds {

inline constexpr double vertices_per_cell = 4096;

// Rounds keep this many faces for each vertex that they cannot move, since its neighbourhood stays dense.
inline constexpr std::size_t faces_per_unfit = 8;

// Rounds that gain little end the work; so does their number.
inline constexpr std::uint64_t most_rounds = 40;
inline constexpr unsigned most_idle_rounds = 3;

/// The cost below which about `edges` edges lie.
inline float threshold(const Mesh& mesh, std::size_t edges) {
    const std::size_t size = mesh.keys.size(), step = (size / 65536) | 1;
    std::vector<float> sample;
    for (std::size_t i = 0; i < size; i += step)
        if (mesh.keys[i] < never) sample.push_back(mesh.keys[i]);
    if (sample.empty()) return 0;
    const auto at = sample.begin() + static_cast<std::ptrdiff_t>(std::min(edges / step, sample.size() - 1));
    std::nth_element(sample.begin(), at, sample.end());
    return *at;
}

/// Assigns cells to all vertices. \return their number
inline std::size_t assign_cells(Mesh& mesh, double area, std::uint64_t round, const RunContext& context) {
    const double share = vertices_per_cell / (0.5 * static_cast<double>(mesh.alive));
    const double side = std::clamp(std::sqrt(area * share), 1.0 / 64, 2.0);
    std::array<double, 3> shift;
    std::uint64_t random = round * 0x9e3779b97f4a7c15ull;
    for (double& s : shift) {
        random = random * 6364136223846793005ull + 1442695040888963407ull;
        s = static_cast<double>(random >> 11) * 0x1p-53;
    }
    // The diagonal is 1 and the centre 0; new vertices may be a little outside.
    const double per_side = 1 / side;
    const auto cells = static_cast<std::uint32_t>(1.25 * per_side) + 2;
    parallel_each(mesh.vertices.size(), elements_per_block, context, [&](std::size_t v) {
        std::uint32_t cell = 0;
        for (unsigned k = 0; k < 3; ++k) {
            const double at = (mesh.vertices[v].p[k] + 0.625) * per_side + shift[k];
            const auto most = static_cast<double>(cells - 1);
            cell = cell * cells + static_cast<std::uint32_t>(std::clamp(at, 0.0, most));
        }
        mesh.vertices[v].cell = cell;
    });
    return std::size_t{cells} * cells * cells;
}

/// The edges with a cost of at most `limit` and both ends in a cell, by cell.
inline Buckets<Corner> candidates(const Mesh& mesh, std::size_t cells, float limit,
                                  const RunContext& context) {
    struct Found {
        std::uint32_t cell;
        Corner corner;
    };
    std::vector<std::vector<Found>> found((mesh.faces.size() + elements_per_block - 1) / elements_per_block);
    parallel_blocks(mesh.faces.size(), elements_per_block, context, [&](std::size_t first, std::size_t end) {
        const auto keys = std::span(mesh.keys).subspan(3 * first, 3 * (end - first));
        std::vector<Found>& here = found[first / elements_per_block];
        here.reserve(static_cast<std::size_t>(
            std::count_if(keys.begin(), keys.end(), [&](float key) { return key <= limit; })));
        for (std::size_t i = 0; i < keys.size(); ++i) {
            if (!(keys[i] <= limit)) continue;
            const std::size_t face = first + i / 3;
            const auto k = static_cast<unsigned>(i % 3);
            const Face& f = mesh.faces[face];
            const std::uint32_t cell = mesh.vertices[f.v[next(k)]].cell;
            if (cell == mesh.vertices[f.v[previous(k)]].cell)
                here.push_back({cell, static_cast<Corner>(4 * face + k)});
        }
    });
    return Buckets<Corner>(cells, [&](auto&& put) {
        for (const auto& some : found) {
            for (const Found& f : some) put(f.cell, f.corner);
        }
    });
}

inline void append(const RoundSteps& from, RoundSteps& to) {
    to.collapses += from.collapses;
    to.steps.insert(to.steps.end(), from.steps.begin(), from.steps.end());
    for (std::size_t i = 0; i < refusal_kinds; ++i) to.refusals[i] += from.refusals[i];
    for (const std::size_t at : from.patch_begin) to.patch_begin.push_back(at + to.patch_faces.size());
    to.patch_faces.insert(to.patch_faces.end(), from.patch_faces.begin(), from.patch_faces.end());
}

}  // namespace rounds

FAQEM_INLINE std::optional<CompactedMesh> simplify_in_rounds(const RoundInput& input, std::size_t least,
                                                             Recording patches, const RunContext& context,
                                                             RoundSteps& result) {
    using namespace rounds;
    const std::size_t slots = input.positions.size(), faces = input.triangles.size();
    const std::size_t most_left = faces - faces / 4;
    if (least >= most_left) return {};  // also without faces
    const RunContext untimed = context.untimed();
    std::optional<Mesh> made = load(input, most_left / faces_per_unfit, untimed);
    if (!made) return {};
    Mesh& mesh = *made;
    least = std::max(least, faces_per_unfit * mesh.unfit);
    if (input.merges == Recording::on) mesh.merged_into.assign(slots, no_index);
    if (patches == Recording::on) result.steps.reserve((faces - least) / 2);
    const auto reduce = [&](std::size_t to) {
        unsigned idle = 0;
        for (std::uint64_t round = 1; round <= most_rounds && idle < most_idle_rounds; ++round) {
            const std::size_t need = mesh.alive - std::min(mesh.alive, to);
            if (need < to / 64 || context.is_late()) break;
            if (2 * mesh.alive < mesh.faces.size()) compact(mesh, untimed);
            const float limit = threshold(mesh, need);
            const std::size_t cells = assign_cells(mesh, mesh.area, round, untimed);
            const Buckets<Corner> sorted = candidates(mesh, cells, limit, untimed);
            std::vector<std::uint32_t> used;
            for (std::uint32_t cell = 0; cell < cells; ++cell)
                if (!sorted[cell].empty()) used.push_back(cell);
            if (used.empty()) break;
            std::vector<RoundSteps> steps(used.size());
            const double quota = 0.5 * static_cast<double>(need) / static_cast<double>(sorted.items().size());
            context.show(Phase::simplify,
                         static_cast<double>(faces - mesh.alive) / static_cast<double>(faces - least));
            parallel_blocks(used.size(), 1, untimed, [&](std::size_t i, std::size_t) {
                if (context.is_late()) return;
                const std::span<const Corner> edges = sorted[used[i]];
                const auto most = static_cast<std::size_t>(quota * static_cast<double>(edges.size()));
                engine::vectorised(
                    [&] { CellCollapser(mesh, used[i], limit, patches, steps[i]).run(edges, most); });
            });
            const std::size_t before = mesh.alive;
            for (RoundSteps& cell : steps) {
                mesh.alive -= 2 * cell.collapses;
                append(cell, result);
            }
            idle = 16 * (before - mesh.alive) < need ? idle + 1 : 0;
        }
    };
    const std::size_t start = input.tracking ? input.tracking->start : 0;
    reduce(std::max(least, start));
    // Where much of the surface cannot move, so many faces are left that the engine begins without tracking, too.
    if (start > 0 && mesh.alive <= start + start / 4) {
        compact(mesh, untimed);
        bind_all(mesh, *input.tracking, slots, untimed);
        reduce(least);
    }
    compact(mesh, untimed);
    release(mesh.keys);
    CompactedMesh left = surface_of(mesh, slots);
    if (mesh.alive <= start) left.bound_faces = bound_faces(mesh);
    return left;
}

FAQEM_DETAIL_END
