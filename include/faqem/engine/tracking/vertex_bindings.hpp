#pragma once
/// \file
/// Bindings of the original vertices to the faces of the current mesh that represent them.

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "faqem/engine/mesh/collapse_mesh.hpp"
#include "faqem/engine/tracking/distance.hpp"
#include "faqem/engine/tracking/original_surface.hpp"
#include "faqem/engine/util/run_context.hpp"
#include "faqem/export.hpp"

FAQEM_NAMESPACE_BEGIN
namespace engine {

/// The tracked original vertices, each bound to one face near it. They are identified by their index in
/// TrackedVertices. Not thread-safe.
///
/// Until bind_all() is called, only the collapse targets are recorded: the current vertex that each vertex
/// was merged into. This is cheap, and sufficient to find the nearest face later.
class VertexBindings {
public:
    /// Binds no vertex yet. O(vertices)
    /// \param original  borrowed, must outlive this object
    /// \param tracked   the vertices to bind; the targets are vertices of `mesh`
    /// \param mesh      the current mesh
    VertexBindings(const OriginalSurface& original, TrackedVertices tracked, const CollapseMesh& mesh)
        : original_(&original), tracked_(std::move(tracked)), collapse_target_(mesh.vertex_slots()) {
        std::iota(collapse_target_.begin(), collapse_target_.end(), Index{0});
    }

    /// Original position of tracked vertex i.
    const Vector3& position(Index i) const { return original_->position(tracked_.original[i]); }

    /// Records that vertex `removed` was merged into `survivor`. Must not be called after bind_all(). O(1)
    void merge(Index survivor, Index removed) { collapse_target_[removed] = survivor; }

    /// The vertex that vertex v was merged into; shortens the path to it. Must not be called after
    /// bind_all(). Amortised O(log n)
    Index current_vertex(Index v) {
        Index current = v;
        while (collapse_target_[current] != current) current = collapse_target_[current];
        while (collapse_target_[v] != current) v = std::exchange(collapse_target_[v], current);
        return current;
    }

    /// Binds each tracked vertex to a face near it, unless its current vertex has no faces. Typically
    /// O(tracked vertices)
    /// \param mesh     the current mesh
    /// \param context  checked for each vertex; exceptions pass through
    void bind_all(const CollapseMesh& mesh, const RunContext& context = {}) {
        first_bound_.assign(mesh.face_slots(), no_index);
        next_bound_.assign(tracked_.original.size(), no_index);
        // Until they are bound, the lists link the vertices that were merged into the same one.
        std::vector<Index> first_merged(mesh.vertex_slots(), no_index);
        for (Index i = static_cast<Index>(next_bound_.size()); i-- > 0;)
            next_bound_[i] = std::exchange(first_merged[current_vertex(tracked_.current[i])], i);
        std::vector<Index> merged, faces;
        std::vector<TriangleDistance> distances;
        for (Index v = 0; v < mesh.vertex_slots(); ++v) {
            if (first_merged[v] == no_index || mesh.degree(v) == 0) continue;
            merged.clear(), faces.clear(), distances.clear();
            PointBatches points;
            for (Index i = first_merged[v]; i != no_index; i = next_bound_[i]) {
                merged.push_back(i);
                points.add(position(i));
            }
            mesh.for_each_face(v, [&](Index f, unsigned corner) {
                const Triangle& t = mesh.triangle(f);
                faces.push_back(f);
                distances.emplace_back(mesh.position(v), mesh.position(t[(corner + 1) % 3]),
                                       mesh.position(t[(corner + 2) % 3]));
            });
            context.count(merged.size());
            for_each_nearest(points, distances, [&](std::size_t i, std::size_t k) {
                const Vector3& p = position(merged[i]);
                const bool may_be_outside = distances[k].is_at_opposite_side(p);
                bind(merged[i],
                     may_be_outside ? find_nearer_face(mesh, p, v, faces[k], distances[k](p)) : faces[k]);
            });
        }
        collapse_target_ = tracked_.current = {};
    }

    /// Binds tracked vertex i to face f. O(1)
    /// \pre it is not bound to another face
    void bind(Index i, Index f) {
        next_bound_[i] = first_bound_[f];
        first_bound_[f] = i;
    }

    /// Releases all vertices bound to face f. O(1)
    void unbind_all(Index f) { first_bound_[f] = no_index; }

    /// Calls visit(i) for each tracked vertex bound to face f. `visit` may bind the vertex to another face.
    template <class Visit>
    void for_each_bound(Index f, Visit&& visit) const {
        for (Index i = first_bound_[f]; i != no_index;) visit(std::exchange(i, next_bound_[i]));
    }

    /// Squared distance from p to the original faces of tracked vertex i. O(valence)
    /// \param at_most  returned if it is smaller
    double squared_distance_to_ring(Index i, const Vector3& p, double at_most) const {
        return original_->squared_distance_to_ring(tracked_.original[i], p, at_most);
    }

private:
    // Finds a face near p by descent: continues with the neighbours of the nearest face while that reduces the squared
    // distance. High-valence vertices are not visited on the way.
    // \param best     the nearest face of `searched`
    // \param nearest  its squared distance
    Index find_nearer_face(const CollapseMesh& mesh, const Vector3& p, Index searched, Index best,
                           double nearest) {
        visited_.assign(1, searched);
        const auto is_visited = [&](Index v) { return std::ranges::find(visited_, v) != visited_.end(); };
        const auto search_faces_of = [&](Index v) {
            if (is_visited(v)) return false;
            const Index before = best;
            mesh.for_each_face(v, [&](Index f, unsigned corner) {
                const Triangle& t = mesh.triangle(f);
                if (is_visited(t[(corner + 1) % 3]) || is_visited(t[(corner + 2) % 3])) return;
                const TriangleDistance distance(mesh.position(t[0]), mesh.position(t[1]),
                                                mesh.position(t[2]));
                const double d = distance(p);
                if (d < nearest) nearest = d, best = f;
            });
            visited_.push_back(v);
            return best != before;
        };
        for (bool nearer = true; nearer && nearest > 0;) {
            nearer = false;
            const Triangle corners = mesh.triangle(best);
            for (const Index v : corners) nearer |= !mesh.is_high_valence(v) && search_faces_of(v);
        }
        return best;
    }

    const OriginalSurface* original_;
    TrackedVertices tracked_;
    std::vector<Index> collapse_target_;  // per vertex of the mesh: the vertex it was merged into, or itself
    std::vector<Index> first_bound_, next_bound_;  // linked list of the vertices bound to each face
    std::vector<Index> visited_;                   // scratch
};

}  // namespace engine
FAQEM_NAMESPACE_END
