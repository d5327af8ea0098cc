#include "asset/scene/rounding_weld.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <span>
#include <utility>

#include "asset/scene/affine.hpp"
#include "asset/scene/messages.hpp"
#include "asset/scene/position_rounding.hpp"
#include "faqem/detail/base/buckets.hpp"
#include "faqem/engine/mesh/index_lists.hpp"
#include "faqem/engine/mesh/weld.hpp"

namespace faqem::detail {
namespace {

constexpr double share_of_length = 1.0 / 4;  // the most that a tolerance may be
// The same, for the rounding of coordinates elsewhere.
constexpr double share_of_length_at_distance = 1.0 / 64;
constexpr double near_factor = 10;
constexpr int most_candidates = 1000;  // among which the partner of an edge is searched

/// The largest difference of two coordinates.
double max_norm_distance(const Vec3& p, const Vec3& q) {
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
        std::map<int, std::size_t> counts;  // by size of the cells
        for (const double r : reach)
            if (r > 0) ++counts[cell_size(r)];
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
            // The same or the next one.
            const Vec3 low = cell_of(p, level.size), high = cell_of(q, level.size);
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
        Vec3 spread = cell;
        for (double& x : spread) x *= 1.6180339887498949;
        return level.table.find(engine::weld_detail::key_of(spread),
                                [&](Index j) { return cell_of(points_[j], level.size) == cell; });
    }

    const std::vector<Vec3>& points_;
    const std::vector<double>& reach_;
    std::vector<Index> next_;  // the next point of the same cell
    std::vector<Level> levels_;
};

struct VertexPair {
    Index a, b;  // a < b
};

Triangle mapped(const Triangle& t, const std::vector<Index>& representative) {
    return {representative[t[0]], representative[t[1]], representative[t[2]]};
}

bool has_equal_corners(const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }

/// The boundary edges, in the order of their vertices.
std::vector<VertexPair> boundary_edges(const std::vector<Triangle>& triangles,
                                       const std::vector<Index>& representative) {
    struct Side {
        Index end, opposite;
    };
    Buckets<Side> sides(representative.size(), [&](auto&& put) {
        for (const Triangle& original : triangles) {
            const Triangle t = mapped(original, representative);
            if (has_equal_corners(t)) continue;
            for (std::size_t c = 0; c < 3; ++c) {
                const auto [a, b] = std::minmax(t[c], t[(c + 1) % 3]);
                put(a, Side{b, t[(c + 2) % 3]});
            }
        }
    });
    std::vector<VertexPair> found;
    for (Index a = 0; a < representative.size(); ++a) {
        const std::span<Side> own = std::span(sides.items()).subspan(sides.begin()[a], sides[a].size());
        std::ranges::sort(own, {}, [](const Side& side) { return std::pair(side.end, side.opposite); });
        for (std::size_t i = 0, next; i < own.size(); i = next) {
            for (next = i + 1; next < own.size() && own[next].end == own[i].end;) ++next;
            if (own[i].opposite == own[next - 1].opposite) found.push_back({a, own[i].end});
        }
    }
    return found;
}

/// By vertex, the length of the edges around it: of a face its second longest edge, so that needles do not count, and
/// the smallest of these.
std::vector<double> edge_lengths(const std::vector<Vec3>& positions, const std::vector<Triangle>& triangles,
                                 const std::vector<Index>& representative) {
    std::vector<double> length(positions.size(), std::numeric_limits<double>::infinity());
    for (const Triangle& original : triangles) {
        const Triangle t = mapped(original, representative);
        if (has_equal_corners(t)) continue;
        std::array<double, 3> edges;
        for (std::size_t c = 0; c < 3; ++c)
            edges[c] = max_norm_distance(positions[t[c]], positions[t[(c + 1) % 3]]);
        std::ranges::sort(edges);
        for (const Index v : t) length[v] = std::min(length[v], edges[1]);
    }
    return length;
}

/// The tolerances of the vertices of boundary edges; 0 for all others.
struct Tolerances {
    std::vector<double> weld, near;

    Tolerances(const std::vector<Vec3>& positions, const std::vector<Triangle>& triangles,
               const std::vector<Index>& representative, const std::vector<VertexPair>& edges,
               const CoordinateRounding& stored)
        : weld(positions.size(), 0), near(positions.size(), 0) {
        const std::vector<double> length = edge_lengths(positions, triangles, representative);
        double most = 0;
        PointBounds bounds;
        for (const Triangle& t : triangles) {
            for (const Index v : t) {
                most = std::max(most, max_norm_distance(positions[v], {}));
                bounds.add(positions[v]);
            }
        }
        const double most_rounding = stored.tolerance(most);
        const double float_rounding = near_factor * double{std::numeric_limits<float>::epsilon()} *
                                      max_norm_distance(bounds.low, bounds.high);
        const auto add = [&](Index v) {
            if (weld[v] > 0) return;
            const double own = stored.tolerance(max_norm_distance(positions[v], {}));
            const double rounding =
                std::min(most_rounding, std::max(own, share_of_length_at_distance * length[v]));
            weld[v] = std::min(rounding, share_of_length * length[v]);
            near[v] = std::min(std::max(near_factor * rounding, float_rounding), share_of_length * length[v]);
        };
        for (const VertexPair& edge : edges) add(edge.a), add(edge.b);
    }
};

/// Welds vertices on the boundary, one after the other.
class BoundaryWelder {
public:
    BoundaryWelder(const std::vector<Vec3>& positions, const std::vector<Triangle>& triangles,
                   const std::vector<Index>& representative, const std::vector<double>& tolerance)
        : positions_(positions),
          triangles_(triangles),
          representative_(representative),
          tolerance_(tolerance),
          welded_(engine::all_indices(positions.size())),
          faces_(positions.size(), [&](auto&& put) {
              for (Index f = 0; f < triangles.size(); ++f)
                  for (const Index v : mapped(triangles[f], representative))
                      if (tolerance[v] > 0) put(v, f);
          }) {}

