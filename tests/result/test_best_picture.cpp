// --max-bytes without a face target: faces and images with the best pictures for the bytes.

#include "result/best_picture.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "support/catch.hpp"
#include "support/painted_sheet.hpp"

using namespace tool_test;
using namespace faqem::detail;

namespace {

nlohmann::json report(const Folder& folder) { return nlohmann::json::parse(read(folder / "r.json")); }

}  // namespace

TEST_CASE("--max-bytes without a face target is never exceeded, and more bytes show more") {
    const ModelFolder folder("in.glb", painted_sheet(40));
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
    const ModelFolder folder("in.glb", painted_sheet(40));
    REQUIRE(run(folder, "simplify in.glb fixed.glb --ratio 0.1").code == 0);
    const std::string bytes = std::to_string(fs::file_size(folder / "fixed.glb"));
    REQUIRE(run(folder, "simplify in.glb out.glb --max-bytes " + bytes).code == 0);
    CHECK(psnr_of(folder, "out.glb") > psnr_of(folder, "fixed.glb") + 1);
}

TEST_CASE("--max-bytes gives the same bytes with any number of threads") {
    const ModelFolder folder("in.glb", painted_sheet(24));
    REQUIRE(run(folder, "simplify in.glb a.glb --max-bytes 12000 --threads 1").code == 0);
    REQUIRE(run(folder, "simplify in.glb b.glb --max-bytes 12000 --threads 3").code == 0);
    CHECK(read(folder / "a.glb") == read(folder / "b.glb"));
}

TEST_CASE("the report of --max-bytes has the results that were compared, and the best one is written") {
    const ModelFolder folder("in.glb", painted_sheet(24));
    REQUIRE(run(folder, "simplify in.glb out.glb --max-bytes 12000 --report r.json").code == 0);
    const nlohmann::json json = report(folder), points = json["compared_results"];
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
    CHECK(report(folder)["compared_results"].empty());
    CHECK(report(folder)["target_faces"] == 576);
}

TEST_CASE("a limit that the smallest result exceeds is refused with the size of that result") {
    const ModelFolder folder("in.glb", sheet(20));
    const std::string before = "the smallest result has ";
    const Outcome none = run(folder, "simplify in.glb out.glb --max-bytes 0");
    CHECK(none.code == 10);
    CHECK(none.err.find(before) != std::string::npos);
    CHECK_FALSE(fs::exists(folder / "out.glb"));
    const Outcome outcome = run(folder, "simplify in.glb out.glb --max-bytes 300");
    REQUIRE(outcome.code == 10);
    CHECK(outcome.err.find("max_bytes allows 300") != std::string::npos);
    const std::size_t at = outcome.err.find(before);
    REQUIRE(at != std::string::npos);
    const std::string bytes = std::to_string(std::stoul(outcome.err.substr(at + before.size())));
    REQUIRE(run(folder, "simplify in.glb out.glb --max-bytes " + bytes).code == 0);
    CHECK(fs::file_size(folder / "out.glb") <= std::stoul(bytes));
}

TEST_CASE("--max-bytes keeps the options of images and the kind of baking that were given") {
    const ModelFolder folder("in.glb", painted_sheet(24));
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
    CHECK(report(folder)["compared_results"][0]["kind"] == "none");

    const std::uintmax_t image = faqem::load(folder / "in.glb").images[0].encoded.size();
    const std::string enough = std::to_string(image + 10000);
    REQUIRE(run(folder, "simplify in.glb keep.glb --bake keep --max-bytes " + enough).code == 0);
    CHECK(faqem::load(folder / "keep.glb").images[0].encoded ==
          faqem::load(folder / "in.glb").images[0].encoded);
}

