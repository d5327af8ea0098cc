#pragma once
/// \file
/// The vertex pairs that may be collapsed: all edges of the complex, and virtual edges between its parts.

#include <cassert>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "faqem/engine/complex.hpp"

namespace faqem::engine {

/// A pair of a vertex as for_each_pair() shows it.
struct Neighbour {
    Index vertex = no_index;  ///< the other end
    Index pair = no_index;
};

/// Pairs with stable indices, and how many faces each has. A pair lives while it has a face, or while it is
/// virtual and both its ends have faces.
class PairTable {
public:
    /// Numbers the edges of `complex` by their smaller vertex, then by the order of that vertex's corners;
    /// the virtual pairs follow. O(faces)
    /// \param virtual_pairs  distinct pairs that are no edges
    PairTable(const Complex& complex, std::span<const std::pair<Index, Index>> virtual_pairs)
        : first_(complex.vertex_slots(), no_index),
          boundary_degree_(complex.vertex_slots(), 0),
          nonmanifold_degree_(complex.vertex_slots(), 0),
          mark_(complex.vertex_slots(), no_index) {
        for (Index v = 0; v < complex.vertex_slots(); ++v) add_edges_above(complex, v);
        for (const auto& [a, b] : virtual_pairs) is_virtual_[add(a, b)] = 1;
    }

    std::size_t size() const { return is_virtual_.size(); }
    bool alive(Index pair) const { return ends_[2 * std::size_t{pair}] != no_index; }
    Index first(Index pair) const { return ends_[2 * std::size_t{pair}]; }
    Index second(Index pair) const { return ends_[2 * std::size_t{pair} + 1]; }
    /// Number of faces with this edge; 0 for a virtual pair.
    std::uint32_t face_count(Index pair) const { return face_count_[pair]; }
    /// Number of edges at v with exactly one face.
    std::uint32_t boundary_degree(Index v) const { return boundary_degree_[v]; }
    /// Number of edges at v with more than two faces.
    std::uint32_t nonmanifold_degree(Index v) const { return nonmanifold_degree_[v]; }

    /// Calls visit(Neighbour) for each living pair of v.
    template <class Visit>
    void for_each_pair(Index v, Visit&& visit) const {
        for (Index s = first_[v]; s != no_index; s = next_[s]) {
            if (ends_[s] == v) visit(Neighbour{ends_[s ^ 1], s / 2});
        }
    }

    /// What merge() found around the survivor.
    struct Change {
        Neighbour neighbour;            ///< pair is no_index where it died with its open edge
        bool boundary_changed = false;  ///< the edge is or was open
    };

    /// Follows complex.collapse(survivor, gone, ...), which must have been done.
    /// \param killed   pairs that ceased to live are appended here
    /// \param changes  becomes the survivor's living pairs, and the vertices that lost their open edge to it
    void merge(const Complex& complex, Index survivor, Index gone, std::vector<Index>& killed,
               std::vector<Change>& changes) {
        changes.clear();
        gather(survivor, survivor, gone, killed, changes);
        gather(gone, survivor, survivor, killed, changes);
        first_[survivor] = first_[gone] = no_index;
        count_faces(complex, survivor, changes);
        std::size_t kept = 0;
        for (const Change& change : changes) {
            const Index pair = change.neighbour.pair;
            mark_[change.neighbour.vertex] = no_index;
            const bool lives = face_count_[pair] > 0 || (is_virtual_[pair] && complex.degree(survivor) > 0 &&
                                                         complex.degree(change.neighbour.vertex) > 0);
            if (lives) {
                const Index slot = 2 * pair + (second(pair) == survivor ? 1 : 0);
                next_[slot] = first_[survivor];
                first_[survivor] = slot;
                changes[kept++] = change;
            } else {
                kill(pair, killed);
                if (change.boundary_changed) changes[kept++] = {{change.neighbour.vertex, no_index}, true};
            }
            if (complex.degree(change.neighbour.vertex) == 0) kill_all(change.neighbour.vertex, killed);
        }
        changes.resize(kept);
    }

