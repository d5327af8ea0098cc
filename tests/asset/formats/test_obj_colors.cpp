#include "asset/formats/obj_colors.hpp"

#include "asset/formats/formats.hpp"
#include "asset/image/srgb.hpp"
#include "support/catch.hpp"
#include "support/format_support.hpp"

using namespace faqem;
using namespace faqem::detail;
using namespace faqem::testing;

namespace {

constexpr Vec4f white = {1, 1, 1, 1}, red = {1, 0, 0, 1}, green = {0, 1, 0, 1}, blue = {0, 0, 1, 1};

// The colours of the positions, and the warnings, of an OBJ file. A face follows its text.
struct Colors {
    std::vector<Vec4f> colors;
    std::vector<std::string> warnings;
};

Colors colors_of(const std::string& text) {
    const Asset asset = read_obj(bytes_of(text + "f 1 2 3\n"), "a.obj");
    return {asset.parts[0].colors, asset.warnings};
}

const std::string three = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

}  // namespace

TEST_CASE("colours above 2 are from 0 to 255, with a warning, and positions without one stay white",
          "[obj]") {
    const Colors bytes = colors_of("v 0 0 0 255 0 51\nv 1 0 0\nv 0 1 0 1 1 1\n");
    REQUIRE(bytes.colors.size() == 3);
    for (std::size_t k = 0; k < 3; ++k) {
        CHECK(bytes.colors[0][k] == Approx(linear_from_srgb(std::array{1.0, 0.0, 0.2}[k])).margin(1e-6));
        CHECK(bytes.colors[2][k] == Approx(linear_from_srgb(1.0 / 255)).epsilon(1e-4));
    }
    CHECK(bytes.colors[1] == white);
    CHECK(any_contains(bytes.warnings, "colours stored as numbers up to 255 are divided by 255"));

    const Colors units = colors_of("v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 2 2 2\n");
    CHECK(units.colors[0] == red);
    CHECK(units.colors[1] == green);
    CHECK(units.warnings.empty());
}

TEST_CASE("blocks of ZBrush colour the positions before them, in lines of any length and case", "[obj]") {
    const Colors result = colors_of("#The following MRGB block contains colours\n" + three +
                                    "#MRGB ffff0000\r\n#a comment\n#mrgb FF00fF00 00808080\n");
    REQUIRE(result.colors.size() == 3);
    CHECK(result.colors[0] == red);
    CHECK(result.colors[1] == green);
    CHECK(result.colors[2][0] == Approx(linear_from_srgb(128 / 255.0)));
    CHECK(result.colors[2][3] == 1);  // the mask is no alpha
    CHECK(result.warnings.empty());
}

TEST_CASE("a block belongs to the positions after the last face or block, others are white", "[obj]") {
    const auto colors = colors_of(three + "f 1 2 3\n" + three + "#MRGB ffff0000ff00ff00\nf 4 5 6\n" + three +
                                  "#MRGB ff0000ffff0000ffff0000ff\n")
                            .colors;
    CHECK(colors == std::vector<Vec4f>{white, white, white, red, green, white, blue, blue, blue});
    // One block for all positions of the file.
    const auto all =
        colors_of(three + "f 1 2 3\nv 2 0 0\nf 1 2 4\n#MRGB ffff0000ff00ff00\n#MRGB ff0000ffffff0000\n");
    CHECK(all.colors == std::vector<Vec4f>{red, green, blue, red});
    CHECK(all.warnings.empty());
}

TEST_CASE("blocks that do not fit are used as far as they do, with a warning", "[obj]") {
    const Colors longer = colors_of(three + "#MRGB ffff0000ff00ff00ff0000ffffff0000\n");
    CHECK(longer.colors == std::vector<Vec4f>{red, green, blue});
    CHECK(any_contains(longer.warnings, "1 colour of #MRGB ignored"));
    const Colors damaged = colors_of(three + "#MRGB ffff0000ff00ff\n#MRGB ff00ff00xf000000\n#MRGB\n");
    CHECK(damaged.colors == std::vector<Vec4f>{red, green, white});
    CHECK(any_contains(damaged.warnings, "2 lines of #MRGB with other than 8 hexadecimal digits"));
}

TEST_CASE("a block replaces numbers after positions, also those from 0 to 255", "[obj]") {
    CHECK(colors_of("v 0 0 0 0 0 255\nv 1 0 0\nv 0 1 0 0 0 0\n#MRGB ffff0000ff00ff00\n").colors ==
          std::vector<Vec4f>{red, green, {0, 0, 0, 1}});
}
