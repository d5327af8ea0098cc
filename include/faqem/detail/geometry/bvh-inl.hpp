#pragma once

#include "faqem/detail/geometry/bvh.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

FAQEM_DETAIL_BEGIN

using engine::RunContext;

/// Number of bins of the surface area heuristic.
inline constexpr int bins = 16;
/// Ranges of at most this many triangles are split at the median, so that the lowest nodes are full.
inline constexpr std::uint32_t max_halved_range = 16;
/// Maximum scale of the frame. A larger one could let lengths overflow or their squares underflow.
inline constexpr double max_scale = 1e90;

using Eigen::AlignedBox3d;

/// Half the surface area; 0 for an empty box.
inline double half_area(const AlignedBox3d& box) {
    if (box.isEmpty()) return 0;
    const Vector3 d = box.sizes();
    return d.x() * d.y() + d.y() * d.z() + d.z() * d.x();
}

/// State of one construction.
struct Bvh::Build {
    struct Item {
        AlignedBox3d box;
        Vector3 centre;  ///< of the box
        std::uint32_t triangle;
    };
    /// A range of `items`.
    struct Range {
        std::uint32_t begin, end;
        std::size_t depth;  ///< number of splits that produced the range
        std::uint32_t size() const { return end - begin; }
    };
    /// A range that is not split yet, and its node.
    struct PendingRange {
        Range range;
        std::uint32_t node;
    };

    std::vector<Item> items;

    /// Partitions the range by the surface area heuristic, evaluated at equidistant planes along one axis.
    /// \param centres  bounding box of the centres of the items
    /// \param axis     0, 1 or 2; the longest axis of `centres`
    /// \return the beginning of the second part, or `range.begin` if no split separates the items
    std::uint32_t split_by_sah(const Range& range, const AlignedBox3d& centres, int axis) {
        // Halved, because the difference of two very large doubles overflows.
        const double low = 0.5 * centres.min()[axis], extent = 0.5 * centres.max()[axis] - low;
        if (!(extent > 0)) return range.begin;
        const auto bin_of = [&](const Item& item) {
            return std::clamp(static_cast<int>((0.5 * item.centre[axis] - low) / extent * bins), 0, bins - 1);
        };
        std::array<AlignedBox3d, bins> boxes;
        std::array<std::uint32_t, bins> counts = {};
        for (std::uint32_t i = range.begin; i < range.end; ++i) {
            const auto bin = static_cast<std::size_t>(bin_of(items[i]));
            boxes[bin].extend(items[i].box);
            ++counts[bin];
        }
        std::array<double, bins> right_cost = {};
        AlignedBox3d box;
        std::uint32_t count = 0;
        for (std::size_t b = bins - 1; b > 0; --b) {
            box.extend(boxes[b]);
            count += counts[b];
            right_cost[b] = half_area(box) * count;
        }
        const std::uint32_t total = range.end - range.begin;
        double best_cost = std::numeric_limits<double>::infinity();
        int best = -1;
        box.setEmpty();
        count = 0;
        for (std::size_t b = 0; b + 1 < bins; ++b) {
            box.extend(boxes[b]);
            count += counts[b];
            if (count == 0 || count == total) continue;
            const double cost = half_area(box) * count + right_cost[b + 1];
            if (cost < best_cost) {
                best_cost = cost;
                best = static_cast<int>(b);
            }
        }
        if (best < 0) return range.begin;
        const auto middle = std::partition(items.begin() + range.begin, items.begin() + range.end,
                                           [&](const Item& item) { return bin_of(item) <= best; });
        return static_cast<std::uint32_t>(middle - items.begin());
    }

    /// Partitions the range near its median. If possible, the size of the first half is a multiple of
    /// `width`, so that its nodes are full.
    /// \return the beginning of the second half
    std::uint32_t halve(const Range& range, int axis) {
        const std::uint32_t half = range.size() / 2, fours = (half + width - 1) / width * width;
        const std::uint32_t middle = range.begin + (fours < range.size() ? fours : half);
        std::nth_element(items.begin() + range.begin, items.begin() + middle, items.begin() + range.end,
                         [axis](const Item& a, const Item& b) {
                             return std::pair(a.centre[axis], a.triangle) <
                                    std::pair(b.centre[axis], b.triangle);
                         });
        return middle;
    }

    /// Partitions the range along the longest axis of its centres.
    /// \return the beginning of the second part; both parts are nonempty
    std::uint32_t split(const Range& range) {
        AlignedBox3d centres;
        for (std::uint32_t i = range.begin; i < range.end; ++i) centres.extend(items[i].centre);
        int axis = 0;
        centres.sizes().maxCoeff(&axis);
        if (range.size() > max_halved_range && range.depth < sah_levels) {
            const std::uint32_t middle = split_by_sah(range, centres, axis);
            if (middle != range.begin) return middle;
        }
        return halve(range, axis);
    }

    /// Splits a range into up to `width` parts, always splitting the largest part.
    std::vector<Range> split_into_children(const Range& range) {
        std::vector<Range> all = {range};
        while (all.size() < width) {
            const auto longest = std::max_element(
                all.begin(), all.end(), [](const Range& a, const Range& b) { return a.size() < b.size(); });
            if (longest->size() == 1) break;
            const std::uint32_t middle = split(*longest);
            const std::size_t depth = longest->depth + 1;
            const Range rest{middle, longest->end, depth};
            *longest = {longest->begin, middle, depth};
            all.insert(longest + 1, rest);
        }
        return all;
    }
};

