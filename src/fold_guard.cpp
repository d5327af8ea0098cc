#include "fold_guard.hpp"

#include <algorithm>
#include <tuple>

namespace faqem::detail {

namespace {

struct Side {
    Index low, high, face;
    bool goes_up;
};

std::vector<Side> sorted_sides(std::span<const Triangle> triangles) {
    std::vector<Side> sides;
    for (Index f = 0; f < triangles.size(); ++f) {
        const Triangle& t = triangles[f];
        if (t[0] == no_index) continue;
        for (std::size_t k = 0; k < 3; ++k) {
            const Index a = t[k], b = t[(k + 1) % 3];
            sides.push_back({std::min(a, b), std::max(a, b), f, a < b});
        }
    }
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
        return std::tie(a.low, a.high, a.face) < std::tie(b.low, b.high, b.face);
    });
    return sides;
}

}  // namespace

FoldGuard::FoldGuard(const Patchwork& mesh, double least_fold)
    : triangles_(mesh.triangles), least_fold_(least_fold) {
    const std::vector<engine::Vector3> normals = unit_normals(mesh);
    const std::vector<Side> sides = sorted_sides(triangles_);
    for (std::size_t i = 0; i < sides.size();) {
        std::size_t end = i + 1;
        while (end < sides.size() && sides[end].low == sides[i].low && sides[end].high == sides[i].high)
            ++end;
        if (end == i + 2) {
            const Edge edge{{sides[i].face, sides[i + 1].face}, sides[i].goes_up == sides[i + 1].goes_up};
            if (!is_fold(edge, normals)) edges_.push_back(edge);
        }
        i = end;
    }
}

}  // namespace faqem::detail
