#include "bake/texture/constant_image.hpp"

#include <algorithm>
#include <cmath>

namespace faqem::detail {

std::array<std::optional<float>, 4> constant_channels(const Pixels& pixels,
                                                      std::span<const std::uint8_t> known) {
    std::array<std::uint8_t, 4> low = {255, 255, 255, 255}, high = {};
    bool is_empty = true;
    for (std::size_t i = 0; i < pixels.rgba.size() / 4; ++i) {
        if (!known[i]) continue;
        is_empty = false;
        for (std::size_t k = 0; k < 4; ++k) {
            low[k] = std::min(low[k], pixels.rgba[4 * i + k]);
            high[k] = std::max(high[k], pixels.rgba[4 * i + k]);
        }
    }
    std::array<std::optional<float>, 4> result;
    for (std::size_t k = 0; k < 4 && !is_empty; ++k) {
        if (high[k] - low[k] <= 1) result[k] = static_cast<float>(low[k] + high[k]) / 2;
    }
    return result;
}

bool is_flat_normal_map(const Pixels& pixels, std::span<const std::uint8_t> known) {
    const auto [x, y, z, alpha] = constant_channels(pixels, known);
    const auto is_zero = [](const std::optional<float>& c) { return c && std::abs(*c - 127.5f) <= 1; };
    return is_zero(x) && is_zero(y) && z && *z >= 254;
}

}  // namespace faqem::detail
