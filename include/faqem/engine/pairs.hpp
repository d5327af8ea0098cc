#pragma once
/// \file
/// The vertex pairs that may be collapsed: all edges of the complex, and virtual edges between its parts.

#include <array>
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
    /// \throws what the poll throws
    PairTable(const Complex& complex, std::span<const std::pair<Index, Index>> virtual_pairs, Poll poll = {})
        : vertices_(complex.vertex_slots()) {
        pairs_.reserve(complex.face_count() / 2 * 3 + virtual_pairs.size());
        for (Index v = 0; v < complex.vertex_slots(); ++v) {
            poll();
            add_edges_above(complex, v);
        }
        for (const auto& [a, b] : virtual_pairs) pairs_[add(a, b)].is_virtual = true;
    }

    std::size_t size() const { return pairs_.size(); }
    bool alive(Index pair) const { return first(pair) != no_index; }
    Index first(Index pair) const { return pairs_[pair].ends[0]; }
    Index second(Index pair) const { return pairs_[pair].ends[1]; }
    /// Number of faces with this edge; 0 for a virtual pair.
    std::uint32_t face_count(Index pair) const { return pairs_[pair].face_count; }
    /// Number of edges at v with exactly one face.
    std::uint32_t boundary_degree(Index v) const { return vertices_[v].boundary_degree; }
    /// Number of edges at v with more than two faces.
    std::uint32_t nonmanifold_degree(Index v) const { return vertices_[v].nonmanifold_degree; }

    /// Calls visit(Neighbour) for each living pair of v.
    template <class Visit>
    void for_each_pair(Index v, Visit&& visit) const {
        for (Index s = vertices_[v].first; s != no_index; s = next(s)) {
            if (end(s) == v) visit(Neighbour{end(s ^ 1), s / 2});
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
        vertices_[survivor].first = vertices_[gone].first = no_index;
        count_faces(complex, survivor, changes);
        std::size_t kept = 0;
        for (const Change& change : changes) {
            const Index pair = change.neighbour.pair;
            vertices_[change.neighbour.vertex].mark = no_index;
            const bool lives =
                face_count(pair) > 0 || (pairs_[pair].is_virtual && complex.degree(survivor) > 0 &&
                                         complex.degree(change.neighbour.vertex) > 0);
            if (lives) {
                const Index slot = 2 * pair + (second(pair) == survivor ? 1 : 0);
                push(survivor, slot);
                changes[kept++] = change;
            } else {
                kill(pair, killed);
                if (change.boundary_changed) changes[kept++] = {{change.neighbour.vertex, no_index}, true};
            }
            if (complex.degree(change.neighbour.vertex) == 0) kill_all(change.neighbour.vertex, killed);
        }
        changes.resize(kept);
    }

    /// A face of the complex is gone; each of its edges has others.
    void face_removed(const Triangle& corners) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Index v = corners[k], n = corners[(k + 1) % 3];
            for (Index s = vertices_[v].first; s != no_index; s = next(s)) {
                if (end(s) == v && end(s ^ 1) == n) set_face_count(s / 2, face_count(s / 2) - 1);
            }
        }
    }

    /// Kills all pairs of a vertex that has no face any more.
    void kill_all(Index v, std::vector<Index>& killed) {
        for (Index s = vertices_[v].first; s != no_index; s = next(s)) {
            if (end(s) == v) kill(s / 2, killed);
        }
        vertices_[v].first = no_index;
    }

