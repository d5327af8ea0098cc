#include "bake/atlas/segmentation.hpp"

#include <algorithm>
#include <cmath>
#include <compare>
#include <numbers>
#include <queue>
#include <tuple>
#include <utility>

#include "faqem/detail/base/vector.hpp"
#include "faqem/engine/mesh/union_find.hpp"

namespace faqem::detail {
namespace {

constexpr double max_normal_spread = 0.12;
constexpr double max_density_ratio = 2;
constexpr double perimeter_weight = 0.02;

struct SharedBoundary {
    Index region;
    double length;  // total length of the shared edges that are not creases

    auto operator<=>(const SharedBoundary&) const = default;
};

struct FaceRegion {
    double area = 0, perimeter = 0;
    Vector3 normal = Vector3::Zero();  // sum of the area vectors
    double min_density = 0, max_density = 0;
    std::vector<SharedBoundary> neighbours;  // sorted by region
    std::uint32_t version = 0;
    bool is_merged = false;

    double spread() const { return 2 * (area - normal.norm()); }
};

struct Merge {
    double cost;
    Index a, b;
    std::uint32_t version_a, version_b;

    bool operator<(const Merge& o) const {  // smallest cost on top, ties by smallest indices
        return std::tuple(o.cost, o.a, o.b) < std::tuple(cost, a, b);
    }
};

class RegionClustering {
public:
    explicit RegionClustering(std::span<const PageTriangle> faces)
        : regions_(faces.size()), merged_(faces.size()) {
        for (std::size_t f = 0; f < faces.size(); ++f) init_region(faces, static_cast<Index>(f));
        for (std::size_t f = 0; f < faces.size(); ++f) {
            for (const SharedBoundary& s : regions_[f].neighbours)
                if (s.region > f) enqueue_merge(static_cast<Index>(f), s.region);
        }
    }

    std::vector<std::vector<Index>> run(const engine::RunContext& context) {
        while (!queue_.empty()) {
            const Merge m = queue_.top();
            queue_.pop();
            const FaceRegion &a = regions_[m.a], &b = regions_[m.b];
            if (a.is_merged || b.is_merged || a.version != m.version_a || b.version != m.version_b) continue;
            context.count(merge(m.a, m.b));
        }
        std::vector<Index> number(regions_.size(), no_index);
        std::vector<std::vector<Index>> result;
        for (Index f = 0; f < regions_.size(); ++f) {
            const Index r = merged_.find(f);
            if (number[r] == no_index) {
                number[r] = static_cast<Index>(result.size());
                result.emplace_back();
            }
            result[number[r]].push_back(f);
        }
        return result;
    }

private:
    void init_region(std::span<const PageTriangle> faces, Index f) {
        const PageTriangle& face = faces[f];
        std::array<Vector3, 3> p;
        for (std::size_t i = 0; i < 3; ++i) p[i] = to_eigen(face.corners[i]) * face.density;
        FaceRegion& region = regions_[f];
        region.normal = engine::area_vector(p[0], p[1], p[2]) / 2;
        region.area = region.normal.norm();
        region.min_density = region.max_density = face.density;
        for (std::size_t c = 0; c < 3; ++c) {
            const double length = (p[(c + 2) % 3] - p[(c + 1) % 3]).norm();
            region.perimeter += length;
            const Index other = face.adjacent[c].triangle;
            if (other != no_index) region.neighbours.push_back({other, face.crease[c] ? 0 : length});
        }
        sort_and_combine(region.neighbours);
    }

    static void sort_and_combine(std::vector<SharedBoundary>& neighbours) {
        std::sort(neighbours.begin(), neighbours.end());
        std::size_t count = 0;
        for (const SharedBoundary& s : neighbours) {
            if (count > 0 && neighbours[count - 1].region == s.region)
                neighbours[count - 1].length += s.length;
            else
                neighbours[count++] = s;
        }
        neighbours.resize(count);
    }

    static double shared_length(const FaceRegion& region, Index other) {
        const auto is_before = [](const SharedBoundary& s, Index j) { return s.region < j; };
        return std::lower_bound(region.neighbours.begin(), region.neighbours.end(), other, is_before)->length;
    }

    void enqueue_merge(Index i, Index j) {
        if (i > j) std::swap(i, j);
        const FaceRegion &a = regions_[i], &b = regions_[j];
        const double shared = shared_length(a, j);
        if (!(shared > 0)) return;
        const double area = a.area + b.area;
        const Vector3 normal = a.normal + b.normal;
        if (!(normal.norm() >= (1 - max_normal_spread) * area)) return;
        const double low = std::min(a.min_density, b.min_density);
        if (!(std::max(a.max_density, b.max_density) <= max_density_ratio * low)) return;
        const double perimeter = a.perimeter + b.perimeter - 2 * shared;
        const double cost = 2 * (area - normal.norm()) - a.spread() - b.spread() +
                            perimeter_weight * perimeter * perimeter / (4 * std::numbers::pi);
        if (std::isfinite(cost)) queue_.push({cost, i, j, a.version, b.version});
    }

