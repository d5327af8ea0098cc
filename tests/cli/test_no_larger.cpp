#include "cli/no_larger.hpp"

#include <cmath>

#include "cli/budget/byte_budget.hpp"
#include "faqem/bake.hpp"
#include "support/catch.hpp"
#include "support/cli_support.hpp"

using namespace tool_test;
using namespace faqem::cli;

namespace {

// A model with a JPEG of low quality: its new texture has more bytes than the file.
faqem::Asset model_with_small_image() {
    faqem::Asset asset = sheet(6, 0.3);
    faqem::Pixels noise{256, 256, {}, false};
    std::uint32_t state = 1;
    for (std::uint32_t i = 0; i < 256 * 256; ++i) {
        for (int k = 0; k < 3; ++k) {
            state = state * 1664525u + 1013904223u;
            noise.rgba.push_back(static_cast<std::uint8_t>(state >> 24));
        }
        noise.rgba.push_back(255);
    }
    asset.images = {encode_jpeg(noise, "noise", 5, faqem::Content::color)};
    asset.materials.resize(1);
    asset.materials[0].base_color_texture.image = 0;
    return asset;
}

std::uint64_t size_of(const Folder& folder, const char* file) { return fs::file_size(folder / file); }

}  // namespace

TEST_CASE("a textured result that would be larger than its input gives up image quality") {
    const Folder folder;
    faqem::save(model_with_small_image(), folder / "in.glb");
    REQUIRE(run(folder, "simplify in.glb larger.glb --ratio 0.5 --allow-larger --report l.json").code == 0);
    REQUIRE(size_of(folder, "larger.glb") > size_of(folder, "in.glb"));
    CHECK(read(folder / "l.json").find("given up") == std::string::npos);
    REQUIRE(run(folder, "simplify in.glb out.glb --ratio 0.5 --report r.json").code == 0);
    CHECK(size_of(folder, "out.glb") < size_of(folder, "larger.glb"));
    const std::string report = read(folder / "r.json");
    CHECK(report.find("given up, to have no more bytes than the input: ") != std::string::npos);
    CHECK(report.find("image quality (") != std::string::npos);
    CHECK((report.find("more than the input") != std::string::npos) ==
          (size_of(folder, "out.glb") > size_of(folder, "in.glb")));
}

TEST_CASE("less than 34 dB are for results that are not larger with them") {
    const faqem::Asset asset = model_with_small_image();
    faqem::Options options;
    options.target = faqem::ratio(0.5);
    options.bake.normal_map = faqem::NormalMap::off;
    options.bake.image_quality = 24;
    const auto least = simplify_no_larger(asset, options, {"out.glb", 0, LargerResult::allowed});
    const std::uint64_t enough = model_bytes(least.asset, "out.glb").total();
    options.bake.image_quality = low_image_quality;
    const auto detailed = simplify_no_larger(asset, options, {"out.glb", 0, LargerResult::allowed});
    REQUIRE(model_bytes(detailed.asset, "out.glb").total() > enough);
    options.bake.image_quality.reset();
    const auto result = simplify_no_larger(asset, options, {"out.glb", enough, LargerResult::gives_up});
    CHECK(result.report.given_up == std::vector<std::string>{"image quality (24 dB)"});
    CHECK(result.asset.images[0].encoded == least.asset.images[0].encoded);
    const auto larger = simplify_no_larger(asset, options, {"out.glb", enough - 1, LargerResult::gives_up});
    CHECK(larger.report.given_up == std::vector<std::string>{"image quality (34 dB)"});
    CHECK(larger.asset.images[0].encoded == detailed.asset.images[0].encoded);
    REQUIRE(larger.report.images.size() == 1);
    CHECK(larger.report.images[0].bytes == detailed.asset.images[0].encoded.size());
    CHECK(larger.report.warnings.back().find("bytes, more than the input with") != std::string::npos);
}

TEST_CASE("each textured level of lod that would be larger than the input gives something up") {
    const Folder folder;
    faqem::save(model_with_small_image(), folder / "in.glb");
    REQUIRE(run(folder, "lod in.glb larger --levels 0.5,0.2 --allow-larger").code == 0);
    REQUIRE(run(folder, "lod in.glb out --levels 0.5,0.2").code == 0);
    for (const char* level : {"in_LOD1.glb", "in_LOD2.glb"}) {
        INFO(level);
        REQUIRE(fs::file_size(folder / "larger" / level) > size_of(folder, "in.glb"));
        CHECK(fs::file_size(folder / "out" / level) < fs::file_size(folder / "larger" / level));
    }
    CHECK(read(folder / "out/in_LOD0.glb") == read(folder / "larger/in_LOD0.glb"));
    CHECK(read(folder / "out/in_LOD.json").find("given up, to have no more bytes than the input: ") !=
          std::string::npos);
}