private:
    struct Vertex {
        Index first = no_index;  ///< slot 2 * pair + end, head of a list
        std::uint32_t boundary_degree = 0, nonmanifold_degree = 0;
        Index mark = no_index;  ///< scratch: pair to the vertex, while gathering
    };
    struct Pair {
        std::array<Index, 2> ends;  ///< no_index: dead
        std::array<Index, 2> next;  ///< slot after each end's, in the list of its vertex
        std::uint32_t face_count = 0;
        bool is_virtual = false;
    };

    Index& end(Index slot) { return pairs_[slot / 2].ends[slot % 2]; }
    Index end(Index slot) const { return pairs_[slot / 2].ends[slot % 2]; }
    Index next(Index slot) const { return pairs_[slot / 2].next[slot % 2]; }

    void push(Index v, Index slot) {
        pairs_[slot / 2].next[slot % 2] = vertices_[v].first;
        vertices_[v].first = slot;
    }

    Index add(Index a, Index b) {
        assert(2 * pairs_.size() + 2 < no_index);
        const auto pair = static_cast<Index>(pairs_.size());
        pairs_.push_back({{a, b}, {no_index, no_index}});
        push(a, 2 * pair);
        push(b, 2 * pair + 1);
        return pair;
    }

    void add_edges_above(const Complex& complex, Index v) {
        const auto begin = static_cast<Index>(size());
        complex.for_each_face(v, [&](Index f, unsigned corner) {
            const Triangle& t = complex.triangle(f);
            for (unsigned k = 1; k < 3; ++k) {
                const Index n = t[(corner + k) % 3];
                if (n < v) continue;
                Index& pair = vertices_[n].mark;
                if (pair == no_index) pair = add(v, n);
                ++pairs_[pair].face_count;
            }
        });
        for (Index pair = begin; pair < size(); ++pair) {
            vertices_[second(pair)].mark = no_index;
            const std::uint32_t count = std::exchange(pairs_[pair].face_count, 0);
            set_face_count(pair, count);
        }
    }

    // Takes the pairs of `v` to `survivor`: the collapsed pair (v, partner) and doubles die.
    void gather(Index v, Index survivor, Index partner, std::vector<Index>& killed,
                std::vector<Change>& changes) {
        for (Index s = vertices_[v].first; s != no_index; s = next(s)) {
            if (end(s) != v) continue;
            const Index pair = s / 2;
            const Index n = end(s ^ 1);
            const Index kept = vertices_[n].mark;
            if (n == partner) {
                kill(pair, killed);
            } else if (kept != no_index) {
                if (face_count(pair) == 1) set_face_count(kept, 1);  // tells count_faces() that it was open
                pairs_[kept].is_virtual = pairs_[kept].is_virtual && pairs_[pair].is_virtual;
                kill(pair, killed);
            } else {
                move_end(pair, v, survivor, s);
                vertices_[n].mark = pair;
                changes.push_back({{n, pair}, false});
            }
        }
    }

    void move_end(Index pair, Index from, Index to, Index slot) {
        if (face_count(pair) == 1) --vertices_[from].boundary_degree, ++vertices_[to].boundary_degree;
        if (face_count(pair) > 2) --vertices_[from].nonmanifold_degree, ++vertices_[to].nonmanifold_degree;
        end(slot) = to;
    }

    void set_face_count(Index pair, std::uint32_t count) {
        const std::uint32_t before = std::exchange(pairs_[pair].face_count, count);
        if ((before == 1) != (count == 1)) change_degree(&Vertex::boundary_degree, pair, count == 1);
        if ((before > 2) != (count > 2)) change_degree(&Vertex::nonmanifold_degree, pair, count > 2);
    }

    void change_degree(std::uint32_t Vertex::*degree, Index pair, bool up) {
        for (const Index v : pairs_[pair].ends) up ? ++(vertices_[v].*degree) : --(vertices_[v].*degree);
    }

    void count_faces(const Complex& complex, Index survivor, std::vector<Change>& changes) {
        counts_.clear();
        for (Change& change : changes) {
            change.boundary_changed = face_count(change.neighbour.pair) == 1;
            counts_.push_back(0);
            vertices_[change.neighbour.vertex].mark = static_cast<Index>(counts_.size() - 1);
        }
        complex.for_each_face(survivor, [&](Index f, unsigned corner) {
            const Triangle& t = complex.triangle(f);
            for (unsigned k = 1; k < 3; ++k) ++counts_[vertices_[t[(corner + k) % 3]].mark];
        });
        for (std::size_t i = 0; i < changes.size(); ++i) {
            set_face_count(changes[i].neighbour.pair, counts_[i]);
            changes[i].boundary_changed |= counts_[i] == 1;
        }
    }

    void kill(Index pair, std::vector<Index>& killed) {
        if (!alive(pair)) return;
        set_face_count(pair, 0);
        pairs_[pair].ends = {no_index, no_index};
        killed.push_back(pair);
    }

    std::vector<Vertex> vertices_;
    std::vector<Pair> pairs_;
    std::vector<std::uint32_t> counts_;  // scratch: faces of each change
};

}  // namespace faqem::engine