TEST_CASE("only options that leave the face count open are followed by a search for the best picture") {
    faqem::Options options;
    CHECK_FALSE(searches_best_picture(options));
    options.max_bytes = 1000;
    CHECK(searches_best_picture(options));
    options.bake.untouched = faqem::UntouchedParts::baked;  // an image option was given
    CHECK(searches_best_picture(options));
    options.target = faqem::ratio(0.1);
    CHECK_FALSE(searches_best_picture(options));
    options.target = {};
    options.bake.kind = faqem::Bake::atlas;
    CHECK_FALSE(searches_best_picture(options));
    options.bake.kind = faqem::Bake::automatic;
    options.history = faqem::Recording::on;
    CHECK_FALSE(searches_best_picture(options));
}

TEST_CASE("--max-bytes sees the rounding of vertices, and chooses finer positions where bytes are enough") {
    const ModelFolder folder("in.glb", painted_sheet(40));
    const auto written = [&](const std::string& options) {
        REQUIRE(
            run(folder, "simplify in.glb out.glb --force --quantize on --report r.json " + options).code ==
            0);
        const nlohmann::json json = report(folder), points = json["compared_results"];
        const auto best = std::max_element(
            points.begin(), points.end(), [](const auto& a, const auto& b) { return a["psnr"] < b["psnr"]; });
        CHECK(std::abs((*best)["psnr"].get<double>() - psnr_of(folder, "out.glb")) < 0.1);
        return std::pair(*best, json);
    };
    const auto [few, few_json] = written("--max-bytes 6000");
    const auto [many, many_json] = written("--max-bytes 150000");
    CHECK(many["position_bits"] == 16);
    CHECK(few["position_bits"] <= many["position_bits"]);
    const auto spacing = [](const nlohmann::json& json) {
        return json["position_rounding"]["spacing"].get<double>();
    };
    const auto [given, given_json] = written("--max-bytes 150000 --position-bits 10");
    CHECK(given["position_bits"] == 10);
    CHECK(given["psnr"] < many["psnr"]);
    CHECK(spacing(given_json) == 64 * spacing(many_json));

    REQUIRE(run(folder, "simplify in.glb out.glb --force --report r.json --max-bytes 12000").code == 0);
    CHECK(report(folder)["compared_results"][0]["position_bits"].is_null());
}

TEST_CASE("--max-bytes leaves out normals that the source has not where faces look better without them") {
    const Folder folder;
    faqem::Asset asset = painted_sheet(40);
    asset.parts[0].normals.clear();
    faqem::save(asset, folder / "in.glb");
    const auto has_normals = [&](const std::string& bytes) {
        REQUIRE(run(folder, "simplify in.glb out.glb --force --max-bytes " + bytes).code == 0);
        return !faqem::load(folder / "out.glb").parts[0].normals.empty();
    };
    CHECK_FALSE(has_normals("400000"));  // enough for all faces

    for (faqem::Vec3& position : asset.parts[0].positions) position[2] *= 10;  // more light and shade
    asset.parts[0].normals.assign(asset.parts[0].positions.size(), {0, 0, 1});
    fs::remove(folder / "in.glb");
    faqem::save(asset, folder / "in.glb");
    CHECK(has_normals("400000"));
}

TEST_CASE("--max-bytes gives an image that is seen ten times as much more bytes than the other") {
    const Folder folder;
    faqem::Asset asset = painted_sheet(40);
    asset.images.push_back(asset.images[0]);
    asset.materials.push_back(asset.materials[0]);
    asset.materials[1].base_color_texture.image = 1;
    faqem::Part& part = asset.parts[0];
    part.face_material.assign(part.triangles.size(), 0);
    for (std::size_t f = 0; f < part.triangles.size() / 20; ++f) part.face_material[f] = 1;
    faqem::save(asset, folder / "in.glb");
    REQUIRE(run(folder, "simplify in.glb out.glb --max-bytes 14000").code == 0);
    const faqem::Asset out = faqem::load(folder / "out.glb");
    REQUIRE(out.images.size() == 2);
    CHECK(2 * out.images[0].encoded.size() > 3 * out.images[1].encoded.size());
}
