#include "mapping_sheets.hpp"

#include <algorithm>

#include "faqem/engine/vector.hpp"
#include "sides.hpp"

namespace faqem::detail {
namespace {

struct Neighbour {
    Index face = no_index;
    bool same_winding = true;
};

// Neighbours over the three edges of each face.
std::vector<Neighbour> neighbours(std::span<const Triangle> triangles, std::span<const Triangle> unwelded,
                                  engine::Poll poll) {
    std::vector<Neighbour> result(3 * triangles.size());
    for_each_edge(sorted_sides(triangles, poll), [&](std::span<const Side> on) {
        poll();
        const auto unwelded_edge = [&](std::size_t i) -> std::uint64_t {
            if (unwelded.empty()) return 0;
            const Triangle& t = unwelded[on[i].face];
            const Index from = t[on[i].corner], to = t[(on[i].corner + 1) % 3];
            return std::uint64_t{std::min(from, to)} << 32 | std::max(from, to);
        };
        for_each_pair(on.size(), unwelded_edge, [&](std::size_t i, std::size_t j) {
            const Side &a = on[i], &b = on[j];
            const bool same = a.goes_up != b.goes_up;
            result[std::size_t{3} * a.face + a.corner] = {b.face, same};
            result[std::size_t{3} * b.face + b.corner] = {a.face, same};
        });
    });
    return result;
}

double area(std::span<const Vec3> positions, const Triangle& t) {
    using engine::to_eigen;
    return engine::area_vector(to_eigen(positions[t[0]]), to_eigen(positions[t[1]]),
                               to_eigen(positions[t[2]]))
        .norm();
}

}  // namespace

Sheets find_sheets(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                   std::span<const Triangle> unwelded, engine::Poll poll) {
    const std::vector<Neighbour> next = neighbours(triangles, unwelded, poll);
    Sheets result{std::vector<Index>(triangles.size(), no_index),
                  std::vector<std::int8_t>(triangles.size(), 1)};
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
        ++sheets;
    }
    return result;
}

}  // namespace faqem::detail
