#pragma once
/// \file
/// Which part of the original each face of today stands for.

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "faqem/engine/mesh/collapse_mesh.hpp"
#include "faqem/engine/tracking/distance.hpp"
#include "faqem/engine/tracking/original_surface.hpp"
#include "faqem/export.hpp"

FAQEM_NAMESPACE_BEGIN
namespace engine {

/// Vertices of the original, each bound to one living face near it. They are called by their place in the
/// lineage.
///
/// Until begin() only the lineage is kept: which vertex of today each of them has gone into. That is cheap,
/// and enough to find the nearest face later.
class VertexBindings {
public:
    /// \param original  borrowed
    /// \param tracked   into vertices of the complex
    /// O(vertices)
    VertexBindings(const OriginalSurface& original, TrackedVertices tracked, const CollapseMesh& mesh)
        : original_(&original), tracked_(std::move(tracked)), collapse_target_(mesh.vertex_slots()) {
        std::iota(collapse_target_.begin(), collapse_target_.end(), Index{0});
    }

    const Vector3& position(Index i) const { return original_->position(tracked_.original[i]); }

    /// The vertex `gone` of today becomes `survivor`. Before begin() only.
    void merge(Index survivor, Index removed) { collapse_target_[removed] = survivor; }

    /// The vertex that a vertex of the complex has gone into since; shortens the way for the next one. Before
    /// begin() only.
    Index current_vertex(Index v) {
        Index current = v;
        while (collapse_target_[current] != current) current = collapse_target_[current];
        while (collapse_target_[v] != current) v = std::exchange(collapse_target_[v], current);
        return current;
    }

    /// Binds every vertex to a face near it, as far as its lineage has faces. O(vertices), typically
    /// \throws what the poll throws
    void bind_all(const CollapseMesh& mesh, CancellationCheck check_cancelled = {}) {
        first_bound_.assign(mesh.face_slots(), no_index);
        next_bound_.assign(tracked_.original.size(), no_index);
        for (Index i = 0; i < next_bound_.size(); ++i) {
            check_cancelled(4);  // looks at two dozen faces
            const Index current = current_vertex(tracked_.current[i]);
            if (mesh.degree(current) > 0) bind(i, find_near_face(mesh, position(i), current));
        }
        collapse_target_ = tracked_.current = {};
    }

    /// Binds vertex i to face f. \pre it is bound to no other face
    void bind(Index i, Index f) {
        next_bound_[i] = first_bound_[f];
        first_bound_[f] = i;
    }

    /// Forgets what is bound to face f.
    void unbind_all(Index f) { first_bound_[f] = no_index; }

    /// Calls visit(i) for all that are bound to face f. visit may bind the vertex anew.
    template <class Visit>
    void for_each_bound(Index f, Visit&& visit) const {
        for (Index i = first_bound_[f]; i != no_index;) visit(std::exchange(i, next_bound_[i]));
    }

    /// Squared distance of p to the original faces around vertex i, or `at_most` where that is smaller.
    /// O(valence)
    double squared_distance_to_ring(Index i, const Vector3& p, double at_most) const {
        return original_->squared_distance_to_ring(tracked_.original[i], p, at_most);
    }

private:
    // Goes from the faces around `today` to nearer and nearer ones, but not around hubs.
    Index find_near_face(const CollapseMesh& mesh, const Vector3& p, Index current) {
        Index best = no_index;
        double nearest = std::numeric_limits<double>::infinity();
        visited_.clear();
        const auto is_visited = [&](Index v) {
            return std::find(visited_.begin(), visited_.end(), v) != visited_.end();
        };
        const auto look_around = [&](Index v) {
            if (is_visited(v)) return false;
            const Index before = best;
            mesh.for_each_face(v, [&](Index f, unsigned corner) {
                const Triangle& t = mesh.triangle(f);
                if (is_visited(t[(corner + 1) % 3]) || is_visited(t[(corner + 2) % 3])) return;
                const TriangleDistance distance(mesh.position(t[0]), mesh.position(t[1]),
                                                mesh.position(t[2]));
                const double d = distance(p);
                if (best == no_index || d < nearest) nearest = d, best = f;
            });
            visited_.push_back(v);
            return best != before;
        };
        for (bool nearer = look_around(current); nearer && nearest > 0;) {
            nearer = false;
            const Triangle corners = mesh.triangle(best);
            for (const Index v : corners) nearer |= !mesh.is_high_valence(v) && look_around(v);
        }
        return best;
    }

    const OriginalSurface* original_;
    TrackedVertices tracked_;
    std::vector<Index> collapse_target_;  // of each vertex of the complex: the next one on the way to today's
    std::vector<Index> first_bound_, next_bound_;  // lists of vertices bound to each face
    std::vector<Index> visited_;                   // scratch
};

}  // namespace engine
FAQEM_NAMESPACE_END
