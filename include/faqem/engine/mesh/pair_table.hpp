#pragma once
/// \file
/// Vertex pairs that may be collapsed: the edges of the mesh, and virtual edges between its components.

#include <array>
#include <cassert>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "faqem/engine/mesh/collapse_mesh.hpp"
#include "faqem/export.hpp"

FAQEM_ENGINE_BEGIN

/// A pair as seen from one of its vertices.
struct Neighbour {
    Index vertex = no_index;  ///< the other vertex
    Index pair = no_index;    ///< index in the PairTable
};

/// The vertex pairs of a mesh, with stable indices and the number of faces of each. A pair is alive as long
/// as it has a face, or is virtual and both vertices have faces.
class PairTable {
public:
    /// Finds the edges of a mesh. They are numbered by their smaller vertex, then in the order of that
    /// vertex's corners; the virtual pairs follow. O(faces)
    /// \param virtual_pairs    distinct pairs that are not edges
    PairTable(const CollapseMesh& mesh, std::span<const std::pair<Index, Index>> virtual_pairs)
        : vertices_(mesh.vertex_slots()) {
        // A closed surface has three edges per two faces; each boundary edge adds half an edge. Growing the
        // array later would take twice the memory.
        const std::size_t extra_boundary_pairs = mesh.face_count() / 64;
        pairs_.reserve(mesh.face_count() / 2 * 3 + extra_boundary_pairs + virtual_pairs.size());
        for (Index v = 0; v < mesh.vertex_slots(); ++v) add_edges_to_larger(mesh, v);
        for (const auto& [a, b] : virtual_pairs) pairs_[add(a, b)].is_virtual = true;
        build_pair_lists();
    }

    /// Number of pairs, including those that are not alive.
    std::size_t size() const { return pairs_.size(); }
    /// Whether the pair still exists.
    bool is_alive(Index pair) const { return first(pair) != no_index; }
    /// The two vertices of a pair; no_index if it is not alive.
    Index first(Index pair) const { return pairs_[pair].ends[0]; }
    Index second(Index pair) const { return pairs_[pair].ends[1]; }
    /// Number of faces of the edge; 0 for a virtual pair.
    std::uint32_t face_count(Index pair) const { return pairs_[pair].face_count; }
    /// The faces of the edge; with one face, the first entry. O(1)
    /// \pre face_count(pair) is 1 or 2
    const std::array<Index, 2>& faces(Index pair) const { return pairs_[pair].faces; }
    /// Number of boundary edges at v (edges with exactly one face).
    std::uint32_t boundary_degree(Index v) const { return vertices_[v].boundary_degree; }
    /// Number of non-manifold edges at v (edges with more than two faces).
    std::uint32_t nonmanifold_degree(Index v) const { return vertices_[v].nonmanifold_degree; }

    /// Calls visit(Neighbour) for each pair of v that is alive. O(valence)
    template <class Visit>
    void for_each_pair(Index v, Visit&& visit) const {
        for (const Index s : slots_[vertices_[v].slots])
            if (end(s) == v) visit(Neighbour{end(s ^ 1), s / 2});
    }

    /// A neighbour of the survivor after merge().
    struct Change {
        Neighbour neighbour;            ///< pair is no_index if the pair died and was a boundary edge
        bool boundary_changed = false;  ///< the edge is or was a boundary edge
    };

    /// Updates the pairs after mesh.collapse(survivor, removed, ...). O(valence)
    /// \param mesh               the mesh after the collapse
    /// \param survivor, removed  the vertices of the collapsed pair
    /// \param killed             pairs that are no longer alive are appended
    /// \param changes            replaced by the pairs of the survivor that are alive, and the neighbours
    ///     that have lost their boundary edge to the survivor
    void merge(const CollapseMesh& mesh, Index survivor, Index removed, std::vector<Index>& killed,
               std::vector<Change>& changes) {
        changes.clear();
        take_over(survivor, survivor, removed, killed, changes);
        take_over(removed, survivor, survivor, killed, changes);
        vertices_[removed].slots.size = 0;
        remaining_.clear();
        recount_faces_around(mesh, survivor, changes);
        std::size_t count = 0;
        for (const Change& change : changes) {
            const Index pair = change.neighbour.pair;
            vertices_[change.neighbour.vertex].mark = no_index;
            const bool lives =
                face_count(pair) > 0 || (pairs_[pair].is_virtual && mesh.degree(survivor) > 0 &&
                                         mesh.degree(change.neighbour.vertex) > 0);
            if (lives) {
                remaining_.push_back(2 * pair + (second(pair) == survivor ? 1 : 0));
                changes[count++] = change;
            } else {
                kill(pair, killed);
                if (change.boundary_changed) changes[count++] = {{change.neighbour.vertex, no_index}, true};
            }
            if (mesh.degree(change.neighbour.vertex) == 0) kill_all(change.neighbour.vertex, killed);
        }
        changes.resize(count);
        slots_.assign(vertices_[survivor].slots, remaining_);
    }

    /// Updates the face counts after mesh.remove_face(). O(valence)
    /// \param mesh     the mesh after the removal
    /// \param corners  vertices of the removed face; each of its edges must have other faces
    void after_face_removal(const CollapseMesh& mesh, const Triangle& corners) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Index v = corners[k], n = corners[(k + 1) % 3];
            for_each_pair(v, [&](Neighbour to) {
                if (to.vertex == n) recount_faces(mesh, to.pair);
            });
        }
    }

    /// Kills all pairs of a vertex that has no faces. O(valence)
    /// \param killed  the killed pairs are appended
    void kill_all(Index v, std::vector<Index>& killed) {
        for_each_pair(v, [&](Neighbour n) { kill(n.pair, killed); });
        vertices_[v].slots.size = 0;
    }

