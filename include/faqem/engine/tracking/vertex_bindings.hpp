#pragma once
/// \file
/// Bindings of the original vertices to the faces of the current mesh that represent them.

#include <algorithm>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "faqem/engine/mesh/collapse_mesh.hpp"
#include "faqem/engine/tracking/distance.hpp"
#include "faqem/engine/tracking/original_surface.hpp"
#include "faqem/engine/util/run_context.hpp"
#include "faqem/export.hpp"

FAQEM_ENGINE_BEGIN

/// Finds faces near points that were merged into vertices of a mesh. References the mesh.
/// \tparam Mesh  has position(v), triangle(f), is_high_valence(v) and for_each_face(v, visit(f, corner))
template <class Mesh>
class NearFaceSearch {
public:
    explicit NearFaceSearch(const Mesh& mesh) : mesh_(mesh) {}

    /// Finds a face for each of some points. Typically O(points)
    /// \param v            the vertex they were merged into; has at least one face
    /// \param points       what identifies them
    /// \param position_of  a function of one of these
    /// \param visit        called with one of these and its face
    template <class PositionOf, class Visit>
    void find(Index v, std::span<const Index> points, PositionOf&& position_of, Visit&& visit) {
        faces_.clear(), distances_.clear(), batches_.clear();
        for (const Index i : points) batches_.add(position_of(i));
        mesh_.for_each_face(v, [&](Index f, unsigned corner) {
            const Triangle& t = mesh_.triangle(f);
            faces_.push_back(f);
            distances_.emplace_back(mesh_.position(v), mesh_.position(t[(corner + 1) % 3]),
                                    mesh_.position(t[(corner + 2) % 3]));
        });
        for_each_nearest(batches_, distances_, [&](std::size_t i, std::size_t k) {
            const Vector3& p = position_of(points[i]);
            const bool may_be_outside = distances_[k].is_at_opposite_side(p);
            visit(points[i],
                  may_be_outside ? find_nearer_face(p, v, faces_[k], distances_[k](p)) : faces_[k]);
        });
    }

private:
    // Finds a face near p by descent: continues with the neighbours of the nearest face while that reduces the squared
    // distance. High-valence vertices are not visited on the way.
    // \param best     the nearest face of `searched`
    // \param nearest  its squared distance
    Index find_nearer_face(const Vector3& p, Index searched, Index best, double nearest) {
        visited_.assign(1, searched);
        const auto is_visited = [&](Index v) {
            return std::find(visited_.begin(), visited_.end(), v) != visited_.end();
        };
        const auto search_faces_of = [&](Index v) {
            if (is_visited(v)) return false;
            const Index before = best;
            mesh_.for_each_face(v, [&](Index f, unsigned corner) {
                const Triangle& t = mesh_.triangle(f);
                if (is_visited(t[(corner + 1) % 3]) || is_visited(t[(corner + 2) % 3])) return;
                const TriangleDistance distance(mesh_.position(t[0]), mesh_.position(t[1]),
                                                mesh_.position(t[2]));
                const double d = distance(p);
                if (d < nearest) nearest = d, best = f;
            });
            visited_.push_back(v);
            return best != before;
        };
        for (bool nearer = true; nearer && nearest > 0;) {
            nearer = false;
            const Triangle corners = mesh_.triangle(best);
            for (const Index v : corners) nearer |= !mesh_.is_high_valence(v) && search_faces_of(v);
        }
        return best;
    }

    const Mesh& mesh_;
    std::vector<Index> faces_, visited_;
    std::vector<TriangleDistance> distances_;
    PointBatches batches_;
};

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

    /// Binds each tracked vertex to a face near it, if known to that of TrackedVertices, unless its current vertex has no
    /// faces. Typically O(tracked vertices)
    /// \param mesh     the current mesh
    /// \param context  checked for each vertex; exceptions pass through
    void bind_all(const CollapseMesh& mesh, const RunContext& context = {}) {
        first_bound_.assign(mesh.face_slots(), no_index);
        next_bound_.assign(tracked_.original.size(), no_index);
        if (tracked_.faces.empty()) return search_all(mesh, context);
        for (Index i = 0; i < next_bound_.size(); ++i) {
            const Index f = tracked_.faces[tracked_.original[i]];
            if (f != no_index) bind(i, f);
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
    // As bind_all() without known faces.
    void search_all(const CollapseMesh& mesh, const RunContext& context) {
        // Until they are bound, the lists link the vertices that were merged into the same one.
        std::vector<Index> first_merged(mesh.vertex_slots(), no_index);
        for (Index i = static_cast<Index>(next_bound_.size()); i-- > 0;)
            next_bound_[i] = std::exchange(first_merged[current_vertex(tracked_.current[i])], i);
        NearFaceSearch search(mesh);
        std::vector<Index> merged;
        for (Index v = 0; v < mesh.vertex_slots(); ++v) {
            if (first_merged[v] == no_index || mesh.degree(v) == 0) continue;
            merged.clear();
            for (Index i = first_merged[v]; i != no_index; i = next_bound_[i]) merged.push_back(i);
            context.count(merged.size());
            search.find(
                v, merged, [this](Index i) { return position(i); }, [this](Index i, Index f) { bind(i, f); });
        }
        collapse_target_ = tracked_.current = {};
    }

    const OriginalSurface* original_;
    TrackedVertices tracked_;
    std::vector<Index> collapse_target_;  // per vertex of the mesh: the vertex it was merged into, or itself
    std::vector<Index> first_bound_, next_bound_;  // linked list of the vertices bound to each face
};

FAQEM_ENGINE_END
