#pragma once
/// \file
/// Push-pull interpolation: texels that were not baked get the colours of the texels around them. The gutter
/// is not among them: it is baked with its chart, see tile_owners().

#include <cstdint>
#include <vector>

#include "faqem/asset.hpp"

namespace faqem::detail {

/// Range [begin, end) of the channels of RGBA.
struct ChannelRange {
    std::uint32_t begin = 0, end = 4;
};

/// Fills unknown texels by push-pull interpolation (Gortler et al. 1996, The Lumigraph): the image is halved
/// repeatedly by averaging known texels until all are known; then every unknown texel is interpolated from
/// the next coarser image.
/// \param pixels    changed where `known` is zero, in `channels` only
/// \param known     width * height entries, nonzero for baked texels; if all are zero, nothing is changed
/// \param channels  the channels to be filled
/// Complexity: O(texels) time, 5/3 bytes of memory per texel.
void push_pull(Pixels& pixels, const std::vector<std::uint8_t>& known, ChannelRange channels);

}  // namespace faqem::detail
