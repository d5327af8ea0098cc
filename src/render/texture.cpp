#include "render/texture.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "asset/image/srgb.hpp"
#include "asset/image/texel_reading.hpp"

namespace faqem::render {

namespace {

// Coarser levels would mix unrelated charts of an atlas, whose gutters are a few texels wide.
constexpr std::size_t max_levels = 4;

std::uint8_t to_byte(double x) {
    return static_cast<std::uint8_t>(std::lround(std::clamp(x, 0.0, 1.0) * 255));
}

Eigen::Vector4f texel(const Texture& texture, const Texture::Level& level, std::uint32_t x, std::uint32_t y) {
    const std::uint8_t* p = &level.rgba[(std::size_t{y} * level.width + x) * 4];
    if (texture.color_space == ColorSpace::linear) {
        return Eigen::Vector4f(p[0], p[1], p[2], p[3]) / 255.0f;
    }
    const auto& decode = detail::linear_from_srgb_byte();
    return {decode[p[0]], decode[p[1]], decode[p[2]], static_cast<float>(p[3]) / 255.0f};
}

Texture::Level downsampled(const Texture& texture, const Texture::Level& from) {
    Texture::Level to;
    to.width = std::max(1u, from.width / 2);
    to.height = std::max(1u, from.height / 2);
    to.rgba.resize(std::size_t{to.width} * to.height * 4);
    std::size_t out = 0;
    for (std::uint32_t y = 0; y < to.height; ++y) {
        for (std::uint32_t x = 0; x < to.width; ++x) {
            const std::uint32_t x1 = std::min(2 * x + 1, from.width - 1),
                                y1 = std::min(2 * y + 1, from.height - 1);
            const Eigen::Vector4f mean =
                0.25f * (texel(texture, from, 2 * x, 2 * y) + texel(texture, from, x1, 2 * y) +
                         texel(texture, from, 2 * x, y1) + texel(texture, from, x1, y1));
            for (int k = 0; k < 4; ++k) {
                const double c = mean[k];
                const bool encode = k < 3 && texture.color_space == ColorSpace::srgb;
                to.rgba[out++] = to_byte(encode ? detail::srgb_from_linear(c) : c);
            }
        }
    }
    return to;
}

Eigen::Vector4f bilinear(const Texture& texture, const Texture::Level& level, const TextureRef& texture_ref,
                         const Eigen::Vector2d& uv) {
    // Coordinates beyond the precision of double are meaningless; 0 avoids integer overflow.
    const auto texel_coordinate = [](double u, std::uint32_t size) {
        const double x = u * size;
        return std::isfinite(x) && std::abs(x) < 1e15 ? x : 0.0;
    };
    double x = texel_coordinate(uv.x(), level.width), y = texel_coordinate(uv.y(), level.height);
    if (texture_ref.filter == Filter::nearest) {
        return texel(
            texture, level,
            detail::wrapped_texel(static_cast<std::int64_t>(std::floor(x)), level.width, texture_ref.wrap_u),
            detail::wrapped_texel(static_cast<std::int64_t>(std::floor(y)), level.height,
                                  texture_ref.wrap_v));
    }
    x -= 0.5;
    y -= 0.5;
    const auto x0 = static_cast<std::int64_t>(std::floor(x)), y0 = static_cast<std::int64_t>(std::floor(y));
    const auto s = static_cast<float>(x - static_cast<double>(x0)),
               t = static_cast<float>(y - static_cast<double>(y0));
    const auto at = [&](int i, int j) {
        return texel(texture, level, detail::wrapped_texel(x0 + i, level.width, texture_ref.wrap_u),
                     detail::wrapped_texel(y0 + j, level.height, texture_ref.wrap_v));
    };
    const Eigen::Vector4f top = (1 - s) * at(0, 0) + s * at(1, 0), bottom = (1 - s) * at(0, 1) + s * at(1, 1);
    return (1 - t) * top + t * bottom;
}

}  // namespace

Texture make_texture(Pixels pixels, ColorSpace color_space) {
    Texture texture;
    texture.color_space = color_space;
    if (pixels.width == 0 || pixels.height == 0) return texture;
    texture.levels.push_back({pixels.width, pixels.height, std::move(pixels.rgba)});
    while (texture.levels.size() < max_levels &&
           (texture.levels.back().width > 1 || texture.levels.back().height > 1)) {
        texture.levels.push_back(downsampled(texture, texture.levels.back()));
    }
    return texture;
}

Eigen::Vector2d transform_uv(const TextureRef& texture_ref, const Eigen::Vector2d& uv) {
    const double c = std::cos(texture_ref.rotation), s = std::sin(texture_ref.rotation);
    const double u = texture_ref.scale[0] * uv.x(), v = texture_ref.scale[1] * uv.y();
    return {texture_ref.offset[0] + c * u + s * v, texture_ref.offset[1] - s * u + c * v};
}

Eigen::Vector4f sample(const Texture& texture, const TextureRef& texture_ref, const Eigen::Vector2d& uv,
                       double lod) {
    const double last = static_cast<double>(texture.levels.size() - 1);
    const double clamped = lod > 0 ? std::min(lod, last) : 0;
    const auto level = static_cast<std::size_t>(clamped);
    const auto t = static_cast<float>(clamped - static_cast<double>(level));
    Eigen::Vector4f fine = bilinear(texture, texture.levels[level], texture_ref, uv);
    if (!(t > 0)) return fine;
    return (1 - t) * fine + t * bilinear(texture, texture.levels[level + 1], texture_ref, uv);
}

}  // namespace faqem::render
