#pragma once
/// \file
/// The collapses of one cell in one round.

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "faqem/detail/rounds/kernels.hpp"
#include "faqem/detail/rounds/round_mesh.hpp"
#include "faqem/export.hpp"
#include "faqem/option_types.hpp"
#include "faqem/report.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {
namespace rounds {

/// An edge, and its cost when it was queued.
struct EdgeKey {
    Corner corner;
    float key;
};

/// Collapses edges of one cell, cheapest first.
class CellCollapser {
public:
    CellCollapser(Mesh& mesh, std::uint32_t cell, float limit, Recording patches, BlockSteps& out)
        : mesh_(mesh), cell_(cell), limit_(limit), patches_(patches), out_(out) {}

    void run(std::span<const Corner> candidates, std::size_t most) {
        first_.fill(no_index);
        nodes_.reserve(candidates.size() * 2);
        for (const Corner c : candidates) push({c, mesh_.key(c)});
        for (bucket_ = 0; bucket_ < buckets; ++bucket_) {
            while (first_[bucket_] != no_index && out_.collapses < most) {
                const Node node = nodes_[first_[bucket_]];
                first_[bucket_] = node.next;
                prefetch(node.next);
                try_collapse(node.candidate);
            }
        }
    }

private:
    static constexpr unsigned buckets = 256;

    struct Node {
        EdgeKey candidate;
        std::uint32_t next;
    };

    unsigned bucket_of(float key) const {
        const std::uint32_t below =
            (std::bit_cast<std::uint32_t>(limit_) - std::bit_cast<std::uint32_t>(key)) >> 20;
        return below < buckets ? buckets - 1 - below : 0;
    }

    void push(const EdgeKey& c) {
        const unsigned b = std::max(bucket_of(c.key), bucket_);
        const auto node = static_cast<std::uint32_t>(nodes_.size());
        nodes_.push_back({c, no_index});
        if (first_[b] == no_index)
            first_[b] = node;
        else
            nodes_[last_[b]].next = node;
        last_[b] = node;
    }

    void prefetch(std::uint32_t node) const {
        for (int i = 0; i < 3 && node != no_index; ++i) node = nodes_[node].next;
        if (node == no_index) return;
        const Face& f = mesh_.faces[nodes_[node].candidate.corner >> 2];
        if (f.v[0] != no_index) {
            for (unsigned k = 0; k < 3; ++k) {
                __builtin_prefetch(&mesh_.vertices[f.v[k]]);
                if (f.o[k] != no_index) __builtin_prefetch(&mesh_.faces[f.o[k] >> 2]);
            }
        }
        for (int i = 0; i < 3 && node != no_index; ++i) node = nodes_[node].next;
        if (node != no_index) __builtin_prefetch(&mesh_.faces[nodes_[node].candidate.corner >> 2]);
    }

    // Where to begin a walk around the pair at the edge opposite corner c: at a border if there is one.
    Corner start_of_star(Corner c, const Vertex& u, const Vertex& v) {
        const Corner at_u = (c & ~3u) | next(c & 3), at_v = (c & ~3u) | previous(c & 3);
        is_open_ = true;
        if (mesh_.faces[c >> 2].o[c & 3] == no_index) return mesh_.first_of_fan(at_v);
        if (u.bent) {
            const Corner first = mesh_.first_of_fan(at_u);
            if (first != at_u) return first;
        }
        if (v.bent) {
            const Corner first = mesh_.first_of_fan(at_v);
            if (first != at_v || mesh_.faces[c >> 2].o[next(c & 3)] == no_index) return first;
        }
        is_open_ = false;
        return mesh_.turned(at_u);
    }

    // Walks around the pair counterclockwise, from one vertex to the other at their common faces.
    // Returns whether each of these was passed once.
    bool gather(Corner start, Index u, Index v, int shared) {
        size_ = 0;
        Corner c = start;
        do {
            const Face& f = mesh_.faces[c >> 2];
            const unsigned k = c & 3;
            const Index behind = f.v[previous(k)];
            const bool dies = behind == u || behind == v;
            if (dies) {
                --shared;
            } else {
                if (size_ == Star::most) return false;
                corner_[size_] = c;
                ring_[size_++] = f.v[next(k)];
                ring_[size_] = behind;
            }
            const Corner across = f.o[dies ? k : next(k)];
            if (across == no_index) break;
            c = (across & ~3u) | next(across & 3);
        } while (c != start);
        return shared == 0;
    }

