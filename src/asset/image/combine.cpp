#include "asset/image/combine.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "asset/image/image_size.hpp"

namespace faqem::detail {
namespace {

std::size_t pixel_count(std::uint32_t width, std::uint32_t height) { return std::size_t{width} * height; }

std::uint8_t luminance_of(const std::uint8_t* p) {
    return static_cast<std::uint8_t>((2126u * p[0] + 7152u * p[1] + 722u * p[2] + 5000u) / 10000u);
}

/// Where a position of a scaled row lies between two of its source values.
/// Scales an image with `channels` interleaved channels.
std::vector<std::uint8_t> scaled(const std::vector<std::uint8_t>& values, std::size_t channels,
                                 std::array<std::uint32_t, 2> from, std::array<std::uint32_t, 2> to) {
    if (from == to) return values;
    const std::vector<Tap> columns = taps_of(from[0], to[0]), rows = taps_of(from[1], to[1]);
    std::vector<std::uint8_t> result(pixel_count(to[0], to[1]) * channels);
    std::uint8_t* out = result.data();
    for (const Tap& row : rows) {
        const std::uint8_t* above = &values[std::size_t{row.first} * from[0] * channels];
        const std::uint8_t* below = &values[std::size_t{row.second} * from[0] * channels];
        for (const Tap& column : columns) {
            for (std::size_t k = 0; k < channels; ++k) {
                const std::size_t a = column.first * channels + k, b = column.second * channels + k;
                const double upper = above[a] + column.share * (above[b] - above[a]);
                const double lower = below[a] + column.share * (below[b] - below[a]);
                *out++ = static_cast<std::uint8_t>(upper + row.share * (lower - upper) + 0.5);
            }
        }
    }
    return result;
}

/// Sets a channel to the values of an image, scaled to the size of the pixels.
void put_channel(const ScalarImage& image, std::size_t channel, Pixels& pixels) {
    const std::vector<std::uint8_t> values =
        scaled(image.values, 1, {image.width, image.height}, {pixels.width, pixels.height});
    for (std::size_t i = 0; i < values.size(); ++i) pixels.rgba[4 * i + channel] = values[i];
}

}  // namespace

std::vector<Tap> taps_of(std::uint32_t from, std::uint32_t to, bool repeats) {
    std::vector<Tap> taps(to);
    for (std::uint32_t i = 0; i < to; ++i) {
        const double at = (i + 0.5) * from / to - 0.5;
        const double inside = repeats ? (at < 0 ? at + from : at) : std::clamp(at, 0.0, from - 1.0);
        const auto first = static_cast<std::uint32_t>(inside);
        taps[i] = {first, first + 1 < from ? first + 1 : (repeats ? 0 : first), inside - first};
    }
    return taps;
}

ScalarImage scalar_image(const Pixels& pixels, ScalarChannel channel) {
    if (channel == ScalarChannel::automatic)
        channel = has_transparent_pixel(pixels) ? ScalarChannel::alpha : ScalarChannel::luminance;
    ScalarImage result{pixels.width, pixels.height, {}};
    result.values.resize(pixel_count(pixels.width, pixels.height));
    const auto fill = [&](auto&& value) {
        for (std::size_t i = 0; i < result.values.size(); ++i) result.values[i] = value(&pixels.rgba[4 * i]);
    };
    if (channel == ScalarChannel::luminance) {
        fill(luminance_of);
    } else {
        const std::size_t k =
            static_cast<std::size_t>(channel) - static_cast<std::size_t>(ScalarChannel::red);
        fill([k](const std::uint8_t* p) { return p[k]; });
    }
    return result;
}

bool is_grey(const Pixels& pixels) {
    for (std::size_t i = 0; i < pixels.rgba.size(); i += 4)
        if (pixels.rgba[i] != pixels.rgba[i + 1] || pixels.rgba[i] != pixels.rgba[i + 2]) return false;
    return true;
}

bool is_normal_map(const Pixels& pixels) {
    if (is_grey(pixels)) return false;
    std::size_t directions = 0;
    for (std::size_t i = 0; i < pixels.rgba.size(); i += 4) {
        double square = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const double x = pixels.rgba[i + k] / 127.5 - 1;
            square += x * x;
        }
        constexpr double shortest = 0.75 * 0.75, longest = 1.25 * 1.25;
        directions += square > shortest && square < longest && pixels.rgba[i + 2] >= 127;
    }
    return directions * 2 >= pixels.rgba.size() / 4;
}

Pixels with_alpha(const Pixels& color, const ScalarImage& alpha) {
    Pixels result{std::max(color.width, alpha.width), std::max(color.height, alpha.height), {}, false};
    result.rgba = scaled(color.rgba, 4, {color.width, color.height}, {result.width, result.height});
    put_channel(alpha, 3, result);
    result.has_alpha = has_transparent_pixel(result);
    return result;
}

Pixels roughness_metallic(const ScalarImage& roughness, const ScalarImage& metallic) {
    Pixels result{
        std::max(roughness.width, metallic.width), std::max(roughness.height, metallic.height), {}, false};
    result.rgba.assign(4 * pixel_count(result.width, result.height), 255);
    if (!roughness.values.empty()) put_channel(roughness, 1, result);
    if (!metallic.values.empty()) put_channel(metallic, 2, result);
    return result;
}

Pixels normals_of_heights(const ScalarImage& heights, double depth) {
    const std::uint32_t width = heights.width, height = heights.height;
    Pixels result{width, height, std::vector<std::uint8_t>(4 * pixel_count(width, height), 255), false};
    const auto at = [&](std::uint32_t x, std::uint32_t y) {
        return heights.values[std::size_t{y} * width + x] / 255.0;
    };
    for (std::uint32_t y = 0; y < height; ++y) {
        const std::uint32_t above = y == 0 ? height - 1 : y - 1, below = y + 1 == height ? 0 : y + 1;
        for (std::uint32_t x = 0; x < width; ++x) {
            const std::uint32_t left = x == 0 ? width - 1 : x - 1, right = x + 1 == width ? 0 : x + 1;
            const double du = depth * (at(right, y) - at(left, y)) * width / 2;
            const double dv = depth * (at(x, above) - at(x, below)) * height / 2;
            const double length = std::sqrt(du * du + dv * dv + 1);
            const std::array<double, 3> n = {-du / length, -dv / length, 1 / length};
            std::uint8_t* to = &result.rgba[4 * (std::size_t{y} * width + x)];
            for (std::size_t k = 0; k < 3; ++k)
                to[k] = static_cast<std::uint8_t>(std::clamp(n[k] * 127.5 + 128, 0.0, 255.0));
        }
    }
    return result;
}

}  // namespace faqem::detail