    /// Returns, for every vertex that represents others, the one that it is welded to.
    std::vector<Index> operator()() {
        PointGrid grid(positions_, tolerance_);
        for (Index v = 0; v < welded_.size(); ++v) {
            if (!(tolerance_[v] > 0)) continue;
            double least = std::numeric_limits<double>::infinity();
            Index nearest = no_index;
            grid.visit_near(v, [&](Index w) {
                const double d = max_norm_distance(positions_[v], positions_[w]);
                if (!(d <= std::min(tolerance_[v], tolerance_[w]))) return false;
                if ((d < least || (d == least && w < nearest)) && !is_in_face_with(v, w))
                    least = d, nearest = w;
                return false;
            });
            if (nearest == no_index)
                grid.insert(v);
            else
                welded_[v] = nearest;
        }
        return std::move(welded_);
    }

private:
    // Whether a face of v has a corner that is w or was welded to it.
    bool is_in_face_with(Index v, Index w) const {
        for (const Index f : faces_[v])
            for (const Index corner : mapped(triangles_[f], representative_))
                if (welded_[corner] == w) return true;
        return false;
    }

    const std::vector<Vec3>& positions_;
    const std::vector<Triangle>& triangles_;
    const std::vector<Index>& representative_;
    const std::vector<double>& tolerance_;
    std::vector<Index> welded_;
    Buckets<Index> faces_;  // of the vertices that have a tolerance
};

/// Counts edges that have another edge nearby. Of edges that are near each other the middles are, too.
std::uint64_t count_near_edges(const std::vector<Vec3>& positions, const std::vector<VertexPair>& edges,
                               const std::vector<double>& reach_of_vertex) {
    std::vector<Vec3> middles;
    std::vector<double> reach;
    for (const auto [a, b] : edges) {
        const Vec3 &p = positions[a], &q = positions[b];
        middles.push_back({0.5 * p[0] + 0.5 * q[0], 0.5 * p[1] + 0.5 * q[1], 0.5 * p[2] + 0.5 * q[2]});
        reach.push_back(std::min(reach_of_vertex[a], reach_of_vertex[b]));
    }
    PointGrid grid(middles, reach);
    for (std::size_t e = 0; e < edges.size(); ++e)
        if (reach[e] > 0) grid.insert(static_cast<Index>(e));
    std::uint64_t count = 0;
    for (std::size_t e = 0; e < edges.size(); ++e) {
        if (!(reach[e] > 0)) continue;
        int candidates = 0;
        grid.visit_near(static_cast<Index>(e), [&](Index other) {
            if (other == e) return false;
            const double r = std::min(reach[e], reach[other]);
            const auto are_near = [&](Index a, Index b) {
                return max_norm_distance(positions[a], positions[b]) <= r;
            };
            const auto [a, b] = edges[e];
            const auto [c, d] = edges[other];
            const bool found = (are_near(a, c) && are_near(b, d)) || (are_near(a, d) && are_near(b, c));
            if (found) ++count;
            return found || ++candidates == most_candidates;
        });
    }
    return count;
}

}  // namespace

RoundingWeld find_rounding_weld(const std::vector<Vec3>& positions, const std::vector<Triangle>& triangles,
                                const StoredPrecision& stored) {
    RoundingWeld result;
    std::vector<Index> representative = engine::weld_exact(positions);
    std::vector<VertexPair> edges = boundary_edges(triangles, representative);
    if (edges.empty()) return result;
    const Tolerances tolerances(positions, triangles, representative, edges, {positions, stored});
    const std::vector<Index> welded = BoundaryWelder(positions, triangles, representative, tolerances.weld)();
    for (Index v = 0; v < welded.size(); ++v)
        if (welded[v] != v) ++result.welded;
    if (result.welded > 0) {
        for (Index& r : representative) r = welded[r];
        edges = boundary_edges(triangles, representative);
    }
    result.near_edges = count_near_edges(positions, edges, tolerances.near);
    if (result.welded > 0) {
        result.representative = std::move(representative);
        result.messages.push_back(pluralized(result.welded, "position") + " that differ" +
                                  (result.welded == 1 ? "s" : "") + " from another one by rounding welded");
    }
    if (result.near_edges > 0)
        result.messages.push_back(
            pluralized(result.near_edges, "boundary edge") + (result.near_edges == 1 ? " has" : " have") +
            " another one nearby and may be torn: welded only within a distance that is given");
    return result;
}

std::vector<std::string> weld_rounded_positions(Asset& asset) {
    std::vector<std::string> warnings;
    for (std::size_t p = 0; p < asset.parts.size(); ++p) {
        Part& part = asset.parts[p];
        const RoundingWeld found = find_rounding_weld(part.positions, part.triangles, asset.precision);
        found.apply(part.positions);
        for (const std::string& message : found.messages)
            warnings.push_back(part_title(asset, p) + ": " + message);
    }
    return warnings;
}

}  // namespace faqem::detail
