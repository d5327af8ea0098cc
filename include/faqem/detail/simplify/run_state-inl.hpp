#pragma once

#include "faqem/export.hpp"
#include "faqem/detail/simplify/run_state.hpp"

#include <cassert>
#include <utility>

FAQEM_NAMESPACE_BEGIN
namespace detail {

// Of some slots; no_index where there is none.
template <class T>
std::vector<T> taken(const std::vector<T>& of, const std::vector<Index>& slots) {
    std::vector<T> result;
    result.reserve(slots.size());
    for (const Index slot : slots) result.push_back(slot == no_index ? static_cast<T>(no_index) : of[slot]);
    return result;
}

FAQEM_INLINE Ground::Ground(const Prepared& prepared, const std::vector<std::uint8_t>& locked, Border border,
               engine::Poll poll)
    : now_(arrange(prepared, poll)), places_(now_.vertex), locked_(taken(locked, now_.vertex)) {
    if (border != Border::locked) return;
    for (const auto& [a, b] : engine::find_open_edges(now_.triangles, now_.positions.size(), poll))
        locked_[a] = locked_[b] = 1;
}

FAQEM_INLINE void Ground::take(Reduced&& reduced) {
    places_ = taken(places_, reduced.places);
    into_ = taken(reduced.into, into_);
    locked_ = taken(locked_, reduced.vertices);
    Arranged less{taken(now_.vertex, reduced.vertices), taken(now_.face, reduced.faces),
                  std::move(reduced.positions), std::move(reduced.triangles)};
    std::swap(now_, less);
    if (!keeps_whole_ || !whole_positions_.empty()) return;
    whole_positions_ = std::move(less.positions);
    whole_triangles_ = std::move(less.triangles);
}

FAQEM_INLINE std::vector<Index> Ground::places_of(const std::vector<Index>& slots) const { return taken(places_, slots); }

FAQEM_INLINE Patchwork Ground::whole() const {
    assert(keeps_whole_);
    if (whole_positions_.empty()) return {now_.positions, now_.triangles};
    return {whole_positions_, whole_triangles_};
}

FAQEM_INLINE double Ground::area() const {
    double sum = 0;
    for (const Triangle& t : now_.triangles)
        sum += 0.5 *
               engine::area_vector(now_.positions[t[0]], now_.positions[t[1]], now_.positions[t[2]]).norm();
    return sum;
}

}  // namespace detail
FAQEM_NAMESPACE_END
