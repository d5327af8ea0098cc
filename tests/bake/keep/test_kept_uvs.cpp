// Bake::automatic keeps the UVs of parts whose pictures are as good as with new images.

#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "asset/gltf/source_document.hpp"
#include "bake/keep/kept_uvs.hpp"
#include "faqem/bake.hpp"
#include "support/catch.hpp"
#include "support/scenes.hpp"

using namespace faqem;
using namespace faqem::test;

namespace {

// A smooth sheet whose texture is repeated `repeats` times in both directions.
Part tiled_sheet(Index n, float repeats) {
    const auto place = [n](double x, double y) { return Vec3{x / n, y / n, 0.05 * std::sin(3 * x / n)}; };
    const auto uv_of = [&](const Vec3& p) { return std::array{repeats * p[0], repeats * (1 - p[1])}; };
    Part part = uv_mapped(sheet(n, place), uv_of);
    part.name = "sheet";
    return part;
}

// Stripes that differ at every texel.
Pixels weave(std::uint32_t size) {
    return paint(size, size, [](std::uint32_t x, std::uint32_t y) {
        return Rgba{static_cast<std::uint8_t>(40 + 37 * (x * x + 3 * y) % 180),
                    static_cast<std::uint8_t>(60 + 53 * (y * y + x) % 150), 90, 255};
    });
}

Asset tiled_cloth() {
    Asset asset = textured_square(weave(256));
    TextureRef& texture = asset.materials[0].base_color_texture;
    texture.wrap_u = texture.wrap_v = Wrap::repeat;
    asset.parts = {tiled_sheet(24, 40)};
    return asset;
}

// UVs by triangle at random places of the image: every edge is a seam.
Asset shuffled_sheet() {
    Asset asset = textured_square(weave(256));
    const Part from = tiled_sheet(16, 1);
    Part& part = asset.parts[0] = from;
    part.positions.clear();
    part.uvs[0].clear();
    for (std::size_t f = 0; f < from.triangles.size(); ++f) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Index v = from.triangles[f][k];
            part.triangles[f][k] = static_cast<Index>(part.positions.size());
            part.positions.push_back(from.positions[v]);
            const Vec2f& uv = from.uvs[0][v];
            const auto shift = static_cast<float>(f * 7 % 11) / 16;
            part.uvs[0].push_back({uv[0] / 3 + shift, uv[1] / 3 + shift});
        }
    }
    return asset;
}

// A sheet whose UVs do not survive the simplification well, since they differ from smooth ones at every vertex.
Asset distorted_sheet(float amount = 0.03f) {
    Asset asset = textured_square(paint(64, 64, [](std::uint32_t x, std::uint32_t y) {
        return (x / 8 + y / 8) % 2 ? Rgba{250, 250, 250, 255} : Rgba{10, 10, 10, 255};
    }));
    asset.parts = {tiled_sheet(24, 1)};
    std::vector<Vec2f>& uvs = asset.parts[0].uvs[0];
    for (std::size_t v = 0; v < uvs.size(); ++v) uvs[v][0] += amount * static_cast<float>(v * v % 7);
    return asset;
}

// The asset as if read from a document with the same materials, and a mesh for each part.
Asset from_document(Asset asset, detail::Json document) {
    SourceDocument source;
    source.document = std::move(document);
    asset.source = std::make_shared<const SourceDocument>(std::move(source));
    for (Index m = 0; m < asset.materials.size(); ++m) asset.materials[m].source = m;
    for (Index p = 0; p < asset.parts.size(); ++p) asset.parts[p].source = p;
    return asset;
}

// Simplified meshes with given numbers of faces, without and with UVs.
SimplifiedParts with_face_counts(const Asset& asset, const std::vector<std::array<std::size_t, 2>>& counts) {
    SimplifiedParts result;
    for (std::size_t p = 0; p < counts.size(); ++p) {
        for (std::size_t k = 0; k < 2; ++k) {
            SimplifyResult part;
            part.mesh.triangles.assign(asset.parts[p].triangles.begin(),
                                       asset.parts[p].triangles.begin() + static_cast<long>(counts[p][k]));
            (k == 0 ? result.parts : result.with_uvs).push_back(std::move(part));
        }
    }
    return result;
}

