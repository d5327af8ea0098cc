// The engine's templates with a metric of the user's own: the shortest edge goes first, to its midpoint.
#include <faqem/engine/engine.hpp>

struct ShortestEdge {
    void initialise(const faqem::engine::Complex&, const faqem::engine::PairTable&) {}
    std::optional<faqem::engine::Candidate> evaluate(const faqem::engine::Complex& complex,
                                                     const faqem::engine::PairTable& pairs,
                                                     faqem::Index pair,
                                                     faqem::engine::Freedom freedom) const {
        if (freedom != faqem::engine::Freedom::anywhere) return std::nullopt;
        const auto& a = complex.position(pairs.first(pair));
        const auto& b = complex.position(pairs.second(pair));
        return faqem::engine::Candidate{0.5 * (a + b), (a - b).norm()};
    }
    void collapsing(const faqem::engine::Complex&, const faqem::engine::PairTable&, faqem::Index,
                    faqem::Index, const faqem::engine::Vector3&) {}
    void collapsed(const faqem::engine::Complex&, const faqem::engine::PairTable&, faqem::Index,
                   std::span<const faqem::engine::PairTable::Change>) {}
    faqem::engine::Staleness staleness(const faqem::engine::PairTable::Change&) const {
        return faqem::engine::Staleness::now;
    }
};

int main() {
    using namespace faqem::engine;
    // An octahedron becomes a tetrahedron.
    Complex complex({{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
                    {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}});
    PairTable pairs(complex, {});
    Wedges wedges;
    std::vector<std::uint8_t> locked(6, 0);
    ShortestEdge metric;
    NoRecorder recorder;
    Engine<ShortestEdge, HeapQueue, NoRecorder> engine(complex, pairs, wedges, locked, metric, recorder);
    const LoopResult result = engine.run({});
    return result.stop == faqem::StopReason::reached_target && complex.face_count() == 4 ? 0 : 1;
}
