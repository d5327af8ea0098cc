#include "bake/texture/pending_images.hpp"

#include <memory>

#include "support/catch.hpp"
#include "support/scenes.hpp"

using namespace faqem;
using namespace faqem::detail;
using namespace faqem::test;

TEST_CASE("a halved image has the means of four texels, is known where one of them is, and no original") {
    PendingImage image;
    image.pixels = paint(4, 2, [](std::uint32_t x, std::uint32_t y) {
        const auto c = static_cast<std::uint8_t>(40 * x + 20 * y);
        return Rgba{c, c, c, 255};
    });
    image.known = std::make_shared<const std::vector<std::uint8_t>>(
        std::vector<std::uint8_t>{0, 0, 0, 0, 0, 0, 0, 1});  // the last texel
    image.original = Image{};
    halve(image);
    CHECK(image.pixels.width == 2);
    CHECK(image.pixels.height == 1);
    CHECK(image.pixels.rgba == std::vector<std::uint8_t>{30, 30, 30, 255, 110, 110, 110, 255});
    CHECK(*image.known == std::vector<std::uint8_t>{0, 1});
    CHECK_FALSE(image.original);
}
