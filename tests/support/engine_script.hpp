#pragma once
// Metrics with given costs and positions, and runs of the engine with them.

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "faqem/engine/engine.hpp"
#include "support/meshes.hpp"

namespace faqem::test {

using namespace engine;

inline std::uint64_t taken(const LoopResult& result, Rung rung) {
    return result.rungs[static_cast<std::size_t>(rung)];
}
inline std::uint64_t refused(const LoopResult& result, Refusal why) {
    return result.refusals[static_cast<std::size_t>(why)];
}

// A metric with a given position for each pair of original vertices. Costs are in the order of the pairs;
// pairs without an entry are not collapsed.
struct Script : MetricDefaults {
    Script() = default;
    explicit Script(std::map<Ends, Vector3> o) : offers(std::move(o)) {}

    std::map<Ends, Vector3> offers;

    std::optional<Candidate> evaluate(const CollapseMesh& collapse_mesh, const PairTable& pairs, Index pair,
                                      AllowedPosition allowed_position) const {
        const Index u = pairs.first(pair), v = pairs.second(pair);
        const auto at = offers.find(ends(u, v));
        if (at == offers.end() || allowed_position == AllowedPosition::nowhere) return std::nullopt;
        const auto order = static_cast<double>(std::distance(offers.begin(), at));
        if (allowed_position == AllowedPosition::at_first) return Candidate{collapse_mesh.position(u), order};
        if (allowed_position == AllowedPosition::at_second)
            return Candidate{collapse_mesh.position(v), order};
        return Candidate{at->second, order};
    }
    Reevaluation reevaluation(const PairTable::Change&) const { return Reevaluation::none; }
};

// The engine with a mesh, and all data that a run changes.
template <class Metric>
struct Play {
    Play(const TriangleMesh& mesh, Metric m, const std::vector<Ends>& extra = {})
        : collapse_mesh(collapse_mesh_of(mesh)),
          pairs(collapse_mesh, extra),
          locked(mesh.positions.size(), 0),
          metric(std::move(m)),
          recorder(collapse_mesh) {}

    const LoopResult& run(std::size_t target, const Rules& rules, double tiny = 0,
                          double distance_weight = 0) {
        LoopOptions options;
        options.target_faces = target;
        options.rules = rules;
        options.tiny_component_diagonal = tiny;
        options.distance_weight = distance_weight;
        Engine<Metric, HeapQueue, HistoryRecorder> engine(collapse_mesh, pairs, wedges, locked, metric,
                                                          recorder);
        return result = engine.run(options);
    }

    CollapseMesh collapse_mesh;
    PairTable pairs;
    Wedges wedges;
    std::vector<std::uint8_t> locked;
    Metric metric;
    HistoryRecorder recorder;
    LoopResult result;
};

// Vertices 2 and 3 of hinge() are collapsed; the new position rotates triangle 0 1 2 about the x axis.
inline Script turn_hinge(double degrees) {
    const double a = degrees * pi / 180;
    return Script({{{2, 3}, {1, std::cos(a), std::sin(a)}}});
}

}  // namespace faqem::test
