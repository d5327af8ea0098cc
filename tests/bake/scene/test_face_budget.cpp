#include "bake/scene/face_budget.hpp"

#include <cmath>

#include "support/catch.hpp"

using namespace faqem;
using detail::cost_weights;

namespace {

// An instance that is scaled along the axes. It is translated too, which must not affect the weights.
Instance scaled_instance(Index part, double x, double y, double z) {
    return {part, {x, 0, 0, 0, 0, y, 0, 0, 0, 0, z, 0, 100, 200, 300, 1}};
}

}  // namespace

TEST_CASE("cost weights are the fourth power of the scale summed over the instances") {
    const std::vector<Instance> placed = {scaled_instance(0, 1, 1, 1), scaled_instance(1, 2, 2, 2),
                                          scaled_instance(0, -2, 2, 2)};
    CHECK(cost_weights(2, placed) == std::vector<double>{1 + 16, 16});
}

TEST_CASE("cost weights do not depend on rotation") {
    const double c = std::cos(0.3), s = std::sin(0.3);
    const std::vector<Instance> turned = {
        {0, {3 * c, 3 * s, 0, 0, -3 * s, 3 * c, 0, 0, 0, 0, 3, 0, 0, 0, 0, 1}}};
    CHECK(cost_weights(1, turned)[0] == Approx(81));
}

TEST_CASE("cost weights of flattened parts use the remaining axes and are 1 without size or instance") {
    const std::vector<Instance> placed = {scaled_instance(0, 3, 3, 0), scaled_instance(1, 0, 0, 0)};
    const std::vector<double> weights = cost_weights(3, placed);
    CHECK(weights[0] == Approx(36));
    CHECK(weights[1] == 1);
    CHECK(weights[2] == 1);
    CHECK(cost_weights(0, {}).empty());
}
