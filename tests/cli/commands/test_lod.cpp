#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>

#include "cli/commands/lod_levels.hpp"
#include "cli/process/shown_text.hpp"
#include "faqem/compare.hpp"
#include "faqem/error.hpp"
#include "support/catch.hpp"
#include "support/cli_support.hpp"

using namespace tool_test;

namespace {

nlohmann::json manifest(const Folder& folder, const std::string& name) {
    return nlohmann::json::parse(read(folder / name));
}

std::size_t faces(const fs::path& file) { return faqem::load(file).parts.at(0).triangles.size(); }

/// A collapse removes up to two faces, so that a result may have one face less than the target.
bool close_to(std::size_t faces, std::size_t target) { return faces <= target && faces + 2 > target; }

}  // namespace

TEST_CASE("lod writes the original, one model per level and a manifest") {
    const ModelFolder folder("hill.glb", sheet(30, 0.2));
    const Outcome outcome = run(folder, "lod hill.glb out --levels 50%,0.1,50 --bake none");
    CHECK(outcome.code == 0);
    CHECK(outcome.err.empty());
    CHECK(outcome.out.find("hill_LOD3.glb: ") != std::string::npos);
    const nlohmann::json json = manifest(folder, "out/hill_LOD.json");
    REQUIRE(json["levels"].size() == 4);
    CHECK(json["source"] == "hill.glb");
    const faqem::Asset original = faqem::load(folder / "hill.glb");
    const faqem::MeshView before{original.parts[0].positions, original.parts[0].triangles};
    double last_error = 0, last_distance = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        const nlohmann::json& level = json["levels"][i];
        const std::string file = "hill_LOD" + std::to_string(i) + ".glb";
        CHECK(level["file"] == file);
        CHECK(level["faces"] == faces(folder / ("out/" + file)));
        CHECK(level["error"] >= last_error);
        CHECK(level["switch_distance"] >= last_distance);
        last_error = level["error"], last_distance = level["switch_distance"];
        const faqem::Asset simplified = faqem::load(folder / ("out/" + file));
        const faqem::MeshView after{simplified.parts[0].positions, simplified.parts[0].triangles};
        CHECK(faqem::hausdorff(before, after).value <= last_error + 1e-6);
        CHECK(level.contains("report") == (i > 0));
        CHECK(level["bytes"] == fs::file_size(folder / ("out/" + file)));
    }
    CHECK(json["levels"][0]["faces"] == 1800);
    CHECK(json["levels"][0]["error"] == 0);
    CHECK(json["levels"][0]["screen_coverage"].is_null());
    const std::size_t targets[] = {1800, 900, 180, 50};
    for (std::size_t i = 0; i < 4; ++i) CHECK(close_to(json["levels"][i]["faces"], targets[i]));
}

TEST_CASE("lod prints the bytes of the source and of all levels, and warns of a share without percent sign") {
    const ModelFolder folder("a.glb", sheet(20, 0.2));
    const auto size = [&](const char* file) { return faqem::cli::shown_bytes(fs::file_size(folder / file)); };
    const Outcome folder_of_files = run(folder, "lod a.glb out --levels 40,4 --without-original --bake none");
    const std::uint64_t both =
        fs::file_size(folder / "out/a_LOD0.glb") + fs::file_size(folder / "out/a_LOD1.glb");
    CHECK(folder_of_files.out.find(size("a.glb") + " -> " + faqem::cli::shown_bytes(both) +
                                   ", with out/a_LOD.json\n") != std::string::npos);
    CHECK(folder_of_files.out.find("faces, " + size("out/a_LOD1.glb") + ", error") != std::string::npos);
    CHECK(folder_of_files.out.find("a share has a percent sign: 40%") != std::string::npos);
    const Outcome one_file = run(folder, "lod a.glb all.glb --levels 40% --bake none");
    CHECK(one_file.out.find(" -> " + size("all.glb") + ", with all.json\n") != std::string::npos);
    CHECK(one_file.out.find("percent sign") == std::string::npos);
}

