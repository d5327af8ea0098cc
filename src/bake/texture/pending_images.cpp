#include "bake/texture/pending_images.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <unordered_set>
#include <utility>

#include "asset/image/codecs.hpp"

namespace faqem::detail {
namespace {

Content encoded_content(TextureContent content) { return is_color(content) ? Content::color : Content::data; }

// An image in a format without has_image_quality().
Image encode_in_format(const PendingImage& pending, const BakeOptions& bake) {
    if (bake.image_format == ImageFormat::source && pending.original) return *pending.original;
    const bool is_jpeg =
        bake.image_format == ImageFormat::source ? pending.was_jpeg : bake.image_format == ImageFormat::jpeg;
    return is_jpeg && !pending.pixels.has_alpha ? encode_jpeg(pending.pixels, pending.name, bake.jpeg_quality,
                                                              encoded_content(pending.content))
                                                : encode_png(pending.pixels, pending.name);
}

Image encoded_image(const PendingImage& pending, const BakeOptions& bake, const RunContext& context) {
    const Pixels& pixels = pending.pixels;
    const Content content = encoded_content(pending.content);
    if (has_image_quality(bake.image_format)) {
        const bool is_webp = bake.image_format == ImageFormat::webp && is_color(pending.content);
        const bool may_be_webp = bake.image_format != ImageFormat::png_or_jpeg;
        const ImageLimits limits{
            least_quality(bake, pending.content, pending.roughness, pending.quality_change),
            pending.may_shrink, !is_webp,
            bake.image_format == ImageFormat::webp || (may_be_webp && pending.tries_webp), pending.repeats};
        Image smallest = encode_smallest(pixels, *pending.known, pending.name, content, limits, context);
        const bool was_webp = pending.original && pending.original->mime_type == "image/webp";
        const bool keeps_original = pending.original && (was_webp ? may_be_webp : !is_webp) &&
                                    smallest.encoded.size() >= pending.original->encoded.size();
        return keeps_original ? *pending.original : std::move(smallest);
    }
    return encode_in_format(pending, bake);
}

using Codec = ImageEncoding::Codec;

// Levels by fineness, in steps of fineness_step. A JPEG with the step has about the bytes and the error of a WebP with the quality.
constexpr std::array<std::uint32_t, 8> webp_levels = {20, 40, 55, 68, 80, 88, 94, 98};
constexpr std::array<std::uint32_t, 8> jpeg_levels = {45, 30, 20, 13, 9, 6, 4, 2};
constexpr std::array<std::uint32_t, 4> png_levels = {6, 3, 1, 0};

// The fineness after those of lossy encodings.
constexpr std::uint32_t last_fineness = 8 * fineness_step;

// JPEGs of colours with larger steps have chroma of half the resolution.
constexpr std::uint32_t full_chroma_step = 9;

// Lossless encodings are small for images with at most so many colours, as a palette has.
constexpr std::size_t few_colors = 256;

// Largest sides of the formats, texels.
constexpr std::uint32_t webp_side = 16383, jpeg_side = 65500;

bool has_few_colors(const Pixels& pixels) {
    std::unordered_set<std::uint32_t> colors;
    for (std::size_t i = 0; i < pixels.rgba.size(); i += 4) {
        std::uint32_t color = 0;
        std::memcpy(&color, &pixels.rgba[i], 4);
        if (colors.insert(color).second && colors.size() > few_colors) return false;
    }
    return true;
}

// Adds levels and what is between them.
template <std::size_t n>
void add_encodings(std::vector<ImageEncoding>& result, Codec codec,
                   const std::array<std::uint32_t, n>& levels) {
    for (std::uint32_t fineness = 0; fineness <= (n - 1) * fineness_step; ++fineness) {
        const std::uint32_t before = levels[fineness / fineness_step], part = fineness % fineness_step;
        const std::uint32_t after = part > 0 ? levels[fineness / fineness_step + 1] : before;
        const std::uint32_t level = (before * (fineness_step - part) + after * part) / fineness_step;
        const bool is_new = level != after && level != result.back().level;
        if (part == 0 || is_new) result.push_back({codec, level, fineness});
    }
}

}  // namespace

bool tries_webp(const Asset& source) {
    return source.source && std::any_of(source.images.begin(), source.images.end(),
                                        [](const Image& image) { return image.mime_type == "image/webp"; });
}

void halve(PendingImage& image) {
    const std::size_t width = image.pixels.width;
    image.pixels = halved(image.pixels);
    std::vector<std::uint8_t> known(std::size_t{image.pixels.width} * image.pixels.height);
    for (std::size_t i = 0; i < known.size(); ++i) {
        const std::uint8_t* const first =
            image.known->data() + 2 * (i / image.pixels.width) * width + 2 * (i % image.pixels.width);
        known[i] = first[0] | first[1] | first[width] | first[width + 1];
    }
    image.known = std::make_shared<const std::vector<std::uint8_t>>(std::move(known));
    image.original.reset();
}

void encode_pending_images(std::span<const PendingImage> pending, const BakeOptions& bake,
                           const RunContext& context, std::vector<Image>& images) {
    parallel_blocks(pending.size(), 1, context,
                    [&](std::size_t i, std::size_t, const RunContext& block_context) {
                        block_context.check_now();
                        images[pending[i].image] = encoded_image(pending[i], bake, block_context);
                    });
}

std::vector<ImageEncoding> image_encodings(const PendingImage& pending, const BakeOptions& bake) {
    if (!has_image_quality(bake.image_format)) return {{}};
    const Pixels& pixels = pending.pixels;
    const std::uint32_t side = std::max(pixels.width, pixels.height);
    const bool is_webp = bake.image_format == ImageFormat::webp;
    const bool may_be_webp = is_webp || (bake.image_format != ImageFormat::png_or_jpeg && pending.tries_webp);
    const bool may_be_core = !(is_webp && is_color(pending.content));
    std::vector<ImageEncoding> result;
    if (may_be_webp && side <= webp_side) {
        add_encodings(result, Codec::webp, webp_levels);
        result.push_back({Codec::near_lossless_webp, 40, last_fineness});
    }
    if (may_be_core) {
        if (pixels.has_alpha) {
            for (std::uint32_t i = 0; i < png_levels.size(); ++i)
                result.push_back({Codec::png, png_levels[i], 2 * i * fineness_step});
        } else if (side <= jpeg_side) {
            add_encodings(result, Codec::jpeg, jpeg_levels);
        }
    }
    if (has_few_colors(pixels)) {
        if (may_be_core && !pixels.has_alpha) result.push_back({Codec::png, 0, 0});
        if (may_be_webp && side <= webp_side) result.push_back({Codec::lossless_webp, 100, 0});
    }
    if (pending.original) {
        const bool was_webp = pending.original->mime_type == "image/webp";
        const bool is_allowed = was_webp ? bake.image_format != ImageFormat::png_or_jpeg : may_be_core;
        if (is_allowed) result.push_back({Codec::original, 0, 0});
    }
    if (result.empty()) result.push_back({Codec::png, 0, 0});
    std::ranges::stable_sort(result, {}, &ImageEncoding::fineness);
    return result;
}

Image encode_as(const PendingImage& pending, const BakeOptions& bake, const ImageEncoding& encoding) {
    const auto webp = [&](WebpMode mode) {
        return encode_webp(pending.pixels, pending.name,
                           {.mode = mode, .level = static_cast<int>(encoding.level)});
    };
    switch (encoding.codec) {
        case Codec::standard:
            break;
        case Codec::original:
            return *pending.original;
        case Codec::jpeg: {
            const bool has_half_chroma = is_color(pending.content) && encoding.level > full_chroma_step;
            return write_jpeg(pending.pixels, pending.name,
                              {encoding.level, has_half_chroma ? Chroma::half : Chroma::full});
        }
        case Codec::png:
            return write_png(pending.pixels, pending.name, static_cast<int>(encoding.level));
        case Codec::webp:
            return webp(WebpMode::lossy);
        case Codec::near_lossless_webp:
            return webp(WebpMode::near_lossless);
        case Codec::lossless_webp:
            return webp(WebpMode::lossless);
    }
    return encode_in_format(pending, bake);
}

double mean_square_error(const PendingImage& pending, const Image& encoded) {
    return mean_square_of(
        shown_quality(pending.pixels, decode(encoded), *pending.known, pending.repeats).whole);
}

}  // namespace faqem::detail
