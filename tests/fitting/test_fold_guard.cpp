#include "faqem/detail/fitting/fold_guard.hpp"

#include <cmath>

#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace faqem;
using detail::FoldGuard;
using engine::Vector3;

namespace {

// Two triangles at the edge 0 1 with the given dihedral angle; 180 degrees is flat.
std::vector<Vector3> opened(double degrees) {
    const double a = degrees * test::pi / 180;
    return {{0, 0, 0}, {0, 1, 0}, {1, 0.5, 0}, {std::cos(a), 0.5, std::sin(a)}};
}
const std::vector<Triangle> consistent_faces = {{0, 2, 1}, {0, 1, 3}};
const std::vector<Triangle> inconsistent_faces = {{0, 2, 1}, {1, 0, 3}};

int folds(const FoldGuard& guard, const std::vector<Vector3>& positions) {
    int count = 0;
    guard.for_each_fold(positions, [&](const Triangle&, const Triangle&) { ++count; });
    return count;
}

}  // namespace

TEST_CASE("fold guard: an edge is folded if its dihedral angle is below the limit") {
    // A cosine of -0.9 between the normals: 25.8 degrees.
    for (const auto& triangles : {consistent_faces, inconsistent_faces}) {
        const std::vector<Vector3> flat = opened(180);
        const FoldGuard guard({flat, triangles}, -0.9);
        CHECK(folds(guard, flat) == 0);
        CHECK(folds(guard, opened(27)) == 0);
        CHECK(folds(guard, opened(25)) == 1);
        CHECK(folds(guard, opened(-10)) == 1);
    }
}

TEST_CASE("fold guard: edges that are folded initially are ignored") {
    const std::vector<Vector3> closed = opened(5);
    const FoldGuard guard({closed, consistent_faces}, -0.9);
    CHECK(folds(guard, opened(3)) == 0);
}

TEST_CASE("fold guard: removed faces and edges with one or three faces are ignored") {
    std::vector<Vector3> positions = opened(5);
    positions.push_back({-1, 0.5, 0});
    const std::vector<Triangle> fin = {{0, 2, 1}, {no_index, no_index, no_index}, {0, 1, 3}, {0, 1, 4}};
    std::vector<Vector3> start = opened(180);
    start.push_back({0, 0.5, 1});
    CHECK(folds(FoldGuard({start, fin}, -0.9), positions) == 0);
}
