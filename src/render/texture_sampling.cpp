#include "render/texture_sampling.hpp"

#include <bit>
#include <cmath>

#include "asset/image/rgba_lanes.hpp"
#include "asset/image/srgb.hpp"

namespace faqem::detail {
namespace {

// sRGB bytes of intervals of linear light. An interval has the doubles with the same exponent and first bits of the
// mantissa.
class SrgbBytes {
public:
    static constexpr double least = 1.0 / 8192;  // smaller values have the byte 0

    SrgbBytes() {
        const auto scaled = [](double linear) { return srgb_from_linear(linear) * 255 + 0.5; };
        // More than the rounding errors of srgb_from_linear().
        constexpr double margin = 1e-9;
        for (std::size_t i = 0; i < bytes_.size(); ++i) {
            const double low = std::floor(scaled(begin_of(i)) - margin),
                         high = std::floor(scaled(begin_of(i + 1)) + margin);
            bytes_[i] = static_cast<std::int16_t>(low == high ? low : -1 - low);
        }
        for (std::size_t i = 0; i < ends_.size(); ++i)
            ends_[i] = linear_from_srgb((static_cast<double>(i) + 0.5) / 255);
    }

    // The byte of a value from `least` to less than 1; -1 if it is too close to the end of the values with a byte.
    int at(double linear) const {
        const int byte =
            bytes_[(std::bit_cast<std::uint64_t>(linear) - std::bit_cast<std::uint64_t>(least)) >> shift];
        if (byte >= 0) return byte;
        const int low = -1 - byte;
        const double end = ends_[static_cast<std::size_t>(low)];
        // More than the rounding errors of both conversions.
        constexpr double margin = 1e-9;
        if (std::abs(linear - end) <= margin * end) return -1;
        return linear < end ? low : low + 1;
    }

private:
    static constexpr int shift = 43;  // 512 intervals for each power of two
    static double begin_of(std::size_t i) {
        return std::bit_cast<double>(std::bit_cast<std::uint64_t>(least) + (std::uint64_t{i} << shift));
    }
    std::array<std::int16_t, 13 * 512> bytes_;  // of the interval; -1 - b if it has b and b + 1
    std::array<double, 255> ends_;              // of the values with each byte
};

// Linear light of each sRGB byte.
const std::array<float, 256>& linear_from_srgb_byte() {
    static const auto table = [] {
        std::array<float, 256> t{};
        for (std::size_t i = 0; i < t.size(); ++i)
            t[i] = static_cast<float>(linear_from_srgb(static_cast<double>(i) / 255));
        return t;
    }();
    return table;
}

RgbaLanes mix(RgbaLanes a, RgbaLanes b, float t) { return a + t * (b - a); }

LinearColor to_linear_color(RgbaLanes texel) { return {texel[0], texel[1], texel[2], texel[3]}; }

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

// Largest integer <= x, for |x| < 2^62. std::floor() is a call of a function without SSE4.
std::int64_t floor_of(double x) {
    const auto truncated = static_cast<std::int64_t>(x);
    return truncated - (static_cast<double>(truncated) > x);
}

// Four neighbouring texels, and the position between them.
struct Corners {
    std::array<std::uint32_t, 2> x, y;
    float s, t;

