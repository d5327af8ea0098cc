#pragma once
/// \file
/// Parts of the border of a surface that lie in a plane or on a line, as at a tile of a terrain. They stay there
/// during simplification.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "faqem/engine/mesh/vector.hpp"
#include "faqem/engine/quadric/placement.hpp"
#include "faqem/export.hpp"

FAQEM_ENGINE_BEGIN

/// The flats of a border, and where the vertices are. Without such parts both arrays are empty.
struct PlanarBorders {
    /// Entry of `at` for a vertex at which two flats meet.
    static constexpr Index corner = no_index - 1;

    std::vector<Flat> flats;
    std::vector<Index> at;  ///< per vertex: an index into `flats`, `corner`, or no_index

    /// The entry of a vertex that was merged from two others. O(1)
    static Index merged(Index a, Index b) {
        if (a == no_index || a == b) return b;
        return b == no_index ? a : corner;
    }
};

/// Finds the parts of a border that are straight or planar up to rounding.
class PlanarBorderSearch {
public:
    /// \param positions  one per vertex; borrowed
    /// \param triangles  indices into `positions`; borrowed
    PlanarBorderSearch(std::span<const Vector3> positions, std::span<const Triangle> triangles)
        : positions_(positions), triangles_(triangles) {}

    /// O(n log n) for n boundary edges; O(triangles) if a part is found
    /// \param edges  the boundary edges of the triangles
    PlanarBorders find(std::span<const std::array<Index, 2>> edges) {
        PlanarBorders result;
        if (edges.empty()) return result;
        Eigen::AlignedBox3d box;
        for (const Vector3& p : positions_) box.extend(p);
        tolerance_ = 1e-6 * box.diagonal().norm();
        for_each_path(edges, [&](std::vector<Index>& path) { split(path); });
        // Lines come last: they replace the planes in which they lie.
        std::stable_partition(chains_.begin(), chains_.end(), [](const Chain& c) { return !c.is_line; });
        remove_parts_of_flat_surfaces();
        if (chains_.empty()) return result;
        result.at.assign(positions_.size(), no_index);
        for (const Chain& chain : chains_) {
            const auto flat = static_cast<Index>(result.flats.size());
            for (const Index v : chain.vertices) {
                const bool is_end = v == chain.vertices.front() || v == chain.vertices.back();
                Index& at = result.at[v];
                at = chain.is_line && !is_end ? flat : PlanarBorders::merged(at, flat);
            }
            const Vector3& n = chain.axis;
            const Eigen::Matrix3d square = n * n.transpose();
            result.flats.push_back(
                {positions_[chain.vertices.front()],
                 chain.is_line ? square : Eigen::Matrix3d(Eigen::Matrix3d::Identity() - square)});
        }
        return result;
    }

private:
    /// Successive vertices of the border on a line or in a plane. The first is the last one, too, if the plane
    /// contains a whole loop.
    struct Chain {
        std::vector<Index> vertices;
        Vector3 axis;  ///< unit vector: direction of the line, or normal of the plane
        bool is_line;
    };

    static constexpr std::size_t least_edges = 16;

    /// A part of a path that starts at `begin`.
    struct Growth {
        std::size_t end;  ///< last vertex
        /// Vertices between the first and the last one at which the direction changes.
        std::size_t turns = 0;
        std::size_t first_turn;  ///< `end` if there is none
        std::size_t last_turn;
        Vector3 axis = Vector3::Zero();
    };

    // Calls visit(path) for each sequence of edges between vertices at which the border branches or ends, and for
    // each loop, whose first vertex is its last one.
    template <class Visit>
    static void for_each_path(std::span<const std::array<Index, 2>> edges, Visit&& visit) {
        std::vector<std::array<Index, 2>> ends;  // both directions of each edge
        for (const auto& [a, b] : edges) ends.push_back({a, b}), ends.push_back({b, a});
        std::sort(ends.begin(), ends.end());
        const auto index = [&](Index a, Index b) {
            return static_cast<std::size_t>(std::lower_bound(ends.begin(), ends.end(), std::array{a, b}) -
                                            ends.begin());
        };
        const auto continues = [&](Index v) { return index(v + 1, 0) - index(v, 0) == 2; };
        std::vector<bool> is_used(ends.size(), false);
        for (const bool is_loop : {false, true}) {
            for (std::size_t i = 0; i < ends.size(); ++i) {
                if (is_used[i] || (!is_loop && continues(ends[i][0]))) continue;
                std::vector<Index> path = {ends[i][0]};
                for (std::size_t k = i;;) {
                    const auto [from, to] = ends[k];
                    is_used[k] = is_used[index(to, from)] = true;
                    path.push_back(to);
                    if (to == path.front() || !continues(to)) break;
                    const std::size_t first = index(to, 0);
                    k = ends[first][1] == from ? first + 1 : first;
                }
                visit(path);
            }
        }
    }

