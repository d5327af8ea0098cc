#pragma once
/// \file
/// The collapses of one cell in one round.

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "faqem/detail/rounds/kernels.hpp"
#include "faqem/detail/rounds/round_mesh.hpp"
#include "faqem/engine/tracking/distance.hpp"
#include "faqem/export.hpp"
#include "faqem/option_types.hpp"
#include "faqem/report.hpp"

FAQEM_DETAIL_BEGIN
namespace rounds {

/// An edge, and its cost when it was queued.
struct EdgeKey {
    Corner corner;
    float key;
};

/// Collapses edges of one cell, cheapest first.
class CellCollapser {
public:
    CellCollapser(Mesh& mesh, std::uint32_t cell, float limit, Recording patches, RoundSteps& out)
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

    // Walks around the vertex at corner `from`, counterclockwise, up to the face `end`, which is not visited.
    bool gather(Corner from, Index end) {
        for (Corner c = from; c >> 2 != end;) {
            if (size_ == Star::most) return false;
            const Face& f = mesh_.faces[c >> 2];
            corner_[size_] = c;
            ring_[size_++] = f.v[next(c & 3)];
            const Corner across = f.o[next(c & 3)];
            if (across == no_index) return false;
            c = (across & ~3u) | next(across & 3);
        }
        return true;
    }

    // The corner of the next face around the vertex of corner c, counterclockwise.
    Corner turned(Corner c) const {
        const Corner across = mesh_.faces[c >> 2].o[next(c & 3)];
        return (across & ~3u) | next(across & 3);
    }

