// Images of parts that keep their UVs: encoded again where something changed.

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "asset/gltf/source_document.hpp"
#include "bake/keep/kept_images.hpp"
#include "support/catch.hpp"
#include "support/scenes.hpp"

using namespace faqem;
using namespace faqem::test;

namespace {

Pixels smooth(std::uint32_t size, std::uint8_t alpha = 255) {
    return paint(size, size, [=](std::uint32_t x, std::uint32_t y) {
        return Rgba{static_cast<std::uint8_t>(50 + x * 150 / size),
                    static_cast<std::uint8_t>(50 + y * 150 / size), 90,
                    static_cast<std::uint8_t>(x < size / 2 ? 255 : alpha)};
    });
}

// The images of an asset after add_kept_images() and encode_pending_images(), with one part that keeps its UVs.
Asset encoded(const Asset& asset, const BakeOptions& bake,
              std::vector<detail::KeptPart> parts = {{0, false}}) {
    detail::UnencodedResult out;
    Asset& result = out.asset.asset;
    result.parts = asset.parts;
    result.materials = asset.materials;
    result.images = asset.images;
    detail::add_kept_images(asset, bake, parts, {}, out);
    detail::encode_pending_images(out.pending, bake, {}, result.images);
    return result;
}

}  // namespace

TEST_CASE("kept images: fewer texels and bytes where the loss is within the quality") {
    const Asset asset = textured_square(smooth(128));
    const Image image = encoded(asset, {}).images[0];
    CHECK(decode(image).width < 128);
    CHECK(image.encoded.size() < asset.images[0].encoded.size());
}

TEST_CASE("kept images: the bytes of the source stay where another part keeps its images") {
    Asset asset = textured_square(smooth(128));
    asset.parts.push_back(square());
    CHECK(encoded(asset, {}, {{0, false}, {1, true}}).images[0].encoded == asset.images[0].encoded);
    BakeOptions source;
    source.image_format = ImageFormat::source;
    CHECK(encoded(asset, source).images[0].encoded == asset.images[0].encoded);
}

TEST_CASE("kept images: a texture without filter keeps its resolution") {
    Asset asset = textured_square(smooth(128));
    asset.materials[0].base_color_texture.filter = Filter::nearest;
    BakeOptions bake;
    bake.texture_size = 64;
    CHECK(decode(encoded(asset, bake).images[0]).width == 128);
}

TEST_CASE("kept images: texture_size is a maximum, for lossless images too") {
    const Asset asset = textured_square(smooth(256));
    BakeOptions bake = lossless().bake;
    bake.texture_size = 64;
    const Image image = encoded(asset, bake).images[0];
    CHECK(image.mime_type == "image/png");
    CHECK(decode(image).width == 64);
}

TEST_CASE("kept images: alpha stays only where the material uses it") {
    Asset asset = textured_square(smooth(64, 100));
    CHECK_FALSE(decode(encoded(asset, lossless().bake).images[0]).has_alpha);
    asset.materials[0].alpha_mode = AlphaMode::blend;
    CHECK(decode(encoded(asset, lossless().bake).images[0]).has_alpha);
}

TEST_CASE("kept images: those of unknown extensions stay as they are") {
    Asset asset = textured_square(smooth(128));
    asset.materials[0].extension_textures.push_back(
        {"VENDOR_paint", "paintTexture", asset.materials[0].base_color_texture});
    CHECK(encoded(asset, {}).images[0].encoded == asset.images[0].encoded);
}

TEST_CASE("kept images: all texels count where an animation moves the texture, and only there") {
    Asset asset = textured_square(smooth(64));
    for (Vec2f& uv : asset.parts[0].uvs[0]) uv = {uv[0] / 4, uv[1] / 4};
    asset.materials[0].source = 1;
    const auto uncounted = [&](const std::string& pointer) {
        const auto source = std::make_shared<SourceDocument>();
        source->document["extensionsUsed"] = {"KHR_animation_pointer"};
        source->document["materials"] = {detail::Json::object(), detail::Json::object()};
        source->document["animations"][0]["channels"][0]["target"]["extensions"]["KHR_animation_pointer"] = {
            {"pointer", pointer}};
        asset.source = source;
        detail::UnencodedResult out;
        out.asset.asset = asset;
        detail::add_kept_images(asset, {}, std::vector<detail::KeptPart>{{0, false}}, {}, out);
        const std::vector<std::uint8_t>& known = *out.pending.at(0).known;
        return std::count(known.begin(), known.end(), 0);
    };
    const std::string offset =
        "/pbrMetallicRoughness/baseColorTexture/extensions/KHR_texture_transform/offset";
    CHECK(uncounted("/materials/1" + offset) == 0);
    CHECK(uncounted("/materials/0" + offset) > 2000);
    CHECK(uncounted("/nodes/0/translation") > 2000);
}