TEST_CASE("lod --without-original writes the first level as LOD0") {
    const ModelFolder folder("a.glb", sheet(20, 0.2));
    REQUIRE(
        run(folder, "lod a.glb . --levels 0.5,error:2% --without-original --format ply --bake none --quiet")
            .code == 0);
    CHECK(close_to(faces(folder / "a_LOD0.ply"), 400));
    CHECK(faces(folder / "a_LOD1.ply") < 400);
    CHECK_FALSE(fs::exists(folder / "a_LOD2.ply"));
    const nlohmann::json json = manifest(folder, "a_LOD.json");
    CHECK(json["levels"][1]["error"] <= json["levels"][1]["report"]["max_error"]["allowed"]);
}

TEST_CASE("at the switch distance the error covers the allowed number of pixels") {
    using namespace faqem::cli;
    // With a field of view of 90 degrees, 1000 pixels show 2 units at distance 1: an error of 0.01 covers 5
    // pixels.
    CHECK(switch_distance(0.01, {1, 90, 1000}) == Approx(5));
    CHECK(switch_distance(0.01, {5, 90, 1000}) == Approx(1));
    CHECK(switch_distance(0, {1, 60, 1080}) == 0);
    const faqem::cli::Json json =
        lod_manifest("a", 3, {1, 90, 1000}, {{"a_LOD0.glb", 10, 8, 500, 0.009, 0.01, {}}});
    // 3 units are 1.5 times the view height at distance 1, and 0.3 of it at distance 5.
    CHECK(json["levels"][0]["screen_coverage"].get<double>() == Approx(0.3));
}

TEST_CASE("lod rejects invalid levels and options and writes nothing") {
    const ModelFolder folder("a.glb", sheet(8, 0.2));
    for (const char* levels : {"0.1,0.5", "0", "-1", "1.5", "x", "error:", "error:-1", "nan", "0%", "150%"}) {
        const Outcome outcome = run(folder, std::string("lod a.glb out --bake none --levels=") + levels);
        CHECK(outcome.code == 2);
        CHECK(outcome.err.find("level") != std::string::npos);
        CHECK_FALSE(fs::exists(folder / "out/a_LOD.json"));
        CHECK_FALSE(fs::exists(folder / "out/a_LOD0.glb"));
    }
    CHECK(run(folder, "lod a.glb out --ratio 0.5").code == 2);
    CHECK(run(folder, "lod none.glb out").code == 3);
    CHECK(run(folder, "lod a.glb out --fov 180").code == 2);
    CHECK(run(folder, "lod a.glb out --format xyz").code == 2);
}

TEST_CASE("levels of a mesh ten million units from the origin keep shape and position") {
    const Folder folder;
    faqem::Asset hill = sheet(20, 0.2);
    for (faqem::Vec3& p : hill.parts[0].positions) p[0] += 1e7, p[1] -= 2e7;
    faqem::save(hill, folder / "far.ply");
    const std::string rest = " --levels 0.5,0.2 --bake none --quiet";
    REQUIRE(run(folder, "lod far.ply out" + rest).code == 0);
    REQUIRE(run(folder, "lod far.ply all.glb" + rest).code == 0);
    const faqem::MeshView before{hill.parts[0].positions, hill.parts[0].triangles};
    const faqem::Asset all = faqem::load(folder / "all.glb");
    for (std::size_t i = 0; i < 3; ++i) {
        const faqem::Asset one = faqem::load(folder / ("out/far_LOD" + std::to_string(i) + ".glb"));
        for (const faqem::Asset* asset : {&one, &all}) {
            const std::size_t part = asset == &all ? i : 0;
            const faqem::Instance where = faqem::instances(*asset).at(0);
            std::vector<faqem::Vec3> positions = asset->parts.at(part).positions;
            for (faqem::Vec3& p : positions) {
                for (std::size_t k = 0; k < 3; ++k) p[k] += where.transform[12 + k];
            }
            CHECK(faqem::hausdorff(before, {positions, asset->parts[part].triangles}).value < 0.1);
        }
    }
}