    // read: (x, y) -> RgbaLanes
    template <class Read>
    RgbaLanes interpolate(const Read& read) const {
        return mix(mix(read(x[0], y[0]), read(x[1], y[0]), s), mix(read(x[0], y[1]), read(x[1], y[1]), s), t);
    }
};

double valid_or_zero(double x) { return std::abs(x) < 1e9 ? x : 0.0; }

}  // namespace

MipImage::MipImage(Pixels pixels, TexelEncoding encoding, const RunContext& context)
    : pixels_(std::move(pixels)), encoding_(encoding) {
    for (std::size_t level = 0; width(level) > 1 || height(level) > 1; ++level)
        levels_.push_back(downsample(level, context));
}

template <class Visit>
auto MipImage::with_reader(std::size_t level, const Visit& visit) const {
    const auto row = [columns = std::size_t{width(level)}](std::uint32_t x, std::uint32_t y) {
        return (y * columns + x) * 4;
    };
    if (level > 0) {
        return visit([&, texels = levels_[level - 1].rgba.get()](std::uint32_t x, std::uint32_t y) {
            return to_lanes(texels + row(x, y)) * (1.0f / 65535);
        });
    }
    constexpr float unit = 1.0f / 255;
    const std::uint8_t* texels = pixels_.rgba.data();
    const float* linear = linear_from_srgb_byte().data();
    switch (encoding_) {
        case TexelEncoding::data:
            return visit(
                [&](std::uint32_t x, std::uint32_t y) { return to_lanes(texels + row(x, y)) * unit; });
        case TexelEncoding::color_and_data_alpha:
            return visit([&](std::uint32_t x, std::uint32_t y) {
                const std::uint8_t* p = texels + row(x, y);
                return RgbaLanes{linear[p[0]], linear[p[1]], linear[p[2]], p[3] * unit};
            });
        case TexelEncoding::opaque_color:
            return visit([&](std::uint32_t x, std::uint32_t y) {
                const std::uint8_t* p = texels + row(x, y);
                return RgbaLanes{linear[p[0]], linear[p[1]], linear[p[2]], 1};
            });
        case TexelEncoding::color:
            break;
    }
    return visit([&](std::uint32_t x, std::uint32_t y) {
        const std::uint8_t* p = texels + row(x, y);
        const float alpha = p[3] * unit;
        return RgbaLanes{linear[p[0]], linear[p[1]], linear[p[2]], 1} * alpha;
    });
}

MipImage::Level MipImage::downsample(std::size_t from, const RunContext& context) const {
    Level result{std::max(1u, width(from) / 2), std::max(1u, height(from) / 2), {}};
    // Not a vector, since zeroing half a gigabyte takes long and cannot be cancelled.
    result.rgba.reset(new std::uint16_t[std::size_t{result.width} * result.height * 4]);
    std::vector<Taps> all_columns;
    all_columns.reserve(result.width);
    for (std::uint32_t x = 0; x < result.width; ++x)
        all_columns.push_back(taps(x, width(from), result.width));
    const auto fill_row = [&](std::size_t y) {
        const Taps rows = taps(static_cast<std::uint32_t>(y), height(from), result.height);
        std::uint16_t* to = &result.rgba[y * result.width * 4];
        with_reader(from, [&](const auto& read) {
            for (const Taps& columns : all_columns) {
                RgbaLanes weighted = {};
                for (std::uint32_t j = 0; j < rows.count; ++j) {
                    for (std::uint32_t i = 0; i < columns.count; ++i)
                        weighted +=
                            rows.weight[j] * columns.weight[i] * read(columns.first + i, rows.first + j);
                }
                for (const float c : to_linear_color(weighted))
                    *to++ = static_cast<std::uint16_t>(std::clamp(c, 0.0f, 1.0f) * 65535 + 0.5f);
            }
        });
    };
    constexpr std::size_t rows_at_once = 16;
    parallel_each(result.height, rows_at_once, context, fill_row);
    return result;
}

auto MipImage::sample_level(std::size_t level, double u, double v, const TextureRef& texture_ref) const {
    const std::uint32_t columns = width(level), rows = height(level);
    const double x = u * columns, y = v * rows;
    if (texture_ref.filter == Filter::nearest) {
        const std::uint32_t i = wrapped_texel(floor_of(x), columns, texture_ref.wrap_u),
                            j = wrapped_texel(floor_of(y), rows, texture_ref.wrap_v);
        return with_reader(level, [&](const auto& read) { return read(i, j); });
    }
    const std::int64_t i = floor_of(x - 0.5), j = floor_of(y - 0.5);
    const Corners corners{
        {wrapped_texel(i, columns, texture_ref.wrap_u), wrapped_texel(i + 1, columns, texture_ref.wrap_u)},
        {wrapped_texel(j, rows, texture_ref.wrap_v), wrapped_texel(j + 1, rows, texture_ref.wrap_v)},
        static_cast<float>(x - 0.5 - static_cast<double>(i)),
        static_cast<float>(y - 0.5 - static_cast<double>(j))};
    return with_reader(level, [&](const auto& read) { return corners.interpolate(read); });
}

LinearColor MipImage::sample(const TextureRef& texture_ref, double u, double v, double lod) const {
    u = valid_or_zero(u);
    v = valid_or_zero(v);
    const double deepest = static_cast<double>(levels_.size());
    const double at = lod > 0 ? std::min(lod, deepest) : 0;
    const auto level = static_cast<std::size_t>(at);
    const float t = static_cast<float>(at - static_cast<double>(level));
    const RgbaLanes fine = sample_level(level, u, v, texture_ref);
    if (!(t > 0)) return to_linear_color(fine);
    return to_linear_color(mix(fine, sample_level(level + 1, u, v, texture_ref), t));
}

Vec3f MipImage::stored_color(const TextureRef& texture_ref, double u, double v) const {
    const auto index = [](double at, std::uint32_t n, Wrap wrap) {
        return wrapped_texel(floor_of(valid_or_zero(at) * n), n, wrap);
    };
    const std::size_t x = index(u, pixels_.width, texture_ref.wrap_u);
    const std::size_t y = index(v, pixels_.height, texture_ref.wrap_v);
    const std::uint8_t* p = &pixels_.rgba[(y * pixels_.width + x) * 4];
    const auto& linear = linear_from_srgb_byte();
    return {linear[p[0]], linear[p[1]], linear[p[2]]};
}

double uv_area(const std::vector<Vec2f>& uvs, const Triangle& t) {
    const Vec2f &a = uvs[t[0]], &b = uvs[t[1]], &c = uvs[t[2]];
    const double x1 = double{b[0]} - a[0], y1 = double{b[1]} - a[1];
    const double x2 = double{c[0]} - a[0], y2 = double{c[1]} - a[1];
    return std::abs(x1 * y2 - x2 * y1) / 2;
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
    if (!(linear >= SrgbBytes::least)) return 0;
    if (linear >= 1) return 255;
    static const SrgbBytes table;
    const int byte = table.at(linear);
    return byte >= 0 ? static_cast<std::uint8_t>(byte) : linear_byte(srgb_from_linear(linear));
}

}  // namespace faqem::detail
