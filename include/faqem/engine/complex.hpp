#pragma once
/// \file
/// The surface as the engine sees it: any triangle soup, edges with three faces and more included.

#include <array>
#include <cassert>
#include <cstdint>
#include <utility>
#include <vector>

#include "faqem/engine/vector.hpp"
#include "faqem/mesh.hpp"

namespace faqem::engine {

/// 6 * max_faces < 2^32: a soup has up to three edges per face, and a pair two ends.
inline constexpr std::size_t max_faces = 715'827'880;

/// Vertices, triangles, and for each vertex a linked list of its corners. Faces keep their index for life.
///
/// Lists are cleaned lazily: a corner of a dead face stays in the list of a vertex until that vertex survives
/// a collapse, so that removing a face next to a vertex of valence n costs O(1), not O(n). At most max_faces
/// faces: corners and pairs are numbered in 32 bits.
class Complex {
public:
    /// \param positions  one per vertex
    /// \param triangles  indices into positions; a face with no_index corners is dead from the start
    Complex(std::vector<Vector3> positions, std::vector<Triangle> triangles)
        : positions_(std::move(positions)),
          triangles_(std::move(triangles)),
          first_(positions_.size(), no_index),
          next_(3 * triangles_.size(), no_index),
          degree_(positions_.size(), 0) {
        for (std::size_t f = triangles_.size(); f-- > 0;) {
            if (!alive(static_cast<Index>(f))) continue;
            ++face_count_;
            for (std::size_t c = 3; c-- > 0;) push_corner(triangles_[f][c], static_cast<Index>(3 * f + c));
        }
    }

    std::size_t vertex_slots() const { return positions_.size(); }
    std::size_t face_slots() const { return triangles_.size(); }
    /// Faces that are alive.
    std::size_t face_count() const { return face_count_; }

    const Vector3& position(Index v) const { return positions_[v]; }
    const Triangle& triangle(Index f) const { return triangles_[f]; }
    bool alive(Index f) const { return triangles_[f][0] != no_index; }
    /// Number of living faces at v.
    std::uint32_t degree(Index v) const { return degree_[v]; }

    /// Calls visit(face, corner) for every living face at v; corner is 0, 1 or 2.
    template <class Visit>
    void for_each_face(Index v, Visit&& visit) const {
        for (Index c = first_[v]; c != no_index; c = next_[c]) {
            const Index f = c / 3;
            if (alive(f)) visit(f, c % 3);
        }
    }

    /// Calls visit(face, corner) until it returns false; tells whether it never did.
    template <class Visit>
    bool all_faces(Index v, Visit&& visit) const {
        for (Index c = first_[v]; c != no_index; c = next_[c]) {
            const Index f = c / 3;
            if (alive(f) && !visit(f, c % 3)) return false;
        }
        return true;
    }

    bool has_corner(Index f, Index v) const {
        const Triangle& t = triangles_[f];
        return t[0] == v || t[1] == v || t[2] == v;
    }

    /// Twice the area of f, along its normal.
    Vector3 area_vector(Index f) const {
        const Triangle& t = triangles_[f];
        return engine::area_vector(positions_[t[0]], positions_[t[1]], positions_[t[2]]);
    }

    /// Moves `survivor` to `p` and gives it the faces of `gone`; faces with both vanish.
    /// \return number of faces that vanished
    std::size_t collapse(Index survivor, Index gone, const Vector3& p) {
        assert(survivor != gone);
        const std::size_t before = face_count_;
        for (Index c = first_[gone]; c != no_index; c = next_[c]) {
            const Index f = c / 3;
            if (alive(f) && has_corner(f, survivor)) remove_face(f);
        }
        Index kept = no_index;
        splice(first_[survivor], kept, survivor);
        splice(first_[gone], kept, survivor);
        first_[survivor] = kept;
        degree_[survivor] += degree_[gone];
        first_[gone] = no_index;
        degree_[gone] = 0;
        positions_[survivor] = p;
        return before - face_count_;
    }

    /// Removes a living face.
    void remove_face(Index f) {
        for (Index v : triangles_[f]) --degree_[v];
        triangles_[f] = {no_index, no_index, no_index};
        --face_count_;
    }

private:
    void push_corner(Index v, Index c) {
        next_[c] = first_[v];
        first_[v] = c;
        ++degree_[v];
    }

    // Moves the living corners of list `from` to the front of list `to`, now belonging to `owner`.
    void splice(Index from, Index& to, Index owner) {
        while (from != no_index) {
            const Index following = next_[from];
            if (alive(from / 3)) {
                triangles_[from / 3][from % 3] = owner;
                next_[from] = to;
                to = from;
            }
            from = following;
        }
    }

    std::vector<Vector3> positions_;
    std::vector<Triangle> triangles_;
    std::vector<Index> first_, next_;  // lists of corners 3 * face + corner
    std::vector<std::uint32_t> degree_;
    std::size_t face_count_ = 0;
};

}  // namespace faqem::engine
