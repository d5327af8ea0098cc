#pragma once
/// \file
/// Which part of the original each face of today stands for.

#include <limits>
#include <utility>
#include <vector>

#include "faqem/engine/complex.hpp"
#include "faqem/engine/distance.hpp"

namespace faqem::engine {

/// The original surface, and its vertices, each bound to one living face near it.
///
/// Until begin() only the lineage is kept: which vertex of today each original vertex has gone into. That is
/// cheap, and enough to find the nearest face later.
class Bindings {
public:
    /// Remembers the surface as it is now as the original. O(faces); about 60 bytes per face
    explicit Bindings(const Complex& complex) : rings_(complex.vertex_slots() + 1, 0) {
        triangles_.reserve(complex.face_slots());
        for (Index f = 0; f < complex.face_slots(); ++f) triangles_.push_back(complex.triangle(f));
        for (Index v = 0; v < complex.vertex_slots(); ++v) {
            positions_.push_back(complex.position(v));
            into_.push_back(v);
            complex.for_each_face(v, [&](Index f, unsigned) { ring_faces_.push_back(f); });
            rings_[v + 1] = ring_faces_.size();
        }
    }

    const Vector3& position(Index v) const { return positions_[v]; }

    /// The vertex `gone` of today becomes `survivor`. Before begin() only.
    void merge(Index survivor, Index gone) { into_[gone] = survivor; }

    /// The vertex of today that v has gone into; shortens the way for the next one. Before begin() only.
    Index into(Index v) {
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
            if (complex.degree(today) > 0) bind(v, near_face(complex, positions_[v], today));
        }
        into_ = {};
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

    std::vector<Vector3> positions_;
    std::vector<Triangle> triangles_;
    std::vector<std::size_t> rings_;  // where the original faces of each vertex begin
    std::vector<Index> ring_faces_;
    std::vector<Index> into_;
    std::vector<Index> first_, next_;  // lists of vertices bound to each face
};

}  // namespace faqem::engine
