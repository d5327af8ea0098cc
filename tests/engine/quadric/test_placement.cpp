#include "faqem/engine/quadric/placement.hpp"

#include "support/catch.hpp"

using namespace faqem;
using namespace faqem::engine;

namespace {

const Vector3 vertex_a(0, 0, 0), vertex_b(4, 0, 0);

Quadric plane_x(double x, double weight) { return Quadric::plane_through({1, 0, 0}, {x, 0, 0}, weight); }

}  // namespace

TEST_CASE("the optimal position of a well-conditioned quadric is its minimum") {
    Quadric q = plane_x(7, 1);
    q += Quadric::plane_through({0, 1, 0}, {0, 8, 0}, 1);
    q += Quadric::plane_through({0, 0, 1}, {0, 0, 9}, 1);
    CHECK(optimal_position(q, vertex_a, vertex_b, AllowedPosition::anywhere) == Vector3(7, 8, 9));
    CHECK(optimal_position(q, vertex_a, vertex_b, AllowedPosition::at_first) == vertex_a);
    CHECK(optimal_position(q, vertex_a, vertex_b, AllowedPosition::at_second) == vertex_b);
}

TEST_CASE("a singular quadric yields the best of both vertices and their midpoint") {
    // Paper, Sec. 3.1.
    CHECK(optimal_position(plane_x(0.5, 1), vertex_a, vertex_b, AllowedPosition::anywhere) == vertex_a);
    CHECK(optimal_position(plane_x(3.5, 1), vertex_a, vertex_b, AllowedPosition::anywhere) == vertex_b);
    CHECK(optimal_position(plane_x(2.5, 1), vertex_a, vertex_b, AllowedPosition::anywhere) ==
          Vector3(2, 0, 0));
}

TEST_CASE("among equally good positions the first vertex is preferred, then the second") {
    CHECK(optimal_position(Quadric(), vertex_a, vertex_b, AllowedPosition::anywhere) == vertex_a);
    CHECK(optimal_position(Quadric(), vertex_b, vertex_a, AllowedPosition::anywhere) == vertex_b);
    CHECK(optimal_position(plane_x(3, 1), vertex_a, vertex_b, AllowedPosition::anywhere) ==
          vertex_b);  // b and midpoint tie
    CHECK(optimal_position(plane_x(1, 1), vertex_a, vertex_b, AllowedPosition::anywhere) ==
          vertex_a);  // a and midpoint tie
    CHECK(optimal_position(plane_x(2, 1), vertex_a, vertex_b, AllowedPosition::anywhere) ==
          (vertex_a + vertex_b) / 2);  // a and b tie
}

TEST_CASE("the intersection of allowed positions is the stricter one, or none if they conflict") {
    using enum AllowedPosition;
    for (const AllowedPosition one : {anywhere, at_first, at_second, nowhere}) {
        CHECK(intersection(one, one) == one);
        CHECK(intersection(anywhere, one) == one);
        CHECK(intersection(one, anywhere) == one);
        CHECK(intersection(one, nowhere) == nowhere);
        CHECK(intersection(nowhere, one) == nowhere);
    }
    CHECK(intersection(at_first, at_second) == nowhere);
    CHECK(intersection(at_second, at_first) == nowhere);
}

TEST_CASE("a minimum outside the bounds is rejected") {
    Quadric q = plane_x(7, 1);
    q += Quadric::plane_through({0, 1, 0}, {0, 0, 0}, 1);
    q += Quadric::plane_through({0, 0, 1}, {0, 0, 0}, 1);
    const Eigen::AlignedBox3d wide(Vector3(0, 0, 0), Vector3(7, 0, 0)),
        narrow(Vector3(0, 0, 0), Vector3(6, 0, 0));
    CHECK(optimal_position(q, vertex_a, vertex_b, AllowedPosition::anywhere, &wide) == Vector3(7, 0, 0));
    CHECK(optimal_position(q, vertex_a, vertex_b, AllowedPosition::anywhere, &narrow) == vertex_b);
}

TEST_CASE("placement bounds extend the bounding box by a tenth of its diagonal") {
    const Eigen::AlignedBox3d bounds = placement_bounds({Vector3(0, 0, 1), Vector3(3, 4, 1)});
    CHECK(bounds.min() == Vector3(-0.5, -0.5, 0.5));
    CHECK(bounds.max() == Vector3(3.5, 4.5, 1.5));
}
