#include "faqem/engine/recorder.hpp"

#include <set>
#include <type_traits>

#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace faqem;
using namespace faqem::engine;

static_assert(std::is_empty_v<NoRecorder>, "NoRecorder must not have data members");

TEST_CASE("recorder: a collapse is recorded with both vertices, the position and the faces around them") {
    const TriangleMesh mesh = test::grid(2);
    CollapseMesh collapse_mesh = test::collapse_mesh_of(mesh);
    HistoryRecorder recorder(collapse_mesh);
    CHECK(recorder.version(4) == 4);
    recorder.before_collapse(collapse_mesh, 4, 0, {{1, 2, 3}, 0});
    collapse_mesh.collapse(4, 0, {1, 2, 3});
    recorder.before_collapse(collapse_mesh, 1, 4, {{4, 5, 6}, 0});
    collapse_mesh.collapse(1, 4, {4, 5, 6});
    recorder.before_deletion(7);
    CHECK(recorder.version(1) == 10);
    const CollapseHistory h = recorder.take();
    REQUIRE(h.collapses.size() == 2);
    CHECK(h.collapses[0].first == 4);
    CHECK(h.collapses[0].second == 0);
    CHECK(h.collapses[0].position == Vec3{1, 2, 3});
    CHECK(h.collapses[1].first == 1);
    CHECK(h.collapses[1].second == 9);
    // Faces 0 and 1 contain vertices 0 and 4; the others contain vertex 4.
    const auto patch = [&](std::size_t k) {
        const auto faces = h.patch(k);
        return std::set<Index>(faces.begin(), faces.end());
    };
    CHECK(h.patch_begin == std::vector<std::uint64_t>{0, 6, 11});
    CHECK(patch(0) == std::set<Index>{0, 1, 3, 4, 6, 7});
    CHECK(patch(1) == std::set<Index>{2, 3, 4, 6, 7});
    REQUIRE(h.deleted_faces.size() == 1);
    CHECK(h.deleted_faces[0].time == 2);
    CHECK(h.deleted_faces[0].face == 7);
}

TEST_CASE("recorder: the history continues on a renumbered mesh with the same history indices") {
    //     3---2    History indices: vertices 10, 11, 12, 13, faces 20 and 21, first new vertex 30.
    //     | / |
    //     0---1
    CollapseMesh collapse_mesh = test::collapse_mesh_of(test::quad());
    HistoryRecorder recorder({10, 11, 12, 13}, {20, 21}, 30);
    const Triangle& first = collapse_mesh.triangle(0);
    const Index other = first[0] != 1 && first[1] != 1 && first[2] != 1 ? 0 : 1;  // the face without vertex 1
    recorder.add_collapse(0, 1, {5, 5, 5}, std::vector<Index>{0, 1});
    // The remaining triangle has slots 2, 0, 3, which become 0, 1, 2.
    recorder.renumber(std::vector<Index>{2, 0, 3}, std::vector<Index>{other});
    CHECK(recorder.version(0) == 12);
    CHECK(recorder.version(1) == 30);
    const CollapseMesh left({{1, 1, 0}, {5, 5, 5}, {0, 1, 0}}, {{0, 2, 1}});
    recorder.before_collapse(left, 2, 1, {{6, 6, 6}, 0});
    CHECK(recorder.version(2) == 31);
    const CollapseHistory h = recorder.take();
    REQUIRE(h.collapses.size() == 2);
    CHECK(h.collapses[0].first == 10);
    CHECK(h.collapses[0].second == 11);
    CHECK(h.collapses[1].first == 13);
    CHECK(h.collapses[1].second == 30);
    CHECK(h.collapses[1].position == Vec3{6, 6, 6});
    CHECK(h.patch_begin == std::vector<std::uint64_t>{0, 2, 3});
    CHECK(h.patch_faces == std::vector<Index>{20, 21, 20 + other});
}