std::vector<detail::PartSet> possible_sets(const Asset& asset, SimplifiedParts simplified,
                                           std::uint64_t target) {
    simplified.report.target_faces = target;
    std::vector<detail::BakePart> parts(asset.parts.size());
    for (Index p = 0; p < parts.size(); ++p) {
        parts[p].index = p;
        parts[p].source = &asset.parts[p];
        parts[p].simplified = &simplified.parts[p];
    }
    return detail::sets_with_uvs(asset, parts, simplified);
}

Options tenth() { return {.target = ratio(0.1), .bake = {.texture_size = 256}}; }

}  // namespace

TEST_CASE("kept UVs: a repeated pattern stays an image that is repeated") {
    const Asset asset = tiled_cloth();
    const SimplifiedAsset result = simplify(asset, tenth());
    CHECK(result.report.kept_uvs == std::vector<std::string>{"part 'sheet'"});
    CHECK(result.report.pages.empty());
    CHECK(result.report.faces_out <= result.report.target_faces);
    CHECK(result.report.faces_out == result.asset.parts[0].triangles.size());
    REQUIRE(result.asset.images.size() == 1);
    CHECK(result.asset.materials[0].base_color_texture.wrap_u == Wrap::repeat);
    float largest = 0;
    for (const Vec2f& uv : result.asset.parts[0].uvs[0]) largest = std::max(largest, uv[0]);
    CHECK(largest == Approx(40).epsilon(0.01));
}

TEST_CASE("kept UVs: a part whose UVs cannot follow the simplification gets a new page") {
    const SimplifiedAsset result = simplify(shuffled_sheet(), tenth());
    CHECK(result.report.kept_uvs.empty());
    CHECK(result.report.pages.size() == 1);
    CHECK(result.report.faces_out <= result.report.target_faces);
}

TEST_CASE("kept UVs: parts that share an image keep it together or not at all") {
    Asset asset = shuffled_sheet();
    asset.parts.push_back(tiled_sheet(24, 1));
    for (Vec3& p : asset.parts[1].positions) p[0] += 1;  // beside the other
    CHECK(simplify(asset, tenth()).report.kept_uvs.empty());
    asset.materials.push_back(asset.materials[0]);
    asset.materials[1].base_color_texture.image = add_texture(asset, ramp(128));
    for (Index& m : asset.parts[1].face_material) m = 1;
    const SimplifiedAsset result = simplify(asset, tenth());
    CHECK(result.report.kept_uvs == std::vector<std::string>{"part 'sheet'"});
    CHECK(result.report.pages.size() == 1);
    CHECK(result.asset.parts[0].triangles.size() + result.asset.parts[1].triangles.size() ==
          result.report.faces_out);
}

TEST_CASE("kept UVs: textures without filter stay whole, unless pictures are clearly worse so") {
    Asset asset = distorted_sheet();
    asset.materials[0].base_color_texture.filter = Filter::nearest;
    CHECK(simplify(asset, tenth()).report.kept_uvs.empty());
    asset.parts = distorted_sheet(0.012f).parts;  // a new page would blur the borders of its texels
    CHECK(simplify(asset, tenth()).report.kept_uvs.size() == 1);
    asset.parts = {tiled_sheet(24, 1)};
    const SimplifiedAsset result = simplify(asset, tenth());
    CHECK(result.report.kept_uvs.size() == 1);
    CHECK(result.asset.materials[0].base_color_texture.filter == Filter::nearest);
    CHECK(decode(result.asset.images.at(0)).width == 64);
}

TEST_CASE("kept UVs: a part with material variants keeps them, whatever the pictures") {
    Asset asset = distorted_sheet();
    asset.materials.push_back(asset.materials[0]);
    asset.materials[1].base_color_texture.image = add_texture(asset, ramp(64));
    asset =
        from_document(std::move(asset), detail::Json::parse(R"({"materials":[{},{}],"meshes":[{"primitives":[
        {"extensions":{"KHR_materials_variants":{"mappings":[{"material":1,"variants":[0]}]}}}]}]})"));
    const SimplifiedAsset result = simplify(asset, tenth());
    CHECK(result.report.kept_uvs.size() == 1);
    REQUIRE(result.asset.materials.size() == 2);
    CHECK(result.asset.materials[1].source == 1);
    CHECK_FALSE(result.asset.materials[0].rebaked);
    CHECK(result.asset.images.size() == 2);
}

