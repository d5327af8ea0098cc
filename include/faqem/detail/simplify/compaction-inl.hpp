#pragma once

#include "faqem/export.hpp"
#include "faqem/detail/simplify/compaction.hpp"

#include <numeric>
#include <utility>

FAQEM_NAMESPACE_BEGIN
namespace detail {

using engine::Vector3;

FAQEM_INLINE SlotTrace::SlotTrace(std::size_t slots) : next_(slots) {
    std::iota(next_.begin(), next_.end(), Index{0});
    places_ = next_;
}

FAQEM_INLINE Index SlotTrace::root(Index slot) {
    Index end = slot;
    while (next_[end] != end) end = next_[end];
    while (next_[slot] != end) slot = std::exchange(next_[slot], end);
    return end;
}

FAQEM_INLINE Reduced reduced(std::vector<Index> faces, std::vector<Triangle> triangles, std::span<const Vector3> positions,
                SlotTrace& trace, engine::Poll poll) {
    Reduced out;
    out.faces = std::move(faces);
    out.triangles = std::move(triangles);
    std::vector<Index> number(positions.size(), no_index);
    for (const Triangle& t : out.triangles) {
        poll();
        for (const Index v : t) number[v] = 0;
    }
    for (Index v = 0; v < number.size(); ++v) {
        poll();
        if (number[v] == no_index) continue;
        number[v] = static_cast<Index>(out.vertices.size());
        out.vertices.push_back(v);
        out.places.push_back(trace.places()[v]);
        out.positions.push_back(positions[v]);
    }
    for (Triangle& t : out.triangles) {
        for (Index& v : t) v = number[v];
    }
    out.into.reserve(number.size());
    for (Index v = 0; v < number.size(); ++v) {
        poll();
        out.into.push_back(number[trace.root(v)]);
    }
    return out;
}

FAQEM_INLINE Reduced reduced(const engine::Complex& complex, SlotTrace& trace, engine::Poll poll) {
    std::vector<Index> faces;
    std::vector<Triangle> triangles;
    for (Index f = 0; f < complex.face_slots(); ++f) {
        poll();
        if (!complex.alive(f)) continue;
        faces.push_back(f);
        triangles.push_back(complex.triangle(f));
    }
    std::vector<Vector3> positions;
    positions.reserve(complex.vertex_slots());
    for (Index v = 0; v < complex.vertex_slots(); ++v) positions.push_back(complex.position(v));
    return reduced(std::move(faces), std::move(triangles), positions, trace, poll);
}

}  // namespace detail
FAQEM_NAMESPACE_END
