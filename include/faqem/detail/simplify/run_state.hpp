#pragma once
/// \file
/// The surface on its way through the engines, in slots.

#include <cstdint>
#include <numeric>
#include <optional>
#include <vector>

#include "faqem/detail/fitting/closest_point_tracker.hpp"
#include "faqem/detail/simplify/block_decimation.hpp"
#include "faqem/detail/simplify/spatial_order.hpp"
#include "faqem/engine/tracking/original_surface.hpp"
#include "faqem/export.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

/// What the next engine begins with, and whose it was.
class RunState {
public:
    RunState() = default;
    /// \param locked  one per vertex of the prepared mesh
    /// \throws what the poll throws
    RunState(const PreprocessedMesh& prepared, const std::vector<std::uint8_t>& locked, Boundary boundary,
             engine::CancellationCheck check_cancelled = {});

    /// Keeps what is there now, for initial_surface(). To be called before the first step. O(1)
    void keep_initial_surface() { keeps_initial_surface_ = true; }
    /// Lets engines watch the distance to what is there now, and keeps it. To be called before the first step.
    /// \throws what the poll throws.
    /// O(faces)
    void track_original(engine::CancellationCheck check_cancelled = {}) {
        keep_initial_surface();
        original_.emplace(mesh_.positions, mesh_.triangles, check_cancelled);
        vertex_map_.resize(mesh_.positions.size());
        std::iota(vertex_map_.begin(), vertex_map_.end(), Index{0});
    }

    /// Goes on with what is left after some steps.
    void advance_to(CompactedMesh&& compacted);

    const ReorderedMesh& mesh() const { return mesh_; }
    const std::vector<std::uint8_t>& locked() const { return locked_; }
    /// Of each slot: the vertex of the prepared mesh whose place it has, or no_index.
    const std::vector<Index>& source_vertices() const { return source_vertices_; }
    /// As source_vertices(), of what has the places of these slots now; no_index stays.
    std::vector<Index> source_vertices_of(const std::vector<Index>& slots) const;
    /// The slot that each vertex of the original has gone into, or no_index. Empty if it is not remembered.
    const std::vector<Index>& vertex_map() const { return vertex_map_; }
    /// Null if it is not remembered.
    const engine::OriginalSurface* original() const { return original_ ? &*original_ : nullptr; }
    /// The surface before the first step. \pre it is kept
    MeshRef initial_surface() const;
    /// Area of what is there now. O(faces)
    double area() const;

private:
    ReorderedMesh mesh_;
    // As it was, where there is less now. The original has borrowed it.
    std::vector<engine::Vector3> initial_positions_;
    std::vector<Triangle> initial_triangles_;
    bool keeps_initial_surface_ = false;
    std::optional<engine::OriginalSurface> original_;
    std::vector<Index> vertex_map_, source_vertices_;
    std::vector<std::uint8_t> locked_;
};

}  // namespace detail
FAQEM_NAMESPACE_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/simplify/run_state-inl.hpp"
#endif