TEST_CASE("kept UVs: a part with an animated texture transform keeps them, whatever the pictures") {
    const auto kept_with = [](const char* pointer) {
        detail::Json document = detail::Json::parse(R"({"materials":[{}],"meshes":[{"primitives":[{}]}],
            "animations":[{"channels":[{"target":{"path":"pointer"}}]}]})");
        document["animations"][0]["channels"][0]["target"]["extensions"]["KHR_animation_pointer"]["pointer"] =
            pointer;
        return simplify(from_document(distorted_sheet(), document), tenth()).report.kept_uvs.size();
    };
    const std::string texture =
        "/pbrMetallicRoughness/baseColorTexture/extensions/KHR_texture_transform/offset";
    CHECK(kept_with(("/materials/0" + texture).c_str()) == 1);
    CHECK(kept_with(("/materials/01" + texture).c_str()) == 0);
    CHECK(kept_with("/materials/0/pbrMetallicRoughness/baseColorFactor") == 0);
}

TEST_CASE("kept UVs: parts may have a few faces more with them, if the model has no more than its target") {
    const Asset asset = tiled_cloth();
    CHECK(possible_sets(asset, with_face_counts(asset, {{100, 102}}), 102).size() == 1);
    CHECK(possible_sets(asset, with_face_counts(asset, {{100, 102}}), 101).empty());
    CHECK(possible_sets(asset, with_face_counts(asset, {{100, 103}}), 200).empty());
    CHECK(possible_sets(asset, with_face_counts(asset, {{400, 404}}), 404).size() == 1);
    CHECK(possible_sets(asset, with_face_counts(asset, {{100, 100}}), 50).size() == 1);
}

TEST_CASE("kept UVs: sets share the faces that the target leaves") {
    Asset asset = tiled_cloth();
    for (Index p = 1; p < 3; ++p) {
        asset.parts.push_back(asset.parts[0]);
        asset.materials.push_back(asset.materials[0]);
        asset.materials[p].base_color_texture.image = add_texture(asset, ramp(8));
        asset.parts[p].face_material.assign(asset.parts[p].triangles.size(), p);
    }
    const SimplifiedParts simplified = with_face_counts(asset, {{100, 102}, {100, 102}, {100, 99}});
    CHECK(possible_sets(asset, simplified, 303) == std::vector<detail::PartSet>{{0}, {2}});
    CHECK(possible_sets(asset, simplified, 304).size() == 3);
    CHECK(possible_sets(asset, simplified, 300) == std::vector<detail::PartSet>{{2}});
}

TEST_CASE("kept UVs: none are tried when an option is about the atlas or the collapses") {
    const Asset asset = tiled_cloth();
    const auto kept = [&](Options options) { return simplify_parts(asset, options).with_uvs.size(); };
    CHECK(kept(tenth()) == 1);
    Options options = tenth();
    SECTION("history") { options.history = Recording::on; }
    SECTION("correspondence") { options.bake.correspondence = Recording::on; }
    SECTION("kind") { options.bake.kind = Bake::atlas; }
    SECTION("texel density") { options.bake.texel_density = 1; }
    SECTION("normal map") { options.bake.normal_map = NormalMap::on; }
    SECTION("target") { options.target = ratio(1); }
    CHECK(kept(options) == 0);
}

TEST_CASE("kept UVs: the result does not depend on the number of threads") {
    const Asset asset = tiled_cloth();
    Options options = tenth();
    options.threads = 1;
    const SimplifiedAsset one = simplify(asset, options);
    options.threads = 2;
    const SimplifiedAsset two = simplify(asset, options);
    CHECK(one.report.kept_uvs == two.report.kept_uvs);
    CHECK(one.asset.parts[0].positions == two.asset.parts[0].positions);
    CHECK(one.asset.parts[0].uvs == two.asset.parts[0].uvs);
    CHECK(one.asset.images[0].encoded == two.asset.images[0].encoded);
}

TEST_CASE("kept UVs: cancellation at any time gives a cancelled result") {
    const Asset asset = tiled_cloth();
    Options options = tenth();
    int calls = 0;
    options.progress = [&](Phase, double) {
        ++calls;
        return Continue::yes;
    };
    simplify(asset, options);
    const int all = calls;
    for (int limit = 1; limit < all; limit += std::max(1, all / 7)) {
        calls = 0;
        options.progress = [&](Phase, double) { return ++calls < limit ? Continue::yes : Continue::cancel; };
        const SimplifiedAsset result = simplify(asset, options);
        if (calls < limit) continue;  // the number of calls depends on the time
        CHECK(result.report.stop == StopReason::cancelled);
        CHECK(result.asset.parts.empty());
    }
}
