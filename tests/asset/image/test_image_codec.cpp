// The choice of the image codec.

#include "asset/image/image_codec.hpp"

#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "asset/image/image.hpp"
#include "faqem/error.hpp"
#include "support/catch.hpp"
#include "support/format_support.hpp"

using namespace faqem;
using namespace faqem::testing;

namespace {

int provider_calls = 0;
int decode_calls = 0;
bool has_webp = false;
bool provider_fails = false;

bool reads_webp() { return has_webp; }

Pixels decode_to_nothing(const Image&, const std::string& format, engine::CancellationCheck) {
    ++decode_calls;
    return {static_cast<std::uint32_t>(format.size()), 0, {}, false};
}

Image encode_jpeg_to_name(const Pixels&, const std::string& name, std::uint32_t quality, Content,
                          engine::CancellationCheck) {
    Image image;
    image.name = "JPEG " + name + " " + std::to_string(quality);
    return image;
}

constexpr detail::ImageCodec fake_codec = {"test", reads_webp, decode_to_nothing, encode_jpeg_to_name};

const detail::ImageCodec& provide_fake() {
    ++provider_calls;
    if (provider_fails) throw Error("no codec");
    return fake_codec;
}

/// Sets an image codec provider; restores the previous one at the end of the scope.
class WithProvider {
public:
    explicit WithProvider(detail::ImageCodecProvider provider)
        : previous_(detail::set_image_codec_provider(provider)) {
        provider_calls = 0;
        decode_calls = 0;
        has_webp = false;
        provider_fails = false;
    }
    ~WithProvider() { detail::set_image_codec_provider(previous_); }
    WithProvider(const WithProvider&) = delete;
    WithProvider& operator=(const WithProvider&) = delete;

    detail::ImageCodecProvider previous() const { return previous_; }

private:
    detail::ImageCodecProvider previous_;
};

/// The bytes of a JPEG of 1 x 1 pixels up to the end of its header.
Image jpeg_header() {
    using namespace std::string_literals;
    return image_of("\xff\xd8\xff\xc0\0\x0b\x08\0\1\0\1\1\1\x11\0"s);
}

/// Encodes with quality 90.
Image encode(const Pixels& pixels, const std::string& name) {
    return encode_jpeg(pixels, name, 90, Content::color);
}

/// The bytes of a lossy WebP of 1 x 1 pixels up to the end of its header.
Image webp_header() {
    using namespace std::string_literals;
    return image_of("RIFF\x16\0\0\0WEBPVP8 \x0a\0\0\0\x10\0\0\x9d\x01\x2a\1\0\1\0"s);
}

}  // namespace

TEST_CASE("the default image codec of faqem::asset uses OpenImageIO") {
    const WithProvider fake(provide_fake);
    CHECK(fake.previous() == &detail::oiio_image_codec);
}

TEST_CASE("the image codec provider is called once, when the codec is needed") {
    const WithProvider fake(provide_fake);
    CHECK(provider_calls == 0);
    std::vector<std::thread> threads;
    for (int i = 0; i < 4; ++i) threads.emplace_back([] { encode({}, "a"); });
    for (std::thread& thread : threads) thread.join();
    CHECK(encode({}, "a").name == "JPEG a 90");
    CHECK(decode(jpeg_header()).width == 4);  // "jpeg"
    CHECK(decode_calls == 1);
    CHECK(provider_calls == 1);
}

TEST_CASE("setting the image codec provider switches the codec") {
    const Pixels pixels{1, 1, {1, 2, 3, 255}, false};
    const Image before = encode(pixels, "a");
    {
        const WithProvider fake(provide_fake);
        CHECK(encode(pixels, "a").name == "JPEG a 90");
        CHECK(detail::set_image_codec_provider(detail::oiio_image_codec) == &provide_fake);
        CHECK(encode(pixels, "a").encoded == before.encoded);
        CHECK(detail::set_image_codec_provider(provide_fake) == &detail::oiio_image_codec);
        CHECK(encode(pixels, "a").name == "JPEG a 90");
        CHECK(provider_calls == 2);
    }
    CHECK(encode(pixels, "a").encoded == before.encoded);
}

TEST_CASE("an image codec provider that throws is called again") {
    const WithProvider fake(provide_fake);
    provider_fails = true;
    for (int i = 0; i < 2; ++i) CHECK_THROWS_WITH(encode({}, "a"), "no codec");
    CHECK_THROWS_WITH(decode(jpeg_header()), "no codec");
    CHECK(provider_calls == 3);
    provider_fails = false;
    CHECK(encode({}, "a").name == "JPEG a 90");
    CHECK(encode({}, "a").name == "JPEG a 90");
    CHECK(provider_calls == 4);
}

TEST_CASE("PNG and JPEG are known to be supported without the image codec, WebP is not") {
    const WithProvider fake(provide_fake);
    CHECK(detail::can_decode_image("image/png"));
    CHECK(detail::can_decode_image("image/jpeg"));
    CHECK_FALSE(detail::can_decode_image("image/ktx2"));
    CHECK(provider_calls == 0);
    CHECK_FALSE(detail::can_decode_image("image/webp"));
    CHECK(provider_calls == 1);
    CHECK_THROWS_WITH(decode(webp_header()),
                      ContainsSubstring("image/webp is not supported; only PNG and JPEG are supported"));
    CHECK(decode_calls == 0);
    has_webp = true;
    CHECK(detail::can_decode_image("image/webp"));
    CHECK(detail::decodable_format_names() == "PNG, JPEG and WebP");
    CHECK(decode(webp_header()).width == 4);  // "webp"
    CHECK(provider_calls == 1);
}

TEST_CASE("the header of an image is checked before the image codec is needed") {
    const WithProvider fake(provide_fake);
    CHECK_THROWS_AS(decode(image_of("\xff\xd8\xff\xe0")), InputError);
    CHECK(provider_calls == 0);
}
