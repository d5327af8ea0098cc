#pragma once
/// \file
/// The memoryless metric with an additional cost for the distance from the original surface.

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "faqem/engine/metric/memoryless.hpp"
#include "faqem/engine/tracking/boundary_bindings.hpp"
#include "faqem/engine/tracking/distance.hpp"
#include "faqem/engine/tracking/vertex_bindings.hpp"
#include "faqem/engine/util/run_context.hpp"
#include "faqem/export.hpp"

FAQEM_ENGINE_BEGIN

/// A distance beyond which collapses are refused, as far as distances of points and costs show. Contractions are refused
/// as well.
struct DistanceLimit {
    /// The limit for points of new faces as a share of `distance`: points between them may be farther.
    static constexpr double share_inside = 0.95;

    double distance = std::numeric_limits<double>::infinity();  ///< engine units
    /// Above 0: the surface is not tracked, and collapses are refused if the root mean square distance that their cost
    /// stands for exceeds this share of the distance. 0: the surface is tracked from the start.
    double untracked_share = 0;
    /// Whether a point of a new face is near enough to the original; required if the surface is tracked.
    std::function<bool(const Vector3&)> is_near = {};

    bool is_finite() const { return distance < std::numeric_limits<double>::infinity(); }
};

/// Memoryless metric with tracked distances, which limits the largest distance from the original. The
/// memoryless metric does not detect that many small errors in one direction add up. Here each original
/// vertex is bound to the face that represents it, and a collapse has the additional cost w d^2. d is the
/// largest of these distances: from the vertices bound to the faces around the pair to the faces after the
/// collapse, and from the new vertex to the original faces of the bound vertex nearest to it. w is the mean
/// face area of the result.
///
/// Far above the target all distances are small and only boundaries are tracked: they have few vertices,
/// and the planes of a small hole hardly contribute compared with those of the surface around it.
/// exact_cost() is expensive; the engine calls it only when a pair is about to be collapsed. Not
/// thread-safe.
class TrackedMetric : public MetricDefaults {
public:
    static constexpr bool has_exact_cost = true;

    /// The surface is tracked once the face count is at most this many times the target. Tracking at all
    /// sizes takes four times as long with almost no improvement (docs/measurements/quality.md).
    static constexpr std::size_t tracking_start_ratio = 3;
    /// Factor on the squared distances of boundaries: outlines are visible first, and the distances at the
    /// original boundary vertices are smaller than those between them.
    static constexpr double boundary_factor = 2;
    /// Where one vertex of a pair has more faces than this, only those of the other vertex are tracked: each pair of the
    /// vertex would visit all of them.
    static constexpr std::uint32_t max_tracked_valence = 64;

    /// \param weights       weights of the memoryless metric
    /// \param original      borrowed, must outlive this object
    /// \param tracked       the vertices to track, original vertices ascending; the targets are vertices of
    ///     the mesh
    /// \param target_faces  target face count; 0: only boundaries are tracked
    /// \param weight        w, the cost of a squared distance, > 0; engine units squared
    /// \param curves        as for MemorylessMetric
    /// \param context       must outlive this object; checked by initialise(), exact_cost() and after_collapse();
    ///     exceptions pass through
    /// \param limit         refuses collapses; if it is finite, `target_faces` has no effect
    TrackedMetric(const MemorylessWeights& weights, const OriginalSurface& original, TrackedVertices tracked,
                  std::size_t target_faces, double weight, const FeatureCurves* curves = nullptr,
                  const RunContext& context = RunContext::endless(), DistanceLimit limit = {})
        : context_(context),
          memoryless_(weights, curves),
          original_(&original),
          tracked_(std::move(tracked)),
          target_faces_(target_faces),
          weight_(weight),
          limit_(std::move(limit)) {}

    /// Binds the tracked vertices. To be called once. O(faces + tracked vertices), typically
    void initialise(const CollapseMesh& mesh, const PairTable& pairs) {
        memoryless_.initialise(mesh, pairs);
        boundary_bindings_.emplace(*original_, tracked_, mesh, pairs);
        bindings_.emplace(*original_, std::exchange(tracked_, {}), mesh);
        start_tracking_if_near_target(mesh, pairs);
    }

    /// Position and cost of the memoryless metric; the cost is a lower bound of exact_cost().
    std::optional<Candidate> evaluate(const CollapseMesh& mesh, const PairTable& pairs, Index pair,
                                      AllowedPosition allowed_position, const Flat* flat = nullptr) const {
        return memoryless_.evaluate(mesh, pairs, pair, allowed_position, flat);
    }

