#include <algorithm>
#include <cmath>

#include "bake/scene/unencoded_result.hpp"
#include "faqem/error.hpp"
#include "support/catch.hpp"
#include "support/message_of.hpp"
#include "support/scenes.hpp"

using namespace faqem;
using namespace faqem::test;

namespace {

constexpr double no_time = 1e-9;

// A wavy sheet over [0, 1]^2 with UVs that equal x and y. With a seam, the UVs of the part with x > 0.5 are moved by 2.
Asset wavy(Index n, bool has_seam = false) {
    Asset asset = textured_square(ramp(64));
    Part part = uv_mapped(sheet(n, [n](double x, double y) {
        return Vec3{x / n, y / n, 0.02 * std::sin(20 * x / n) * std::cos(14 * y / n)};
    }));
    for (Triangle& t : part.triangles) {
        const double x = part.positions[t[0]][0] + part.positions[t[1]][0] + part.positions[t[2]][0];
        if (!has_seam || x < 1.5) continue;
        for (Index& v : t) {
            const Vec2f uv = part.uvs[0][v];
            part.positions.push_back(Vec3(part.positions[v]));
            part.uvs[0].push_back({uv[0] + 2, uv[1]});
            v = static_cast<Index>(part.positions.size() - 1);
        }
    }
    asset.parts = {part};
    return asset;
}

}  // namespace

TEST_CASE("an asset without time keeps its meshes and images") {
    const Asset source = wavy(12);
    const SimplifiedAsset simplified = simplify(source, {.target = ratio(0.1), .max_seconds = no_time});
    CHECK(simplified.report.stop == StopReason::reached_time_limit);
    CHECK(simplified.report.faces_out == source.parts[0].triangles.size());
    CHECK(simplified.asset.parts[0].uvs == source.parts[0].uvs);
    REQUIRE(simplified.asset.images.size() == 1);
    CHECK(simplified.asset.images[0].encoded == source.images[0].encoded);
    CHECK(testing::any_contains(simplified.report.warnings, "max_seconds"));
}

TEST_CASE("a bake without time gives simplified meshes the UVs and images of the source") {
    const Asset source = wavy(24);
    const Bake kind = GENERATE(Bake::automatic, Bake::atlas);
    Options options{.target = ratio(0.1), .bake = {.kind = kind}};
    const SimplifiedParts parts = simplify_parts(source, options);
    options.max_seconds = no_time;
    const SimplifiedAsset simplified = bake(source, parts, options);
    CHECK(simplified.report.stop == StopReason::reached_target);
    CHECK(testing::any_contains(simplified.report.warnings, "max_seconds"));
    CHECK(!testing::any_contains(simplified.report.warnings, "cross borders"));
    CHECK(simplified.report.pages.empty());
    CHECK(simplified.report.kept_uvs.size() == (kind == Bake::automatic ? 1 : 0));
    REQUIRE(simplified.asset.images.size() == 1);
    CHECK(simplified.asset.images[0].encoded == source.images[0].encoded);
    const Part& part = simplified.asset.parts[0];
    const TriangleMesh& mesh = kind == Bake::automatic ? parts.with_uvs[0].mesh : parts.parts[0].mesh;
    CHECK(part.triangles.size() == mesh.triangles.size());
    // All corners of a vertex have one UV: it is not split.
    CHECK(part.positions.size() == mesh.positions.size());
    REQUIRE(part.uvs.size() == 1);
    double worst = 0;
    for (std::size_t v = 0; v < part.positions.size(); ++v) {
        for (std::size_t k = 0; k < 2; ++k)
            worst = std::max(worst, std::abs(part.uvs[0][v][k] - part.positions[v][k]));
    }
    CHECK(worst < 0.01);
}

TEST_CASE("meshes that were simplified with their UVs keep these without time") {
    const Asset source = wavy(24, true);
    Options options{.target = ratio(0.1)};
    const SimplifiedParts parts = simplify_parts(source, options);
    REQUIRE(parts.with_uvs.size() == 1);
    const SimplifiedAsset expected =
        bake(source, {.parts = parts.with_uvs, .report = parts.report, .with_uvs = {}},
             {.bake = {.kind = Bake::keep}});
    options.max_seconds = no_time;
    const SimplifiedAsset late = bake(source, parts, options);
    CHECK(!testing::any_contains(late.report.warnings, "cross borders"));
    CHECK(late.report.kept_uvs.size() == 1);
    CHECK(late.asset.parts[0].positions == expected.asset.parts[0].positions);
    CHECK(late.asset.parts[0].triangles == expected.asset.parts[0].triangles);
    CHECK(late.asset.parts[0].uvs == expected.asset.parts[0].uvs);
}

