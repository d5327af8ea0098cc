#include "asset/image/image_checks.hpp"

#include <cstdint>

#include "faqem/error.hpp"

namespace faqem::detail {
namespace {

constexpr std::uint64_t max_decoded_bytes = std::uint64_t{1} << 30;

std::string text_of(const ImageSize& size) {
    return std::to_string(size.width) + " x " + std::to_string(size.height);
}

}  // namespace

std::string image_title(const Image& image) {
    return image.name.empty() ? "image" : "image '" + image.name + "'";
}

void fail_image(const Image& image, const std::string& what) {
    throw InputError(image.uri, image_title(image), what);
}

void fail_truncated_image(const Image& image, const ImageSize& size) {
    fail_image(image, "is damaged: " + std::to_string(image.encoded.size()) + " bytes cannot hold " +
                          text_of(size) + " pixels");
}

void check_image_size(const Image& image, const ImageSize& size) {
    if (size.width == 0 || size.height == 0 || size.width > max_image_side || size.height > max_image_side ||
        size.pixels() * 4 > max_decoded_bytes)
        fail_image(image, "is " + text_of(size) + " pixels, at most " +
                              text_of({max_image_side, max_image_side}) + " are supported");
}

}  // namespace faqem::detail