TEST_CASE("lod writes nothing if a level misses its target or maximum error") {
    const ModelFolder folder("a.glb", sheet(8, 0.2));
    const Outcome outcome =
        run(folder, "lod a.glb out --levels 0.5,4 --lock-boundary --strict-target --bake none");
    CHECK(outcome.code == 5);
    CHECK(outcome.err.find("faqem: a.glb: target missed: ") == 0);
    CHECK_FALSE(fs::exists(folder / "out"));
    CHECK(run(folder, "lod a.glb new/inner --levels 0.5,4 --lock-boundary --strict-target").code == 5);
    CHECK_FALSE(fs::exists(folder / "new"));
    const Outcome far = run(folder, "lod a.glb out --levels 0.5,error:0.0001% --bake none");
    CHECK(far.code == 6);
    CHECK(far.err.find("faqem: a.glb: max error exceeded: ") == 0);
    CHECK(far.err.find("; out was not written\n") != std::string::npos);
}

TEST_CASE("lod with a file as output writes all levels to it, and its scene has the finest") {
    const ModelFolder folder("hill.glb", sheet(24, 0.2));
    const std::string options = " --levels 0.5,0.1 --texture-size 128";
    REQUIRE(run(folder, "lod hill.glb one.glb" + options).code == 0);
    REQUIRE(run(folder, "lod hill.glb many" + options).code == 0);
    CHECK_FALSE(fs::is_directory(folder / "one.glb"));
    const faqem::Asset one = faqem::load(folder / "one.glb");
    REQUIRE(one.parts.size() == 3);
    const auto shown = faqem::instances(one);
    REQUIRE(shown.size() == 1);
    CHECK(shown[0].part == 0);
    const std::string bytes = read(folder / "one.glb");
    std::uint32_t length = 0;  // of the first chunk, which is the JSON
    std::memcpy(&length, bytes.data() + 12, 4);
    const nlohmann::json gltf = nlohmann::json::parse(bytes.substr(20, length));
    const nlohmann::json& node = gltf["nodes"][gltf["scenes"][0]["nodes"][0].get<std::size_t>()];
    CHECK(gltf["extensionsUsed"].dump().find("MSFT_lod") != std::string::npos);
    const nlohmann::json& ids = node["extensions"]["MSFT_lod"]["ids"];
    REQUIRE(ids.size() == 2);
    const nlohmann::json json = manifest(folder, "one.json");
    const nlohmann::json& coverage = node["extras"]["MSFT_screencoverage"];
    REQUIRE(coverage.size() == 3);
    CHECK(coverage[2] == 0);
    for (std::size_t i = 0; i < 3; ++i) {
        const std::string name = "many/hill_LOD" + std::to_string(i) + ".glb";
        CHECK(one.parts[i].triangles == faqem::load(folder / name).parts.at(0).triangles);
        CHECK(json["levels"][i]["file"] == "one.glb");
        CHECK(json["levels"][i]["faces"] == one.parts[i].triangles.size());
        if (i == 0) continue;
        CHECK(gltf["nodes"][ids[i - 1].get<std::size_t>()]["mesh"] == i);
        const double full = std::min(1.0, json["levels"][i]["screen_coverage"].get<double>());
        CHECK(coverage[i - 1].get<double>() == Approx(full));
    }
    for (const char* wrong : {"levels.obj", "levels.OFF", "levels.glb --format glb"}) {
        CAPTURE(wrong);
        CHECK(run(folder, std::string("lod hill.glb ") + wrong).code == 2);
    }
    CHECK_FALSE(fs::exists(folder / "levels.obj"));
}

TEST_CASE("a file with levels is read as the finest one in every command") {
    const ModelFolder folder("hill.glb", sheet(24, 0.2));
    const std::string options = " --levels 0.5,0.1 --texture-size 128 --allow-larger";
    REQUIRE(run(folder, "lod hill.glb hill_LOD.glb" + options).code == 0);
    const std::string warning = "2 coarser levels of 1 node (MSFT_lod) left out";
    const Outcome strict = run(folder, "simplify hill_LOD.glb x.glb --ratio 0.3 --strict");
    CHECK(strict.code == 3);
    CHECK(strict.err.find(warning) != std::string::npos);

    const Outcome again = run(folder, "lod hill_LOD.glb again.glb --history h.bin" + options);
    CHECK(again.code == 0);
    CHECK(again.out.find(warning) != std::string::npos);
    const bool is_same = read(folder / "again.glb") == read(folder / "hill_LOD.glb");
    CHECK(is_same);
    const Outcome cut =
        run(folder, "truncate h.bin cut.glb --source hill_LOD.glb --faces 200 --texture-size 128");
    CHECK(cut.code == 0);
    CHECK(cut.out.find(warning) != std::string::npos);
    CHECK(faqem::load(folder / "cut.glb").parts.size() == 1);

    fs::create_directory(folder / "in");
    fs::copy_file(folder / "hill_LOD.glb", folder / "in/hill_LOD.glb");
    const Outcome batch = run(folder, "batch in out --ratio 0.3 --texture-size 128");
    CHECK(batch.code == 0);
    CHECK(batch.out.find(warning) != std::string::npos);
    CHECK(batch.out.find("\"faces_in\":1152") != std::string::npos);
}

