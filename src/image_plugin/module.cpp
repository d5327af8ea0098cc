// The exported function of the image plugin, which load.cpp looks up.

#include "asset/image/image_codec.hpp"
#include "faqem/export.hpp"

extern "C" FAQEM_EXPORT const faqem::detail::ImageCodec* faqem_image_codec() {
    return &faqem::detail::oiio_image_codec();
}
