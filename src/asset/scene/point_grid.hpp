#pragma once
/// \file
/// Points that are near each other, where each point has a reach of its own.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "faqem/engine/mesh/weld.hpp"
#include "faqem/mesh.hpp"

namespace faqem::detail {

/// The largest difference of two coordinates.
inline double max_norm_distance(const Vec3& p, const Vec3& q) {
    return std::max({std::abs(p[0] - q[0]), std::abs(p[1] - q[1]), std::abs(p[2] - q[2])});
}

/// Grids of points, one for each power of two of their reach, so that a cell is about as large as the reach of its
/// points. Holds references to the arrays.
class PointGrid {
public:
    /// \param points  finite
    /// \param reach   one per point; those that are not > 0 are never found
    PointGrid(const std::vector<Vec3>& points, const std::vector<double>& reach)
        : points_(points), reach_(reach), next_(points.size(), no_index) {
        std::vector<std::pair<int, std::size_t>> counts;  // by size of the cells
        for (const double r : reach) {
            if (!(r > 0)) continue;
            const int size = cell_size(r);
            const auto at = std::ranges::lower_bound(counts, std::pair(size, std::size_t{0}));
            if (at != counts.end() && at->first == size)
                ++at->second;
            else
                counts.insert(at, {size, 1});
        }
        for (const auto& [size, count] : counts)
            levels_.push_back({size, engine::weld_detail::VertexTable(count)});
    }

    /// Adds a point whose reach is > 0. O(1) expected
    void insert(Index i) {
        const int size = cell_size(reach_[i]);
        const auto level = std::ranges::find_if(levels_, [&](const Level& l) { return l.size == size; });
        Index& head = *head_of(*level, cell_of(points_[i], size));
        if (head == no_index) {
            head = i;
        } else {
            next_[i] = next_[head];
            next_[head] = i;
        }
    }

    /// Calls visit(j) for added points j, among them all with max_norm_distance() <= min(reach[i], reach[j]) from point
    /// i, until it returns true. The order depends on the order of the calls of insert() alone.
    template <class Visit>
    void visit_near(Index i, Visit&& visit) {
        for (Level& level : levels_) {
            const double r = std::min(reach_[i], std::ldexp(1.0, level.size - 1));
            Vec3 p = points_[i], q = p;
            for (std::size_t k = 0; k < 3; ++k) p[k] -= r, q[k] += r;
            const Vec3 low = cell_of(p, level.size),
                       high = cell_of(q, level.size);  // the same or the next one
            for (unsigned corner = 0; corner < 8; ++corner) {
                Vec3 cell = low;
                bool is_new = true;
                for (std::size_t k = 0; k < 3; ++k) {
                    if (((corner >> k) & 1u) == 0) continue;
                    is_new = is_new && high[k] != low[k];
                    cell[k] = high[k];
                }
                if (!is_new) continue;
                for (Index j = *head_of(level, cell); j != no_index; j = next_[j])
                    if (visit(j)) return;
            }
        }
    }

private:
    struct Level {
        int size;
        engine::weld_detail::VertexTable table;  // the first point of each cell
    };

    // The exponent of the power of two that is the size of a cell: at least twice the reach, so that at most two cells
    // in each direction are within reach.
    static int cell_size(double reach) {
        int exponent = 0;
        std::frexp(reach, &exponent);
        return exponent + 1;
    }
    static Vec3 cell_of(const Vec3& p, int size) {
        return {std::floor(std::ldexp(p[0], -size)), std::floor(std::ldexp(p[1], -size)),
                std::floor(std::ldexp(p[2], -size))};
    }
    Index* head_of(Level& level, const Vec3& cell) {
        // Integers have few digits in binary, of which the hash needs many.
        Vec3 key = engine::weld_detail::without_negative_zero(cell);
        for (double& x : key) x *= 1.6180339887498949;
        return level.table.find(key, [&](Index j) { return cell_of(points_[j], level.size) == cell; });
    }

    const std::vector<Vec3>& points_;
    const std::vector<double>& reach_;
    std::vector<Index> next_;  // the next point of the same cell
    std::vector<Level> levels_;
};

}  // namespace faqem::detail
