#pragma once
/// \file
/// Push-pull interpolation: texels that were not baked get the colours of the texels around them. The gutter
/// is not among them: it is baked with its chart, see tile_owners().

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "faqem/asset.hpp"

namespace faqem::detail {

/// Range [begin, end) of the channels of RGBA.
struct ChannelRange {
    std::uint32_t begin = 0, end = 4;
};

struct PyramidLevel {
    std::uint32_t width = 0, height = 0;
    std::vector<std::uint8_t> rgba, known;
};

inline PyramidLevel push(std::uint32_t width, std::uint32_t height, const std::vector<std::uint8_t>& rgba,
                         const std::vector<std::uint8_t>& known) {
    PyramidLevel result{(width + 1) / 2, (height + 1) / 2, {}, {}};
    const std::size_t size = std::size_t{result.width} * result.height;
    result.rgba.resize(4 * size);
    result.known.resize(size);
    for (std::uint32_t y = 0; y < result.height; ++y) {
        for (std::uint32_t x = 0; x < result.width; ++x) {
            std::array<unsigned, 4> sum{};
            unsigned count = 0;
            for (std::uint32_t j = 2 * y; j < std::min(2 * y + 2, height); ++j) {
                for (std::uint32_t i = 2 * x; i < std::min(2 * x + 2, width); ++i) {
                    const std::size_t at = std::size_t{j} * width + i;
                    if (!known[at]) continue;
                    ++count;
                    for (std::size_t k = 0; k < 4; ++k) sum[k] += rgba[4 * at + k];
                }
            }
            if (count == 0) continue;
            const std::size_t to = std::size_t{y} * result.width + x;
            result.known[to] = 1;
            for (std::size_t k = 0; k < 4; ++k)
                result.rgba[4 * to + k] = static_cast<std::uint8_t>((sum[k] + count / 2) / count);
        }
    }
    return result;
}

/// Bilinear interpolation of the four coarse texels around the centre of a fine one: weights 9, 3, 3 and 1 of
/// 16.
inline std::uint8_t upsampled(const PyramidLevel& coarse, std::uint32_t x, std::uint32_t y, std::size_t k) {
    const auto other = [](std::uint32_t i, std::uint32_t n) {
        const std::uint32_t c = i / 2;
        return i % 2 ? std::min(c + 1, n - 1) : c - (c > 0);
    };
    const std::uint32_t x0 = x / 2, y0 = y / 2, x1 = other(x, coarse.width), y1 = other(y, coarse.height);
    const auto at = [&](std::uint32_t i, std::uint32_t j) -> unsigned {
        return coarse.rgba[4 * (std::size_t{j} * coarse.width + i) + k];
    };
    return static_cast<std::uint8_t>((9 * at(x0, y0) + 3 * at(x1, y0) + 3 * at(x0, y1) + at(x1, y1) + 8) /
                                     16);
}

inline void pull(std::uint32_t width, std::uint32_t height, std::vector<std::uint8_t>& rgba,
                 const std::vector<std::uint8_t>& known, const PyramidLevel& coarse, ChannelRange channels) {
    for (std::uint32_t y = 0; y < height; ++y) {
        for (std::uint32_t x = 0; x < width; ++x) {
            const std::size_t at = std::size_t{y} * width + x;
            if (known[at]) continue;
            for (std::size_t k = channels.begin; k < channels.end; ++k)
                rgba[4 * at + k] = upsampled(coarse, x, y, k);
        }
    }
}

inline bool is_complete(const std::vector<std::uint8_t>& known) {
    return std::ranges::find(known, 0) == known.end();
}

/// Fills unknown texels by push-pull interpolation (Gortler et al. 1996, The Lumigraph): the image is halved
/// repeatedly by averaging known texels until all are known; then every unknown texel is interpolated from
/// the next coarser image.
/// \param pixels    changed where `known` is zero, in `channels` only
/// \param known     width * height entries, nonzero for baked texels; if all are zero, nothing is changed
/// \param channels  the channels to be filled
/// Complexity: O(texels) time, 5/3 bytes of memory per texel.
inline void push_pull(Pixels& pixels, const std::vector<std::uint8_t>& known, ChannelRange channels) {
    if (is_complete(known) || std::ranges::none_of(known, [](std::uint8_t k) { return k; })) return;
    std::vector<PyramidLevel> levels;
    levels.push_back(push(pixels.width, pixels.height, pixels.rgba, known));
    while (!is_complete(levels.back().known)) {
        const PyramidLevel& last = levels.back();
        levels.push_back(push(last.width, last.height, last.rgba, last.known));
    }
    for (std::size_t i = levels.size() - 1; i-- > 0;) {
        PyramidLevel& fine = levels[i];
        pull(fine.width, fine.height, fine.rgba, fine.known, levels[i + 1], {});
    }
    pull(pixels.width, pixels.height, pixels.rgba, known, levels.front(), channels);
}

}  // namespace faqem::detail
