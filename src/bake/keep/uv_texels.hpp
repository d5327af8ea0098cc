#pragma once
/// \file
/// The texels of an image that triangles with texture coordinates show.

#include <array>
#include <cstdint>
#include <vector>

#include "faqem/asset.hpp"

namespace faqem::detail {

/// Marks the texels of an image that triangles show.
class UvTexels {
public:
    /// \param width, height  of the image, > 0
    UvTexels(std::uint32_t width, std::uint32_t height);

    /// Marks the texels of a triangle, and those around it that bilinear filtering reads. Parts outside the image
    /// are marked according to the wrap modes.
    /// \param uv  of the corners, after the texture's transform, v pointing down
    /// Complexity: O(texels that are marked); at most O(texels of the image) over all calls.
    void add(const std::array<Vec2f, 3>& uv, Wrap wrap_u, Wrap wrap_v);

    /// By texel, top row first: nonzero if it is shown. All texels, if none was marked, or if the image is repeated
    /// on the surface.
    std::vector<std::uint8_t> finish() &&;

private:
    std::uint32_t width_, height_;
    std::vector<std::uint8_t> shown_;
    bool is_empty_ = true;
    double repetitions_ = 0;  // area of all triangles, in images
};

}  // namespace faqem::detail
