#pragma once
/// \file
/// The memoryless metric, and how far a collapse takes the surface from the original.

#include <algorithm>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "faqem/export.hpp"
#include "faqem/engine/tracking/vertex_bindings.hpp"
#include "faqem/engine/tracking/boundary_bindings.hpp"
#include "faqem/engine/tracking/distance.hpp"
#include "faqem/engine/metric/memoryless.hpp"

FAQEM_NAMESPACE_BEGIN
namespace engine {

/// What keeps the largest distance small. The memoryless metric forgets: many small errors in one direction
/// add up. Here every original vertex is bound to the face that stands for it, and a collapse costs, besides,
/// w d^2, where d is the largest distance of what is bound to the faces around the pair from the faces that
/// would be there after it, and of the new vertex from the original faces around the bound vertex nearest to
/// it; w is the area that a face of the result has on average.
///
/// Far above the target all distances are small, and only borders are watched: they are few, and a small hole
/// hardly holds itself against the surface around it. refine() is dear: the engine asks for it when a pair is
/// about to be collapsed.
class TrackedMetric {
public:
    /// The surface is tracked from this many times the target on. At all sizes it costs four times as much,
    /// and gains next to nothing (docs/quality.md).
    static constexpr std::size_t begins_at = 4;
    /// Squared distances of borders count so many times: outlines are seen first, and what is measured at the
    /// original's border vertices is less than what is between them.
    static constexpr double border_factor = 2;

    /// \param weights       of the memoryless metric
    /// \param original      borrowed
    /// \param lineage       of the vertices to look after, into those of the complex; original ones ascending
    /// \param target_faces  the result's; 0: only borders are watched
    /// \param weight        what the square of a distance costs, > 0
    /// \param curves        as MemorylessMetric's
    TrackedMetric(const MemorylessWeights& weights, const Original& original, Lineage lineage,
                  std::size_t target_faces, double weight, const GroupCurves* curves = nullptr)
        : planes_(weights, curves),
          original_(&original),
          lineage_(std::move(lineage)),
          target_faces_(target_faces),
          weight_(weight) {}

    void initialise(const Complex& complex, const PairTable& pairs, Poll poll = {}) {
        poll_ = poll;
        planes_.initialise(complex, pairs, poll);
        border_.emplace(*original_, lineage_, complex, pairs, poll);
        bindings_.emplace(*original_, std::exchange(lineage_, {}), complex);
        begin_if_time(complex);
    }

    /// What the memoryless metric says: less than the cost will be.
    std::optional<Candidate> evaluate(const Complex& complex, const PairTable& pairs, Index pair,
                                      Freedom freedom) const {
        return planes_.evaluate(complex, pairs, pair, freedom);
    }

    /// The whole cost. O(bound vertices times valence) at worst, one distance per bound vertex typically.
    double refine(const Complex& complex, const PairTable& pairs, Index u, Index v,
                  const Candidate& candidate) {
        double farthest = border_factor * border_->squared_distance(complex, pairs, u, v, candidate.point);
        if (is_tracking_) {
            look_ahead(complex, u, v, candidate.point);
            if (!after_.empty()) farthest = std::max({farthest, forward(), backward(candidate.point)});
        }
        return candidate.cost + weight_ * farthest;
    }

    void collapsing(const Complex& complex, const PairTable& pairs, Index survivor, Index gone,
                    const Vector3& p) {
        planes_.collapsing(complex, pairs, survivor, gone, p);
        border_->collapsing(pairs, survivor, gone);
        if (!is_tracking_) return bindings_->merge(survivor, gone);
        bound_.clear();
        complex.for_each_face_around(survivor, gone, [&](Index f, unsigned) {
            bindings_->for_each_bound(f, [&](Index x) { bound_.push_back(x); });
            bindings_->release(f);
        });
    }

    void collapsed(const Complex& complex, const PairTable& pairs, Index survivor,
                   std::span<const PairTable::Change> around) {
        planes_.collapsed(complex, pairs, survivor, around);
        border_->collapsed(complex, pairs, survivor, around);
        if (!is_tracking_) return begin_if_time(complex);
        after_.clear();
        faces_.clear();
        complex.for_each_face(survivor, [&](Index f, unsigned) {
            const Triangle& t = complex.triangle(f);
            after_.emplace_back(complex.position(t[0]), complex.position(t[1]), complex.position(t[2]));
            faces_.push_back(f);
        });
        if (faces_.empty()) return;
        for_each_bound(
            [&](Index x) { bindings_->bind(x, faces_[nearest_of(after_, bindings_->position(x))]); });
    }

    Staleness staleness(const PairTable::Change& change) const { return planes_.staleness(change); }

    /// Costs of waiting pairs may only rise: \pre weight is not below the one before.
    void aim(std::size_t target_faces, double weight) {
        target_faces_ = target_faces;
        weight_ = weight;
    }

private:
    void begin_if_time(const Complex& complex) {
        if (complex.face_count() / begins_at > target_faces_) return;
        is_tracking_ = true;
        bindings_->begin(complex, poll_);
    }

    // Collects the faces there would be, and what is bound to those there are.
    void look_ahead(const Complex& complex, Index u, Index v, const Vector3& p) {
        after_.clear();
        bound_.clear();
        complex.for_each_face_around(u, v, [&](Index f, unsigned corner) {
            bindings_->for_each_bound(f, [&](Index x) { bound_.push_back(x); });
            if (complex.has_corner(f, u) && complex.has_corner(f, v)) return;
            const Triangle& t = complex.triangle(f);
            after_.emplace_back(p, complex.position(t[(corner + 1) % 3]),
                                complex.position(t[(corner + 2) % 3]));
        });
    }

    // Visits what is bound around the pair, and polls now and then.
    template <class Visit>
    void for_each_bound(Visit&& visit) const {
        constexpr std::size_t stretch = 128;
        for (std::size_t begin = 0; begin < bound_.size(); begin += stretch) {
            const std::size_t end = std::min(bound_.size(), begin + stretch);
            poll_(2 * (end - begin));  // each with several faces
            for (std::size_t i = begin; i < end; ++i) visit(bound_[i]);
        }
    }

    // Largest squared distance from a bound vertex to the faces there would be.
    double forward() const {
        FarthestPoint farthest(after_);
        for_each_bound([&](Index i) { farthest.add(bindings_->position(i)); });
        return farthest.squared_distance();
    }

    // Squared distance from p to the original around the nearest bound vertex; 0 where none is bound.
    double backward(const Vector3& p) const {
        Index at = no_index;
        double nearest = std::numeric_limits<double>::infinity();
        for (const Index i : bound_) {
            const double d = (bindings_->position(i) - p).squaredNorm();
            if (d < nearest) nearest = d, at = i;
        }
        return at == no_index ? 0 : bindings_->squared_distance_around(at, p, nearest);
    }

    Poll poll_;
    MemorylessMetric planes_;
    std::optional<Bindings> bindings_;
    std::optional<BorderBindings> border_;
    const Original* original_;
    Lineage lineage_;
    std::size_t target_faces_;
    bool is_tracking_ = false;
    double weight_;
    std::vector<TriangleDistance> after_;  // the faces there would be
    std::vector<Index> faces_;             // their indices
    std::vector<Index> bound_;             // original vertices bound around the pair
};

static_assert(RefiningMetric<TrackedMetric> && AimingMetric<TrackedMetric>);

}  // namespace engine
FAQEM_NAMESPACE_END