    int ring_size() const { return size_ + is_open_; }

    bool has_repeated_vertex() const {
        for (int i = 1; i < ring_size(); ++i) {
            for (int j = 0; j < i; ++j) {
                if (ring_[i] == ring_[j]) return true;
            }
        }
        return false;
    }

    // Adds area x n n^T of the triangle (0, t, a).
    static void add_plane(const Vector& t, const Vector& a, Planes& q) {
        const auto [x, y, z] = cross(t, a);
        const float w = 0.5f / std::max(length({x, y, z}), 1e-30f);
        q[0] += w * x * x, q[1] += w * x * y, q[2] += w * x * z;
        q[3] += w * y * y, q[4] += w * y * z, q[5] += w * z * z;
    }

    void try_collapse(const EdgeKey& candidate) {
        Corner c = candidate.corner;
        float& key = mesh_.key(c);
        if (key != candidate.key) return;
        // A vertex on a straight border survives.
        const auto& ends = mesh_.faces[c >> 2].v;
        if (mesh_.place(mesh_.vertices[ends[next(c & 3)]], mesh_.vertices[ends[previous(c & 3)]]) ==
            Place::at_second)
            c = mesh_.faces[c >> 2].o[c & 3];
        if (c == no_index) return refuse(key, Refusal::locked);
        const Index f = c >> 2;
        const unsigned k = c & 3;
        const Corner across = mesh_.faces[f].o[k];
        const bool at_border = across == no_index;
        const Index u = mesh_.faces[f].v[next(k)], v = mesh_.faces[f].v[previous(k)];
        const Index apex_f = mesh_.faces[f].v[k];
        const Index apex_g = at_border ? apex_f : mesh_.faces[across >> 2].v[across & 3];
        if (!is_inside(apex_f) || !is_inside(apex_g)) return;
        const Vertex &at_u = mesh_.vertices[u], &at_v = mesh_.vertices[v];
        const auto t = mesh_.difference(u, v);
        Planes shared_f = {}, shared_g = {}, shared;
        add_plane(t, mesh_.difference(u, apex_f), shared_f);
        if (!at_border) add_plane(t, mesh_.difference(u, apex_g), shared_g);
        for (unsigned j = 0; j < 6; ++j) shared[j] = shared_f[j] + shared_g[j];
        if (at_u.bent && at_v.bent) add_edge_planes(mesh_, c, Roots{mesh_}, shared);
        put(batch_, 0, at_u.planes, at_v.planes, shared, t);
        solve(batch_, 0);
        restrict_to(mesh_.place(at_u, at_v), batch_, 0);
        if (batch_.cost[0] > candidate.key) {
            key = batch_.cost[0];
            if (key > limit_) return;
            if (bucket_of(key) > bucket_) return push({candidate.corner, key});
        }
        const Corner start = start_of_star(c, at_u, at_v);
        if (!gather(start, u, v, at_border ? 1 : 2)) return refuse(key, Refusal::link);
        for (int i = 0; i < ring_size(); ++i) {
            if (!is_inside(ring_[i])) return;
        }
        if (size_ < (is_open_ ? 1 : 3) || has_repeated_vertex()) return refuse(key, Refusal::link);
        place_ring(u, v, t);
        const float x[3] = {batch_.x[0][0], batch_.x[1][0], batch_.x[2][0]};
        compute_planes(star_, size_, x);
        if (turns(star_, size_, least_cosine)) return refuse(key, Refusal::flip);
        is_creased_ = folds_inside(star_, size_, is_open_, crease_cosine);
        if ((is_creased_ && folds_inside(star_, size_, is_open_, fold_cosine)) || folds_outside())
            return refuse(key, Refusal::fold);
        collapse(c, u, v, x, shared_f, shared_g);
    }

    bool is_inside(Index v) const { return mesh_.vertices[v].cell == cell_; }

    bool is_at(int i, Index v) const { return mesh_.faces[corner_[i] >> 2].v[corner_[i] & 3] == v; }

