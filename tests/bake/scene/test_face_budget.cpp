#include "bake/scene/face_budget.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace faqem;
using detail::cost_weights;

namespace {

// Stretched along the axes, and moved, which must not count.
Instance stretched(Index part, double x, double y, double z) {
    return {part, {x, 0, 0, 0, 0, y, 0, 0, 0, 0, z, 0, 100, 200, 300, 1}};
}

}  // namespace

TEST_CASE("a part counts by the fourth power of its scale, once for each place it is at") {
    const std::vector<Instance> placed = {stretched(0, 1, 1, 1), stretched(1, 2, 2, 2),
                                          stretched(0, -2, 2, 2)};
    CHECK(cost_weights(2, placed) == std::vector<double>{1 + 16, 16});
}

TEST_CASE("turning a part changes nothing") {
    const double c = std::cos(0.3), s = std::sin(0.3);
    const std::vector<Instance> turned = {
        {0, {3 * c, 3 * s, 0, 0, -3 * s, 3 * c, 0, 0, 0, 0, 3, 0, 0, 0, 0, 1}}};
    CHECK(cost_weights(1, turned)[0] == Approx(81));
}

TEST_CASE("a part squashed flat counts by what is left, one without size or place as it is") {
    const std::vector<Instance> placed = {stretched(0, 3, 3, 0), stretched(1, 0, 0, 0)};
    const std::vector<double> weights = cost_weights(3, placed);
    CHECK(weights[0] == Approx(36));
    CHECK(weights[1] == 1);
    CHECK(weights[2] == 1);
    CHECK(cost_weights(0, {}).empty());
}
