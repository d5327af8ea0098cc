#include "bvh.hpp"

#include <algorithm>
#include <utility>

namespace faqem::detail {

namespace {

using engine::Vector3;

constexpr std::uint32_t leaf_size = 4;
constexpr int bins = 16;

struct Box {
    Vector3 low = Vector3::Constant(std::numeric_limits<double>::infinity());
    Vector3 high = Vector3::Constant(-std::numeric_limits<double>::infinity());

    void add(const Vector3& p) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    void add(const Box& other) {
        low = low.cwiseMin(other.low);
        high = high.cwiseMax(other.high);
    }
    /// Half the surface; 0 for a box nothing was added to.
    double half_area() const {
        if (!(low.x() <= high.x())) return 0;
        const Vector3 d = high - low;
        return d.x() * d.y() + d.y() * d.z() + d.z() * d.x();
    }
};

}  // namespace

/// The state of one construction.
struct Bvh::Build {
    struct Item {
        Box box;
        Vector3 centre;  ///< of the box
        std::uint32_t triangle;
    };
    struct Range {
        std::uint32_t begin, end;
        std::uint32_t parent;  ///< whose right child this is; no_index: the root or a left child
        int depth;
    };

    std::vector<Item> items;

    /// Surface-area heuristic over bins of the longest axis; returns begin where it finds no split.
    std::uint32_t split_by_area(const Range& range, const Box& centres, int axis) {
        const double low = centres.low[axis], width = centres.high[axis] - low;
        if (!(width > 0)) return range.begin;
        const auto bin_of = [&](const Item& item) {
            return std::clamp(static_cast<int>((item.centre[axis] - low) / width * bins), 0, bins - 1);
        };
        std::array<Box, bins> boxes;
        std::array<std::uint32_t, bins> counts = {};
        for (std::uint32_t i = range.begin; i < range.end; ++i) {
            const auto bin = static_cast<std::size_t>(bin_of(items[i]));
            boxes[bin].add(items[i].box);
            ++counts[bin];
        }
        std::array<double, bins> right_cost = {};
        Box box;
        std::uint32_t count = 0;
        for (std::size_t b = bins - 1; b > 0; --b) {
            box.add(boxes[b]);
            count += counts[b];
            right_cost[b] = box.half_area() * count;
        }
        const std::uint32_t total = range.end - range.begin;
        double best_cost = std::numeric_limits<double>::infinity();
        int best = -1;
        box = {};
        count = 0;
        for (std::size_t b = 0; b + 1 < bins; ++b) {
            box.add(boxes[b]);
            count += counts[b];
            if (count == 0 || count == total) continue;
            const double cost = box.half_area() * count + right_cost[b + 1];
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

    std::uint32_t split(const Range& range) {
        Box centres;
        for (std::uint32_t i = range.begin; i < range.end; ++i) centres.add(items[i].centre);
        int axis = 0;
        (centres.high - centres.low).maxCoeff(&axis);
        if (range.depth < sah_levels) {
            const std::uint32_t middle = split_by_area(range, centres, axis);
            if (middle != range.begin) return middle;
        }
        const std::uint32_t middle = range.begin + (range.end - range.begin) / 2;
        std::nth_element(items.begin() + range.begin, items.begin() + middle, items.begin() + range.end,
                         [axis](const Item& a, const Item& b) {
                             return std::pair(a.centre[axis], a.triangle) <
                                    std::pair(b.centre[axis], b.triangle);
                         });
        return middle;
    }

    Box bounds(const Range& range) const {
        Box box;
        for (std::uint32_t i = range.begin; i < range.end; ++i) box.add(items[i].box);
        return box;
    }
};

template <class Positions>
std::vector<Bvh::Corners> Bvh::corners(const Positions& positions, std::span<const Triangle> triangles) {
    std::vector<Corners> all;
    all.reserve(triangles.size());
    const auto place = [&](Index v) { return Vector3(positions[v][0], positions[v][1], positions[v][2]); };
    for (std::size_t f = 0; f < triangles.size(); ++f) {
        const auto [a, b, c] = triangles[f];
        if (a == no_index || b == no_index || c == no_index) continue;
        all.push_back({place(a), place(b), place(c), static_cast<Index>(f)});
    }
    return all;
}

Bvh::Bvh(std::span<const Vec3> positions, std::span<const Triangle> triangles)
    : Bvh(corners(positions, triangles)) {}

Bvh::Bvh(std::span<const Vector3> positions, std::span<const Triangle> triangles)
    : Bvh(corners(positions, triangles)) {}

Bvh::Bvh(std::vector<Corners> triangles) : triangles_(std::move(triangles)) {
    if (triangles_.empty()) return;
    Build build;
    build.items.reserve(triangles_.size());
    for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
        Build::Item item;
        for (const Vector3& p : {triangles_[i].a, triangles_[i].b, triangles_[i].c}) item.box.add(p);
        item.centre = 0.5 * item.box.low + 0.5 * item.box.high;
        item.triangle = i;
        build.items.push_back(item);
    }

    nodes_.reserve(build.items.size());
    std::vector<Build::Range> todo = {{0, static_cast<std::uint32_t>(build.items.size()), no_index, 0}};
    while (!todo.empty()) {
        const Build::Range range = todo.back();
        todo.pop_back();
        const auto node = static_cast<std::uint32_t>(nodes_.size());
        if (range.parent != no_index) nodes_[range.parent].first = node;
        const Box box = build.bounds(range);
        nodes_.push_back({box.low, box.high, 0, 0});
        if (range.end - range.begin <= leaf_size) {
            nodes_[node].first = range.begin;
            nodes_[node].count = range.end - range.begin;
            continue;
        }
        const std::uint32_t middle = build.split(range);
        // The left child is taken next, so it follows its parent.
        todo.push_back({middle, range.end, node, range.depth + 1});
        todo.push_back({range.begin, middle, no_index, range.depth + 1});
    }

    std::vector<Corners> in_order;
    in_order.reserve(triangles_.size());
    for (const Build::Item& item : build.items) in_order.push_back(triangles_[item.triangle]);
    triangles_ = std::move(in_order);
    for (const Node& node : nodes_) {  // the order inside a leaf must not depend on std::partition
        std::sort(triangles_.begin() + node.first, triangles_.begin() + node.first + node.count,
                  [](const Corners& a, const Corners& b) { return a.face < b.face; });
    }
}

void Bvh::refit(std::span<const Vector3> positions, std::span<const Triangle> triangles) {
    for (Corners& t : triangles_) {
        const auto [a, b, c] = triangles[t.face];
        t.a = positions[a], t.b = positions[b], t.c = positions[c];
    }
    for (std::size_t i = nodes_.size(); i-- > 0;) {  // children come after their parents
        Node& node = nodes_[i];
        Box box;
        for (std::uint32_t k = node.first; k < node.first + node.count; ++k) {
            for (const Vector3& p : {triangles_[k].a, triangles_[k].b, triangles_[k].c}) box.add(p);
        }
        if (node.count == 0) {
            for (const Node& child : {nodes_[i + 1], nodes_[node.first]}) box.add(Box{child.low, child.high});
        }
        node.low = box.low;
        node.high = box.high;
    }
}

}  // namespace faqem::detail
