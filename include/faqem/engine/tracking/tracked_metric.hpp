#pragma once
/// \file
/// The memoryless metric, and how far a collapse takes the surface from the original.

#include <algorithm>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "faqem/engine/metric/memoryless.hpp"
#include "faqem/engine/tracking/boundary_bindings.hpp"
#include "faqem/engine/tracking/distance.hpp"
#include "faqem/engine/tracking/vertex_bindings.hpp"
#include "faqem/export.hpp"

FAQEM_NAMESPACE_BEGIN
namespace engine {

/// What keeps the largest distance small. The memoryless metric forgets: many small errors in one direction
/// add up. Here every original vertex is bound to the face that stands for it, and a collapse costs, besides,
/// w d^2, where d is the largest distance of what is bound to the faces around the pair from the faces that
/// would be there after it, and of the new vertex from the original faces around the bound vertex nearest to
/// it; w is the area that a face of the result has on average.
///
/// Far above the target all distances are small, and only borders are watched: they are few, and a small hole
/// hardly holds itself against the surface around it. exact_cost() is dear: the engine asks for it when a pair is
/// about to be collapsed.
class TrackedMetric {
public:
    /// The surface is tracked from this many times the target on. At all sizes it costs four times as much,
    /// and gains next to nothing (docs/quality.md).
    static constexpr std::size_t tracking_start_ratio = 4;
    /// Squared distances of borders count so many times: outlines are seen first, and what is measured at the
    /// original's border vertices is less than what is between them.
    static constexpr double boundary_factor = 2;

    /// \param weights       of the memoryless metric
    /// \param original      borrowed
    /// \param tracked       of the vertices to look after, into those of the complex; original ones ascending
    /// \param target_faces  the result's; 0: only borders are watched
    /// \param weight        what the square of a distance costs, > 0
    /// \param curves        as MemorylessMetric's
    TrackedMetric(const MemorylessWeights& weights, const OriginalSurface& original, TrackedVertices tracked,
                  std::size_t target_faces, double weight, const FeatureCurves* curves = nullptr)
        : memoryless_(weights, curves),
          original_(&original),
          tracked_(std::move(tracked)),
          target_faces_(target_faces),
          weight_(weight) {}

    void initialise(const CollapseMesh& mesh, const PairTable& pairs,
                    CancellationCheck check_cancelled = {}) {
        check_cancelled_ = check_cancelled;
        memoryless_.initialise(mesh, pairs, check_cancelled);
        boundary_bindings_.emplace(*original_, tracked_, mesh, pairs, check_cancelled);
        bindings_.emplace(*original_, std::exchange(tracked_, {}), mesh);
        start_tracking_if_near_target(mesh);
    }

    /// What the memoryless metric says: less than the cost will be.
    std::optional<Candidate> evaluate(const CollapseMesh& mesh, const PairTable& pairs, Index pair,
                                      AllowedPosition allowed_position) const {
        return memoryless_.evaluate(mesh, pairs, pair, allowed_position);
    }

    /// The whole cost. O(bound vertices times valence) at worst, one distance per bound vertex typically.
    double exact_cost(const CollapseMesh& mesh, const PairTable& pairs, Index u, Index v,
                      const Candidate& candidate) {
        double farthest =
            boundary_factor * boundary_bindings_->squared_distance(mesh, pairs, u, v, candidate.point);
        if (is_tracking_) {
            gather_faces_after(mesh, u, v, candidate.point);
            if (!faces_after_.empty())
                farthest = std::max(
                    {farthest, squared_distance_to_result(), squared_distance_to_original(candidate.point)});
        }
        return candidate.cost + weight_ * farthest;
    }

    void before_collapse(const CollapseMesh& mesh, const PairTable& pairs, Index survivor, Index removed,
                         const Vector3& p) {
        memoryless_.before_collapse(mesh, pairs, survivor, removed, p);
        boundary_bindings_->before_collapse(pairs, survivor, removed);
        if (!is_tracking_) return bindings_->merge(survivor, removed);
        bound_.clear();
        mesh.for_each_face_around(survivor, removed, [&](Index f, unsigned) {
            bindings_->for_each_bound(f, [&](Index x) { bound_.push_back(x); });
            bindings_->unbind_all(f);
        });
    }