TEST_CASE("images that were asked for are not given up, with a warning") {
    const Folder folder;
    faqem::save(model_with_small_image(), folder / "in.glb");
    const std::string larger =
        "simplify in.glb larger.glb --ratio 0.5 --allow-larger --image-quality 40 --quiet";
    REQUIRE(run(folder, larger).code == 0);
    const std::string asked =
        "simplify in.glb out.glb --ratio 0.5 --image-quality 40 --quiet --report r.json";
    REQUIRE(run(folder, asked).code == 0);
    CHECK(read(folder / "out.glb") == read(folder / "larger.glb"));
    CHECK(read(folder / "r.json").find("\"given_up\": []") != std::string::npos);
    CHECK(read(folder / "r.json").find("\"content\": \"POSITION\"") != std::string::npos);
    CHECK(read(folder / "r.json").find("bytes, more than the input with ") != std::string::npos);
}

TEST_CASE("meshes that the simplification leaves as they are stay so when something is given up") {
    faqem::Asset asset = model_with_small_image();
    faqem::Part small;
    small.name = "small";
    small.positions = {{0, 0, 5}, {1, 0, 5}, {0, 1, 5}};
    small.triangles = {{0, 1, 2}};
    small.uvs = {{{0, 0}, {1, 0}, {0, 1}}};
    small.face_material = {0};
    asset.parts.push_back(small);
    faqem::Options options;
    options.target = faqem::ratio(0.5);
    const auto full = simplify_no_larger(asset, options, {"out.glb", 0, LargerResult::allowed});
    const std::uint64_t bytes = model_bytes(full.asset, "out.glb").geometry + 1;
    const auto less = simplify_no_larger(asset, options, {"out.glb", bytes, LargerResult::gives_up});
    CHECK(less.report.warnings.at(less.report.warnings.size() - 2).find("image quality") !=
          std::string::npos);
    REQUIRE(full.report.untouched_parts.size() == 1);
    CHECK(less.report.untouched_parts == full.report.untouched_parts);
    CHECK(less.asset.images.back().encoded == asset.images[0].encoded);
}

TEST_CASE("images are encoded with less and less quality until the result is not larger") {
    const faqem::Asset asset = model_with_small_image();
    faqem::Options options;
    options.target = faqem::ratio(0.5);
    options.bake.kind = faqem::Bake::atlas;
    const auto full = simplify_no_larger(asset, options, {"out.glb", 0, LargerResult::allowed});
    options.bake.image_quality = 24;
    const auto least = simplify_no_larger(asset, options, {"out.glb", 0, LargerResult::allowed});
    options.bake.image_quality = 40;
    const std::uint64_t enough = model_bytes(least.asset, "out.glb").total();
    REQUIRE(enough < model_bytes(full.asset, "out.glb").total());
    const auto result = simplify_no_larger(asset, options, {"out.glb", enough, LargerResult::gives_up});
    CHECK(model_bytes(result.asset, "out.glb").total() <= enough);
    REQUIRE(result.report.images.size() == result.asset.images.size());
    for (std::size_t i = 0; i < result.asset.images.size(); ++i)
        CHECK(result.report.images[i].bytes == result.asset.images[i].encoded.size());
}

TEST_CASE("a normal map that the source does not have goes first, with the tangents for it") {
    faqem::Asset asset = model_with_small_image();
    faqem::Options options;
    options.target = faqem::ratio(0.1);
    options.bake.kind = faqem::Bake::atlas;
    for (faqem::Vec3& p : asset.parts[0].positions) p[2] = 0.5 * std::sin(9 * p[0]) * std::cos(7 * p[1]);
    asset.parts[0].normals.clear();
    const auto full = simplify_no_larger(asset, options, {"out.glb", 0, LargerResult::allowed});
    REQUIRE(full.asset.materials[0].normal_texture);
    const std::uint64_t bytes = model_bytes(full.asset, "out.glb").total() - 1;
    const auto less = simplify_no_larger(asset, options, {"out.glb", bytes, LargerResult::gives_up});
    CHECK_FALSE(less.asset.materials[0].normal_texture);
    CHECK(less.asset.parts[0].tangents.empty());
    CHECK(less.asset.images.size() == full.asset.images.size() - 1);
    CHECK(less.asset.materials[0].base_color_texture.image == 0);
    REQUIRE_FALSE(less.report.warnings.empty());
    CHECK(less.report.warnings.back().find("the normal map") != std::string::npos);
}

TEST_CASE("nothing is given up where no image is new") {
    const faqem::Asset asset = model_with_small_image();
    faqem::Options options;
    options.target = faqem::ratio(1);
    const std::uint64_t bytes = model_bytes(asset, "out.glb").total() - 1;
    const auto result = simplify_no_larger(asset, options, {"out.glb", bytes, LargerResult::gives_up});
    REQUIRE(result.report.warnings.size() == 1);
    CHECK(result.report.warnings[0].find("more than the input") != std::string::npos);
}

TEST_CASE("bare models and options without new images have no rule about bytes") {
    const faqem::Asset bare = sheet(6);
    faqem::Options options;
    options.bake.kind = faqem::Bake::none;
    const auto bare_result = simplify_no_larger(bare, options, {"out.glb", 1, LargerResult::gives_up});
    for (const std::string& warning : bare_result.report.warnings)
        CHECK(warning.find("input") == std::string::npos);
    CHECK(larger_result({}, false) == LargerResult::gives_up);
    CHECK(larger_result({}, true) == LargerResult::allowed);
    CHECK(larger_result({.untouched = faqem::UntouchedParts::baked}, false) == LargerResult::warns);
}
