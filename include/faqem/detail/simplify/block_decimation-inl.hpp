#pragma once

#include "faqem/detail/simplify/block_decimation.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <limits>
#include <utility>

#include "faqem/detail/base/buckets.hpp"
#include "faqem/engine/engine.hpp"
#include "faqem/engine/metric/bordered.hpp"
#include "faqem/engine/metric/memoryless.hpp"
#include "faqem/engine/queue/sweep_queue.hpp"
#include "faqem/engine/tracking/tracked_metric.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

using engine::CollapseMesh;

// Part of the whole surface's share that a block keeps. Of the surplus of collapses the most expensive ones
// are discarded, so that blocks with little detail give more collapses than blocks with much.
inline constexpr double local_share = 0.88;

// Blocks are not used if more than this part of the faces would remain: one engine would then have to process
// most of the surface a second time.
inline constexpr double max_remaining_share = 0.75;

/// The faces by block. A face belongs to every block that contains one of its corners.
inline Buckets<Index> faces_by_block(const BlockInput& input) {
    return Buckets<Index>(input.block_count(), [&](auto&& put) {
        for (Index f = 0; f < input.triangles.size(); ++f) {
            const Triangle& t = input.triangles[f];
            const std::size_t a = input.block_of(t[0]), b = input.block_of(t[1]), c = input.block_of(t[2]);
            put(a, f);
            if (b != a) put(b, f);
            if (c != a && c != b) put(c, f);
        }
    });
}

/// Number of faces with a vertex that is fixed because it has faces in several blocks.
inline std::size_t count_fixed_faces(const BlockInput& input) {
    std::vector<std::uint8_t> is_fixed(input.positions.size(), 0);
    for (const Triangle& t : input.triangles) {
        if (!input.is_between_blocks(t)) continue;
        for (const Index v : t) is_fixed[v] = 1;
    }
    return static_cast<std::size_t>(
        std::count_if(input.triangles.begin(), input.triangles.end(),
                      [&](const Triangle& t) { return is_fixed[t[0]] || is_fixed[t[1]] || is_fixed[t[2]]; }));
}

/// The mesh of one block: its own vertices, followed by vertices of other blocks that its faces refer to.
class Block {
public:
    /// \param block_faces  the faces of block `b`; must outlive this object
    Block(const BlockInput& input, std::size_t b, std::span<const Index> block_faces)
        : faces(block_faces),
          first_(static_cast<Index>(b * input.per_block)),
          own_(static_cast<Index>(std::min(input.per_block, input.positions.size() - first_))) {
        for (const Index f : faces) {
            for (const Index v : input.triangles[f])
                if (!is_own(v)) others_.push_back(v);
        }
        std::sort(others_.begin(), others_.end());
        others_.erase(std::unique(others_.begin(), others_.end()), others_.end());
        positions.reserve(own_ + others_.size());
        locked.reserve(own_ + others_.size());
        triangles.reserve(faces.size());
        for (Index v = 0; v < own_ + others_.size(); ++v) {
            positions.push_back(input.positions[slot(v)]);
            locked.push_back(v >= own_ || input.locked[slot(v)]);
            if (!input.closed.empty()) closed.push_back(input.closed[slot(v)]);
            if (input.borders && !input.borders->at.empty()) borders.push_back(input.borders->at[slot(v)]);
        }
        for (const Index f : faces) {
            const Triangle& t = input.triangles[f];
            triangles.push_back({local(t[0]), local(t[1]), local(t[2])});
            if (!input.is_between_blocks(t)) continue;
            ++between;
            for (const Index v : triangles.back()) locked[v] = 1;
        }
    }

    Index own() const { return own_; }
    /// The vertex slot of the whole surface for a vertex of the block.
    Index slot(Index v) const { return v < own_ ? first_ + v : others_[v - own_]; }

    /// Releases positions and triangles after a CollapseMesh has copied them.
    void forget_surface() {
        std::vector<Vector3>().swap(positions);
        std::vector<Triangle>().swap(triangles);
    }

    std::span<const Index> faces;  ///< face slots of the whole surface
    std::vector<Vector3> positions;
    std::vector<Triangle> triangles;
    std::vector<std::uint8_t> locked, closed;
    std::vector<Index> borders;  ///< as PlanarBorders::at
    std::size_t between = 0;     ///< number of faces with a corner in another block