    // Adds the chains of a path.
    void split(std::vector<Index>& path) {
        double length = 0;
        for (std::size_t i = 1; i < path.size(); ++i) length += (at(path, i) - at(path, i - 1)).norm();
        const std::size_t vertices = path.size();
        // A loop starts with the last straight part of a plane, and ends with all of it.
        if (path.front() == path.back()) {
            const Growth first = grow(path, 0, most_axes);
            if (first.end + 1 < path.size()) {
                const std::size_t start = first.last_turn;
                path.pop_back();
                std::rotate(path.begin(), path.begin() + static_cast<std::ptrdiff_t>(start), path.end());
                for (std::size_t i = 0; i <= first.end - start; ++i) path.push_back(path[i]);
            }
        }
        for (std::size_t i = 0; i + 1 < path.size();) {
            const Growth plane = grow(path, i, most_axes);
            if (plane.turns > 1) add(path, i, plane, length, false);
            i = plane.turns > 1 ? plane.last_turn : plane.first_turn;
        }
        path.resize(vertices);
        for (std::size_t i = 0; i + 1 < path.size();) {
            const Growth line = grow(path, i, 1);
            add(path, i, line, length, true);
            i = line.end;
        }
    }

    // Parts of few edges do not count: small modelled pieces have many, and their few faces are better spent elsewhere;
    // nor do short parts of a ragged border, as along the cells of a grid.
    void add(const std::vector<Index>& path, std::size_t begin, const Growth& part, double all,
             bool is_line) {
        double length = 0;
        for (std::size_t i = begin; i < part.end; ++i) length += (at(path, i + 1) - at(path, i)).norm();
        if (part.end - begin < least_edges || !(length >= least_share * all)) return;
        const auto first = path.begin() + static_cast<std::ptrdiff_t>(begin);
        chains_.push_back(
            {{first, first + static_cast<std::ptrdiff_t>(part.end - begin + 1)}, part.axis, is_line});
    }

    // The longest part from `begin` that is on a line (axes = 1) or in a plane (2). A plane is spanned by the two
    // points with the largest triangle so far. The tests allow for their errors, which grow with the distance.
    Growth grow(const std::vector<Index>& path, std::size_t begin, unsigned axes) const {
        const Vector3& a = at(path, begin);
        Growth part{begin, 0, 0, 0};
        Vector3 e1 = Vector3::Zero(), e2 = Vector3::Zero();
        Vector3 run_start = a, run_far = a;  // of the straight part at the end
        for (std::size_t j = begin + 1; j < path.size(); ++j) {
            const Vector3 p = at(path, j) - a, normal = e1.cross(e2);
            const double area = normal.norm(), with_1 = e1.cross(p).norm(), with_2 = p.cross(e2).norm();
            if (area > 0 && !(std::abs(normal.dot(p)) <= tolerance_ * (area + with_1 + with_2))) break;
            if (!is_on_line(run_far - run_start, a + p - run_start)) {
                if (axes == 1) break;
                if (part.turns++ == 0) part.first_turn = j - 1;
                part.last_turn = j - 1;
                run_start = at(path, j - 1);
                run_far = a + p;
            } else if ((a + p - run_start).squaredNorm() > (run_far - run_start).squaredNorm()) {
                run_far = a + p;
            }
            if (area > 0) {
                if (std::max(with_1, with_2) > area) (with_1 > with_2 ? e2 : e1) = p;
            } else if (!is_on_line(e1, p)) {
                e2 = p;
            } else if (p.squaredNorm() > e1.squaredNorm()) {
                e1 = p;
            }
            part.end = j;
        }
        if (part.turns == 0) part.first_turn = part.last_turn = part.end;
        part.axis = (axes == 1 ? e1 : Vector3(e1.cross(e2))).normalized();
        return part;
    }

    // Whether p is on the line through 0 and `along`, up to rounding of all three.
    bool is_on_line(const Vector3& along, const Vector3& p) const {
        const double length = along.norm();
        return !(along.cross(p).norm() > tolerance_ * (length + p.norm()));
    }

    // Removes the chains whose faces lie in one plane with them: the surface itself keeps them straight.
    void remove_parts_of_flat_surfaces() {
        std::vector<Index> chain_at(positions_.size(), no_index);
        std::vector<std::uint8_t> is_bent(chains_.size(), 0);
        for (const bool lines : {false, true}) {
            std::fill(chain_at.begin(), chain_at.end(), no_index);
            std::vector<Vector3> normals(chains_.size(), Vector3::Zero());
            for (Index c = 0; c < chains_.size(); ++c) {
                if (chains_[c].is_line != lines) continue;
                if (!lines) normals[c] = chains_[c].axis;
                for (const Index v : chains_[c].vertices) chain_at[v] = c;
            }
            for (const Triangle& t : triangles_) {
                for (unsigned k = 0; k < 3; ++k) {
                    const Index c = chain_at[t[k]];
                    if (c == no_index || c != chain_at[t[(k + 1) % 3]]) continue;
                    const Vector3 side = positions_[t[(k + 2) % 3]] - positions_[t[k]];
                    if (normals[c].isZero()) normals[c] = chains_[c].axis.cross(side).normalized();
                    is_bent[c] |= std::abs(normals[c].dot(side)) > 4 * tolerance_;
                }
            }
        }
        std::size_t c = 0;
        std::erase_if(chains_, [&](const Chain&) { return !is_bent[c++]; });
    }

    const Vector3& at(const std::vector<Index>& path, std::size_t i) const { return positions_[path[i]]; }

    static constexpr unsigned most_axes = 2;
    static constexpr double least_share = 1.0 / 16;  ///< of the length of a path

    std::span<const Vector3> positions_;
    std::span<const Triangle> triangles_;
    double tolerance_ = 0;
    std::vector<Chain> chains_;
};

FAQEM_ENGINE_END
