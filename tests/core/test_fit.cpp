#include "fit.hpp"

#include <catch2/catch.hpp>

using namespace faqem;
using detail::Pull;
using engine::Vector3;

namespace {

const std::vector<Triangle> one = {{0, 1, 2}};
const Vector3 up(0, 0, 1);

}  // namespace

TEST_CASE("fit: pulls of the same height at all corners lift the triangle by that, nearly") {
    std::vector<Pull> pulls;
    for (std::size_t k = 0; k < 3; ++k) {
        Pull pull{{0, {0, 0, 0}}, 0.5 * up, up};
        pull.spot.weight[k] = 1;
        pulls.push_back(pull);
    }
    const std::vector<std::uint8_t> free(3, 0);
    for (const Vector3& step : detail::fitting_step(one, pulls, free, 0.5)) {
        // Each vertex: (w + hold) step = w gap, with hold = 0.02 * 1.2 w / 3 and 2e-4 of the same.
        CHECK(step.z() == Approx(0.5 / (1 + 0.0202 * 1.2 / 3)).epsilon(1e-3));
        CHECK(step.head<2>().norm() < 1e-12);
    }
}

TEST_CASE("fit: fixed vertices stay, the others make up for them") {
    const std::vector<Pull> pulls = {{{0, {0.5, 0.5, 0}}, up, up}};
    const std::vector<std::uint8_t> fixed = {1, 0, 0};
    const std::vector<Vector3> steps = detail::fitting_step(one, pulls, fixed, 0.5);
    CHECK(steps[0] == Vector3::Zero());
    // Alone it would need to go twice as far: half of its move arrives at the middle of the edge.
    CHECK(steps[1].z() == Approx(2).epsilon(0.02));
    CHECK(steps[2].norm() < 1e-9);
}

TEST_CASE("fit: far pulls weigh more than near ones") {
    // Two pulls at one corner, up by 4 and down by 1: weights 2 and 1, so (2 * 4 - 1) / 3.
    const std::vector<Pull> pulls = {{{0, {1, 0, 0}}, 4 * up, up}, {{0, {1, 0, 0}}, -1 * up, up}};
    const std::vector<std::uint8_t> free(3, 0);
    CHECK(detail::fitting_step(one, pulls, free, 0.5)[0].z() == Approx(7.0 / 3).epsilon(0.02));
}

TEST_CASE("fit: without pulls nothing moves") {
    const std::vector<std::uint8_t> free(3, 0);
    for (const Vector3& step : detail::fitting_step(one, {}, free, 0.5)) CHECK(step == Vector3::Zero());
}

TEST_CASE("fit: a spot is where its weights say") {
    const std::vector<Vector3> x = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}};
    CHECK((detail::Spot{0, {0.25, 0.25, 0.5}}.on(x, one) - Vector3(0.25, 1, 0)).norm() < 1e-15);
}