    /// The vertex of the block for a vertex slot of the whole surface.
    /// \param v  must belong to the block
    Index local(Index v) const {
        if (is_own(v)) return v - first_;
        const auto at = std::lower_bound(others_.begin(), others_.end(), v);
        return own_ + static_cast<Index>(at - others_.begin());
    }

private:
    bool is_own(Index v) const { return v >= first_ && v - first_ < own_; }

    Index first_, own_;
    std::vector<Index> others_;
};

/// The collapses of one block.
struct BlockResult {
    std::vector<BlockStep> steps;
    std::vector<double> costs;           ///< after each step: largest cost so far
    std::vector<std::uint32_t> removed;  ///< after each step: number of removed faces
    std::vector<Index> patch_faces;      ///< face slots of the whole surface
    std::vector<std::size_t> patch_begin;
    engine::LoopResult loop_result;

    /// End of the first `count` steps in patch_faces.
    std::size_t patch_end(std::size_t count) const {
        return count < patch_begin.size() ? patch_begin[count] : patch_faces.size();
    }
};

/// Records the collapses of one block.
class StepRecorder {
public:
    /// \param faces  approximate number of faces that will be removed; most steps remove two
    StepRecorder(const Block& block, Recording patches, std::size_t faces, BlockResult& result)
        : block_(block), patches_(patches), result_(result) {
        const std::size_t steps = faces / 2 + faces / 32;  // growing the arrays would need twice the memory
        result.steps.reserve(steps);
        result.costs.reserve(steps);
        result.removed.reserve(steps);
        if (patches == Recording::off) return;
        result.patch_begin.reserve(steps);
        result.patch_faces.reserve(steps * usual_patch);
    }

    void before_collapse(const CollapseMesh& mesh, Index survivor, Index gone, const engine::Candidate& to) {
        if (result_.steps.empty()) before_ = mesh.face_count();
        end_step(mesh);
        result_.steps.push_back({block_.slot(survivor), block_.slot(gone), to.point});
        result_.costs.push_back(result_.costs.empty() ? to.cost : std::max(result_.costs.back(), to.cost));
        if (patches_ == Recording::off) return;
        result_.patch_begin.push_back(result_.patch_faces.size());
        mesh.for_each_face_around(survivor, gone,
                                  [&](Index f, unsigned) { result_.patch_faces.push_back(block_.faces[f]); });
    }
    void end_step(const CollapseMesh& mesh) {
        if (!result_.steps.empty())
            result_.removed.push_back(static_cast<std::uint32_t>(before_ - mesh.face_count()));
    }
    void before_deletion(Index) {}

private:
    /// Faces around an edge, with a margin.
    static constexpr std::size_t usual_patch = 10;

    const Block& block_;
    Recording patches_;
    BlockResult& result_;
    std::size_t before_ = 0;
};

/// One per original vertex: nonzero if its distance is tracked.
inline std::vector<std::uint8_t> watched_vertices(const BlockTracking& tracking) {
    const bool all = tracking.watched == Watched::borders_and_surface;
    std::vector<std::uint8_t> watched(tracking.vertex_map.size(), all);
    for (const auto& edge : tracking.original.boundary_edges())
        for (const Index v : edge) watched[v] = 1;
    for (Index v = 0; v < watched.size(); ++v) watched[v] &= tracking.vertex_map[v] != no_index;
    return watched;
}

/// The tracked original vertices, by the block of the vertex that they were merged into.
inline Buckets<Index> watched_by_block(const BlockInput& input, const BlockTracking& tracking) {
    const std::vector<std::uint8_t> watched = watched_vertices(tracking);
    return Buckets<Index>(input.block_count(), [&](auto&& put) {
        for (Index v = 0; v < watched.size(); ++v)
            if (watched[v]) put(input.block_of(tracking.vertex_map[v]), v);
    });
}

/// The original vertices of one block as the input of the tracked metric.
inline engine::TrackedVertices tracked_vertices(std::span<const Index> watched,
                                                std::span<const Index> vertex_map, const Block& block) {
    engine::TrackedVertices tracked;
    for (const Index v : watched) tracked.add(v, block.local(vertex_map[v]));
    return tracked;
}