    /// Kills all pairs of a vertex that has no face any more.
    void kill_all(Index v, std::vector<Index>& killed) {
        for (Index s = first_[v]; s != no_index; s = next_[s]) {
            if (ends_[s] == v) kill(s / 2, killed);
        }
        first_[v] = no_index;
    }

private:
    Index add(Index a, Index b) {
        assert(ends_.size() + 2 < no_index);
        const auto slot = static_cast<Index>(ends_.size());
        ends_.insert(ends_.end(), {a, b});
        next_.insert(next_.end(), {first_[a], first_[b]});
        first_[a] = slot;
        first_[b] = slot + 1;
        is_virtual_.push_back(0);
        face_count_.push_back(0);
        return slot / 2;
    }

    void add_edges_above(const Complex& complex, Index v) {
        const auto begin = static_cast<Index>(size());
        complex.for_each_face(v, [&](Index f, unsigned corner) {
            const Triangle& t = complex.triangle(f);
            for (unsigned k = 1; k < 3; ++k) {
                const Index n = t[(corner + k) % 3];
                if (n < v) continue;
                if (mark_[n] == no_index) mark_[n] = add(v, n);
                ++face_count_[mark_[n]];
            }
        });
        for (Index pair = begin; pair < size(); ++pair) {
            mark_[second(pair)] = no_index;
            const std::uint32_t count = std::exchange(face_count_[pair], 0);
            set_face_count(pair, count);
        }
    }

    // Takes the pairs of `v` to `survivor`: the collapsed pair (v, partner) and doubles die.
    void gather(Index v, Index survivor, Index partner, std::vector<Index>& killed,
                std::vector<Change>& changes) {
        for (Index s = first_[v]; s != no_index; s = next_[s]) {
            if (ends_[s] != v) continue;
            const Index pair = s / 2;
            const Index n = ends_[s ^ 1];
            if (n == partner) {
                kill(pair, killed);
            } else if (mark_[n] != no_index) {
                const Index kept = mark_[n];
                if (face_count_[pair] == 1) set_face_count(kept, 1);  // tells count_faces() that it was open
                is_virtual_[kept] = is_virtual_[kept] && is_virtual_[pair];
                kill(pair, killed);
            } else {
                move_end(pair, v, survivor, s);
                mark_[n] = pair;
                changes.push_back({{n, pair}, false});
            }
        }
    }

    void move_end(Index pair, Index from, Index to, Index slot) {
        if (face_count_[pair] == 1) --boundary_degree_[from], ++boundary_degree_[to];
        if (face_count_[pair] > 2) --nonmanifold_degree_[from], ++nonmanifold_degree_[to];
        ends_[slot] = to;
    }

    void set_face_count(Index pair, std::uint32_t count) {
        const std::uint32_t before = std::exchange(face_count_[pair], count);
        if ((before == 1) != (count == 1)) change_degree(boundary_degree_, pair, count == 1);
        if ((before > 2) != (count > 2)) change_degree(nonmanifold_degree_, pair, count > 2);
    }

    void change_degree(std::vector<std::uint32_t>& degree, Index pair, bool up) {
        for (const Index v : {first(pair), second(pair)}) up ? ++degree[v] : --degree[v];
    }

    void count_faces(const Complex& complex, Index survivor, std::vector<Change>& changes) {
        for (Change& change : changes) {
            change.boundary_changed = face_count_[change.neighbour.pair] == 1;
            set_face_count(change.neighbour.pair, 0);
        }
        complex.for_each_face(survivor, [&](Index f, unsigned corner) {
            const Triangle& t = complex.triangle(f);
            for (unsigned k = 1; k < 3; ++k) {
                const Index pair = mark_[t[(corner + k) % 3]];
                set_face_count(pair, face_count_[pair] + 1);
            }
        });
        for (Change& change : changes) change.boundary_changed |= face_count_[change.neighbour.pair] == 1;
    }

    void kill(Index pair, std::vector<Index>& killed) {
        if (!alive(pair)) return;
        set_face_count(pair, 0);
        ends_[2 * std::size_t{pair}] = ends_[2 * std::size_t{pair} + 1] = no_index;
        killed.push_back(pair);
    }

    std::vector<Index> ends_;          // two per pair; no_index: dead
    std::vector<Index> first_, next_;  // lists of slots (2 * pair + end) per vertex
    std::vector<std::uint32_t> face_count_;
    std::vector<std::uint8_t> is_virtual_;
    std::vector<std::uint32_t> boundary_degree_, nonmanifold_degree_;
    std::vector<Index> mark_;  // scratch: pair to a vertex, while gathering
};

}  // namespace faqem::engine
