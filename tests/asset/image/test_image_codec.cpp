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

Pixels decode_to_nothing(const Image&, const std::string& format) {
    ++decode_calls;
    return {static_cast<std::uint32_t>(format.size()), 0, {}, false};
}

constexpr detail::ImageCodec fake_codec = {"test", reads_webp, decode_to_nothing};

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
    has_webp = true;
    CHECK(provider_calls == 0);
    std::vector<std::thread> threads;
    for (int i = 0; i < 4; ++i) threads.emplace_back([] { detail::can_decode_image("image/webp"); });
    for (std::thread& thread : threads) thread.join();
    CHECK(decode(webp_header()).width == 4);  // "webp"
    CHECK(decode_calls == 1);
    CHECK(provider_calls == 1);
}

TEST_CASE("an image codec provider that throws is called again") {
    const WithProvider fake(provide_fake);
    has_webp = provider_fails = true;
    for (int i = 0; i < 2; ++i) CHECK_THROWS_WITH(decode(webp_header()), "no codec");
    CHECK(provider_calls == 2);
    provider_fails = false;
    CHECK(decode(webp_header()).width == 4);
    CHECK(provider_calls == 3);
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
