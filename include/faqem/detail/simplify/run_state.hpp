#pragma once
/// \file
/// The intermediate surface of a run, which is passed from one engine to the next.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "faqem/detail/fitting/closest_point_tracker.hpp"
#include "faqem/detail/rounds/links.hpp"
#include "faqem/detail/rounds/rounds.hpp"
#include "faqem/detail/simplify/compaction.hpp"
#include "faqem/detail/simplify/spatial_order.hpp"
#include "faqem/engine/constraints/planar_borders.hpp"
#include "faqem/engine/tracking/original_surface.hpp"
#include "faqem/export.hpp"

FAQEM_DETAIL_BEGIN

/// The surface that the next engine starts from, and its relation to the preprocessed mesh. Vertices and
/// faces are numbered by slots, which change with every advance_to(). Positions are in engine units.
class RunState {
public:
    RunState() = default;
    /// Reorders the preprocessed mesh.
    /// \param prepared  read only during the call
    /// \param locked    one per vertex of `prepared`; nonzero: must not move
    /// \param boundary  locked: the vertices of boundary edges are locked, too
    /// Complexity: O(n log n)
    /// \param context   its threads are used
    RunState(const PreprocessedMesh& prepared, const std::vector<std::uint8_t>& locked, Boundary boundary,
             const engine::RunContext& context = {});

    /// Retains the current surface for initial_surface(). \pre advance_to() has not been called. O(1)
    void keep_initial_surface() { keeps_initial_surface_ = true; }
    /// Makes original() and vertex_map() available, so that engines can track the distance to the current
    /// surface. Includes keep_initial_surface().
    /// \pre advance_to() has not been called
    /// Complexity: O(faces)
    void track_original() {
        keep_initial_surface();
        original_.emplace(mesh_.positions, mesh_.triangles);
        vertex_map_ = engine::all_indices(mesh_.positions.size());
    }

    /// Sets borders(). \pre advance_to() has not been called. O(faces)
    void find_planar_borders();

    /// Simplifies the current surface in rounds, to a twentieth more faces than the target if the distance from the original is
    /// tracked, else a quarter. Further parameters and the result are those of detail::simplify_in_rounds(); none below
    /// min_vertices_of_rounds.
    /// \param distance_weight  see RoundTracking
    /// \post advance_to() follows if there is a result, since the arrays of the current surface may be released
    std::optional<CompactedMesh> simplify_in_rounds(std::size_t target, double distance_weight,
                                                    std::span<const Index> groups, Recording patches,
                                                    const engine::RunContext& context, RoundSteps& found);

    /// Replaces the current surface by a simplified one.
    /// \param compacted  made from mesh(); moved from
    /// Complexity: O(n)
    void advance_to(CompactedMesh&& compacted);

    const ReorderedMesh& mesh() const { return mesh_; }
    /// Releases what only simplify_in_rounds() uses, before the first advance_to(). O(1)
    void release_links() { links_ = {}; }
    /// One per vertex slot; nonzero: must not move.
    const std::vector<std::uint8_t>& locked() const { return locked_; }
    /// One per vertex slot; nonzero: in a closed component of the preprocessed mesh.
    const std::vector<std::uint8_t>& closed() const { return closed_; }
    /// The planar parts of the border, by vertex slot; empty unless find_planar_borders() was called.
    const engine::PlanarBorders& borders() const { return borders_; }
    /// One per vertex slot: the vertex of the preprocessed mesh that has exactly the same position, or
    /// no_index.
    const std::vector<Index>& source_vertices() const {
        return source_vertices_.empty() ? mesh_.vertex : source_vertices_;
    }
    /// The entries of source_vertices() for the given slots; no_index stays no_index. O(slots)
    std::vector<Index> source_vertices_of(const std::vector<Index>& slots) const;
    /// One per vertex of original(): the slot that it was merged into, or no_index if that vertex was
    /// removed. Empty unless track_original() was called.
    const std::vector<Index>& vertex_map() const { return vertex_map_; }
    /// All vertices of original() for an engine that tracks them. \pre track_original() was called
    engine::TrackedVertices tracked_vertices() {
        engine::TrackedVertices tracked(vertex_map_);
        tracked.faces = std::move(bound_faces_);
        return tracked;
    }
    /// The surface whose distance is tracked; null unless track_original() was called.
    const engine::OriginalSurface* original() const { return original_ ? &*original_ : nullptr; }
    /// The surface before the first advance_to(). References this object. \pre keep_initial_surface() was
    /// called
    MeshRef initial_surface() const;
    /// Area of the current surface. O(faces)
    double area() const { return detail::area({mesh_.positions, mesh_.triangles}); }

private:
    ReorderedMesh mesh_;
    std::vector<Links> links_;
    // The initial surface once mesh_ has been replaced. original_ references these arrays.
    std::vector<engine::Vector3> initial_positions_;
    std::vector<Triangle> initial_triangles_;
    bool keeps_initial_surface_ = false;
    std::optional<engine::OriginalSurface> original_;
    std::vector<Index> vertex_map_, source_vertices_;  // the latter is empty before the first advance_to()
    std::vector<Index> bound_faces_;                   // as CompactedMesh has them
    std::vector<std::uint8_t> locked_, closed_;
    engine::PlanarBorders borders_;
};

FAQEM_DETAIL_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/simplify/run_state-inl.hpp"
#endif
