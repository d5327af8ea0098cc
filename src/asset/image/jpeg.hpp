#pragma once
/// \file
/// Decoding and encoding of JPEG files.

#include <cstdint>
#include <string>

#include "faqem/asset.hpp"
#include "faqem/export.hpp"

namespace faqem::detail {

/// Decodes a JPEG to RGBA: grey, YCbCr, RGB, CMYK or YCCK, baseline or progressive. CMYK is taken as inverted, as
/// Adobe's programs write it.
/// \param image  its declared size has been checked
/// \throws InputError  the image is damaged. Whatever libjpeg warns of is damage, for example bytes that are
///                     missing at the end
/// O(pixels + bytes)
Pixels read_jpeg(const Image& image);

/// Encodes pixels as a baseline JPEG with the best Huffman codes, without alpha.
/// \param pixels   of the declared size, at least one
/// \param name     Image::name of the result
/// \param quality  in [1, 100]
/// \param content  below quality 90 the chroma of Content::color has half the resolution in both directions
/// \throws WriteError  a side is longer than 65500 pixels
/// O(pixels)
Image write_jpeg(const Pixels& pixels, const std::string& name, std::uint32_t quality, Content content);

/// Resolution of the chroma of a JPEG.
enum class Chroma { full, half };

/// How coarsely write_jpeg() rounds coefficients, chosen for the mean squared error: the tables that a quality stands
/// for are coarser at high frequencies, as for pictures that are viewed from one distance, which textures are not. At
/// the same error, files are 15 to 25% smaller (docs/measurements/appearance.md, "Image formats").
struct JpegRounding {
    std::uint32_t step =
        16;  ///< in [1, 100]: step of the lowest frequency; that of the highest is 2.4 times as large
    Chroma chroma = Chroma::full;
};

/// The same with steps instead of a quality.
FAQEM_EXPORT Image write_jpeg(const Pixels& pixels, const std::string& name, const JpegRounding& rounding);

}  // namespace faqem::detail
