// Options::larger: a result has no more bytes than the files of its source.

#include <cmath>

#include "faqem/bake.hpp"
#include "result/image_trials.hpp"
#include "support/catch.hpp"
#include "support/cli_support.hpp"
#include "support/message_of.hpp"

using namespace tool_test;
using faqem::detail::model_size;

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

// The same as if it had been loaded from files of a size.
faqem::Asset from_files(faqem::Asset asset, std::uint64_t bytes) {
    asset.format = faqem::ModelFormat::glb;
    asset.file_bytes = bytes;
    return asset;
}

// simplify() to half of the faces with a new texture.
faqem::SimplifiedAsset halved(const faqem::Asset& asset, faqem::Options options = {}) {
    options.target = faqem::ratio(0.5);
    return simplify(asset, options);
}

faqem::Options atlas_options() {
    faqem::Options options{.bake = {.kind = faqem::Bake::atlas}};
    options.bake.normal_map = faqem::NormalMap::off;
    return options;
}

std::uint64_t bytes_of(const faqem::SimplifiedAsset& result) {
    return model_size(result.asset, faqem::ModelFormat::glb).total();
}

std::uint64_t bytes_with_source_uvs(const faqem::Asset& asset) {
    faqem::Options options{.bake = {.kind = faqem::Bake::keep}};
    return bytes_of(halved(asset, options));
}

bool has_warning(const faqem::SimplifiedAsset& result, const std::string& text) {
    return faqem::testing::any_contains(result.report.warnings, text);
}

std::uint64_t size_of(const Folder& folder, const char* file) { return fs::file_size(folder / file); }

}  // namespace

TEST_CASE("a textured result that would be larger than its input gives something up") {
    const ModelFolder folder("in.glb", model_with_small_image());
    for (const std::string kind : {"auto", "atlas"}) {
        const std::string command =
            "simplify in.glb out.glb --force --ratio 0.5 --report r.json --bake " + kind;
        REQUIRE(run(folder, command + " --allow-larger").code == 0);
        const std::uint64_t larger = size_of(folder, "out.glb");
        CHECK(larger > size_of(folder, "in.glb"));
        CHECK(read(folder / "r.json").find("given up") == std::string::npos);
        REQUIRE(run(folder, command).code == 0);
        CHECK(size_of(folder, "out.glb") <= size_of(folder, "in.glb"));
        CHECK(read(folder / "r.json").find("given up, to have no more bytes than the input: ") !=
              std::string::npos);
    }
}

TEST_CASE("images get smaller until the result fits, and no smaller than that") {
    const faqem::Asset asset = model_with_small_image();
    const auto full = halved(asset, atlas_options());
    const std::uint64_t more = bytes_of(full);
    const auto unchanged = halved(from_files(asset, more), atlas_options());
    CHECK(unchanged.report.given_up.empty());
    CHECK((unchanged.asset.images[0].encoded == full.asset.images[0].encoded));
    for (const std::uint64_t bytes : {more - 1, more / 2, more / 8}) {
        CAPTURE(bytes);
        const auto result = halved(from_files(asset, bytes), atlas_options());
        CHECK(bytes_of(result) <= bytes);
        CHECK(bytes_of(result) > bytes / 2);
        CHECK(result.report.given_up == std::vector<std::string>{"size and quality of the images"});
        REQUIRE(result.report.images.size() == 1);
        CHECK(result.report.images[0].bytes == result.asset.images[0].encoded.size());
        CHECK(result.asset.parts[0].triangles == full.asset.parts[0].triangles);
    }
}

