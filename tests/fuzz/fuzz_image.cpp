#include "asset/image/image.hpp"
#include "asset/image/image_size.hpp"
#include "fuzz/fuzz.hpp"

using namespace faqem;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    // Large images are skipped: they only take longer, and the decoders belong to other projects. So does all of the
    // plugin but the header, which is read here.
    Image image;
    image.name = "a";
    image.encoded.assign(data, data + size);
    // Models name TGA images by their extension, since these have no signature.
    Image by_name = image;
    by_name.mime_type = "image/x-tga";
    detail::declared_size(by_name);
    const auto declared = detail::declared_size(image);
    if ((declared && declared->pixels() > 1 << 20) || detail::needs_plugin(image)) return 0;
    const auto pixels = fuzz::refusable("image 'a'", [&] { return decode(image); });
    if (!pixels) return 0;
    fuzz::expect(pixels->rgba.size() == std::size_t{4} * pixels->width * pixels->height, "all pixels");
    const Pixels back = decode(encode_png(*pixels, "b"));
    fuzz::expect(back.rgba == pixels->rgba, "the same pixels after encoding");
    return 0;
}