    bool has_repeated_vertex() const {
        for (int i = 1; i < size_; ++i) {
            for (int j = 0; j < i; ++j)
                if (ring_[i] == ring_[j]) return true;
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
        const Corner c = candidate.corner;
        float& key = mesh_.key(c);
        if (key != candidate.key) return;
        const Index f = c >> 2, g = mesh_.faces[f].o[c & 3] >> 2;
        const unsigned k = c & 3, m = mesh_.faces[f].o[c & 3] & 3;
        const Index u = mesh_.faces[f].v[next(k)], v = mesh_.faces[f].v[previous(k)];
        const Index apex_f = mesh_.faces[f].v[k], apex_g = mesh_.faces[g].v[m];
        if (!is_inside(apex_f) || !is_inside(apex_g)) return;
        const auto t = mesh_.difference(u, v);
        Planes shared_f = {}, shared_g = {}, shared;
        add_plane(t, mesh_.difference(u, apex_f), shared_f);
        add_plane(t, mesh_.difference(u, apex_g), shared_g);
        for (unsigned j = 0; j < 6; ++j) shared[j] = shared_f[j] + shared_g[j];
        put(batch_, 0, mesh_.vertices[u].planes, mesh_.vertices[v].planes, shared, t);
        solve(batch_, 0);
        if (!(batch_.cost[0] <= candidate.key)) {
            key = batch_.cost[0];
            if (!(key <= limit_)) return;
            if (bucket_of(key) > bucket_) return push({c, key});
        }
        size_ = 0;
        if (!gather(turned(4 * f + next(k)), g)) return refuse(key, Refusal::link);
        const int first = size_;  // number of faces around u
        if (!gather(turned(4 * g + next(m)), f)) return refuse(key, Refusal::link);
        for (int i = 0; i < size_; ++i)
            if (!is_inside(ring_[i])) return;
        if (size_ < 3 || first == 0 || first == size_ || has_repeated_vertex())
            return refuse(key, Refusal::link);
        place_ring(u, t, first);
        const float x[3] = {batch_.x[0][0], batch_.x[1][0], batch_.x[2][0]};
        compute_planes(star_, size_, x);
        if (turns(star_, size_, least_cosine)) return refuse(key, Refusal::flip);
        if (folds_inside(star_, size_) || folds_outside()) return refuse(key, Refusal::fold);
        if (mesh_.original) {
            const float cost = batch_.cost[0] + mesh_.distance_weight * squared_distance(f, g, u, x);
            if (!(cost <= candidate.key)) {
                key = cost;
                if (!(cost <= limit_)) return;
                if (bucket_of(cost) > bucket_) return push({c, cost});
            }
        }
        collapse(f, g, k, m, u, v, first, x, shared_f, shared_g);
    }

    // The largest squared distance after the collapse to x that engine::TrackedMetric would find.
    float squared_distance(Index f, Index g, Index u, const float (&x)[3]) {
        bound_.clear(), points_.clear(), after_.clear();
        gather_bound(f, u), gather_bound(g, u);
        const Vector to = {x[0], x[1], x[2]};
        for (int i = 0; i < size_; ++i) {
            gather_bound(corner_[i] >> 2, u);
            after_.emplace_back(to, Vector{star_.ring[0][i], star_.ring[1][i], star_.ring[2][i]},
                                Vector{star_.ring[0][i + 1], star_.ring[1][i + 1], star_.ring[2][i + 1]});
        }
        const auto [nearest, at] = points_.nearest(to);
        if (at == no_index) return 0;
        engine::Vector3 p = engine::to_eigen(mesh_.vertices[u].p);
        for (int j = 0; j < 3; ++j) p[j] += static_cast<double>(x[j]) * mesh_.unit;
        const double square = mesh_.unit * mesh_.unit;
        const double to_original =
            mesh_.original->squared_distance_to_ring(bound_[at], p, static_cast<double>(nearest) * square);
        return engine::farthest_squared(points_, after_, static_cast<float>(to_original / square));
    }

    // Appends the original vertices bound to face f, and their positions relative to vertex u.
    void gather_bound(Index f, Index u) {
        for (Index i = mesh_.first_bound[f]; i != no_index; i = mesh_.next_bound[i]) {
            const engine::Vector3& p = mesh_.original->position(i);
            const auto& from = mesh_.vertices[u].p;
            bound_.push_back(i);
            points_.add({static_cast<float>((p[0] - from[0]) * mesh_.scale),
                         static_cast<float>((p[1] - from[1]) * mesh_.scale),
                         static_cast<float>((p[2] - from[2]) * mesh_.scale)});
        }
    }

    // Binds the original vertices found by squared_distance() to the faces after the collapse.
    void rebind() {
        for (int i = 0; i < size_; ++i) mesh_.first_bound[corner_[i] >> 2] = no_index;
        engine::for_each_nearest(points_, after_, [&](std::size_t i, std::size_t k) {
            mesh_.next_bound[bound_[i]] = std::exchange(mesh_.first_bound[corner_[k] >> 2], bound_[i]);
        });
    }

    bool is_inside(Index v) const { return mesh_.vertices[v].cell == cell_; }

    void place_ring(Index u, const Vector& t, int first) {
        for (int i = 0; i < size_; ++i) {
            const auto d = mesh_.difference(u, ring_[i]);
            for (unsigned j = 0; j < 3; ++j) {
                star_.ring[j][i] = d[j];
                star_.centre[j][i] = i >= first ? t[j] : 0;
            }
        }
        const int padded = (size_ + lanes - 1) / lanes * lanes;
        for (unsigned j = 0; j < 3; ++j) {
            for (int i = size_; i <= padded; ++i) star_.ring[j][i] = star_.ring[j][0];
            for (int i = size_; i < padded; ++i) star_.centre[j][i] = 0;
        }
    }

    // Whether an edge of the ring becomes a fold, or might: where the face behind it is in another cell. Where a normal
    // turns by less than 34 degrees, its edge becomes no fold unless it was nearly one.
    bool folds_outside() const {
        for (int i = 0; i < size_; ++i) {
            if (star_.along[i] > 0.827f * star_.before_length[i] * star_.after_length[i]) continue;
            const Corner across = mesh_.faces[corner_[i] >> 2].o[corner_[i] & 3];
            if (across == no_index) continue;
            const Face& outer = mesh_.faces[across >> 2];
            if (!is_inside(outer.v[across & 3])) return true;
            const auto [x, y, z] =
                cross(mesh_.difference(outer.v[0], outer.v[1]), mesh_.difference(outer.v[0], outer.v[2]));
            const float along = star_.normal[0][i] * x + star_.normal[1][i] * y + star_.normal[2][i] * z;
            if (along < fold_cosine * star_.after_length[i] * length({x, y, z})) return true;
        }
        return false;
    }

    void refuse(float& key, Refusal reason) {
        key = never;
        ++out_.refusals[static_cast<std::size_t>(reason)];
    }

    void collapse(Index f, Index g, unsigned k, unsigned m, Index u, Index v, int first, const float (&x)[3],
                  const Planes& shared_f, const Planes& shared_g) {
        if (mesh_.original) rebind();
        Vertex& at = mesh_.vertices[u];
        const auto t = mesh_.difference(u, v);
        const auto old = at.p;
        if (x[0] == t[0] && x[1] == t[1] && x[2] == t[2]) {
            at.p = mesh_.vertices[v].p;
            at.source = mesh_.vertices[v].source;
        } else {
            for (unsigned j = 0; j < 3; ++j) at.p[j] += static_cast<double>(x[j]) * mesh_.unit;
            if (at.p != old) at.source = no_index;
        }
        ++out_.collapses;
        if (patches_ == Recording::on) record(f, g, u, v);
        if (!mesh_.merged_into.empty()) mesh_.merged_into[mesh_.vertices[v].slot] = at.slot;
        mesh_.vertices[v].slot = no_index;
        unite(mesh_.faces[f].o[next(k)], mesh_.faces[f].o[previous(k)]);
        unite(mesh_.faces[g].o[next(m)], mesh_.faces[g].o[previous(m)]);
        for (const Index dead : {f, g}) {
            mesh_.faces[dead].v[0] = no_index;
            for (unsigned j = 0; j < 3; ++j) mesh_.key(4 * dead + j) = never;
        }
        for (int i = first; i < size_; ++i) mesh_.faces[corner_[i] >> 2].v[corner_[i] & 3] = u;
        Planes sum = {};
        for (int i = 0; i < size_; ++i)
            for (unsigned j = 0; j < 6; ++j) sum[j] += star_.after[j][i];
        at.planes = sum;
        int last = size_ - 1;
        for (int i = 0; i < size_; last = i++) {
            Planes& q = mesh_.vertices[ring_[i]].planes;
            for (unsigned j = 0; j < 6; ++j) {
                q[j] +=
                    star_.after[j][i] - star_.before[j][i] + (star_.after[j][last] - star_.before[j][last]);
            }
        }
        for (unsigned j = 0; j < 6; ++j) {
            mesh_.vertices[ring_[0]].planes[j] -= shared_f[j];
            mesh_.vertices[ring_[first]].planes[j] -= shared_g[j];
        }
        update_keys(sum, x);
    }

    void unite(Corner a, Corner b) {
        mesh_.faces[a >> 2].o[a & 3] = b;
        mesh_.faces[b >> 2].o[b & 3] = a;
    }

    void record(Index f, Index g, Index u, Index v) {
        const auto& p = mesh_.vertices[u].p;
        out_.steps.push_back({mesh_.vertices[u].slot, mesh_.vertices[v].slot, {p[0], p[1], p[2]}});
        out_.patch_begin.push_back(out_.patch_faces.size());
        for (const Index dead : {f, g}) out_.patch_faces.push_back(mesh_.faces[dead].slot);
        for (int i = 0; i < size_; ++i) out_.patch_faces.push_back(mesh_.faces[corner_[i] >> 2].slot);
    }

    // Costs of the edges from the new vertex.
    void update_keys(const Planes& sum, const float (&x)[3]) {
        for (int begin = 0; begin < size_; begin += EdgeBatch::size) {
            const int end = std::min(begin + EdgeBatch::size, size_);
            for (int i = begin; i < end; ++i) {
                const int last = i == 0 ? size_ - 1 : i - 1;
                Planes shared;
                for (unsigned j = 0; j < 6; ++j) shared[j] = star_.after[j][i] + star_.after[j][last];
                put(batch_, i - begin, sum, mesh_.vertices[ring_[i]].planes, shared,
                    {star_.ring[0][i] - x[0], star_.ring[1][i] - x[1], star_.ring[2][i] - x[2]});
            }
            solve(batch_);
            for (int i = begin; i < end; ++i) {
                const Corner a = (corner_[i] & ~3u) | previous(corner_[i] & 3);
                const Corner b = mesh_.faces[a >> 2].o[a & 3];
                const float key = mesh_.vertices[ring_[i]].lock ? never : batch_.cost[i - begin];
                mesh_.key(std::min(a, b)) = key;
                mesh_.key(std::max(a, b)) = never;
                if (key <= limit_) push({std::min(a, b), key});
            }
        }
    }

    static constexpr float least_cosine = 0.3f;

    Mesh& mesh_;
    unsigned bucket_ = 0;
    std::vector<Node> nodes_;
    std::array<std::uint32_t, buckets> first_, last_;
    std::uint32_t cell_;
    float limit_;
    Recording patches_;
    RoundSteps& out_;
    int size_ = 0;               // faces around the pair that remain
    Corner corner_[Star::room];  // their corners at the pair
    Index ring_[Star::room];     // see Star
    Star star_ = {};
    EdgeBatch batch_ = {};
    // Original vertices bound to the faces around the pair, and the faces after the collapse, relative to the first
    // vertex of the pair.
    std::vector<Index> bound_;
    engine::BasicPointBatches<float> points_;
    std::vector<engine::BasicTriangleDistance<float>> after_;
};

}  // namespace rounds
FAQEM_DETAIL_END