    void place_ring(Index u, Index v, const Vector& t) {
        for (int i = 0; i < ring_size(); ++i) {
            const auto d = mesh_.difference(u, ring_[i]);
            for (unsigned j = 0; j < 3; ++j) star_.ring[j][i] = d[j];
        }
        const int padded = (size_ + lanes - 1) / lanes * lanes;
        for (unsigned j = 0; j < 3; ++j) {
            for (int i = ring_size(); i <= padded; ++i) star_.ring[j][i] = star_.ring[j][0];
            for (int i = 0; i < padded; ++i) star_.centre[j][i] = i < size_ && is_at(i, v) ? t[j] : 0;
        }
    }

    // Whether an edge of the ring becomes a fold, or might: where the face behind it is in another cell. Where a normal
    // turns by less than 34 degrees, its edge becomes no fold unless it was nearly one.
    bool folds_outside() {
        for (int i = 0; i < size_; ++i) {
            if (star_.along[i] > 0.827f * star_.before_length[i] * star_.after_length[i]) continue;
            const Corner across = mesh_.faces[corner_[i] >> 2].o[corner_[i] & 3];
            if (across == no_index) continue;
            const Face& outer = mesh_.faces[across >> 2];
            if (!is_inside(outer.v[across & 3])) return true;
            const auto [x, y, z] =
                cross(mesh_.difference(outer.v[0], outer.v[1]), mesh_.difference(outer.v[0], outer.v[2]));
            const float along = star_.normal[0][i] * x + star_.normal[1][i] * y + star_.normal[2][i] * z;
            const float both = star_.after_length[i] * length({x, y, z});
            if (along < fold_cosine * both) return true;
            is_creased_ = is_creased_ || along < crease_cosine * both;
        }
        return false;
    }

    void refuse(float& key, Refusal reason) {
        key = never;
        ++out_.refusals[static_cast<std::size_t>(reason)];
    }

    // \param c  opposite the edge
    void collapse(Corner c, Index u, Index v, const float (&x)[3], const Planes& shared_f,
                  const Planes& shared_g) {
        Vertex& at = mesh_.vertices[u];
        const auto t = mesh_.difference(u, v);
        const auto old = at.p;
        if (x[0] == t[0] && x[1] == t[1] && x[2] == t[2]) {
            at.p = mesh_.vertices[v].p;
            at.source = mesh_.vertices[v].source;
        } else {
            for (unsigned j = 0; j < 3; ++j) at.p[j] += static_cast<double>(x[j]);
            if (at.p != old) at.source = no_index;
        }
        const Corner dead[2] = {c, mesh_.faces[c >> 2].o[c & 3]};
        ++out_.collapses;
        if (patches_ == Recording::on) record(dead, u, v);
        if (mesh_.vertices[v].bent) at.bent = 1;
        mesh_.vertices[v].slot = no_index;
        for (int i = 0; i < size_; ++i) mesh_.faces[corner_[i] >> 2].v[corner_[i] & 3] = u;
        Planes sum = {};
        for (int i = 0; i < size_; ++i) {
            for (unsigned j = 0; j < 6; ++j) sum[j] += star_.after[j][i];
        }
        at.planes = sum;
        int last = size_ - 1;
        for (int i = 0; i < size_; last = i++) {
            Planes& q = mesh_.vertices[ring_[i]].planes;
            for (unsigned j = 0; j < 6; ++j) {
                q[j] +=
                    star_.after[j][i] - star_.before[j][i] + (star_.after[j][last] - star_.before[j][last]);
            }
        }
        for (const Corner d : dead) {
            if (d == no_index) continue;
            Face& f = mesh_.faces[d >> 2];
            const unsigned k = d & 3;
            Planes& q = mesh_.vertices[f.v[k]].planes;
            for (unsigned j = 0; j < 6; ++j) q[j] -= (d == c ? shared_f : shared_g)[j];
            unite(f.o[next(k)], f.o[previous(k)]);
            f.v[0] = no_index;
            for (unsigned j = 0; j < 3; ++j) mesh_.key((d & ~3u) + j) = never;
            ++out_.faces;
        }
        sum_bent(u, corner_[0]);
        for (int i = 0; i < size_; ++i) sum_bent(ring_[i], (corner_[i] & ~3u) | next(corner_[i] & 3));
        if (is_open_) sum_bent(ring_[size_], (corner_[size_ - 1] & ~3u) | previous(corner_[size_ - 1] & 3));
        update_keys(at, x);
    }