TEST_CASE("a level pixels:N@D is the error that covers N pixels at distance D") {
    using namespace faqem::cli;
    const ViewSettings view_settings{1, 90, 1000};  // 2 units cover 1000 pixels at distance 1
    const auto error = [&](const char* text) {
        const faqem::Level level = parse_level(text, view_settings);
        REQUIRE(std::holds_alternative<faqem::MaxError>(level));
        CHECK(std::get<faqem::MaxError>(level).unit == faqem::Length::Unit::model);
        return std::get<faqem::MaxError>(level).value;
    };
    CHECK(error("pixels:1@1") == Approx(0.002));
    CHECK(error("pixels:2@50") == Approx(0.2));
    CHECK(switch_distance(error("pixels:1@50"), view_settings) == Approx(50));
    CHECK(std::holds_alternative<faqem::Target>(parse_level("0.5", view_settings)));
    for (const char* wrong : {"pixels:", "pixels:1", "pixels:1@", "pixels:@5", "pixels:0@5", "pixels:1@-5",
                              "pixels:nan@5", "pixels:1@inf", "pixels:1@5x"}) {
        CAPTURE(wrong);
        CHECK_THROWS_AS(parse_level(wrong, view_settings), faqem::OptionError);
    }
}

TEST_CASE("lod meets error levels given in pixels at a distance") {
    const ModelFolder folder("a.glb", sheet(20, 0.2));
    REQUIRE(run(folder, "lod a.glb out --levels pixels:1@2,pixels:1@20 --bake none --quiet").code == 0);
    const nlohmann::json json = manifest(folder, "out/a_LOD.json");
    CHECK(json["levels"][1]["switch_distance"] <= 2);
    CHECK(json["levels"][2]["switch_distance"] <= 20);
    CHECK(json["levels"][2]["switch_distance"] > 2);
}

TEST_CASE("levels with --textures shared share a new texture, stored once in one file") {
    const ModelFolder folder("a.glb", sheet(20, 0.2));
    const std::string options =
        " --levels 0.5,0.1 --textures shared --texture-size 128 --normal-map off --quiet";
    REQUIRE(run(folder, "lod a.glb one.glb --without-original" + options).code == 0);
    const std::string bytes = read(folder / "one.glb");
    const nlohmann::json document = nlohmann::json::parse(bytes.substr(20, bytes.find("BIN\0", 20, 4) - 24));
    CHECK(document["images"].size() == 1);
    CHECK(document["meshes"].size() == 2);

    REQUIRE(run(folder, "lod a.glb many" + options).code == 0);
    const auto image = [&](const char* name) { return faqem::load(folder / name).images.at(0).encoded; };
    CHECK(image("many/a_LOD1.glb") == image("many/a_LOD2.glb"));
    CHECK(image("many/a_LOD0.glb") != image("many/a_LOD1.glb"));
    const nlohmann::json json = manifest(folder, "many/a_LOD.json");
    CHECK(json["levels"][2]["report"]["faces_in"] == 800);
    CHECK(json["levels"][2]["error"] > json["levels"][1]["error"]);

    for (const char* wrong : {"--textures both", "--history a.history", "--bake keep", "--keep-groups"}) {
        CAPTURE(wrong);
        const Outcome outcome = run(folder, "lod a.glb out" + options + " " + wrong);
        CHECK(outcome.code == 2);
        CHECK(outcome.err.find("textures") != std::string::npos);
        CHECK(outcome.err.find("::") == std::string::npos);
        CHECK_FALSE(fs::exists(folder / "out/a_LOD1.glb"));
    }
}