    /// Cost including the distances. O(bound vertices times valence) at worst, typically one distance per
    /// bound vertex; O(1) if nothing around the pair has changed since the last call for it
    double exact_cost(const CollapseMesh& mesh, const PairTable& pairs, Index pair,
                      const Candidate& candidate) {
        const Index u = pairs.first(pair), v = pairs.second(pair);
        // A distance of boundaries may depend on edges beyond the neighbours, whose changes are not recorded.
        const bool is_inside = pairs.boundary_degree(u) + pairs.boundary_degree(v) == 0;
        const bool is_kept = is_tracking_ && !limit_.is_finite() && is_inside;
        if (is_kept && known_[pair].collapses >= std::max(last_change_[u], last_change_[v]))
            return candidate.cost + weight_ * known_[pair].farthest;
        constexpr double infinity = std::numeric_limits<double>::infinity();
        const double most = limit_.distance * limit_.distance;
        const double boundary = boundary_bindings_->squared_distance(mesh, pairs, u, v, candidate.point);
        if (boundary > most) return infinity;
        double farthest = boundary_factor * boundary;
        if (is_tracking_) {
            gather_faces_after(mesh, u, v, candidate.point);
            if (!faces_after_.empty()) {
                farthest = std::max(farthest, squared_distance_to_original(candidate.point));
                const double to_result = squared_distance_to_result(std::min(farthest, most));
                if (to_result > most) return infinity;
                farthest = std::max(farthest, to_result);
            } else if (limit_.is_finite()) {
                return infinity;
            }
        } else if (limit_.is_finite()) {
            double area = 0;
            mesh.for_each_face_around(u, v, [&](Index f, unsigned) { area += mesh.area(f); });
            const double share = limit_.untracked_share;
            if (candidate.cost > share * share * most * area) return infinity;
        }
        if (is_kept) known_[pair] = {farthest, collapses_};
        return candidate.cost + weight_ * farthest;
    }

    /// Whether a point of the new faces is beyond the limit: between points near the original they may not be.
    bool exceeds_limit(const Candidate& candidate) const {
        if (!is_tracking_ || !limit_.is_finite()) return false;
        const Vector3& p = candidate.point;
        return !limit_.is_near(p) || std::any_of(opposite_.begin(), opposite_.end(), [&](const auto& edge) {
            return !limit_.is_near((p + edge[0] + edge[1]) / 3) || !limit_.is_near((p + edge[0]) / 2);
        });
    }

    double contraction_cost(const CollapseMesh& mesh, const Contraction& contraction,
                            const Candidate& candidate) {
        if (limit_.is_finite()) return std::numeric_limits<double>::infinity();
        if (!is_tracking_ || contraction.remaining().empty()) return candidate.cost;
        faces_after_.clear();
        clear_bound();
        for (const Index f : contraction.vanishing()) gather_bound(f);
        for (const auto& [f, a, b] : contraction.remaining()) {
            gather_bound(f);
            faces_after_.emplace_back(candidate.point, mesh.position(a), mesh.position(b));
        }
        return candidate.cost +
               weight_ * squared_distance_to_result(squared_distance_to_original(candidate.point));
    }

    void before_collapse(const CollapseMesh& mesh, const PairTable& pairs, Index survivor, Index removed,
                         const Vector3& p) {
        memoryless_.before_collapse(mesh, pairs, survivor, removed, p);
        boundary_bindings_->before_collapse(pairs, survivor, removed);
        if (!is_tracking_) return bindings_->merge(survivor, removed);
        clear_bound();
        faces_.clear();
        tracked_all_ = tracks_all_faces(mesh, survivor, removed);
        for_each_tracked_face(mesh, survivor, removed, [&](Index f, unsigned) {
            gather_bound(f);
            bindings_->unbind_all(f);
            if (!tracked_all_ && !(mesh.has_corner(f, survivor) && mesh.has_corner(f, removed)))
                faces_.push_back(f);
        });
    }

    void after_collapse(const CollapseMesh& mesh, const PairTable& pairs, Index survivor,
                        std::span<const PairTable::Change> around) {
        memoryless_.after_collapse(mesh, pairs, survivor, around);
        boundary_bindings_->after_collapse(mesh, pairs, survivor, around);
        if (!is_tracking_) return start_tracking_if_near_target(mesh, pairs);
        last_change_[survivor] = ++collapses_;
        for (const PairTable::Change& change : around) last_change_[change.neighbour.vertex] = collapses_;
        if (tracked_all_) mesh.for_each_face(survivor, [&](Index f, unsigned) { faces_.push_back(f); });
        if (faces_.empty()) return;
        faces_after_.clear();
        for (const Index f : faces_) {
            const Triangle& t = mesh.triangle(f);
            faces_after_.emplace_back(mesh.position(t[0]), mesh.position(t[1]), mesh.position(t[2]));
        }
        context_.count(bound_.size());
        for_each_nearest(points_, faces_after_,
                         [&](std::size_t i, std::size_t k) { bindings_->bind(bound_[i], faces_[k]); });
    }