private:
    struct Vertex {
        IndexList slots;  ///< 2 * pair + end; may contain pairs that are dead or belong to another vertex now
        std::uint32_t boundary_degree = 0, nonmanifold_degree = 0;
        Index mark = no_index;  ///< scratch: pair to the vertex
    };
    struct Pair {
        std::array<Index, 2> ends;                          ///< the two vertices; no_index: not alive
        std::array<Index, 2> faces = {no_index, no_index};  ///< the first two faces
        std::uint32_t face_count = 0;
        bool is_virtual = false;

        void add_face(Index f) {
            if (face_count < 2) faces[face_count] = f;
            ++face_count;
        }
    };

    Index& end(Index slot) { return pairs_[slot / 2].ends[slot % 2]; }
    Index end(Index slot) const { return pairs_[slot / 2].ends[slot % 2]; }

    Index add(Index a, Index b) {
        assert(2 * pairs_.size() + 2 < no_index);
        const auto pair = static_cast<Index>(pairs_.size());
        pairs_.push_back({{a, b}});
        for (const Index v : {a, b}) ++vertices_[v].slots.size;
        return pair;
    }

    // \pre each list size is the number of pairs of the vertex; the lists have no memory yet
    void build_pair_lists() {
        slots_.reserve(2 * pairs_.size(), vertices_.size());
        for (Vertex& vertex : vertices_)
            if (vertex.slots.size > 0) vertex.slots = slots_.allocate(vertex.slots.size);
        for (Index pair = 0; pair < pairs_.size(); ++pair) {
            slots_.push_back(vertices_[first(pair)].slots, 2 * pair);
            slots_.push_back(vertices_[second(pair)].slots, 2 * pair + 1);
        }
    }

    // Adds the edges from v to vertices of higher index.
    void add_edges_to_larger(const CollapseMesh& mesh, Index v) {
        const auto begin = static_cast<Index>(size());
        mesh.for_each_face(v, [&](Index f, unsigned corner) {
            const Triangle& t = mesh.triangle(f);
            for (unsigned k = 1; k < 3; ++k) {
                const Index n = t[(corner + k) % 3];
                if (n < v) continue;
                Index& pair = vertices_[n].mark;
                if (pair == no_index) pair = add(v, n);
                pairs_[pair].add_face(f);
            }
        });
        for (Index pair = begin; pair < size(); ++pair) {
            vertices_[second(pair)].mark = no_index;
            apply_face_count(pair, 0);
        }
    }

    // Moves the pairs of `v` to `survivor`. Kills the collapsed pair (v, partner) and duplicate pairs.
    void take_over(Index v, Index survivor, Index partner, std::vector<Index>& killed,
                   std::vector<Change>& changes) {
        for (const Index s : slots_[vertices_[v].slots]) {
            if (end(s) != v) continue;
            const Index pair = s / 2;
            const Index n = end(s ^ 1);
            const Index present = vertices_[n].mark;
            if (n == partner) {
                kill(pair, killed);
            } else if (present != no_index) {
                if (face_count(pair) == 1)
                    set_face_count(present, 1);  // so that recount_faces_around() sees a boundary edge
                pairs_[present].is_virtual = pairs_[present].is_virtual && pairs_[pair].is_virtual;
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
        if (before == count) return;
        if ((before == 1) != (count == 1)) change_degree(&Vertex::boundary_degree, pair, count == 1);
        if ((before > 2) != (count > 2)) change_degree(&Vertex::nonmanifold_degree, pair, count > 2);
    }

    void change_degree(std::uint32_t Vertex::*degree, Index pair, bool up) {
        for (const Index v : pairs_[pair].ends) up ? ++(vertices_[v].*degree) : --(vertices_[v].*degree);
    }

    // \pre the mark of each neighbour is its pair
    void recount_faces_around(const CollapseMesh& mesh, Index survivor, std::vector<Change>& changes) {
        counts_.clear();
        for (Change& change : changes) {
            Pair& pair = pairs_[change.neighbour.pair];
            change.boundary_changed = pair.face_count == 1;
            counts_.push_back(std::exchange(pair.face_count, 0));
        }
        mesh.for_each_face(survivor, [&](Index f, unsigned corner) {
            const Triangle& t = mesh.triangle(f);
            for (unsigned k = 1; k < 3; ++k) pairs_[vertices_[t[(corner + k) % 3]].mark].add_face(f);
        });
        for (std::size_t i = 0; i < changes.size(); ++i) {
            apply_face_count(changes[i].neighbour.pair, counts_[i]);
            changes[i].boundary_changed |= face_count(changes[i].neighbour.pair) == 1;
        }
    }

    void recount_faces(const CollapseMesh& mesh, Index pair) {
        const std::uint32_t before = std::exchange(pairs_[pair].face_count, 0);
        mesh.for_each_face_between(first(pair), second(pair), [&](Index f) { pairs_[pair].add_face(f); });
        apply_face_count(pair, before);
    }

    // \param before  face count that the degrees of its vertices include
    void apply_face_count(Index pair, std::uint32_t before) {
        set_face_count(pair, std::exchange(pairs_[pair].face_count, before));
    }

    void kill(Index pair, std::vector<Index>& killed) {
        if (!is_alive(pair)) return;
        set_face_count(pair, 0);
        pairs_[pair].ends = {no_index, no_index};
        killed.push_back(pair);
    }

    std::vector<Vertex> vertices_;
    std::vector<Pair> pairs_;
    IndexLists slots_;
    std::vector<Index> remaining_;       // scratch: entries of the survivor
    std::vector<std::uint32_t> counts_;  // scratch: previous face count of each change
};

FAQEM_ENGINE_END
