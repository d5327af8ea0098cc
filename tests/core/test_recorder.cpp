#include "faqem/engine/recorder.hpp"

#include <catch2/catch.hpp>
#include <set>
#include <type_traits>

#include "core/meshes.hpp"

using namespace faqem;
using namespace faqem::engine;

static_assert(std::is_empty_v<NoRecorder>, "recording nothing takes no room");

TEST_CASE("a collapse is recorded with both versions, the point and the faces at either end") {
    const TriangleMesh mesh = test::grid(2);
    Complex complex = test::complex_of(mesh);
    HistoryRecorder recorder(complex);
    CHECK(recorder.version(4) == 4);
    recorder.collapsing(complex, 4, 0, {{1, 2, 3}, 0});
    complex.collapse(4, 0, {1, 2, 3});
    recorder.collapsing(complex, 1, 4, {{4, 5, 6}, 0});
    complex.collapse(1, 4, {4, 5, 6});
    recorder.deleting(7);
    CHECK(recorder.version(1) == 10);
    const CollapseHistory h = recorder.take();
    REQUIRE(h.collapses.size() == 2);
    CHECK(h.collapses[0].first == 4);
    CHECK(h.collapses[0].second == 0);
    CHECK(h.collapses[0].position == Vec3{1, 2, 3});
    CHECK(h.collapses[1].first == 1);
    CHECK(h.collapses[1].second == 9);
    // Faces 0 and 1 lie between 0 and 4; 2, 3, 4, 6, 7 ... are the others at 4.
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
