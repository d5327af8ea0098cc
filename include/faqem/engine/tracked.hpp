#pragma once
/// \file
/// The memoryless metric, and how far a collapse takes the surface from the original.

#include <algorithm>
#include <concepts>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "faqem/engine/bindings.hpp"
#include "faqem/engine/distance.hpp"
#include "faqem/engine/memoryless.hpp"

namespace faqem::engine {

/// Tells how far a point is from the original surface.
template <class S>
concept OriginalSurface = requires(const S surface, const Vector3& p, double at_most) {
    // Squared distance of p, or at_most where that is smaller.
    { surface.squared_distance(p, at_most) } -> std::same_as<double>;
};

/// What keeps the largest distance small. The memoryless metric forgets: many small errors in one direction
/// add up. Here every original vertex is bound to the face that stands for it, and a collapse costs, besides,
/// w d^2, where d is the largest distance between what is bound to the faces around the pair and the faces
/// that would be there after it, in both directions, and w the area that a face of the result has on average.
///
/// refine() is dear: the engine asks for it when a pair is about to be collapsed.
/// \tparam Surface  the original; in the engine's units
template <OriginalSurface Surface>
class TrackedMetric {
public:
    /// \param original      borrowed; must outlive the metric
    /// \param target_faces  the result's, > 0
    TrackedMetric(const MemorylessWeights& weights, const Surface& original, std::size_t target_faces)
        : planes_(weights), original_(original), per_face_(1 / static_cast<double>(target_faces)) {}

    void initialise(const Complex& complex, const PairTable& pairs) {
        planes_.initialise(complex, pairs);
        bindings_.initialise(complex);
        double area = 0;
        for (Index f = 0; f < complex.face_slots(); ++f) {
            if (complex.alive(f)) area += 0.5 * complex.area_vector(f).norm();
        }
        weight_ = area * per_face_;
    }

    /// What the memoryless metric says: less than the cost will be.
    std::optional<Candidate> evaluate(const Complex& complex, const PairTable& pairs, Index u, Index v,
                                      Freedom freedom) const {
        return planes_.evaluate(complex, pairs, u, v, freedom);
    }

    /// The whole cost. O(bound vertices times valence) at worst, one distance per bound vertex typically.
    double refine(const Complex& complex, Index u, Index v, const Candidate& candidate) {
        look_ahead(complex, u, v, candidate.point);
        if (after_.empty()) return candidate.cost;
        return candidate.cost + weight_ * backward(forward());
    }

    void collapsing(const Complex& complex, const PairTable& pairs, Index survivor, Index gone,
                    const Vector3& p) {
        planes_.collapsing(complex, pairs, survivor, gone, p);
        bound_.clear();
        for_each_face_around(complex, survivor, gone, [&](Index f, unsigned) {
            bindings_.for_each_bound(f, [&](Index x) { bound_.push_back(x); });
            bindings_.release(f);
        });
    }

    void collapsed(const Complex& complex, const PairTable& pairs, Index survivor,
                   std::span<const PairTable::Change> around) {
        planes_.collapsed(complex, pairs, survivor, around);
        after_.clear();
        faces_.clear();
        complex.for_each_face(survivor, [&](Index f, unsigned) {
            const Triangle& t = complex.triangle(f);
            after_.emplace_back(complex.position(t[0]), complex.position(t[1]), complex.position(t[2]));
            faces_.push_back(f);
        });
        if (faces_.empty()) return;
        for (const Index x : bound_) bindings_.bind(x, faces_[nearest_face(bindings_.position(x))]);
    }

    Staleness staleness(const PairTable::Change& change) const { return planes_.staleness(change); }

private:
    // All faces of u, and those of v that are not u's.
    template <class Visit>
    static void for_each_face_around(const Complex& complex, Index u, Index v, Visit&& visit) {
        complex.for_each_face(u, visit);
        complex.for_each_face(v, [&](Index f, unsigned corner) {
            if (!complex.has_corner(f, u)) visit(f, corner);
        });
    }

    // Collects the faces and edges there would be, and what is bound to those there are.
    void look_ahead(const Complex& complex, Index u, Index v, const Vector3& p) {
        after_.clear();
        probes_.assign(1, p);
        bound_.clear();
        for_each_face_around(complex, u, v, [&](Index f, unsigned corner) {
            bindings_.for_each_bound(f, [&](Index x) { bound_.push_back(x); });
            if (complex.has_corner(f, u) && complex.has_corner(f, v)) return;
            const Triangle& t = complex.triangle(f);
            const Vector3 &a = complex.position(t[(corner + 1) % 3]),
                          &b = complex.position(t[(corner + 2) % 3]);
            after_.emplace_back(p, a, b);
            // Faces in order around p share their edges: the first of each tells of the edge.
            probes_.push_back(0.5 * (p + a));
        });
    }

    // Largest squared distance from a bound vertex to the faces there would be.
    double forward() const {
        double worst = 0;
        std::size_t first = 0;  // neighbours have their nearest face in common: try the last one's first
        for (const Index i : bound_) {
            const Vector3& x = bindings_.position(i);
            double nearest = std::numeric_limits<double>::infinity();
            for (std::size_t j = 0; j < after_.size() && nearest > worst; ++j) {
                const std::size_t k = first + j < after_.size() ? first + j : first + j - after_.size();
                const double d = after_[k](x);
                if (d < nearest) nearest = d;
                if (d <= worst) first = k;
            }
            if (nearest > worst) worst = nearest;
        }
        return worst;
    }

    // The larger of `worst` and the squared distances from the new vertex and the middles of its edges to the
    // original. A bound vertex near by often shows that they are no farther.
    double backward(double worst) const {
        for (const Vector3& q : probes_) {
            double nearest = std::numeric_limits<double>::infinity();
            for (const Index i : bound_)
                nearest = std::min(nearest, (bindings_.position(i) - q).squaredNorm());
            if (nearest > worst) worst = std::max(worst, original_.squared_distance(q, nearest));
        }
        return worst;
    }

    std::size_t nearest_face(const Vector3& x) const {
        std::size_t at = 0;
        double nearest = std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < after_.size(); ++k) {
            const double d = after_[k](x);
            if (d < nearest) nearest = d, at = k;
        }
        return at;
    }

    MemorylessMetric planes_;
    Bindings bindings_;
    const Surface& original_;
    double per_face_;
    double weight_ = 0;
    std::vector<TriangleDistance> after_;  // the faces there would be
    std::vector<Index> faces_;             // their indices
    std::vector<Index> bound_;             // original vertices bound around the pair
    std::vector<Vector3> probes_;          // points of the surface there would be
};

}  // namespace faqem::engine
