#include "scene/parts/face_budget.hpp"

#include <cmath>

#include "scene/weights/visibility.hpp"
#include "support/catch.hpp"
#include "support/scenes.hpp"

using namespace faqem;
using detail::cost_weights;
using detail::proportional_shares;

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

TEST_CASE("proportional shares count faces, and only the vertices that are not hidden") {
    Asset asset;
    asset.parts = {test::square(), Part{}, test::square(), test::square()};
    CHECK(proportional_shares(asset, 3, {}) == std::vector<double>{1, 0, 1, 1});
    const float hidden = detail::min_visibility;
    const std::vector<std::vector<float>> seen = {
        {1, 1, 1, 1}, {}, {hidden, 0.5f, hidden, hidden}, {hidden, hidden, hidden, hidden}};
    CHECK(proportional_shares(asset, 3, seen) == std::vector<double>{1, 0, 0.25, 0});
    CHECK(proportional_shares(Asset{}, 3, {}).empty());
}

TEST_CASE("a warning names the parts with less than a tenth of their share") {
    Asset asset;
    asset.parts.assign(8, test::square());
    asset.parts[1].name = "wall";
    SimplifiedParts simplified = test::unchanged(asset);
    std::vector<double> shares(8, 20);
    detail::warn_of_small_shares(asset, shares, simplified);
    CHECK(simplified.report.warnings.empty());
    shares[1] = 20.5;
    detail::warn_of_small_shares(asset, shares, simplified);
    REQUIRE(simplified.report.warnings.size() == 1);
    CHECK(simplified.report.warnings[0] ==
          "1 part has less than a tenth of its proportional share of the faces: part 'wall' (2 of 2)");
    shares.assign(8, 30);
    detail::warn_of_small_shares(asset, shares, simplified);
    const std::string& all = simplified.report.warnings.at(1);
    CHECK(all.find("8 parts have less") == 0);
    CHECK(all.find("part 'square' (2 of 2) and 3 more") != std::string::npos);
}