TEST_CASE("a face across a seam shows only the chart at its centre") {
    const Asset source = wavy(24, true);
    Options options{.target = ratio(0.05), .bake = {.kind = Bake::atlas}};
    const SimplifiedParts parts = simplify_parts(source, options);
    options.max_seconds = no_time;
    const SimplifiedAsset simplified = bake(source, parts, options);
    const Part& part = simplified.asset.parts[0];
    std::size_t across = 0;
    for (const Triangle& t : part.triangles) {
        const Vec2f &a = part.uvs[0][t[0]], &b = part.uvs[0][t[1]], &c = part.uvs[0][t[2]];
        const bool is_right = a[0] > 1;
        CHECK((b[0] > 1) == is_right);
        CHECK((c[0] > 1) == is_right);
        bool is_across = false;
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3& p = part.positions[t[k]];
            const double u = part.uvs[0][t[k]][0] - (is_right ? 2.0 : 0.0);
            CHECK((is_right ? u > 0.49 : u < 0.51));
            const bool is_beyond = is_right ? p[0] < 0.49 : p[0] > 0.51;
            if (!is_beyond) CHECK(std::abs(u - p[0]) < 0.02);
            is_across = is_across || is_beyond;
        }
        across += is_across;
    }
    CHECK(across > 0);
    CHECK(testing::any_contains(simplified.report.warnings, "cross borders"));
}

TEST_CASE("kinds of baking without an atlas are completed without time") {
    const Asset source = wavy(16);
    for (const Bake kind : {Bake::vertex, Bake::keep, Bake::none}) {
        Options options{.target = ratio(0.2), .bake = {.kind = kind}};
        const SimplifiedParts parts = simplify_parts(source, options);
        const SimplifiedAsset in_time = bake(source, parts, options);
        options.max_seconds = no_time;
        const SimplifiedAsset late = bake(source, parts, options);
        CHECK(late.report.stop == StopReason::reached_target);
        CHECK(late.report.warnings == in_time.report.warnings);
        CHECK(late.asset.parts[0].positions == in_time.asset.parts[0].positions);
        CHECK(late.asset.parts[0].triangles == in_time.asset.parts[0].triangles);
        CHECK(late.asset.parts[0].uvs == in_time.asset.parts[0].uvs);
        CHECK(late.asset.parts[0].colors == in_time.asset.parts[0].colors);
        CHECK(late.asset.images.size() == in_time.asset.images.size());
    }
}

TEST_CASE("new textures that are complete get the format of the source if there is no time to choose") {
    const Asset source = wavy(12);
    Options options{.target = ratio(0.2), .bake = {.kind = Bake::atlas}};
    const SimplifiedParts parts = simplify_parts(source, options);
    detail::UnencodedResult result = detail::bake_unencoded(source, parts, options, {});
    REQUIRE(!result.pending.empty());
    options.max_seconds = no_time;
    detail::encode_images(result, options, engine::RunContext(options));
    CHECK(testing::any_contains(result.asset.report.warnings, "smallest images"));
    CHECK(result.asset.report.pages.size() == 1);
    for (const ResultImage& image : result.asset.report.images) {
        CHECK(image.mime_type == "image/png");
        CHECK(image.width > 0);
    }
}

TEST_CASE("a correspondence that cannot be completed in time is an error") {
    const Asset source = wavy(12);
    Options options{.target = ratio(0.2), .bake = {.correspondence = Recording::on}};
    const SimplifiedParts parts = simplify_parts(source, options);
    options.max_seconds = no_time;
    CHECK_THROWS_AS(bake(source, parts, options), TimeLimitError);
}

TEST_CASE("a scene, its hidden surface and a search within an error end at the time limit") {
    Asset source = wavy(12);
    source.parts.push_back(source.parts[0]);
    const std::uint64_t faces = 2 * source.parts[0].triangles.size();
    for (Options options : {Options{.target = ratio(0.1), .visibility = Visibility::weighted},
                            Options{.max_error = of_diagonal(0.01)}}) {
        options.max_seconds = no_time;
        const SimplifiedAsset simplified = simplify(source, options);
        CHECK(simplified.report.stop == StopReason::reached_time_limit);
        CHECK(simplified.report.faces_out == faces);
        if (options.max_error) CHECK(simplified.report.max_error->within());
        if (!options.max_error) CHECK(simplified.report.target_faces == faces / 10);
    }
}