/// Simplifies one block with an engine of its own.
/// \param removed  faces that all blocks have removed, of `removable`
template <class Metric>
BlockResult simplify_block(Block& block, Metric metric, const engine::LoopOptions& loop, double share,
                           Recording patches, std::atomic<std::size_t>& removed, std::size_t removable,
                           const RunContext& context) {
    BlockResult result;
    CollapseMesh mesh(block.positions, block.triangles);
    block.forget_surface();
    engine::PairTable pairs(mesh, {});
    engine::Wedges wedges;
    engine::LoopOptions options = block_options(loop, mesh.face_count(), block.between, share);
    options.first_context_vertex = block.own();
    options.closed = block.closed;
    const std::size_t to_remove = mesh.face_count() - std::min(options.target_faces, mesh.face_count());
    StepRecorder recorder(block, patches, to_remove, result);
    std::size_t known = 0;
    // Other threads than the calling one show it to nobody.
    const auto show = [&](std::size_t removed_here) {
        removed += removed_here - std::exchange(known, removed_here);
        context.show(Phase::simplify, static_cast<double>(removed) / static_cast<double>(removable));
    };
    options.progress = [&](double fraction) {
        show(static_cast<std::size_t>(fraction * static_cast<double>(to_remove)));
        return context.ask();
    };
    engine::Engine<Metric, engine::SweepQueue, StepRecorder> engine(mesh, pairs, wedges, block.locked, metric,
                                                                    recorder);
    result.loop_result = engine.run(options);
    if (result.loop_result.stop == StopReason::cancelled) throw engine::Cancelled{};
    recorder.end_step(mesh);
    show(to_remove);
    return result;
}

/// Selects the steps that are taken: all below a cost, and in each block a fraction of those with exactly that
/// cost.
struct StepSelection {
    double cost = std::numeric_limits<double>::infinity();
    std::uint32_t millionths = 1'000'000;

    std::size_t steps(const BlockResult& block) const {
        const auto [begin, end] = std::equal_range(block.costs.begin(), block.costs.end(), cost);
        const auto below = static_cast<std::uint64_t>(begin - block.costs.begin());
        return below + static_cast<std::uint64_t>(end - begin) * millionths / 1'000'000;
    }

    std::size_t removed(const std::vector<BlockResult>& blocks) const {
        std::size_t sum = 0;
        for (const BlockResult& block : blocks)
            if (const std::size_t n = steps(block)) sum += block.removed[n - 1];
        return sum;
    }
};

/// The largest number in [0, last] for which `holds` is true (bisection).
/// \pre holds(0) is true, and `holds` is monotone
template <class Condition>
std::uint64_t last_true(std::uint64_t last, Condition&& holds) {
    std::uint64_t low = 0;
    while (low < last) {
        const std::uint64_t middle = low + (last - low + 1) / 2;
        if (holds(middle))
            low = middle;
        else
            last = middle - 1;
    }
    return low;
}

/// The largest selection of steps that removes at most `most` faces. Non-negative doubles are ordered as
/// their bits.
inline StepSelection select_steps(const std::vector<BlockResult>& blocks, std::size_t most) {
    const auto infinity = std::bit_cast<std::uint64_t>(std::numeric_limits<double>::infinity());
    const auto keeps = [&](StepSelection tried) { return tried.removed(blocks) <= most; };
    const std::uint64_t bits = last_true(infinity, [&](std::uint64_t b) {
        return keeps({std::bit_cast<double>(b), 0});
    });
    const double cost = std::bit_cast<double>(bits);
    const std::uint64_t millionths = last_true(1'000'000, [&](std::uint64_t m) {
        return keeps({cost, static_cast<std::uint32_t>(m)});
    });
    return {cost, static_cast<std::uint32_t>(millionths)};
}

/// Appends the first `steps` steps of a block, and its counts.
inline void append_steps(const BlockResult& block, std::size_t steps, Recording patches, BlockSteps& to) {
    to.steps.insert(to.steps.end(), block.steps.begin(),
                    block.steps.begin() + static_cast<std::ptrdiff_t>(steps));
    for (std::size_t i = 0; i < refusal_kinds; ++i)
        if (i != static_cast<std::size_t>(Refusal::locked)) to.refusals[i] += block.loop_result.refusals[i];
    for (std::size_t i = 0; i < rung_kinds; ++i) to.rungs[i] += block.loop_result.rungs[i];
    if (patches == Recording::off || steps == 0) return;
    const std::size_t first = to.patch_faces.size();
    const std::size_t end = block.patch_end(steps);
    for (std::size_t i = 0; i < steps; ++i) to.patch_begin.push_back(first + block.patch_begin[i]);
    to.patch_faces.insert(to.patch_faces.end(), block.patch_faces.begin(),
                          block.patch_faces.begin() + static_cast<std::ptrdiff_t>(end));
}

