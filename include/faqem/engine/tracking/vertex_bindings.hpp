#pragma once
/// \file
/// Which part of the original each face of today stands for.

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "faqem/export.hpp"
#include "faqem/engine/mesh/triangle_soup.hpp"
#include "faqem/engine/tracking/distance.hpp"
#include "faqem/engine/tracking/reference_surface.hpp"

FAQEM_NAMESPACE_BEGIN
namespace engine {

/// Vertices of the original, each bound to one living face near it. They are called by their place in the
/// lineage.
///
/// Until begin() only the lineage is kept: which vertex of today each of them has gone into. That is cheap,
/// and enough to find the nearest face later.
class Bindings {
public:
    /// \param original  borrowed
    /// \param lineage   into vertices of the complex
    /// O(vertices)
    Bindings(const Original& original, Lineage lineage, const Complex& complex)
        : original_(&original), lineage_(std::move(lineage)), into_(complex.vertex_slots()) {
        std::iota(into_.begin(), into_.end(), Index{0});
    }

    const Vector3& position(Index i) const { return original_->position(lineage_.original[i]); }

    /// The vertex `gone` of today becomes `survivor`. Before begin() only.
    void merge(Index survivor, Index gone) { into_[gone] = survivor; }

    /// The vertex that a vertex of the complex has gone into since; shortens the way for the next one. Before
    /// begin() only.
    Index into(Index v) {
        Index today = v;
        while (into_[today] != today) today = into_[today];
        while (into_[v] != today) v = std::exchange(into_[v], today);
        return today;
    }

    /// Binds every vertex to a face near it, as far as its lineage has faces. O(vertices), typically
    /// \throws what the poll throws
    void begin(const Complex& complex, Poll poll = {}) {
        first_.assign(complex.face_slots(), no_index);
        next_.assign(lineage_.original.size(), no_index);
        for (Index i = 0; i < next_.size(); ++i) {
            poll(4);  // looks at two dozen faces
            const Index today = into(lineage_.today[i]);
            if (complex.degree(today) > 0) bind(i, near_face(complex, position(i), today));
        }
        into_ = lineage_.today = {};
    }

    /// Binds vertex i to face f. \pre it is bound to no other face
    void bind(Index i, Index f) {
        next_[i] = first_[f];
        first_[f] = i;
    }

    /// Forgets what is bound to face f.
    void release(Index f) { first_[f] = no_index; }

    /// Calls visit(i) for all that are bound to face f. visit may bind the vertex anew.
    template <class Visit>
    void for_each_bound(Index f, Visit&& visit) const {
        for (Index i = first_[f]; i != no_index;) visit(std::exchange(i, next_[i]));
    }

    /// Squared distance of p to the original faces around vertex i, or `at_most` where that is smaller.
    /// O(valence)
    double squared_distance_around(Index i, const Vector3& p, double at_most) const {
        return original_->squared_distance_around(lineage_.original[i], p, at_most);
    }

private:
    // Goes from the faces around `today` to nearer and nearer ones, but not around hubs.
    Index near_face(const Complex& complex, const Vector3& p, Index today) {
        Index best = no_index;
        double nearest = std::numeric_limits<double>::infinity();
        looked_around_.clear();
        const auto is_known = [&](Index v) {
            return std::find(looked_around_.begin(), looked_around_.end(), v) != looked_around_.end();
        };
        const auto look_around = [&](Index v) {
            if (is_known(v)) return false;
            const Index before = best;
            complex.for_each_face(v, [&](Index f, unsigned corner) {
                const Triangle& t = complex.triangle(f);
                if (is_known(t[(corner + 1) % 3]) || is_known(t[(corner + 2) % 3])) return;
                const TriangleDistance distance(complex.position(t[0]), complex.position(t[1]),
                                                complex.position(t[2]));
                const double d = distance(p);
                if (best == no_index || d < nearest) nearest = d, best = f;
            });
            looked_around_.push_back(v);
            return best != before;
        };
        for (bool nearer = look_around(today); nearer && nearest > 0;) {
            nearer = false;
            const Triangle corners = complex.triangle(best);
            for (const Index v : corners) nearer |= !complex.is_hub(v) && look_around(v);
        }
        return best;
    }

    const Original* original_;
    Lineage lineage_;
    std::vector<Index> into_;           // of each vertex of the complex: the next one on the way to today's
    std::vector<Index> first_, next_;   // lists of vertices bound to each face
    std::vector<Index> looked_around_;  // scratch
};

}  // namespace engine
FAQEM_NAMESPACE_END
