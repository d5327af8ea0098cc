#include "asset/image/image_codec.hpp"

#include <mutex>
#include <utility>

namespace faqem::detail {
namespace {

struct State {
    std::mutex mutex;
    ImageCodecProvider provider;
    const ImageCodec* codec = nullptr;  ///< of `provider`; null until it is needed
};

// FAQEM_DEFAULT_IMAGE_CODEC is oiio_image_codec or plugin_image_codec: each of the two libraries that
// compile this file defines it.
constinit State state{{}, &FAQEM_DEFAULT_IMAGE_CODEC, nullptr};

}  // namespace

ImageCodecProvider set_image_codec_provider(ImageCodecProvider provider) {
    const std::lock_guard lock(state.mutex);
    state.codec = nullptr;
    return std::exchange(state.provider, provider);
}

const ImageCodec& image_codec() {
    const std::lock_guard lock(state.mutex);
    if (!state.codec) state.codec = &state.provider();
    return *state.codec;
}

}  // namespace faqem::detail