TEST_CASE("where new images would lose more than the UVs of the source, these are kept") {
    // Resampled noise needs more bytes than the noise itself.
    faqem::Asset asset = sheet(6, 0.1);
    faqem::Pixels noise{64, 64, {}, false};
    std::uint32_t state = 1;
    for (int i = 0; i < 64 * 64; ++i) {
        state = state * 1664525u + 1013904223u;
        const auto grey = static_cast<std::uint8_t>(state >> 24);
        noise.rgba.insert(noise.rgba.end(), {grey, grey, grey, 255});
    }
    asset.images = {encode_png(noise, "noise")};
    const std::uint64_t bytes = bytes_with_source_uvs(asset);
    const auto result = halved(from_files(asset, bytes));
    CHECK(bytes_of(result) <= bytes);
    REQUIRE_FALSE(result.report.given_up.empty());
    CHECK(result.report.given_up.back() == "the new texture: UVs and images are those of the source");
    CHECK(result.report.images.at(0).width == 64);
    CHECK(result.report.kept_uvs.size() == 1);
}

TEST_CASE("UVs of the source with which the target is missed are not kept to save bytes") {
    // Two sheets that enclose a volume. Every edge is a seam, so that no face can be removed with these UVs.
    faqem::Asset asset = model_with_small_image();
    const faqem::Part sheet = asset.parts[0];
    faqem::Part& closed = asset.parts[0];
    closed.positions.clear(), closed.triangles.clear(), closed.uvs = {{}};
    for (const bool is_back : {false, true}) {
        for (const auto& [a, b, c] : sheet.triangles) {
            const auto first = static_cast<faqem::Index>(closed.positions.size());
            for (const faqem::Index corner : is_back ? faqem::Triangle{a, c, b} : faqem::Triangle{a, b, c}) {
                const auto [x, y, z] = sheet.positions[corner];
                closed.positions.push_back({x, y, is_back ? z - (1 - x * x) * (1 - y * y) : z});
                const auto [u, v] = sheet.uvs[0][corner];
                closed.uvs[0].push_back({u + 0.01F * static_cast<float>(first % 7), v});
            }
            closed.triangles.push_back({first, first + 1, first + 2});
        }
    }
    closed.face_material.assign(closed.triangles.size(), 0);
    const std::uint64_t bytes = bytes_with_source_uvs(asset);
    const auto result = halved(from_files(asset, bytes));
    CHECK(result.report.faces_out <= closed.triangles.size() / 2);
    CHECK(result.report.kept_uvs.empty());
}

TEST_CASE("each textured level of lod that would be larger than the input gives something up") {
    const ModelFolder folder("in.glb", model_with_small_image());
    REQUIRE(run(folder, "lod in.glb larger --levels 0.5,0.2 --allow-larger").code == 0);
    REQUIRE(run(folder, "lod in.glb out --levels 0.5,0.2").code == 0);
    for (const char* level : {"in_LOD1.glb", "in_LOD2.glb"}) {
        INFO(level);
        REQUIRE(fs::file_size(folder / "larger" / level) > size_of(folder, "in.glb"));
        CHECK(fs::file_size(folder / "out" / level) <= size_of(folder, "in.glb"));
    }
    CHECK(read(folder / "out/in_LOD0.glb") == read(folder / "larger/in_LOD0.glb"));
    CHECK(read(folder / "out/in_LOD.json").find("given up, to have no more bytes than the input: ") !=
          std::string::npos);
}

TEST_CASE("truncate has the rule, too") {
    const ModelFolder folder("in.glb", model_with_small_image());
    REQUIRE(run(folder, "simplify in.glb whole.glb --faces 36 --history h.bin --normal-map off").code == 0);
    const std::string truncate = "truncate h.bin out.glb --force --faces 36 --source in.glb --normal-map off";
    REQUIRE(run(folder, truncate + " --allow-larger").code == 0);
    CHECK(size_of(folder, "out.glb") > size_of(folder, "in.glb"));
    const Outcome outcome = run(folder, truncate);
    REQUIRE(outcome.code == 0);
    CHECK(size_of(folder, "out.glb") <= size_of(folder, "in.glb"));
    CHECK(outcome.out.find("given up, to have no more bytes than the input") != std::string::npos);
}