FAQEM_INLINE std::size_t vertices_per_block(std::size_t vertices, std::size_t few) {
    if (vertices <= few) return vertices;
    constexpr std::size_t most = 4 * max_vertices_per_block;
    const std::size_t blocks = 4 * ((vertices + most - 1) / most);
    return (vertices + blocks - 1) / blocks;
}

FAQEM_INLINE engine::LoopOptions block_options(const engine::LoopOptions& loop, std::size_t faces,
                                               std::size_t between, double share) {
    engine::LoopOptions options = loop;
    options.ladder = engine::Ladder::off;
    const auto inside = static_cast<double>(faces - between);
    options.target_faces = between + static_cast<std::size_t>(local_share * share * inside);
    return options;
}

FAQEM_INLINE BlockSteps simplify_in_blocks(const BlockInput& input, const engine::LoopOptions& loop,
                                           std::size_t least, const BlockTracking* tracking,
                                           Recording patches, const RunContext& context) {
    BlockSteps result;
    if (input.positions.size() <= 2 * input.per_block) return result;
    const std::size_t faces = input.triangles.size();
    const double fixed_share = static_cast<double>(count_fixed_faces(input)) / static_cast<double>(faces);
    const double share = spare_share * static_cast<double>(least) / static_cast<double>(faces);
    const double remaining_share = fixed_share + (1 - fixed_share) * share;
    if (!(remaining_share < max_remaining_share)) return result;
    const auto removable = static_cast<std::size_t>((1 - remaining_share) * static_cast<double>(faces));
    const Buckets<Index> block_faces = faces_by_block(input);
    const Buckets<Index> watched = tracking ? watched_by_block(input, *tracking) : Buckets<Index>();
    std::vector<BlockResult> results(input.block_count());
    std::atomic<std::size_t> removed{0};
    const RunContext untimed = context.untimed();
    try {
        parallel_blocks(
            results.size(), 1, untimed, [&](std::size_t b, std::size_t, const RunContext& block_context) {
                if (context.is_late()) return;
                Block block(input, b, block_faces[b]);
                const auto simplify = [&](auto metric) {
                    std::span<const engine::Flat> flats;
                    if (input.borders) flats = input.borders->flats;
                    return simplify_block(
                        block,
                        engine::BorderedMetric(std::move(metric), flats, block.borders, loop.distance_weight),
                        loop, share, patches, removed, removable, block_context);
                };
                if (!tracking) {
                    results[b] = simplify(engine::MemorylessMetric());
                    return;
                }
                const std::size_t begin_at =
                    tracking->watched == Watched::borders ? 0 : block.triangles.size();
                results[b] = simplify(engine::TrackedMetric(
                    {}, tracking->original, tracked_vertices(watched[b], tracking->vertex_map, block),
                    begin_at, loop.distance_weight));
            });
    } catch (const engine::Cancelled&) {
        result.is_cancelled = true;
        return result;
    }
    const StepSelection selected = select_steps(results, removable);
    std::size_t steps = 0, patch_faces = 0;
    for (const BlockResult& block : results) {
        steps += selected.steps(block);
        if (patches == Recording::on) patch_faces += block.patch_end(selected.steps(block));
    }
    result.steps.reserve(steps);
    result.collapses = steps;
    if (patches == Recording::on) result.patch_begin.reserve(steps);
    result.patch_faces.reserve(patch_faces);
    for (BlockResult& block : results) {
        append_steps(block, selected.steps(block), patches, result);
        block = {};
    }
    return result;
}

FAQEM_INLINE CompactedMesh apply_steps(const BlockInput& input, std::span<const BlockStep> steps) {
    SlotTrace trace(input.positions.size());
    std::vector<Vector3> positions(input.positions.begin(), input.positions.end());
    for (const auto& [survivor, gone, to] : steps) {
        trace.before_collapse(survivor, gone, positions[survivor], positions[gone], to);
        positions[survivor] = to;
    }
    std::vector<Index> faces;
    std::vector<Triangle> triangles;
    for (Index f = 0; f < input.triangles.size(); ++f) {
        const Triangle& t = input.triangles[f];
        const Triangle now = {trace.root(t[0]), trace.root(t[1]), trace.root(t[2])};
        if (now[0] == now[1] || now[1] == now[2] || now[2] == now[0]) continue;
        faces.push_back(f);
        triangles.push_back(now);
    }
    return compacted(std::move(faces), std::move(triangles), positions, trace);
}

}  // namespace detail
FAQEM_NAMESPACE_END
