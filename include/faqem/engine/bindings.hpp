#pragma once
/// \file
/// Which part of the original each face of today stands for.

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "faqem/engine/complex.hpp"
#include "faqem/engine/distance.hpp"

namespace faqem::engine {

/// A surface as it was before the first collapse, and what has become of its vertices. Borrows.
struct Original {
    std::span<const Vector3> positions;
    std::span<const Triangle> triangles;  ///< of different corners
    std::vector<Index> into;              ///< the vertex of the complex that each has gone into, or no_index
    /// Edges with one face.
    std::span<const std::array<Index, 2>> open_edges;
};

/// The original surface, and its vertices, each bound to one living face near it.
///
/// Until begin() only the lineage is kept: which vertex of today each original vertex has gone into. That is
/// cheap, and enough to find the nearest face later.
class Bindings {
public:
    /// \param original  its arrays must outlive the bindings
    /// \param complex   what has become of it
    /// O(faces); about 20 bytes per original face
    Bindings(const Original& original, const Complex& complex)
        : positions_(original.positions),
          triangles_(original.triangles),
          start_(original.into),
          into_(complex.vertex_slots()) {
        std::iota(into_.begin(), into_.end(), Index{0});
        find_rings();
    }

    /// Remembers the surface as it is now as the original. O(faces); about 50 bytes per face
    explicit Bindings(const Complex& complex) {
        for (Index f = 0; f < complex.face_slots(); ++f) {
            if (complex.alive(f)) own_triangles_.push_back(complex.triangle(f));
        }
        for (Index v = 0; v < complex.vertex_slots(); ++v) own_positions_.push_back(complex.position(v));
        start_.resize(complex.vertex_slots());
        std::iota(start_.begin(), start_.end(), Index{0});
        into_ = start_;
        positions_ = own_positions_;
        triangles_ = own_triangles_;
        find_rings();
    }

    // A copy would look at the arrays of the other one.
    Bindings(const Bindings&) = delete;
    Bindings& operator=(const Bindings&) = delete;
    Bindings(Bindings&&) = default;
    Bindings& operator=(Bindings&&) = default;

    std::span<const Vector3> positions() const { return positions_; }
    const Vector3& position(Index v) const { return positions_[v]; }

    /// The vertex `gone` of today becomes `survivor`. Before begin() only.
    void merge(Index survivor, Index gone) { into_[gone] = survivor; }

    /// The vertex of today that original vertex v has gone into, or no_index; shortens the way for the next
    /// one. Before begin() only.
    Index into(Index v) {
        v = start_[v];
        if (v == no_index) return v;
        Index today = v;
        while (into_[today] != today) today = into_[today];
        while (into_[v] != today) v = std::exchange(into_[v], today);
        return today;
    }

    /// Binds every original vertex to a face near it, as far as its lineage has faces. O(vertices), typically
    void begin(const Complex& complex) {
        first_.assign(complex.face_slots(), no_index);
        next_.assign(positions_.size(), no_index);
        for (Index v = 0; v < positions_.size(); ++v) {
            const Index today = into(v);
            if (today != no_index && complex.degree(today) > 0)
                bind(v, near_face(complex, positions_[v], today));
        }
        start_ = into_ = {};
    }

    /// Binds original vertex v to face f. \pre v is bound to no other face
    void bind(Index v, Index f) {
        next_[v] = first_[f];
        first_[f] = v;
    }

    /// Forgets what is bound to face f.
    void release(Index f) { first_[f] = no_index; }

    /// Calls visit(original vertex) for all that are bound to face f. visit may bind the vertex anew.
    template <class Visit>
    void for_each_bound(Index f, Visit&& visit) const {
        for (Index v = first_[f]; v != no_index;) visit(std::exchange(v, next_[v]));
    }

    /// Squared distance of p to the original faces around original vertex v, or `at_most` where that is
    /// smaller. O(valence)
    double squared_distance_around(Index v, const Vector3& p, double at_most) const {
        for (std::size_t i = rings_[v]; i < rings_[v + 1]; ++i) {
            const Triangle& t = triangles_[ring_faces_[i]];
            const TriangleDistance distance(positions_[t[0]], positions_[t[1]], positions_[t[2]]);
            at_most = std::min(at_most, distance(p));
        }
        return at_most;
    }

private:
    // Goes from the faces around `today` to nearer and nearer ones.
    static Index near_face(const Complex& complex, const Vector3& p, Index today) {
        Index best = no_index;
        double nearest = std::numeric_limits<double>::infinity();
        const auto look_around = [&](Index v) {
            const Index before = best;
            complex.for_each_face(v, [&](Index f, unsigned) {
                const Triangle& t = complex.triangle(f);
                const TriangleDistance distance(complex.position(t[0]), complex.position(t[1]),
                                                complex.position(t[2]));
                const double d = distance(p);
                if (best == no_index || d < nearest) nearest = d, best = f;
            });
            return best != before;
        };
        for (bool nearer = look_around(today); nearer && nearest > 0;) {
            nearer = false;
            const Triangle corners = complex.triangle(best);
            for (const Index v : corners) nearer |= look_around(v);
        }
        return best;
    }

    void find_rings() {
        rings_.assign(positions_.size() + 1, 0);
        for (const Triangle& t : triangles_) {
            for (const Index v : t) ++rings_[v + 1];
        }
        std::partial_sum(rings_.begin(), rings_.end(), rings_.begin());
        ring_faces_.resize(rings_.back());
        for (Index f = 0; f < triangles_.size(); ++f) {
            for (const Index v : triangles_[f]) ring_faces_[rings_[v]++] = f;
        }
        // Each is where the next begins now.
        std::copy_backward(rings_.begin(), rings_.end() - 1, rings_.end());
        rings_.front() = 0;
    }

    std::vector<Vector3> own_positions_;
    std::vector<Triangle> own_triangles_;
    std::span<const Vector3> positions_;
    std::span<const Triangle> triangles_;
    std::vector<std::uint32_t> rings_;  // where the original faces of each vertex begin
    std::vector<Index> ring_faces_;
    std::vector<Index> start_;  // the vertex of the complex that each original one was when this was made
    std::vector<Index> into_;   // the next one on the way to that of today
    std::vector<Index> first_, next_;  // lists of vertices bound to each face
};

}  // namespace faqem::engine
