// Errors of pictures, attributed to the images of a model.

#include "result/picture_meter.hpp"

#include <memory>

#include "support/catch.hpp"
#include "support/cli_support.hpp"

using namespace tool_test;
using namespace faqem;
using namespace faqem::detail;

namespace {

Pixels grey(std::uint8_t value) {
    Pixels result{8, 8, {}, false};
    for (int i = 0; i < 64; ++i) result.rgba.insert(result.rgba.end(), {value, value, value, 255});
    return result;
}

// A quarter of the sheet has the second material. Each has a grey image; the third image is not shown by pictures.
Asset two_materials() {
    Asset asset = sheet(8, 0);
    asset.materials.resize(1);
    asset.materials.push_back(asset.materials[0]);
    asset.images.clear();
    for (const char* const name : {"first", "second", "roughness"})
        asset.images.push_back(encode_png(grey(100), name));
    asset.materials[0].base_color_texture.image = 0;
    asset.materials[1].base_color_texture.image = 1;
    asset.materials[1].metallic_roughness_texture = asset.materials[1].base_color_texture;
    asset.materials[1].metallic_roughness_texture.image = 2;
    Part& part = asset.parts[0];
    part.face_material.assign(part.triangles.size(), 0);
    for (std::size_t f = 0; f < part.triangles.size() / 4; ++f) part.face_material[f] = 1;
    return asset;
}

std::vector<detail::PendingImage> pending_images(const Asset& asset) {
    std::vector<detail::PendingImage> result;
    for (Index i = 0; i < asset.images.size(); ++i) {
        detail::PendingImage& image = result.emplace_back();
        image.image = i;
        image.pixels = decode(asset.images[i]);
        image.known = std::make_shared<const std::vector<std::uint8_t>>(64, std::uint8_t{1});
    }
    return result;
}

}  // namespace

TEST_CASE("an image that is 10 of 255 brighter has that error at the pixels that show it, and only there") {
    const Asset asset = two_materials();
    const auto pending = pending_images(asset);
    ImageErrorMeter meter(asset, pending, 0);
    CHECK_FALSE(meter.has_lit_pictures());
    const std::vector<double>& shares = meter.shares();
    CHECK(shares[0] + shares[1] == Approx(1));
    CHECK(shares[1] == Approx(0.25).margin(0.05));
    CHECK(shares[2] == shares[1]);

    const double squared = 10.0 * 10 / (255 * 255);
    const auto first = meter({grey(110), {}, {}});
    REQUIRE(first[0]);
    CHECK_FALSE(first[1]);
    CHECK(first[0]->unlit == Approx(shares[0] * squared).epsilon(0.1));
    CHECK(first[0]->lit == first[0]->unlit);
    const auto both = meter({grey(110), grey(110), grey(0)});
    REQUIRE(both[1]);
    CHECK(both[0]->unlit == Approx(first[0]->unlit).epsilon(0.05));
    CHECK(both[1]->unlit == Approx(shares[1] * squared).epsilon(0.1));
    CHECK_FALSE(both[2]);
    const auto perfect = meter({grey(100), {}, {}});
    CHECK(perfect[0]->unlit == 0);
}

TEST_CASE("an error of a normal map is one of lit pictures") {
    Asset asset = two_materials();
    asset.parts[0].normals.assign(asset.parts[0].positions.size(), {0, 0, 1});
    asset.materials[0].normal_texture = asset.materials[1].metallic_roughness_texture;
    asset.materials[1].metallic_roughness_texture = {};
    const auto flat = [](std::uint8_t x) {
        Pixels result = grey(0);
        for (std::size_t i = 0; i < 64; ++i) {
            result.rgba[4 * i] = x;
            result.rgba[4 * i + 1] = 128;
            result.rgba[4 * i + 2] = 255;
        }
        return result;
    };
    asset.images[2] = encode_png(flat(128), "normals");
    const auto pending = pending_images(asset);
    ImageErrorMeter meter(asset, pending, 0);
    CHECK(meter.has_lit_pictures());
    const auto tilted = meter({{}, {}, flat(200)});
    REQUIRE(tilted[2]);
    CHECK(tilted[2]->unlit == 0);
    CHECK(tilted[2]->lit > 1e-4);
    CHECK(meter({{}, {}, flat(128)})[2]->lit == 0);
}
