#pragma once

#include "faqem/export.hpp"
#include "faqem/detail/mapping/surface_patches.hpp"

#include <algorithm>
#include <array>

#include "faqem/engine/mesh/vector.hpp"
#include "faqem/detail/geometry/halfedges.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {
using engine::to_eigen;
using engine::Vector3;

struct Neighbour {
    Index face = no_index;
    bool same_winding = true;
};

// Of the angle between two faces at an edge: -1 where one continues the other.
inline constexpr double continues = -0.87, turns_off = -0.5;

// The two of three or more faces on an edge where one continues the other, and no third face continues either.
// Calls join(i, j), i < j, for each such pair. open(i): side i has no neighbour yet
template <class Open, class Join>
void for_each_continued(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                        std::span<const Side> on, Open&& open, Join&& join) {
    // More faces leave no room for pairs that are clear of others.
    constexpr std::size_t most = 6;
    if (on.size() < 3 || on.size() > most) return;
    const Vector3 start = to_eigen(positions[on[0].low]);
    const Vector3 edge = (to_eigen(positions[on[0].high]) - start).normalized();
    std::array<Vector3, most> into;  // each face, at right angles to the edge
    for (std::size_t i = 0; i < on.size(); ++i) {
        const Vector3 apex =
            to_eigen(positions[triangles[on[i].face][(std::size_t{on[i].corner} + 2) % 3]]) - start;
        into[i] = (apex - apex.dot(edge) * edge).normalized();
    }
    const auto clear = [&](std::size_t i, std::size_t but) {
        for (std::size_t k = 0; k < on.size(); ++k) {
            if (k != i && k != but && !(into[i].dot(into[k]) > turns_off)) return false;
        }
        return true;
    };
    for (std::size_t i = 0; i < on.size(); ++i) {
        for (std::size_t j = i + 1; j < on.size(); ++j) {
            if (open(i) && open(j) && into[i].dot(into[j]) <= continues && clear(i, j) && clear(j, i))
                join(i, j);
        }
    }
}

// Neighbours over the three edges of each face.
inline std::vector<Neighbour> neighbours(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                                  std::span<const Triangle> unwelded, engine::Poll poll) {
    std::vector<Neighbour> result(3 * triangles.size());
    for_each_edge(sorted_sides(triangles, poll), [&](std::span<const Side> on) {
        poll();
        const auto unwelded_edge = [&](std::size_t i) -> std::uint64_t {
            if (unwelded.empty()) return 0;
            const Triangle& t = unwelded[on[i].face];
            const Index from = t[on[i].corner], to = t[(on[i].corner + 1) % 3];
            return std::uint64_t{std::min(from, to)} << 32 | std::max(from, to);
        };
        const auto beyond = [&](std::size_t i) -> Neighbour& {
            return result[std::size_t{3} * on[i].face + on[i].corner];
        };
        const auto join = [&](std::size_t i, std::size_t j) {
            const bool same = on[i].goes_up != on[j].goes_up;
            beyond(i) = {on[j].face, same};
            beyond(j) = {on[i].face, same};
        };
        for_each_pair(on.size(), unwelded_edge, join);
        for_each_continued(
            positions, triangles, on, [&](std::size_t i) { return beyond(i).face == no_index; }, join);
    });
    return result;
}

inline double area(std::span<const Vec3> positions, const Triangle& t) {
    return engine::area_vector(to_eigen(positions[t[0]]), to_eigen(positions[t[1]]),
                               to_eigen(positions[t[2]]))
        .norm();
}

FAQEM_INLINE Sheets find_sheets(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                   std::span<const Triangle> unwelded, engine::Poll poll) {
    const std::vector<Neighbour> next = neighbours(positions, triangles, unwelded, poll);
    Sheets result;
    result.sheet.assign(triangles.size(), no_index);
    result.sign.assign(triangles.size(), 1);
    std::vector<Index> faces;  // of the sheet at hand, in breadth-first order
    Index sheets = 0;
    for (std::size_t root = 0; root < triangles.size(); ++root) {
        if (triangles[root][0] == no_index || result.sheet[root] != no_index) continue;
        faces.assign(1, static_cast<Index>(root));
        result.sheet[root] = sheets;
        double balance = 0;
        for (std::size_t i = 0; i < faces.size(); ++i) {
            poll();
            const Index f = faces[i];
            balance += result.sign[f] * area(positions, triangles[f]);
            for (std::size_t c = 0; c < 3; ++c) {
                const Neighbour& n = next[std::size_t{3} * f + c];
                if (n.face == no_index || result.sheet[n.face] != no_index) continue;
                result.sheet[n.face] = sheets;
                result.sign[n.face] =
                    static_cast<std::int8_t>(n.same_winding ? result.sign[f] : -result.sign[f]);
                faces.push_back(n.face);
            }
        }
        if (balance < 0) {
            for (Index f : faces) result.sign[f] = static_cast<std::int8_t>(-result.sign[f]);
        }
        result.begin.push_back(result.begin.back() + static_cast<Index>(faces.size()));
        ++sheets;
    }
    result.faces.resize(result.begin.back());
    std::vector<Index> next_place(result.begin.begin(), result.begin.end() - 1);
    for (std::size_t f = 0; f < triangles.size(); ++f) {
        poll();
        if (result.sheet[f] != no_index) result.faces[next_place[result.sheet[f]]++] = static_cast<Index>(f);
    }
    return result;
}

}  // namespace detail
FAQEM_NAMESPACE_END
