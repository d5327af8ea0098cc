#pragma once
/// \file
/// The surface on its way through the engines, in slots.

#include <cstdint>
#include <numeric>
#include <optional>
#include <vector>

#include "faqem/export.hpp"
#include "faqem/detail/simplify/spatial_order.hpp"
#include "faqem/detail/simplify/block_decimation.hpp"
#include "faqem/engine/tracking/reference_surface.hpp"
#include "faqem/detail/fitting/closest_point_tracker.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

/// What the next engine begins with, and whose it was.
class Ground {
public:
    Ground() = default;
    /// \param locked  one per vertex of the prepared mesh
    /// \throws what the poll throws
    Ground(const Prepared& prepared, const std::vector<std::uint8_t>& locked, Border border,
           engine::Poll poll = {});

    /// Keeps what is there now, for whole(). To be called before the first step. O(1)
    void keep_whole() { keeps_whole_ = true; }
    /// Lets engines watch the distance to what is there now, and keeps it. To be called before the first step.
    /// \throws what the poll throws.
    /// O(faces)
    void remember_original(engine::Poll poll = {}) {
        keep_whole();
        original_.emplace(now_.positions, now_.triangles, poll);
        into_.resize(now_.positions.size());
        std::iota(into_.begin(), into_.end(), Index{0});
    }

    /// Goes on with what is left after some steps.
    void take(Reduced&& reduced);

    const Arranged& now() const { return now_; }
    const std::vector<std::uint8_t>& locked() const { return locked_; }
    /// Of each slot: the vertex of the prepared mesh whose place it has, or no_index.
    const std::vector<Index>& places() const { return places_; }
    /// As places(), of what has the places of these slots now; no_index stays.
    std::vector<Index> places_of(const std::vector<Index>& slots) const;
    /// The slot that each vertex of the original has gone into, or no_index. Empty if it is not remembered.
    const std::vector<Index>& into() const { return into_; }
    /// Null if it is not remembered.
    const engine::Original* original() const { return original_ ? &*original_ : nullptr; }
    /// The surface before the first step. \pre it is kept
    Patchwork whole() const;
    /// Area of what is there now. O(faces)
    double area() const;

private:
    Arranged now_;
    // As it was, where there is less now. The original has borrowed it.
    std::vector<engine::Vector3> whole_positions_;
    std::vector<Triangle> whole_triangles_;
    bool keeps_whole_ = false;
    std::optional<engine::Original> original_;
    std::vector<Index> into_, places_;
    std::vector<std::uint8_t> locked_;
};

}  // namespace detail
FAQEM_NAMESPACE_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/simplify/run_state-inl.hpp"
#endif
