#pragma once
/// \file
/// What the renderer and the baker share to read texels of textures.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "asset/image/srgb.hpp"
#include "faqem/asset.hpp"

namespace faqem::detail {

/// Linear light of each sRGB byte.
inline const std::array<float, 256>& linear_from_srgb_byte() {
    static const auto table = [] {
        std::array<float, 256> t{};
        for (std::size_t i = 0; i < t.size(); ++i)
            t[i] = static_cast<float>(linear_from_srgb(static_cast<double>(i) / 255));
        return t;
    }();
    return table;
}

/// wrapped_texel() of a coordinate outside the image.
inline std::uint32_t wrapped_outside(std::int64_t i, std::int64_t n, Wrap wrap) {
    if (wrap == Wrap::clamp) return static_cast<std::uint32_t>(std::clamp<std::int64_t>(i, 0, n - 1));
    const std::int64_t period = wrap == Wrap::mirror ? 2 * n : n;
    std::int64_t r = i % period;
    if (r < 0) r += period;
    return static_cast<std::uint32_t>(r < n ? r : period - 1 - r);
}

/// The column or row that a coordinate reads.
/// \param i  any
/// \param n  number of columns or rows, > 0
inline std::uint32_t wrapped_texel(std::int64_t i, std::int64_t n, Wrap wrap) {
    return i >= 0 && i < n ? static_cast<std::uint32_t>(i) : wrapped_outside(i, n, wrap);
}

}  // namespace faqem::detail
