// Uses the engine templates with a custom metric: the shortest edge is collapsed first, to its midpoint.
#include <faqem/engine/engine.hpp>

struct ShortestEdge : faqem::engine::MetricDefaults {
    std::optional<faqem::engine::Candidate> evaluate(const faqem::engine::CollapseMesh& mesh,
                                                     const faqem::engine::PairTable& pairs, faqem::Index pair,
                                                     faqem::engine::AllowedPosition allowed_position) const {
        if (allowed_position != faqem::engine::AllowedPosition::anywhere) return std::nullopt;
        const auto& a = mesh.position(pairs.first(pair));
        const auto& b = mesh.position(pairs.second(pair));
        return faqem::engine::Candidate{0.5 * (a + b), (a - b).norm()};
    }
    faqem::engine::Reevaluation reevaluation(const faqem::engine::PairTable::Change&) const {
        return faqem::engine::Reevaluation::immediate;
    }
};

int main() {
    using namespace faqem::engine;
    // An octahedron becomes a tetrahedron.
    CollapseMesh mesh(
        {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
        {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}});
    PairTable pairs(mesh, {});
    Wedges wedges;
    std::vector<std::uint8_t> locked(6, 0);
    ShortestEdge metric;
    NoRecorder recorder;
    Engine<ShortestEdge, HeapQueue, NoRecorder> engine(mesh, pairs, wedges, locked, metric, recorder);
    const LoopResult result = engine.run({});
    return result.stop == faqem::StopReason::reached_target && mesh.face_count() == 4 ? 0 : 1;
}
