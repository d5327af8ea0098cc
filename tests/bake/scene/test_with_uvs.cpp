// Results that keep their UVs, with images that are encoded in several sizes.

#include "bake/scene/unencoded_result.hpp"

#include <memory>
#include <utility>

#include "asset/gltf/source_document.hpp"
#include "scene/parts/simplify_parts.hpp"
#include "support/catch.hpp"
#include "support/scenes.hpp"

using namespace faqem;
using namespace faqem::detail;
using namespace faqem::test;

namespace {

constexpr std::array<std::uint64_t, 3> steps = {100, 40, 12};

Asset textured_sheet() {
    Asset asset = textured_square(ramp(64));
    asset.parts = {uv_mapped(sheet(10, [](double x, double y) {
        return Vec3{x / 10, y / 10, 0.001 * x * y};
    }))};
    return asset;
}

Options keeping() { return {.bake = {.kind = Bake::keep}}; }

UnencodedResult with_uvs(const Asset& asset) {
    const Options options = keeping();
    return bake_with_uvs(asset, simplify_parts_in_steps(asset, steps, options, {})[1], options, {});
}

}  // namespace

TEST_CASE("simplification in steps reaches each target, and each result can be baked") {
    const Asset asset = textured_sheet();
    const std::vector<SimplifiedParts> results = simplify_parts_in_steps(asset, steps, keeping(), {});
    REQUIRE(results.size() == 3);
    for (std::size_t i = 0; i < results.size(); ++i) {
        CHECK(results[i].report.faces_out <= steps[i]);
        CHECK(results[i].report.faces_out + 2 >= steps[i]);
        CHECK(bake_with_uvs(asset, results[i], keeping(), {}).asset.asset.parts[0].triangles.size() ==
              results[i].report.faces_out);
    }
}

TEST_CASE("a result with UVs has pending images, which can be halved and encoded again") {
    UnencodedResult result = with_uvs(textured_sheet());
    CHECK(result.asset.report.kept_uvs.size() == 1);
    REQUIRE(result.pending.size() == 1);
    limit_image_sides(result, 64);
    CHECK(result.pending[0].pixels.width == 64);
    limit_image_sides(result, 20);
    CHECK(result.pending[0].pixels.width == 16);
    CHECK(result.pending[0].known->size() == 16 * 16);
    encode_images(result, keeping(), {});
    const Pixels pixels = decode(result.asset.asset.images.at(0));
    CHECK(pixels.width <= 16);
    CHECK(result.asset.report.images.at(0).width == pixels.width);
    result.pending[0].may_shrink = false;  // as for images that are shown without filter
    limit_image_sides(result, 8);
    CHECK(result.pending[0].pixels.width == 16);
}

TEST_CASE("a result with UVs has the images of the source if their format is asked for") {
    const Asset asset = textured_sheet();
    Options options = keeping();
    const SimplifiedParts parts = simplify_parts_in_steps(asset, steps, options, {})[1];
    options.bake.image_format = ImageFormat::source;
    const UnencodedResult result = bake_with_uvs(asset, parts, options, {});
    CHECK(result.pending.empty());
    CHECK(result.asset.asset.images.at(0).encoded == asset.images[0].encoded);
}

TEST_CASE("materials and images that no face has are removed, and the others keep theirs") {
    Asset asset = textured_sheet();
    const Index image = add_texture(asset, ramp(32));
    asset.materials.insert(asset.materials.begin(), asset.materials[0]);
    asset.materials[1].base_color_texture.image = image;
    asset.materials[1].name = "used";
    for (Index& m : asset.parts[0].face_material) m = 1;
    UnencodedResult result = with_uvs(asset);
    REQUIRE(result.asset.asset.images.size() == 2);
    remove_unused_materials(result);
    const Asset& left = result.asset.asset;
    REQUIRE(left.materials.size() == 1);
    REQUIRE(left.images.size() == 1);
    CHECK(left.materials[0].name == "used");
    CHECK(left.materials[0].base_color_texture.image == 0);
    CHECK(left.images[0].encoded == asset.images[image].encoded);
    for (const Index m : left.parts[0].face_material) CHECK(m == 0);
    REQUIRE(result.pending.size() == 1);
    CHECK(result.pending[0].image == 0);
}

TEST_CASE("materials of variants are not removed, although no face has them") {
    Asset asset = textured_sheet();
    asset.materials.push_back(asset.materials[0]);
    asset.materials[1].base_color_texture.image = add_texture(asset, ramp(32));
    SourceDocument document;
    document.document = Json::parse(R"({"materials":[{},{}],"meshes":[{"primitives":[
        {"extensions":{"KHR_materials_variants":{"mappings":[{"material":1,"variants":[0]}]}}}]}]})");
    asset.source = std::make_shared<const SourceDocument>(std::move(document));
    for (Index m = 0; m < 2; ++m) asset.materials[m].source = m;
    asset.parts[0].source = 0;
    UnencodedResult result = with_uvs(asset);
    remove_unused_materials(result);
    CHECK(result.asset.asset.materials.size() == 2);
    CHECK(result.asset.asset.images.size() == 2);
}
