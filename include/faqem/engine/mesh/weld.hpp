#pragma once
/// \file
/// Welding of vertices at the same position (paper, supplementary: pre-emptive merging).

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include "faqem/export.hpp"
#include "faqem/mesh.hpp"

FAQEM_ENGINE_BEGIN

namespace weld_detail {

/// The bit patterns of coordinates, which are equal to themselves even for NaN; those of -0 are those of 0.
using Key = std::array<std::uint64_t, 3>;

inline Key key_of(const Vec3& p) { return std::bit_cast<Key>(Vec3{p[0] + 0.0, p[1] + 0.0, p[2] + 0.0}); }

inline std::uint64_t hash(const Key& key) {
    std::uint64_t h = 0;
    for (const std::uint64_t x : key) {
        h ^= x;
        h *= 0x9e3779b97f4a7c15ull;
        h ^= h >> 29;
    }
    return h;
}

/// Open-addressing hash table of vertices. It is only used for lookups and never iterated, so that the hash
/// function does not affect results.
class VertexTable {
public:
    explicit VertexTable(std::size_t capacity) : slots_(std::bit_ceil(2 * capacity + 1), no_index) {}

    /// Calls match(vertex) for the vertices with the same or a colliding hash until it returns true.
    /// Returns that vertex's slot, or else a free slot.
    template <class Match>
    Index* find(const Key& key, Match&& match) {
        std::size_t i = hash(key) & (slots_.size() - 1);
        while (slots_[i] != no_index && !match(slots_[i])) i = (i + 1) & (slots_.size() - 1);
        return &slots_[i];
    }

private:
    std::vector<Index> slots_;
};

}  // namespace weld_detail

/// Welds vertices at exactly equal positions; -0 equals 0, and equal bit patterns of NaN are equal. O(n) expected
/// \param positions        model units or any other unit
/// \return per vertex, the smallest index of a vertex at the same position
inline std::vector<Index> weld_exact(const PositionView& positions) {
    std::vector<Index> representative(positions.size());
    weld_detail::VertexTable table(positions.size());
    for (Index v = 0; v < positions.size(); ++v) {
        const weld_detail::Key key = weld_detail::key_of(positions[v]);
        Index* slot = table.find(key, [&](Index w) { return weld_detail::key_of(positions[w]) == key; });
        if (*slot == no_index) *slot = v;
        representative[v] = *slot;
    }
    return representative;
}

/// Welds vertices within a distance: first as weld_exact(), then each remaining vertex, in the order of
/// their indices, with the first representative at most `distance` away. O(n) expected if few vertices
/// share a cell of size `distance`
/// \param positions        finite
/// \param distance         in the unit of `positions`, >= 0; 0: as weld_exact()
/// \return per vertex, the index of its representative
inline std::vector<Index> weld_within(const std::vector<Vec3>& positions, double distance) {
    std::vector<Index> representative = weld_exact(positions);
    if (!(distance > 0)) return representative;
    const auto cell_of = [&](const Vec3& p) -> Vec3 {
        return {std::floor(p[0] / distance), std::floor(p[1] / distance), std::floor(p[2] / distance)};
    };
    const auto is_near = [&](Index a, Index b) {
        const Vec3 &p = positions[a], &q = positions[b];
        const double x = p[0] - q[0], y = p[1] - q[1], z = p[2] - q[2];
        return x * x + y * y + z * z <= distance * distance;
    };
    // The representatives in a cell are a list linked by `next_in_cell`.
    weld_detail::VertexTable table(positions.size());
    std::vector<Index> next_in_cell(positions.size(), no_index);
    const auto head_of = [&](const Vec3& cell) {
        return table.find(weld_detail::key_of(cell), [&](Index w) { return cell_of(positions[w]) == cell; });
    };
    for (Index v = 0; v < positions.size(); ++v) {
        if (representative[v] != v) {
            representative[v] = representative[representative[v]];
            continue;
        }
        const Vec3 cell = cell_of(positions[v]);
        Index found = no_index;
        for (int i = 0; i < 27; ++i) {
            const int dx = i % 3 - 1, dy = i / 3 % 3 - 1, dz = i / 9 - 1;
            const Vec3 neighbour_cell = {cell[0] + dx, cell[1] + dy, cell[2] + dz};
            for (Index w = *head_of(neighbour_cell); w != no_index; w = next_in_cell[w])
                if (w < found && is_near(v, w)) found = w;
        }
        if (found != no_index) {
            representative[v] = found;
            continue;
        }
        Index* head = head_of(cell);
        if (*head == no_index) {
            *head = v;
        } else {
            next_in_cell[v] = next_in_cell[*head];
            next_in_cell[*head] = v;
        }
    }
    return representative;
}

FAQEM_ENGINE_END