    Reevaluation reevaluation(const PairTable::Change& change) const {
        return memoryless_.reevaluation(change);
    }

    /// Changes the target.
    /// \param target_faces  new target face count
    /// \param weight        new w; not smaller than before, so that the costs in the queue remain lower
    ///     bounds
    void set_target(std::size_t target_faces, double weight) {
        target_faces_ = target_faces;
        weight_ = weight;
    }

private:
    // The farthest distance of a pair, squared, as of a number of collapses.
    struct Known {
        double farthest = 0;
        std::uint32_t collapses = 0;
    };

    void start_tracking_if_near_target(const CollapseMesh& mesh, const PairTable& pairs) {
        const bool waits = limit_.is_finite() ? limit_.untracked_share > 0
                                              : mesh.face_count() / tracking_start_ratio > target_faces_;
        if (waits) return;
        is_tracking_ = true;
        known_.resize(pairs.size());
        last_change_.assign(mesh.vertex_slots(), collapses_);
        bindings_->bind_all(mesh, context_);
    }

    static bool tracks_all_faces(const CollapseMesh& mesh, Index u, Index v) {
        return std::max(mesh.degree(u), mesh.degree(v)) <= max_tracked_valence;
    }

    // Calls visit(face, corner) for the faces around a pair that are tracked.
    template <class Visit>
    static void for_each_tracked_face(const CollapseMesh& mesh, Index u, Index v, Visit&& visit) {
        if (tracks_all_faces(mesh, u, v)) return mesh.for_each_face_around(u, v, visit);
        mesh.for_each_face(mesh.lower_degree_first(u, v).first, visit);
    }

    // Sets faces_after_ to the tracked faces at the new vertex after the collapse, and bound_ to the vertices bound
    // around the pair.
    void gather_faces_after(const CollapseMesh& mesh, Index u, Index v, const Vector3& p) {
        faces_after_.clear();
        opposite_.clear();
        clear_bound();
        for_each_tracked_face(mesh, u, v, [&](Index f, unsigned corner) {
            gather_bound(f);
            if (mesh.has_corner(f, u) && mesh.has_corner(f, v)) return;
            const Triangle& t = mesh.triangle(f);
            const Vector3 &a = mesh.position(t[(corner + 1) % 3]), &b = mesh.position(t[(corner + 2) % 3]);
            faces_after_.emplace_back(p, a, b);
            opposite_.push_back({a, b});
        });
    }

    void clear_bound() { bound_.clear(), points_.clear(); }

    // Appends the vertices bound to face f, which may be most of the original vertices.
    void gather_bound(Index f) {
        bindings_->for_each_bound(f, [&](Index x) {
            bound_.push_back(x);
            points_.add(bindings_->position(x));
        });
    }

    // The largest of `at_least` and the squared distances from the vertices in bound_ to the faces after the collapse.
    double squared_distance_to_result(double at_least) const {
        context_.count(bound_.size());
        return farthest_squared(points_, faces_after_, at_least);
    }

    // Squared distance from p to the original faces of the nearest vertex in bound_; 0 if bound_ is empty.
    double squared_distance_to_original(const Vector3& p) const {
        const auto [nearest, at] = points_.nearest(p);
        return at == no_index ? 0 : bindings_->squared_distance_to_ring(bound_[at], p, nearest);
    }

    const RunContext& context_;
    MemorylessMetric memoryless_;
    std::optional<VertexBindings> bindings_;
    std::optional<BoundaryBindings> boundary_bindings_;
    const OriginalSurface* original_;
    TrackedVertices tracked_;
    std::size_t target_faces_;
    bool is_tracking_ = false;
    std::uint32_t collapses_ = 1;             // since tracking began; 1 more, so that nothing is known before
    std::vector<std::uint32_t> last_change_;  // per vertex: collapses_ when its faces last changed
    std::vector<Known> known_;                // per pair, if last_change_ of its vertices is not later
    bool tracked_all_ = true;                 // around the pair that is being collapsed
    double weight_;
    DistanceLimit limit_;
    std::vector<std::array<Vector3, 2>> opposite_;  // sides of the faces at the new vertex without it
    std::vector<TriangleDistance> faces_after_;     // faces at the new vertex
    std::vector<Index> faces_;                      // those that are tracked after a collapse
    std::vector<Index> bound_;                      // tracked vertices bound around the pair
    PointBatches points_;                           // their positions
};

static_assert(CollapseMetric<TrackedMetric>);

FAQEM_ENGINE_END
