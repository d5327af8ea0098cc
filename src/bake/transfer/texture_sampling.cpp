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

LinearColor mix(const LinearColor& a, const LinearColor& b, float t) {
    LinearColor result;
    for (std::size_t k = 0; k < 4; ++k) result[k] = a[k] + t * (b[k] - a[k]);
    return result;
}

// Source texels covered by texel i of a downsampled row, with their weights.
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

double valid_or_zero(double x) { return std::abs(x) < 1e9 ? x : 0.0; }

}  // namespace

MipImage::MipImage(Pixels pixels, TexelEncoding encoding, const Workers& workers)
    : pixels_(std::move(pixels)), encoding_(encoding) {
    for (std::size_t level = 0; width(level) > 1 || height(level) > 1; ++level)
        levels_.push_back(downsample(level, workers));
}

LinearColor MipImage::read(std::size_t level, std::uint32_t x, std::uint32_t y) const {
    const std::size_t at = (std::size_t{y} * width(level) + x) * 4;
    if (level > 0) {
        const std::uint16_t* p = &levels_[level - 1].rgba[at];
        constexpr float unit = 1.0f / 65535;
        return {p[0] * unit, p[1] * unit, p[2] * unit, p[3] * unit};
    }
    const std::uint8_t* p = &pixels_.rgba[at];
    constexpr float unit = 1.0f / 255;
    if (encoding_ == TexelEncoding::data) return {p[0] * unit, p[1] * unit, p[2] * unit, p[3] * unit};
    const auto& linear = srgb_table();
    if (encoding_ == TexelEncoding::color_and_data_alpha)
        return {linear[p[0]], linear[p[1]], linear[p[2]], p[3] * unit};
    const float alpha = encoding_ == TexelEncoding::color ? p[3] * unit : 1;
    return {linear[p[0]] * alpha, linear[p[1]] * alpha, linear[p[2]] * alpha, alpha};
}

MipImage::Level MipImage::downsample(std::size_t from, const Workers& workers) const {
    Level result{std::max(1u, width(from) / 2), std::max(1u, height(from) / 2), {}};
    // Not a vector, since zeroing half a gigabyte takes long and cannot be cancelled.
    result.rgba =
        std::make_unique_for_overwrite<std::uint16_t[]>(std::size_t{result.width} * result.height * 4);
    const auto fill_row = [&](std::uint32_t y) {
        const Taps rows = taps(y, height(from), result.height);
        std::uint16_t* to = &result.rgba[std::size_t{y} * result.width * 4];
        for (std::uint32_t x = 0; x < result.width; ++x) {
            const Taps columns = taps(x, width(from), result.width);
            LinearColor sum{};
            for (std::uint32_t j = 0; j < rows.count; ++j) {
                for (std::uint32_t i = 0; i < columns.count; ++i) {
                    const LinearColor c = read(from, columns.first + i, rows.first + j);
                    for (std::size_t k = 0; k < 4; ++k) sum[k] += rows.weight[j] * columns.weight[i] * c[k];
                }
            }
            for (float c : sum) *to++ = static_cast<std::uint16_t>(std::clamp(c, 0.0f, 1.0f) * 65535 + 0.5f);
        }
    };
    constexpr std::size_t rows_at_once = 16;
    parallel_blocks(result.height, rows_at_once, workers, [&](std::size_t y, std::size_t end) {
        for (; y < end; ++y) {
            fill_row(static_cast<std::uint32_t>(y));
        }
    });
    return result;
}

LinearColor MipImage::texel(std::size_t level, std::int64_t x, std::int64_t y,
                            const TextureRef& texture_ref) const {
    return read(level, wrapped(x, width(level), texture_ref.wrap_u),
                wrapped(y, height(level), texture_ref.wrap_v));
}

LinearColor MipImage::sample_level(std::size_t level, double u, double v,
                                   const TextureRef& texture_ref) const {
    const double x = u * width(level), y = v * height(level);
    if (texture_ref.filter == Filter::nearest) {
        return texel(level, static_cast<std::int64_t>(std::floor(x)),
                     static_cast<std::int64_t>(std::floor(y)), texture_ref);
    }
    const double left = std::floor(x - 0.5), top = std::floor(y - 0.5);
    const auto i = static_cast<std::int64_t>(left), j = static_cast<std::int64_t>(top);
    const float s = static_cast<float>(x - 0.5 - left), t = static_cast<float>(y - 0.5 - top);
    return mix(mix(texel(level, i, j, texture_ref), texel(level, i + 1, j, texture_ref), s),
               mix(texel(level, i, j + 1, texture_ref), texel(level, i + 1, j + 1, texture_ref), s), t);
}

LinearColor MipImage::sample(const TextureRef& texture_ref, double u, double v, double lod) const {
    u = valid_or_zero(u);
    v = valid_or_zero(v);
    const double deepest = static_cast<double>(levels_.size());
    const double at = lod > 0 ? std::min(lod, deepest) : 0;
    const auto level = static_cast<std::size_t>(at);
    const float t = static_cast<float>(at - static_cast<double>(level));
    const LinearColor fine = sample_level(level, u, v, texture_ref);
    return t > 0 ? mix(fine, sample_level(level + 1, u, v, texture_ref), t) : fine;
}

Vec3f MipImage::stored_color(const TextureRef& texture_ref, double u, double v) const {
    const auto index = [](double at, std::uint32_t n, Wrap wrap) {
        return wrapped(static_cast<std::int64_t>(std::floor(valid_or_zero(at) * n)), n, wrap);
    };
    const std::size_t x = index(u, pixels_.width, texture_ref.wrap_u);
    const std::size_t y = index(v, pixels_.height, texture_ref.wrap_v);
    const std::uint8_t* p = &pixels_.rgba[(y * pixels_.width + x) * 4];
    const auto& linear = srgb_table();
    return {linear[p[0]], linear[p[1]], linear[p[2]]};
}

UvTransform uv_transform(const TextureRef& texture_ref) {
    const double c = std::cos(double(texture_ref.rotation)), s = std::sin(double(texture_ref.rotation));
    return {{c * texture_ref.scale[0], s * texture_ref.scale[1], texture_ref.offset[0]},
            {-s * texture_ref.scale[0], c * texture_ref.scale[1], texture_ref.offset[1]}};
}

std::uint8_t linear_byte(double value) {
    if (!(value > 0)) return 0;
    return static_cast<std::uint8_t>(std::min(value, 1.0) * 255 + 0.5);
}

std::uint8_t srgb_byte(double linear) {
    return linear > 0 ? linear_byte(srgb_from_linear(std::min(linear, 1.0))) : 0;
}

}  // namespace faqem::detail
