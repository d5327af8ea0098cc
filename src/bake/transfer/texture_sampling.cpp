#include "bake/transfer/texture_sampling.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "asset/image/srgb.hpp"

namespace faqem::detail {
namespace {

const std::array<float, 256>& srgb_table() {
    static const auto table = [] {
        std::array<float, 256> t{};
        for (std::size_t i = 0; i < t.size(); ++i)
            t[i] = static_cast<float>(linear_from_srgb(double(i) / 255));
        return t;
    }();
    return table;
}

std::uint32_t wrapped(std::int64_t i, std::int64_t n, Wrap wrap) {
    if (wrap == Wrap::clamp) return static_cast<std::uint32_t>(std::clamp<std::int64_t>(i, 0, n - 1));
    const std::int64_t period = wrap == Wrap::mirror ? 2 * n : n;
    std::int64_t r = i % period;
    if (r < 0) r += period;
    return static_cast<std::uint32_t>(r < n ? r : period - 1 - r);
}

Linear mix(const Linear& a, const Linear& b, float t) {
    Linear result;
    for (std::size_t k = 0; k < 4; ++k) result[k] = a[k] + t * (b[k] - a[k]);
    return result;
}

// Source texels under texel i of a row made half as long, with their shares.
struct Taps {
    std::uint32_t first, count;
    std::array<float, 3> weight;
};

Taps taps(std::uint32_t i, std::uint32_t from, std::uint32_t to) {
    const double step = double(from) / to, begin = i * step, end = begin + step;
    Taps result{static_cast<std::uint32_t>(begin), 0, {}};
    for (std::uint32_t x = result.first; x < from && result.count < 3; ++x) {
        const double share = std::min(end, x + 1.0) - std::max<double>(begin, x);
        if (!(share > 1e-9)) break;
        result.weight[result.count++] = static_cast<float>(share / step);
    }
    return result;
}

double usable(double x) { return std::abs(x) < 1e9 ? x : 0.0; }

}  // namespace

MipImage::MipImage(Pixels pixels, Encoding encoding, const Workers& workers)
    : pixels_(std::move(pixels)), encoding_(encoding) {
    for (std::size_t level = 0; width(level) > 1 || height(level) > 1; ++level)
        levels_.push_back(half(level, workers));
}

Linear MipImage::read(std::size_t level, std::uint32_t x, std::uint32_t y) const {
    const std::size_t at = (std::size_t{y} * width(level) + x) * 4;
    if (level > 0) {
        const std::uint16_t* p = &levels_[level - 1].rgba[at];
        constexpr float unit = 1.0f / 65535;
        return {p[0] * unit, p[1] * unit, p[2] * unit, p[3] * unit};
    }
    const std::uint8_t* p = &pixels_.rgba[at];
    constexpr float unit = 1.0f / 255;
    if (encoding_ == Encoding::data) return {p[0] * unit, p[1] * unit, p[2] * unit, p[3] * unit};
    const auto& linear = srgb_table();
    if (encoding_ == Encoding::colour_and_number)
        return {linear[p[0]], linear[p[1]], linear[p[2]], p[3] * unit};
    const float alpha = encoding_ == Encoding::colour ? p[3] * unit : 1;
    return {linear[p[0]] * alpha, linear[p[1]] * alpha, linear[p[2]] * alpha, alpha};
}

MipImage::Level MipImage::half(std::size_t from, const Workers& workers) const {
    Level result{std::max(1u, width(from) / 2), std::max(1u, height(from) / 2), {}};
    // Not a vector: to clear half a gigabyte first would take long, with nobody asked.
    result.rgba =
        std::make_unique_for_overwrite<std::uint16_t[]>(std::size_t{result.width} * result.height * 4);
    const auto fill_row = [&](std::uint32_t y) {
        const Taps rows = taps(y, height(from), result.height);
        std::uint16_t* to = &result.rgba[std::size_t{y} * result.width * 4];
        for (std::uint32_t x = 0; x < result.width; ++x) {
            const Taps columns = taps(x, width(from), result.width);
            Linear sum{};
            for (std::uint32_t j = 0; j < rows.count; ++j) {
                for (std::uint32_t i = 0; i < columns.count; ++i) {
                    const Linear c = read(from, columns.first + i, rows.first + j);
                    for (std::size_t k = 0; k < 4; ++k) sum[k] += rows.weight[j] * columns.weight[i] * c[k];
                }
            }
            for (float c : sum) *to++ = static_cast<std::uint16_t>(std::clamp(c, 0.0f, 1.0f) * 65535 + 0.5f);
        }
    };
    constexpr std::size_t rows_at_once = 16;
    parallel_blocks(result.height, rows_at_once, workers, [&](std::size_t y, std::size_t end, Poll poll) {
        for (; y < end; ++y) {
            poll(result.width / 4);
            fill_row(static_cast<std::uint32_t>(y));
        }
    });
    return result;
}

Linear MipImage::texel(std::size_t level, std::int64_t x, std::int64_t y, const TextureRef& use) const {
    return read(level, wrapped(x, width(level), use.wrap_u), wrapped(y, height(level), use.wrap_v));
}

Linear MipImage::at_level(std::size_t level, double u, double v, const TextureRef& use) const {
    const double x = u * width(level), y = v * height(level);
    if (use.filter == Filter::nearest) {
        return texel(level, static_cast<std::int64_t>(std::floor(x)),
                     static_cast<std::int64_t>(std::floor(y)), use);
    }
    const double left = std::floor(x - 0.5), top = std::floor(y - 0.5);
    const auto i = static_cast<std::int64_t>(left), j = static_cast<std::int64_t>(top);
    const float s = static_cast<float>(x - 0.5 - left), t = static_cast<float>(y - 0.5 - top);
    return mix(mix(texel(level, i, j, use), texel(level, i + 1, j, use), s),
               mix(texel(level, i, j + 1, use), texel(level, i + 1, j + 1, use), s), t);
}

Linear MipImage::sample(const TextureRef& use, double u, double v, double lod) const {
    u = usable(u);
    v = usable(v);
    const double deepest = static_cast<double>(levels_.size());
    const double at = lod > 0 ? std::min(lod, deepest) : 0;
    const auto level = static_cast<std::size_t>(at);
    const float t = static_cast<float>(at - static_cast<double>(level));
    const Linear fine = at_level(level, u, v, use);
    return t > 0 ? mix(fine, at_level(level + 1, u, v, use), t) : fine;
}

UvTransform uv_transform(const TextureRef& use) {
    const double c = std::cos(double(use.rotation)), s = std::sin(double(use.rotation));
    return {{c * use.scale[0], s * use.scale[1], use.offset[0]},
            {-s * use.scale[0], c * use.scale[1], use.offset[1]}};
}

std::uint8_t linear_byte(double value) {
    if (!(value > 0)) return 0;
    return static_cast<std::uint8_t>(std::min(value, 1.0) * 255 + 0.5);
}

std::uint8_t srgb_byte(double linear) {
    return linear > 0 ? linear_byte(srgb_from_linear(std::min(linear, 1.0))) : 0;
}

}  // namespace faqem::detail
