#pragma once

#include <cmath>
#include <cstdint>
#include <string>

#include "result/picture_meter.hpp"
#include "support/cli_support.hpp"

namespace tool_test {

/// A curved sheet with a smooth image and some noise.
inline faqem::Asset painted_sheet(faqem::Index n) {
    faqem::Asset asset = sheet(n, 0.2);
    std::uint32_t state = 1;
    const auto color = [&](std::uint32_t x, std::uint32_t y) {
        state = state * 1664525u + 1013904223u;
        const auto noise = static_cast<std::uint8_t>(state >> 28);
        const auto wave = static_cast<std::uint8_t>(100 + 80 * std::sin(0.1 * x) * std::cos(0.07 * y));
        return faqem::test::Rgba{wave, static_cast<std::uint8_t>(x / 2 + noise),
                                 static_cast<std::uint8_t>(y / 2 + noise), 255};
    };
    asset.images[0] = faqem::encode_png(faqem::test::paint(256, 256, color), "painted");
    return asset;
}

/// PSNR of the pictures of a result, beside those of `in.glb` in the same folder, dB.
inline double psnr_of(const Folder& folder, const std::string& file) {
    const faqem::detail::PictureMeter meter(faqem::load(folder / "in.glb"), 0);
    return faqem::detail::picture_psnr(meter(faqem::load(folder / file)));
}

}  // namespace tool_test
