#pragma once
/// \file
/// Which part of the original each face of today stands for.

#include <utility>
#include <vector>

#include "faqem/engine/complex.hpp"

namespace faqem::engine {

/// Original vertices, each bound to one living face near it.
class Bindings {
public:
    /// Binds every vertex to one of its faces. O(faces)
    void initialise(const Complex& complex) {
        first_.assign(complex.face_slots(), no_index);
        next_.assign(complex.vertex_slots(), no_index);
        positions_.resize(complex.vertex_slots());
        for (Index v = 0; v < positions_.size(); ++v) {
            positions_[v] = complex.position(v);
            complex.all_faces(v, [&](Index f, unsigned) {
                bind(v, f);
                return false;
            });
        }
    }

    const Vector3& position(Index v) const { return positions_[v]; }

    /// Binds vertex v to face f. \pre v is bound to no other face
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

private:
    std::vector<Vector3> positions_;
    std::vector<Index> first_, next_;  // lists of vertices bound to each face
};

}  // namespace faqem::engine
