// --max-bytes without a face target: faces and images with the best pictures for the bytes.

#include "cli/best_picture.hpp"

#include <nlohmann/json.hpp>
#include <string>

#include "cli/picture_error.hpp"
#include "support/catch.hpp"
#include "support/cli_support.hpp"

using namespace tool_test;
using namespace faqem::cli;

namespace {

// A curved sheet with a smooth image and some noise.
faqem::Asset painted_sheet(faqem::Index n) {
    faqem::Asset asset = sheet(n, 0.2);
    faqem::Pixels pixels{256, 256, {}, false};
    std::uint32_t state = 1;
    for (std::uint32_t y = 0; y < 256; ++y) {
        for (std::uint32_t x = 0; x < 256; ++x) {
            state = state * 1664525u + 1013904223u;
            const auto noise = static_cast<std::uint8_t>(state >> 28);
            const auto wave = static_cast<std::uint8_t>(100 + 80 * std::sin(0.1 * x) * std::cos(0.07 * y));
            pixels.rgba.insert(pixels.rgba.end(), {wave, static_cast<std::uint8_t>(x / 2 + noise),
                                                   static_cast<std::uint8_t>(y / 2 + noise), 255});
        }
    }
    asset.images[0] = faqem::encode_png(pixels, "painted");
    return asset;
}

double psnr_of(const Folder& folder, const std::string& file) {
    const PictureMeter meter(faqem::load(folder / "in.glb"), 0);
    return picture_psnr(meter(faqem::load(folder / file)));
}

nlohmann::json report(const Folder& folder) { return nlohmann::json::parse(read(folder / "r.json")); }

}  // namespace

TEST_CASE("--max-bytes without a face target is never exceeded, and more bytes show more") {
    const Folder folder;
    faqem::save(painted_sheet(40), folder / "in.glb");
    double last = 0;
    for (const std::string bytes : {"5000", "12000", "40000", "120000"}) {
        CAPTURE(bytes);
        REQUIRE(run(folder, "simplify in.glb out.glb --force --max-bytes " + bytes).code == 0);
        CHECK(fs::file_size(folder / "out.glb") <= std::stoul(bytes));
        const double psnr = psnr_of(folder, "out.glb");
        CHECK(psnr > last);
        last = psnr;
    }
}

TEST_CASE("--max-bytes shows more than a tenth of the faces with as many bytes") {
    const Folder folder;
    faqem::save(painted_sheet(40), folder / "in.glb");
    REQUIRE(run(folder, "simplify in.glb fixed.glb --ratio 0.1").code == 0);
    const std::string bytes = std::to_string(fs::file_size(folder / "fixed.glb"));
    REQUIRE(run(folder, "simplify in.glb out.glb --max-bytes " + bytes).code == 0);
    CHECK(psnr_of(folder, "out.glb") > psnr_of(folder, "fixed.glb") + 1);
}

TEST_CASE("--max-bytes gives the same bytes with any number of threads") {
    const Folder folder;
    faqem::save(painted_sheet(24), folder / "in.glb");
    REQUIRE(run(folder, "simplify in.glb a.glb --max-bytes 12000 --threads 1").code == 0);
    REQUIRE(run(folder, "simplify in.glb b.glb --max-bytes 12000 --threads 3").code == 0);
    CHECK(read(folder / "a.glb") == read(folder / "b.glb"));
}

TEST_CASE("the report of --max-bytes has the results that were compared, and the best one is written") {
    const Folder folder;
    faqem::save(painted_sheet(24), folder / "in.glb");
    REQUIRE(run(folder, "simplify in.glb out.glb --max-bytes 12000 --report r.json").code == 0);
    const nlohmann::json json = report(folder), points = json["budget_points"];
    REQUIRE(!points.empty());
    std::size_t best = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        CHECK(points[i]["bytes"] <= 12000);
        if (points[i]["psnr"] > points[best]["psnr"]) best = i;
    }
    CHECK(points[best]["bytes"] == json["bytes_out"]);
    CHECK(points[best]["faces"] == json["faces_out"]);
    REQUIRE(json["images"].size() == 1);
    CHECK(json["images"][0]["width"] <= points[best]["image_side"]);
    CHECK(json["kept_uvs"].size() == 1);

    REQUIRE(
        run(folder, "simplify in.glb few.glb --ratio 0.5 --max-bytes 120000 --report r.json --force").code ==
        0);
    CHECK(report(folder)["budget_points"].empty());
    CHECK(report(folder)["target_faces"] == 576);
}

TEST_CASE("a budget that the smallest result exceeds is refused with the size of that result") {
    const Folder folder;
    faqem::save(sheet(20), folder / "in.glb");
    const Outcome outcome = run(folder, "simplify in.glb out.glb --max-bytes 300");
    REQUIRE(outcome.code == 10);
    const std::string before = "the smallest result has ";
    const std::size_t at = outcome.err.find(before);
    REQUIRE(at != std::string::npos);
    const std::string bytes = std::to_string(std::stoul(outcome.err.substr(at + before.size())));
    REQUIRE(run(folder, "simplify in.glb out.glb --max-bytes " + bytes).code == 0);
    CHECK(fs::file_size(folder / "out.glb") <= std::stoul(bytes));
}

TEST_CASE("--max-bytes keeps the options of images and the kind of baking that were given") {
    const Folder folder;
    faqem::save(painted_sheet(24), folder / "in.glb");
    REQUIRE(
        run(folder, "simplify in.glb png.glb --max-bytes 40000 --image-format png --texture-size 64").code ==
        0);
    const faqem::Asset png = faqem::load(folder / "png.glb");
    REQUIRE(png.images.size() == 1);
    CHECK(png.images[0].mime_type == "image/png");
    CHECK(faqem::decode(png.images[0]).width <= 64);

    REQUIRE(run(folder, "simplify in.glb none.glb --max-bytes 12000 --bake none --report r.json").code == 0);
    CHECK(faqem::load(folder / "none.glb").images.empty());
    CHECK(fs::file_size(folder / "none.glb") > 10000);
    CHECK(report(folder)["budget_points"][0]["kind"] == "none");

    const std::uintmax_t image = faqem::load(folder / "in.glb").images[0].encoded.size();
    const std::string enough = std::to_string(image + 10000);
    REQUIRE(run(folder, "simplify in.glb keep.glb --bake keep --max-bytes " + enough).code == 0);
    CHECK(faqem::load(folder / "keep.glb").images[0].encoded ==
          faqem::load(folder / "in.glb").images[0].encoded);
}

TEST_CASE("only options that leave the face count open leave it to the budget") {
    faqem::Options options;
    CHECK(leaves_faces_to_budget(options));
    options.bake.untouched = faqem::UntouchedParts::baked;  // an image option was given
    CHECK(leaves_faces_to_budget(options));
    options.target = faqem::ratio(0.1);
    CHECK_FALSE(leaves_faces_to_budget(options));
    options.target = {};
    options.bake.kind = faqem::Bake::atlas;
    CHECK_FALSE(leaves_faces_to_budget(options));
    options.bake.kind = faqem::Bake::automatic;
    options.history = faqem::Recording::on;
    CHECK_FALSE(leaves_faces_to_budget(options));
}