    // Sums the planes of a vertex anew if some may be along edges. Other cells do not change the faces around it.
    void sum_bent(Index v, Corner at) {
        Vertex& vertex = mesh_.vertices[v];
        if (vertex.lock || !(vertex.bent || is_creased_)) return;
        const Fan fan = fan_of(mesh_, mesh_.first_of_fan(at), Roots{mesh_});
        vertex.planes = fan.planes;
        vertex.bent = fan.bent;
    }

    void unite(Corner a, Corner b) {
        if (a != no_index) mesh_.faces[a >> 2].o[a & 3] = b;
        if (b != no_index) mesh_.faces[b >> 2].o[b & 3] = a;
    }

    void record(const Corner (&dead)[2], Index u, Index v) {
        const auto& p = mesh_.vertices[u].p;
        out_.steps.push_back({mesh_.vertices[u].slot, mesh_.vertices[v].slot, {p[0], p[1], p[2]}});
        out_.patch_begin.push_back(out_.patch_faces.size());
        for (const Corner d : dead) {
            if (d != no_index) out_.patch_faces.push_back(mesh_.faces[d >> 2].slot);
        }
        for (int i = 0; i < size_; ++i) out_.patch_faces.push_back(mesh_.faces[corner_[i] >> 2].slot);
    }

    // Costs of the edges from the new vertex.
    void update_keys(const Vertex& at, const float (&x)[3]) {
        for (int begin = 0; begin < ring_size(); begin += EdgeBatch::size) {
            const int end = std::min(begin + EdgeBatch::size, ring_size());
            for (int i = begin; i < end; ++i) {
                const Vertex& other = mesh_.vertices[ring_[i]];
                const bool starts = is_open_ && i == 0, ends = i == size_;
                const int last = i == 0 ? size_ - 1 : i - 1;
                Planes shared;
                for (unsigned j = 0; j < 6; ++j)
                    shared[j] = (ends ? 0.0f : star_.after[j][i]) + (starts ? 0.0f : star_.after[j][last]);
                if (at.bent && other.bent) add_edge_planes(mesh_, spoke(i), Roots{mesh_}, shared);
                put(batch_, i - begin, at.planes, other.planes, shared,
                    {star_.ring[0][i] - x[0], star_.ring[1][i] - x[1], star_.ring[2][i] - x[2]});
            }
            solve(batch_);
            for (int i = begin; i < end; ++i) {
                const Corner a = spoke(i), b = mesh_.faces[a >> 2].o[a & 3];
                const Vertex& other = mesh_.vertices[ring_[i]];
                restrict_to(other.lock ? Place::nowhere : mesh_.place(at, other), batch_, i - begin);
                const float key = batch_.cost[i - begin];
                if (b != no_index) mesh_.key(std::max(a, b)) = never;
                mesh_.key(std::min(a, b)) = key;
                if (key <= limit_) push({std::min(a, b), key});
            }
        }
    }

    // The corner opposite the edge from the new vertex to ring_[i].
    Corner spoke(int i) const {
        const Corner c = corner_[std::min(i, size_ - 1)];
        return (c & ~3u) | (i < size_ ? previous(c & 3) : next(c & 3));
    }

    static constexpr float least_cosine = 0.3f;

    Mesh& mesh_;
    unsigned bucket_ = 0;
    std::vector<Node> nodes_;
    std::array<std::uint32_t, buckets> first_, last_;
    std::uint32_t cell_;
    float limit_;
    Recording patches_;
    BlockSteps& out_;
    int size_ = 0;               // faces around the pair that remain
    bool is_open_ = false;       // there is a border at the pair: ring_[size_] is not ring_[0]
    bool is_creased_ = false;    // edges around the pair become creases
    Corner corner_[Star::room];  // their corners at the pair
    Index ring_[Star::room];     // see Star
    Star star_ = {};
    EdgeBatch batch_ = {};
};

}  // namespace rounds
}  // namespace detail
FAQEM_NAMESPACE_END
