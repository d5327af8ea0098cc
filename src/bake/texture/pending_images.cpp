#include "bake/texture/pending_images.hpp"

#include <algorithm>
#include <utility>

namespace faqem::detail {
namespace {

Content encoded_content(TextureContent content) { return is_color(content) ? Content::color : Content::data; }

Image encoded_image(const PendingImage& pending, const BakeOptions& bake, const RunContext& context) {
    const Pixels& pixels = pending.pixels;
    const Content content = encoded_content(pending.content);
    if (has_image_quality(bake.image_format)) {
        const bool is_webp = bake.image_format == ImageFormat::webp && is_color(pending.content);
        const bool may_be_webp = bake.image_format != ImageFormat::png_or_jpeg;
        const ImageLimits limits{
            least_quality(bake, pending.content, pending.roughness, pending.quality_change),
            pending.may_shrink, !is_webp,
            bake.image_format == ImageFormat::webp || (may_be_webp && pending.tries_webp)};
        Image smallest = encode_smallest(pixels, *pending.known, pending.name, content, limits, context);
        const bool was_webp = pending.original && pending.original->mime_type == "image/webp";
        const bool keeps_original = pending.original && (was_webp ? may_be_webp : !is_webp) &&
                                    smallest.encoded.size() >= pending.original->encoded.size();
        return keeps_original ? *pending.original : std::move(smallest);
    }
    return encode_in_format(pending, bake);
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

Image encode_in_format(const PendingImage& pending, const BakeOptions& bake) {
    if (bake.image_format == ImageFormat::source && pending.original) return *pending.original;
    const bool is_jpeg =
        bake.image_format == ImageFormat::source ? pending.was_jpeg : bake.image_format == ImageFormat::jpeg;
    return is_jpeg && !pending.pixels.has_alpha ? encode_jpeg(pending.pixels, pending.name, bake.jpeg_quality,
                                                              encoded_content(pending.content))
                                                : encode_png(pending.pixels, pending.name);
}

}  // namespace faqem::detail
