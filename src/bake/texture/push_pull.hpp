#pragma once
/// \file
/// No black texels: what the bake left empty takes the colours around it.

#include <cstdint>
#include <vector>

#include "faqem/asset.hpp"
#include "faqem/engine/util/cancellation.hpp"

namespace faqem::detail {

/// Half-open range of channels of RGBA.
struct ChannelRange {
    std::uint32_t begin = 0, end = 4;
};

/// Push-pull (Gortler et al. 1996, The Lumigraph): the image is halved again and again, averaging what is
/// known, until all is; then every unknown texel is read from the next coarser image.
/// \param pixels  changed where `known` is zero, in `channels` only
/// \param known   width * height; nonzero where the texel is baked. All zero: nothing happens
/// O(texels) time, 5/3 bytes per texel.
/// \throws what the poll throws
void push_pull(Pixels& pixels, const std::vector<std::uint8_t>& known, ChannelRange channels,
               engine::CancellationCheck check_cancelled = {});

}  // namespace faqem::detail
