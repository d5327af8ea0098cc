#include "bake/atlas/triangle_pairs.hpp"

#include <algorithm>
#include <cmath>

namespace faqem::detail {
namespace {

constexpr std::uint8_t no_partner = 3;

// Lengths of the edges from a corner to the next one and to the one after it.
std::array<double, 2> legs_at(const PairTriangle& triangle, std::size_t corner) {
    return {triangle.edges[(corner + 2) % 3], triangle.edges[(corner + 1) % 3]};
}

// Texels of a triangle without a partner: its largest angle becomes a right angle, and it covers half of the
// rectangle over its two shorter edges.
double unpaired_texels(const PairTriangle& triangle) {
    const auto& e = triangle.edges;
    const double longest = std::max({e[0], e[1], e[2]});
    return longest > 0 ? e[0] * e[1] * e[2] / longest / 2 : 0;
}

// Sides of the rectangle for a triangle and its neighbour across the edge opposite `corner`.
std::array<double, 2> pair_sides(std::span<const PairTriangle> triangles, Index triangle,
                                 std::uint8_t corner) {
    const AdjacentTriangle& other = triangles[triangle].adjacent[corner];
    const auto a = legs_at(triangles[triangle], corner), b = legs_at(triangles[other.triangle], other.corner);
    return {shared_side(a[0], b[0]), shared_side(a[1], b[1])};
}

// Texels of the rectangle divided by those of the separate triangles; infinite where no pair is allowed.
double waste(std::span<const PairTriangle> triangles, Index t, std::uint8_t corner) {
    const AdjacentTriangle& other = triangles[t].adjacent[corner];
    if (other.triangle == no_index) return HUGE_VAL;
    const auto sides = pair_sides(triangles, t, corner);
    const double both = unpaired_texels(triangles[t]) + unpaired_texels(triangles[other.triangle]);
    const double result = sides[0] * sides[1] / both;
    return result <= max_waste ? result : HUGE_VAL;
}

class Matching {
public:
    explicit Matching(std::span<const PairTriangle> triangles)
        : triangles_(triangles), corner_(triangles.size(), no_partner), waste_(triangles.size()) {
        for (std::size_t t = 0; t < triangles.size(); ++t) {
            for (std::uint8_t c = 0; c < 3; ++c) waste_[t][c] = waste(triangles, static_cast<Index>(t), c);
        }
    }

    void greedy() {
        struct Candidate {
            double waste;
            Index triangle;
            std::uint8_t corner;
        };
        std::vector<Candidate> candidates;
        for (std::size_t i = 0; i < triangles_.size(); ++i) {
            const auto t = static_cast<Index>(i);
            for (std::uint8_t c = 0; c < 3; ++c) {
                if (waste_[t][c] < HUGE_VAL && t < triangles_[t].adjacent[c].triangle) {
                    candidates.push_back({waste_[t][c], t, c});
                }
            }
        }
        std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
            if (a.waste != b.waste) return a.waste < b.waste;
            return a.triangle != b.triangle ? a.triangle < b.triangle : a.corner < b.corner;
        });
        for (const Candidate& c : candidates) {
            if (corner_[c.triangle] == no_partner &&
                corner_[triangles_[c.triangle].adjacent[c.corner].triangle] == no_partner) {
                join(c.triangle, c.corner);
            }
        }
    }

    // Matches triangles without partners over augmenting paths: unpaired, pair, pair, ..., unpaired.
    void augment() {
        for (std::size_t t = 0; t < triangles_.size(); ++t) {
            if (corner_[t] == no_partner) find_augmenting_path(static_cast<Index>(t), 3);
        }
    }

    std::vector<std::uint8_t> corners() && { return std::move(corner_); }

private:
    void join(Index t, std::uint8_t corner) {
        const AdjacentTriangle& other = triangles_[t].adjacent[corner];
        corner_[t] = corner;
        corner_[other.triangle] = other.corner;
    }

    bool on_path(Index t) const { return std::find(path_.begin(), path_.end(), t) != path_.end(); }

    // Finds a partner for t, which is unpaired or whose pair is split by the current path. The rest of the
    // path may split at most `pairs` pairs.
    bool find_augmenting_path(Index t, int pairs) {
        path_.push_back(t);
        bool found = false;
        for (std::uint8_t c : by_waste(t)) {
            const Index other = triangles_[t].adjacent[c].triangle;
            if (!(waste_[t][c] < HUGE_VAL) || on_path(other)) continue;
            if (corner_[other] != no_partner) {
                if (pairs == 0) continue;
                const Index third = triangles_[other].adjacent[corner_[other]].triangle;
                if (on_path(third)) continue;
                path_.push_back(other);
                found = find_augmenting_path(third, pairs - 1);
                path_.pop_back();
                if (!found) continue;
            }
            join(t, c);
            found = true;
            break;
        }
        path_.pop_back();
        return found;
    }

    std::array<std::uint8_t, 3> by_waste(Index t) const {
        std::array<std::uint8_t, 3> order = {0, 1, 2};
        std::sort(order.begin(), order.end(), [&](std::uint8_t a, std::uint8_t b) {
            return waste_[t][a] != waste_[t][b] ? waste_[t][a] < waste_[t][b] : a < b;
        });
        return order;
    }

    std::span<const PairTriangle> triangles_;
    std::vector<std::uint8_t> corner_;
    std::vector<std::array<double, 3>> waste_;
    std::vector<Index> path_;
};

}  // namespace

std::vector<std::uint8_t> pair_triangles(std::span<const PairTriangle> triangles) {
    Matching matching(triangles);
    matching.greedy();
    matching.augment();
    return std::move(matching).corners();
}

}  // namespace faqem::detail
