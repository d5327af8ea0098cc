#include "fuzz/fuzz.hpp"

using namespace faqem;

namespace {

/// A large picture only takes longer: the decoders are libpng's and libjpeg's. Looks at every place where a
/// size might be.
bool might_be_large(fuzz::Bytes bytes) {
    const auto number = [&](std::size_t at, std::size_t size) {
        std::uint64_t value = 0;
        for (const std::uint8_t byte : bytes.subspan(at, size)) value = value << 8 | byte;
        return value;
    };
    if (bytes.size() >= 24 && bytes[0] == 0x89) return number(16, 4) * number(20, 4) > 1 << 20;
    for (std::size_t i = 0; i + 9 <= bytes.size(); ++i)
        if (bytes[i] == 0xFF && bytes[i + 1] >> 4 == 0xC && number(i + 5, 2) * number(i + 7, 2) > 1 << 20)
            return true;
    return false;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (might_be_large({data, size})) return 0;
    Image image;
    image.name = "a";
    image.encoded.assign(data, data + size);
    const auto pixels = fuzz::refusable("image 'a'", [&] { return decode(image); });
    if (!pixels) return 0;
    fuzz::expect(pixels->rgba.size() == std::size_t{4} * pixels->width * pixels->height, "all pixels");
    const Pixels back = decode(encode_png(*pixels, "b"));
    fuzz::expect(back.rgba == pixels->rgba, "the same pixels after encoding");
    return 0;
}
