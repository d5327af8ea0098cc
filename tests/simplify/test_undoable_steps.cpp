#include "faqem/detail/simplify/undoable_steps.hpp"

#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace faqem;

TEST_CASE("steps are undone from the last one around a face, with those that depend on them") {
    // A grid of 8 x 8 squares, each of two triangles. Vertex (i, j) is j * 9 + i.
    const auto vertex = [](Index i, Index j) { return j * 9 + i; };
    engine::CollapseMesh mesh = test::collapse_mesh_of(test::grid(8));
    detail::UndoableSteps steps;
    const auto collapse = [&](Index survivor, Index removed) {
        steps.add(mesh, survivor, removed, mesh.position(survivor));
        mesh.collapse(survivor, removed, mesh.position(survivor));
    };
    // Faces around the first two vertices, around the second two, and with only one of these.
    Index left = no_index, between = no_index, below = no_index;
    mesh.for_each_face(vertex(1, 2), [&](Index f, unsigned) { left = f; });
    mesh.for_each_face(vertex(6, 5),
                       [&](Index f, unsigned) { (mesh.has_corner(f, vertex(6, 6)) ? between : below) = f; });
    collapse(vertex(1, 1), vertex(1, 2));
    collapse(vertex(6, 6), vertex(6, 5));
    collapse(vertex(6, 6), vertex(6, 7));
    const auto removed = [&] {
        std::vector<Index> result;
        steps.replay(mesh.face_slots(), [&](Index, Index v, const engine::Vector3&) { result.push_back(v); });
        return result;
    };
    CHECK(removed() == std::vector{vertex(1, 2), vertex(6, 5), vertex(6, 7)});
    SECTION("the last step, then the one before it") {
        REQUIRE(steps.undo_last(below));
        CHECK(removed() == std::vector{vertex(1, 2), vertex(6, 5)});
        REQUIRE(steps.undo_last(below));
        CHECK(removed() == std::vector{vertex(1, 2)});
        CHECK(!steps.undo_last(below));
        CHECK(steps.count() == 1);
    }
    SECTION("a step without later ones near it") {
        REQUIRE(steps.undo_last(left));
        CHECK(removed() == std::vector{vertex(6, 5), vertex(6, 7)});
    }
    SECTION("a step that another one depends on") {
        REQUIRE(steps.undo_last(between));
        CHECK(removed() == std::vector{vertex(1, 2)});
    }
}
