#pragma once
/// \file
/// Decoding and encoding of PNG, JPEG and WebP files, and decoding of others by plugins, which are loaded when they are
/// first needed.

#include <cstdint>
#include <string>

#include "faqem/asset.hpp"
#include "faqem/export.hpp"

namespace faqem::detail {

/// Decodes a PNG of any colour type and bit depth to 8-bit RGBA. Samples of 16 bits are rounded to the nearest
/// value of 8 bits; gamma, colour profiles and other metadata are skipped.
/// \param image  its declared size has been checked
/// \throws InputError  the image is damaged, or too short for its pixels; the latter is found before memory is
///                     allocated
/// O(pixels + bytes)
Pixels read_png(const Image& image);

/// Encodes pixels as a PNG with 8 bits per sample, as grey or RGB, with alpha or without, or as palette indices:
/// the smallest of those that hold the pixels. Each row has the filter whose result has the least sum of
/// absolute values (W3C PNG specification, "Filter selection").
/// \param pixels  of the declared size, at least one. If Pixels::has_alpha is false, alpha is not written
/// \param name    Image::name of the result
/// \param max_difference  in [0, 127]: by how much a colour value may change, so that filtered values are multiples of
///                        2 max_difference + 1 and compress better. Alpha does not change. This is the near-lossless
///                        mode of JPEG-LS (ISO/IEC 14495-1, A.4.4), with the filters as predictors
/// O(pixels)
FAQEM_EXPORT Image write_png(const Pixels& pixels, const std::string& name, int max_difference = 0);

/// Decodes a JPEG to RGBA: grey, YCbCr, RGB, CMYK or YCCK, baseline or progressive. CMYK is taken as inverted, as
/// Adobe's programs write it.
/// \param image  its declared size has been checked
/// \throws InputError  the image is damaged. Whatever libjpeg warns of is damage, for example bytes that are
///                     missing at the end
/// O(pixels + bytes)
Pixels read_jpeg(const Image& image);

/// Resolution of the chroma of a JPEG.
enum class Chroma { full, half };

/// How coarsely write_jpeg() rounds coefficients, chosen for the mean squared error: the tables that a quality stands
/// for are coarser at high frequencies, as for pictures that are viewed from one distance, which textures are not. At
/// the same error, files are 15 to 25% smaller (docs/measurements/appearance.md, "Image formats").
struct JpegRounding {
    /// In [1, 100]: step of the lowest frequency; that of the highest is 2.4 times as large.
    std::uint32_t step = 16;
    Chroma chroma = Chroma::full;
};

/// Encodes pixels as a baseline JPEG with the best Huffman codes, without alpha, as encode_jpeg() but with steps instead
/// of a quality.
/// \param pixels  of the declared size, at least one
/// \param name    Image::name of the result
/// \throws WriteError  a side is longer than 65500 pixels
/// O(pixels)
FAQEM_EXPORT Image write_jpeg(const Pixels& pixels, const std::string& name, const JpegRounding& rounding);

/// Decodes a WebP to RGBA; of an animation the first picture.
/// \param image  its declared size has been checked
/// \throws InputError  the image is damaged
/// O(pixels + bytes)
Pixels read_webp(const Image& image);

/// Function table of a plugin.
struct ImagePlugin {
    /// Version of faqem that the plugin was built with.
    const char* version;
    /// Decodes an image.
    /// \param format  the name that OpenImageIO has for the format, for example targa; ktx2 for KTX2
    /// \throws InputError        the image is damaged
    /// \throws UnsupportedError  it has more than 8 channels, or more than 32 bits per channel; a KTX2 image is no
    ///                           single picture that Basis Universal encoded
    /// \pre the size in the header is plausible
    Pixels (*decode)(const Image& image, const std::string& format);
};

/// Loads the plugin, with the first call. It is never unloaded, since the libraries it depends on have their own
/// threads. It is a plugin because OpenImageIO depends on about 250 shared libraries, which take 0.3 s and
/// 130 MB.
/// \throws Error  the plugin cannot be loaded from the folder of the calling program or library, nor from its
///                installed location, or belongs to another version; the next call tries again
const ImagePlugin& image_plugin();

/// Whether KTX2 images are decoded: this build has the option for it, and there is a plugin for them where image_plugin()
/// searches. The first call decides.
bool reads_ktx2();

/// Loads the plugin for KTX2 images, with the first call.
/// \throws Error  as image_plugin()
const ImagePlugin& ktx2_plugin();

}  // namespace faqem::detail
