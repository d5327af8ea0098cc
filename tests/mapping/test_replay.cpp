#include "faqem/detail/mapping/replay.hpp"

#include <cmath>

#include "faqem/detail/mapping/successive_projection.hpp"
#include "support/catch.hpp"
#include "support/hand_history.hpp"

using namespace faqem;
using namespace faqem::test;

namespace {

// Faces that share the edge of vertices 0 and 1, at different angles.
TriangleMesh pages(Index faces) {
    TriangleMesh mesh;
    mesh.positions = {{0, 0, 0}, {0, 0, 1}};
    for (Index f = 0; f < faces; ++f) {
        const double angle = 6.28 * f / faces;
        mesh.triangles.push_back({0, 1, static_cast<Index>(mesh.positions.size())});
        mesh.positions.push_back({std::cos(angle), std::sin(angle), 0.5});
    }
    return mesh;
}

// The third vertices of all faces but two are collapsed into an end of the edge, one after the other. Every
// collapse concerns all faces that are left.
CollapseHistory collapsed_pages(Index faces) {
    const TriangleMesh mesh = pages(faces);
    HandHistory hand(mesh.positions, mesh.triangles);
    Index end = 0;
    for (Index f = 0; f + 2 < faces; ++f) end = hand.collapse(end, f + 2, {0, 0, 0});
    return hand.finish();
}

}  // namespace

TEST_CASE("the tables of a replay grow linearly with the number of faces that share an edge") {
    constexpr std::uint64_t largest = detail::max_entries_of_patch;
    std::uint64_t first = 0;
    for (const Index faces : {3000u, 6000u}) {
        const CollapseHistory history = collapsed_pages(faces);
        REQUIRE(history.patch_faces.size() > std::uint64_t{faces} * faces / 3);
        detail::ReplayTables replay = detail::replay_patches(history);
        const std::vector<Index> one_patch(faces, 0);
        detail::describe_patches(history, one_patch, {}, replay);
        // The patches have 3, 4 ... faces.
        CHECK(replay.corners.size() == largest * (largest + 1) / 2 - 3);
        CHECK(replay.previous.size() == replay.corners.size());
        CHECK(replay.bounds.size() == replay.corners.size());
        CHECK(replay.patch_component.size() == replay.corners.size());
        if (first != 0) CHECK(replay.corners.size() == first);
        first = replay.corners.size();
        for (std::size_t k = 0; k < history.patch_count(); ++k) {
            const bool is_small = history.patch(k).size() <= largest;
            if (replay.has_entries(history, k) != is_small) FAIL("patch " << k);
        }
        CHECK(replay.last_patches == std::vector<Index>(2, static_cast<Index>(history.patch_count() - 1)));
    }
}

TEST_CASE("points are mapped to the original where patches are too large for a walk") {
    const CollapseHistory history = collapsed_pages(3000);
    const detail::SuccessiveProjection map(history);
    REQUIRE(history.remaining_faces.size() == 2);
    for (Index face = 0; face < 2; ++face) {
        const SurfacePoint point = map.map(face, {0.2, 0.2, 0.6});
        CHECK(point.face == history.remaining_faces[face]);
        CHECK(std::abs(point.barycentric[2] - 0.6) < 1e-9);
    }
}

TEST_CASE("in an ordinary history, each face of each patch has an entry") {
    const CollapseHistory history = collapsed_pages(100);
    const detail::ReplayTables replay = detail::replay_patches(history);
    CHECK(replay.entry_begin.empty());
    CHECK(replay.corners.size() == history.patch_faces.size());
    for (std::size_t k = 0; k < history.patch_count(); ++k)
        CHECK(replay.first_entry(history, k) == history.patch_begin[k]);
}
