#include "bake/page/texel_values.hpp"

#include <cmath>

#include "support/catch.hpp"

using namespace faqem::detail;
using faqem::engine::Vector3;

namespace {

constexpr Channels everything = {CoreTexture::base_color, CoreTexture::metallic_roughness,
                                 CoreTexture::normal, CoreTexture::occlusion, CoreTexture::emissive};

// The value of a byte in linear light.
float linear(int byte) {
    const double s = byte / 255.0;
    return static_cast<float>(s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4));
}

// A grey sample, by sRGB bytes of its base colour and linear bytes of the other channels.
SampleValues grey(int base, int data) {
    SampleValues result;
    const float value = static_cast<float>(data) / 255;
    result.appearance = {{linear(base), linear(base), linear(base), 1}, {{{value, value, value}, {0, 0, 0}}}};
    result.normal = Vector3(0, 0, 1);
    return result;
}

bool differ(const SampleValues& a, const SampleValues& b, const Channels& channels = everything) {
    const bool result = differ_visibly(channels, {}, a, b);
    CHECK(result == differ_visibly(channels, {}, b, a));
    return result;
}

}  // namespace

TEST_CASE("samples differ visibly by more than one in a byte, in the dark and in the light") {
    for (const int byte : {0, 5, 100, 250}) {
        CHECK_FALSE(differ(grey(byte, 9), grey(byte, 9)));
        CHECK_FALSE(differ(grey(byte, 9), grey(byte + 1, 9)));
        CHECK(differ(grey(byte, 9), grey(byte + 2, 9)));
        CHECK_FALSE(differ(grey(9, byte), grey(9, byte + 1)));
        CHECK(differ(grey(9, byte), grey(9, byte + 2)));
    }
}

TEST_CASE("every channel with an image can differ visibly, the others cannot") {
    const SampleValues a = grey(50, 50);
    SampleValues b = a;
    const auto only_in = [&](CoreTexture texture) {
        Channels others = everything;
        others[texture] = false;
        CHECK(differ(a, b));
        CHECK_FALSE(differ(a, b, others));
        b = a;
    };
    b.appearance.base[3] = 0.9f;
    only_in(CoreTexture::base_color);
    b.appearance.plain[emissive_image][2] = 0.1f;
    only_in(CoreTexture::emissive);
    b.normal = Vector3(0.1, 0, 1);
    only_in(CoreTexture::normal);
    b.normal = Vector3(0, 0, 3);  // of the same direction
    CHECK_FALSE(differ(a, b));
}

TEST_CASE("sums over samples are those of all values, with the origin closest to the centre") {
    TexelSums sum(1);
    SampleValues a = grey(255, 255), b = grey(0, 51);
    a.layers = {{1, 2, 3, 4}};
    a.has_layers = true;
    a.squared_distance = 2;
    a.origin.point = {3, {1, 0, 0}, faqem::MapStep::closest};
    b.squared_distance = 1;
    b.origin.point = {5, {0, 1, 0}, faqem::MapStep::history};
    sum.add(a), sum.add(b);
    CHECK(sum.samples == 2);
    CHECK(sum.base[0] == 1);
    CHECK(sum.base[3] == 2);
    CHECK(sum.plain[orm_image][1] == Approx(1.2));
    CHECK(sum.normal == Vector3(0, 0, 2));
    CHECK(sum.layer_samples == 1);
    CHECK(sum.layers[0][3] == 4);
    CHECK(sum.steps[static_cast<std::size_t>(faqem::MapStep::closest)] == 1);
    CHECK(sum.origin.point.face == 5);
}