    void after_collapse(const CollapseMesh& mesh, const PairTable& pairs, Index survivor,
                        std::span<const PairTable::Change> around) {
        memoryless_.after_collapse(mesh, pairs, survivor, around);
        boundary_bindings_->after_collapse(mesh, pairs, survivor, around);
        if (!is_tracking_) return start_tracking_if_near_target(mesh);
        faces_after_.clear();
        faces_.clear();
        mesh.for_each_face(survivor, [&](Index f, unsigned) {
            const Triangle& t = mesh.triangle(f);
            faces_after_.emplace_back(mesh.position(t[0]), mesh.position(t[1]), mesh.position(t[2]));
            faces_.push_back(f);
        });
        if (faces_.empty()) return;
        for_each_bound([&](Index x) {
            bindings_->bind(x, faces_[nearest_index(faces_after_, bindings_->position(x))]);
        });
    }

    Reevaluation reevaluation(const PairTable::Change& change) const {
        return memoryless_.reevaluation(change);
    }

    /// Costs of waiting pairs may only rise: \pre weight is not below the one before.
    void set_target(std::size_t target_faces, double weight) {
        target_faces_ = target_faces;
        weight_ = weight;
    }

private:
    void start_tracking_if_near_target(const CollapseMesh& mesh) {
        if (mesh.face_count() / tracking_start_ratio > target_faces_) return;
        is_tracking_ = true;
        bindings_->bind_all(mesh, check_cancelled_);
    }

    // Collects the faces there would be, and what is bound to those there are.
    void gather_faces_after(const CollapseMesh& mesh, Index u, Index v, const Vector3& p) {
        faces_after_.clear();
        bound_.clear();
        mesh.for_each_face_around(u, v, [&](Index f, unsigned corner) {
            bindings_->for_each_bound(f, [&](Index x) { bound_.push_back(x); });
            if (mesh.has_corner(f, u) && mesh.has_corner(f, v)) return;
            const Triangle& t = mesh.triangle(f);
            faces_after_.emplace_back(p, mesh.position(t[(corner + 1) % 3]),
                                      mesh.position(t[(corner + 2) % 3]));
        });
    }

    // Visits what is bound around the pair, and polls now and then.
    template <class Visit>
    void for_each_bound(Visit&& visit) const {
        constexpr std::size_t batch_size = 128;
        for (std::size_t begin = 0; begin < bound_.size(); begin += batch_size) {
            const std::size_t end = std::min(bound_.size(), begin + batch_size);
            check_cancelled_(2 * (end - begin));  // each with several faces
            for (std::size_t i = begin; i < end; ++i) visit(bound_[i]);
        }
    }

    // Largest squared distance from a bound vertex to the faces there would be.
    double squared_distance_to_result() const {
        FarthestPoint farthest(faces_after_);
        for_each_bound([&](Index i) { farthest.add(bindings_->position(i)); });
        return farthest.squared_distance();
    }

    // Squared distance from p to the original around the nearest bound vertex; 0 where none is bound.
    double squared_distance_to_original(const Vector3& p) const {
        Index at = no_index;
        double nearest = std::numeric_limits<double>::infinity();
        for (const Index i : bound_) {
            const double d = (bindings_->position(i) - p).squaredNorm();
            if (d < nearest) nearest = d, at = i;
        }
        return at == no_index ? 0 : bindings_->squared_distance_to_ring(at, p, nearest);
    }

    CancellationCheck check_cancelled_;
    MemorylessMetric memoryless_;
    std::optional<VertexBindings> bindings_;
    std::optional<BoundaryBindings> boundary_bindings_;
    const OriginalSurface* original_;
    TrackedVertices tracked_;
    std::size_t target_faces_;
    bool is_tracking_ = false;
    double weight_;
    std::vector<TriangleDistance> faces_after_;  // the faces there would be
    std::vector<Index> faces_;                   // their indices
    std::vector<Index> bound_;                   // original vertices bound around the pair
};

static_assert(LowerBoundMetric<TrackedMetric> && TargetDependentMetric<TrackedMetric>);

}  // namespace engine
FAQEM_NAMESPACE_END