TEST_CASE("a quality that was asked for is not given up, with a warning") {
    faqem::Options options = atlas_options();
    options.bake.image_quality = 40;
    const faqem::Asset asset = model_with_small_image();
    const auto full = halved(asset, options);
    const auto result = halved(from_files(asset, bytes_of(full) - 1), options);
    CHECK((result.asset.images[0].encoded == full.asset.images[0].encoded));
    CHECK(result.report.given_up.empty());
    CHECK(has_warning(result, "bytes, more than the input with "));
    // The plain kind of baking keeps the UVs of the source instead.
    options = {};
    options.bake.image_quality = 40;
    const std::uint64_t bytes = bytes_with_source_uvs(asset);
    const auto kept = halved(from_files(asset, bytes), options);
    CHECK(bytes_of(kept) <= bytes);
    CHECK((kept.asset.images.at(0).encoded == asset.images[0].encoded));
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
    faqem::Options options = atlas_options();
    options.bake.untouched = faqem::UntouchedParts::kept;
    const auto full = halved(asset, options);
    REQUIRE(full.report.untouched_parts.size() == 1);
    const auto less = halved(from_files(asset, bytes_of(full) - 1), options);
    CHECK(less.report.given_up == std::vector<std::string>{"size and quality of the images"});
    CHECK(less.report.untouched_parts == full.report.untouched_parts);
    CHECK((less.asset.images.back().encoded == asset.images[0].encoded));
}

TEST_CASE("a normal map that the source does not have goes first, with the tangents for it") {
    faqem::Asset asset = model_with_small_image();
    for (faqem::Vec3& p : asset.parts[0].positions) p[2] = 0.5 * std::sin(9 * p[0]) * std::cos(7 * p[1]);
    asset.parts[0].normals.clear();
    faqem::Options options = atlas_options();
    options.bake.normal_map = faqem::NormalMap::automatic;
    options.target = faqem::ratio(0.1);
    const auto full = simplify(asset, options);
    REQUIRE(full.asset.materials[0].normal_texture);
    const auto less = simplify(from_files(asset, bytes_of(full) - 1), options);
    CHECK_FALSE(less.asset.materials[0].normal_texture);
    CHECK(less.asset.parts[0].tangents.empty());
    CHECK(less.asset.images.size() == full.asset.images.size() - 1);
    CHECK(less.asset.materials[0].base_color_texture.image == 0);
    CHECK(has_warning(less, "a new normal map, which the source does not have"));
}

TEST_CASE("nothing is given up where no image is new") {
    const faqem::Asset asset = model_with_small_image();
    faqem::Options options{.target = faqem::ratio(1)};
    const std::uint64_t bytes = model_size(asset, faqem::ModelFormat::glb).total() - 1;
    const auto result = simplify(from_files(asset, bytes), options);
    CHECK(result.report.given_up.empty());
    CHECK(has_warning(result, "more than the input"));
}

TEST_CASE("models without files, bare ones and options without new images have no rule about bytes") {
    const auto has_no_rule = [](const faqem::SimplifiedAsset& result) {
        return result.report.given_up.empty() && !has_warning(result, "input");
    };
    CHECK(has_no_rule(halved(model_with_small_image(), atlas_options())));
    faqem::Options options{.bake = {.kind = faqem::Bake::none}};
    CHECK(has_no_rule(halved(from_files(model_with_small_image(), 1), options)));
    faqem::Asset bare = sheet(6);
    bare.images.clear();
    bare.materials.clear();
    bare.parts[0].face_material.clear();
    CHECK(has_no_rule(halved(from_files(bare, 1))));
}

TEST_CASE("textures of one image that are baked to equal images share one") {
    faqem::Asset asset = model_with_small_image();
    asset.materials[0].emissive_texture.image = 0;
    asset.materials[0].emissive = {1, 1, 1};
    const faqem::SimplifiedAsset result = halved(asset, atlas_options());
    const faqem::Material& material = result.asset.materials.at(0);
    CHECK(material.base_color_texture.image == 0);
    CHECK(material.emissive_texture.image == 0);
    CHECK(result.asset.images.size() == 1);
    CHECK(result.report.images.size() == 1);
}