template <class Positions>
std::vector<Bvh::Corners> Bvh::corners(const Positions& positions, std::span<const Triangle> triangles) {
    std::vector<Corners> all;
    all.reserve(triangles.size());
    const auto position = [&](Index v) { return Vector3(positions[v][0], positions[v][1], positions[v][2]); };
    for (std::size_t f = 0; f < triangles.size(); ++f) {
        const auto [a, b, c] = triangles[f];
        if (a == no_index || b == no_index || c == no_index) continue;
        all.push_back({position(a), position(b), position(c), static_cast<Index>(f)});
    }
    return all;
}

FAQEM_INLINE Bvh::Bvh(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                      const RunContext& context)
    : Bvh(corners(positions, triangles), context) {}

FAQEM_INLINE Bvh::Bvh(std::span<const Vector3> positions, std::span<const Triangle> triangles,
                      const RunContext& context)
    : Bvh(corners(positions, triangles), context) {}

inline float round_down(double x) {
    const auto rounded = static_cast<float>(x);
    return rounded > x ? std::nextafter(rounded, -std::numeric_limits<float>::infinity()) : rounded;
}

inline float round_up(double x) { return -round_down(-x); }

FAQEM_INLINE Bvh::Query::Query(const Vector3& p, const Frame& frame) {
    const Vector3 local = frame(p);
    for (int i = 0; i < 3; ++i) {
        const auto x = static_cast<float>(local[i]);
        // Rounding to float here, and in double in the frame.
        const float error = 1.5e-7f * std::abs(x) + 1e-15f;
        low[static_cast<std::size_t>(i)] = x - error;
        high[static_cast<std::size_t>(i)] = x + error;
    }
}

FAQEM_INLINE Bvh::Ray::Ray(const Query& from, const Vector3& direction) : origin(from) {
    for (int i = 0; i < 3; ++i) {
        const auto x = static_cast<float>(direction[i]);
        constexpr float least = 1e-18f;
        inverse[static_cast<std::size_t>(i)] = 1 / (std::abs(x) >= least ? x : std::copysign(least, x));
    }
}

FAQEM_INLINE float Bvh::limit_in_frame(double distance_squared) const {
    return static_cast<float>(distance_squared * frame_.scale * frame_.scale * (1 + 1e-6)) +
           std::numeric_limits<float>::min();
}

FAQEM_INLINE Bvh::Bvh(std::vector<Corners> triangles, const RunContext& context) {
    if (triangles.empty()) return;
    assert(triangles.size() < leaf_bit);
    Build build;
    build.items.reserve(triangles.size());
    AlignedBox3d whole;
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        Build::Item item;
        for (const Vector3& p : {triangles[i].a, triangles[i].b, triangles[i].c}) item.box.extend(p);
        item.centre = 0.5 * item.box.min() + 0.5 * item.box.max();
        item.triangle = i;
        whole.extend(item.box);
        build.items.push_back(item);
    }
    frame_.centre = 0.5 * whole.min() + 0.5 * whole.max();
    const double half_width = (0.5 * whole.max() - 0.5 * whole.min()).maxCoeff();
    if (half_width > 0) frame_.scale = std::min(1 / half_width, max_scale);

    triangles_.reserve(triangles.size());
    nodes_.resize(1);
    std::vector<Build::PendingRange> todo = {{{0, static_cast<std::uint32_t>(triangles.size()), 0}, 0}};
    while (!todo.empty()) {
        const auto [range, at] = todo.back();
        todo.pop_back();
        context.count(range.size());
        for (const Build::Range& part : build.split_into_children(range)) {
            const std::uint32_t k = nodes_[at].count++;
            if (part.size() == 1) {
                nodes_[at].child[k] = static_cast<std::uint32_t>(triangles_.size()) | leaf_bit;
                triangles_.push_back(triangles[build.items[part.begin].triangle]);
            } else {
                nodes_[at].child[k] = static_cast<std::uint32_t>(nodes_.size());
                todo.push_back({part, nodes_[at].child[k]});
                nodes_.emplace_back();
            }
        }
    }
    fit_boxes();
}

FAQEM_INLINE void Bvh::refit(std::span<const Vector3> positions, std::span<const Triangle> triangles) {
    for (Corners& t : triangles_) {
        const auto [a, b, c] = triangles[t.face];
        t.a = positions[a], t.b = positions[b], t.c = positions[c];
    }
    fit_boxes();
}

FAQEM_INLINE void Bvh::fit_boxes() {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    for (std::size_t n = nodes_.size(); n-- > 0;) {  // children come after their parents
        Node& node = nodes_[n];
        for (std::size_t i = 0; i < 3; ++i) node.low[i].fill(infinity), node.high[i].fill(-infinity);
        for (std::uint32_t k = 0; k < node.count; ++k) {
            if (node.child[k] & leaf_bit) {
                const Corners& t = triangles_[node.child[k] & ~leaf_bit];
                AlignedBox3d box;
                for (const Vector3& p : {t.a, t.b, t.c}) box.extend(frame_(p));
                for (int i = 0; i < 3; ++i) {
                    node.low[static_cast<std::size_t>(i)][k] = round_down(box.min()[i]);
                    node.high[static_cast<std::size_t>(i)][k] = round_up(box.max()[i]);
                }
            } else {
                const Node& child = nodes_[node.child[k]];
                for (std::size_t i = 0; i < 3; ++i) {
                    node.low[i][k] = child.low[i].minCoeff();
                    node.high[i][k] = child.high[i].maxCoeff();
                }
            }
        }
    }
}

FAQEM_DETAIL_END