    // Returns the number of operations: about one per 16 entries of the changed lists of neighbours.
    std::uint64_t merge(Index i, Index j) {
        std::size_t visited = 16;
        // The region with more neighbours survives, so that fewer neighbour lists have to be updated.
        if (regions_[i].neighbours.size() < regions_[j].neighbours.size()) std::swap(i, j);
        FaceRegion &a = regions_[i], &b = regions_[j];
        a.perimeter += b.perimeter - 2 * shared_length(a, j);
        a.area += b.area;
        a.normal += b.normal;
        a.min_density = std::min(a.min_density, b.min_density);
        a.max_density = std::max(a.max_density, b.max_density);
        ++a.version;
        b.is_merged = true;
        merged_.unite(i, j);
        for (const SharedBoundary& s : b.neighbours) {
            if (s.region == i) continue;
            replace_neighbour(regions_[s.region].neighbours, j, i);
            visited += regions_[s.region].neighbours.size();
            a.neighbours.push_back(s);
        }
        std::erase_if(a.neighbours, [&](const SharedBoundary& s) { return s.region == j; });
        sort_and_combine(a.neighbours);
        std::vector<SharedBoundary>().swap(b.neighbours);
        for (const SharedBoundary& s : a.neighbours) enqueue_merge(i, s.region);
        return (visited + a.neighbours.size()) / 16;
    }

    static void replace_neighbour(std::vector<SharedBoundary>& neighbours, Index from, Index to) {
        for (SharedBoundary& s : neighbours)
            if (s.region == from) s.region = to;
        sort_and_combine(neighbours);
    }

    std::vector<FaceRegion> regions_;
    engine::UnionFind merged_;  // faces of one region
    std::priority_queue<Merge> queue_;
};

// Calls visit(j) for every neighbour faces[j] of faces[i].
template <class Visit>
void for_each_neighbour(std::span<const PageTriangle> all, std::span<const Index> faces, std::size_t i,
                        Visit&& visit) {
    for (const AdjacentTriangle& adjacent : all[faces[i]].adjacent) {
        if (adjacent.triangle == no_index) continue;
        const auto found = std::lower_bound(faces.begin(), faces.end(), adjacent.triangle);
        if (found != faces.end() && *found == adjacent.triangle)
            visit(static_cast<std::size_t>(found - faces.begin()));
    }
}

// Indices into `faces` of those that are connected to `start`, breadth-first. Marks them as seen; none of them is yet.
std::vector<std::size_t> breadth_first(std::span<const PageTriangle> all, std::span<const Index> faces,
                                       std::size_t start, std::vector<bool>& seen) {
    std::vector<std::size_t> order = {start};
    seen[start] = true;
    for (std::size_t k = 0; k < order.size(); ++k) {
        for_each_neighbour(all, faces, order[k], [&](std::size_t j) {
            if (seen[j]) return;
            seen[j] = true;
            order.push_back(j);
        });
    }
    return order;
}

}  // namespace

std::vector<std::vector<Index>> cluster_faces(std::span<const PageTriangle> faces,
                                              const engine::RunContext& context) {
    return RegionClustering(faces).run(context);
}

std::vector<std::vector<Index>> connected_subsets(std::span<const PageTriangle> all,
                                                  std::span<const Index> faces) {
    std::vector<std::vector<Index>> result;
    std::vector<bool> seen(faces.size(), false);
    for (std::size_t i = 0; i < faces.size(); ++i) {
        if (seen[i]) continue;
        std::vector<Index>& group = result.emplace_back();
        for (const std::size_t k : breadth_first(all, faces, i, seen)) group.push_back(faces[k]);
        std::sort(group.begin(), group.end());
    }
    return result;
}

std::array<std::vector<Index>, 2> bisect(std::span<const PageTriangle> all, std::span<const Index> faces) {
    std::vector<bool> seen(faces.size(), false), seen_again = seen;
    const std::size_t one = breadth_first(all, faces, 0, seen).back();
    const std::size_t other = breadth_first(all, faces, one, seen_again).back();
    std::vector<std::uint8_t> side(faces.size(), 2);
    std::array<std::vector<std::size_t>, 2> order = {{{one}, {other}}};
    std::array<std::size_t, 2> next = {0, 0};
    side[one] = 0;
    side[other] = 1;
    while (next[0] < order[0].size() || next[1] < order[1].size()) {
        // The half with fewer faces grows, as long as its front is not empty.
        std::size_t s = order[1].size() < order[0].size() ? 1 : 0;
        if (next[s] == order[s].size()) s = 1 - s;
        for_each_neighbour(all, faces, order[s][next[s]++], [&](std::size_t j) {
            if (side[j] != 2) return;
            side[j] = static_cast<std::uint8_t>(s);
            order[s].push_back(j);
        });
    }
    std::array<std::vector<Index>, 2> result;
    for (std::size_t i = 0; i < faces.size(); ++i) result[side[i]].push_back(faces[i]);
    return result;
}

}  // namespace faqem::detail
