#include <nlohmann/json.hpp>
#include <string>

#include "support/catch.hpp"
#include "support/cli_support.hpp"

using namespace tool_test;

TEST_CASE("bake shows one model on another mesh, and says how far they are apart") {
    const Folder folder;
    faqem::save(sheet(24, 0.2), folder / "hill.glb");
    REQUIRE(run(folder, "simplify hill.glb bare.stl --faces 200 --bake none").code == 0);
    const std::string bake = "bake bare.stl textured.glb --source hill.glb --texture-size 128 ";
    const Outcome outcome = run(folder, bake);
    CHECK(outcome.code == 0);
    CHECK(outcome.out.starts_with("hill.glb onto bare.stl -> textured.glb\nlargest distance: 0.0"));
    CHECK(outcome.out.find("; texels without a source: 0%") != std::string::npos);
    const faqem::Asset baked = faqem::load(folder / "textured.glb");
    CHECK(baked.parts.at(0).triangles.size() ==
          faqem::load(folder / "bare.stl").parts.at(0).triangles.size());
    CHECK(baked.images.size() > 0);
    REQUIRE(run(folder, bake + "--force --report report.json").code == 0);
    const auto report = nlohmann::json::parse(read(folder / "report.json"));
    CHECK(report["coverage"]["missing_texels"] == 0);
    CHECK(report["coverage"]["unmatched_parts"].empty());
    CHECK(report["bytes_out"] == std::filesystem::file_size(folder / "textured.glb"));
}

TEST_CASE("errors of bake name the file and say what to do") {
    const Folder folder;
    faqem::save(sheet(8), folder / "hill.glb");
    const std::string corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\n", one = "vt 0 0\nvt 1 0\nvt 0 1\n";
    write(folder / "bare.obj", corners + "f 1 2 3\n");
    write(folder / "points.obj", corners);
    write(folder / "far.obj", "v 9 9 0\nv 8 9 0\nv 9 8 0\nf 1 2 3\n");
    write(folder / "overlap.obj", corners + "v 1 1 0\n" + one + "f 1/1 2/2 3/3\nf 4/1 3/2 2/3\n");
    write(folder / "outside.obj", corners + "vt 0 0\nvt 2 0\nvt 0 1\nf 1/1 2/2 3/3\n");
    write(folder / "cut.glb", read(folder / "hill.glb").substr(0, 99));
    fs::create_directory(folder / "models");
    struct Case {
        std::string arguments;
        int code;
        std::string message;
    };
    const auto [arguments, code, message] = GENERATE(
        Case{"points.obj out.glb --source hill.glb", 3, "points.obj: no faces"},
        Case{"bare.obj out.glb --source points.obj", 3, "points.obj: no faces"},
        Case{"bare.obj out.glb --source cut.glb", 3, "cut.glb: "},
        Case{"bare.obj out.glb --source none.glb", 3, "none.glb: no such file"},
        Case{"bare.obj out.glb --source models", 3, "models: is not a regular file"},
        Case{"models out.glb --source hill.glb", 3, "models: is not a regular file"},
        Case{"far.obj out.glb --source hill.glb", 3,
             "hill.glb onto far.obj: target: no point of it is near the source, on the side that the source "
             "shows: "
             "they must be at the same place and of the same size, or max_distance must be larger"},
        Case{"bare.obj out.glb --source hill.glb --uvs keep", 3,
             "hill.glb onto bare.obj: target: its UVs cannot be kept, because part 'bare' has none: new ones "
             "are "
             "needed"},
        Case{"overlap.obj out.glb --source hill.glb --uvs keep", 3,
             "overlap.obj: target: its UVs cannot be kept, "
             "because some overlap"},
        Case{"outside.obj out.glb --source hill.glb --uvs keep", 3, "because some are outside of [0, 1]"},
        Case{"bare.obj hill.glb --source hill.glb", 2, "hill.glb: is the same file as the input"},
        Case{"bare.obj bare.obj --source hill.glb", 2, "bare.obj: is the same file as the input"},
        Case{"bare.obj out.ply --source hill.glb", 2,
             "out.ply: the file name must end in one of .glb, .gltf, .vrm, .obj"},
        Case{"bare.obj out.stl --source hill.glb", 2,
             "out.stl: the file name must end in one of .glb, .gltf, .vrm, .obj"},
        Case{"bare.obj out.glb --source hill.glb --bake vertex", 2,
             "--bake: must be auto, atlas or per-triangle"},
        Case{"bare.obj out.glb --source hill.glb --max-distance 0", 2, "max_distance must be finite and > 0"},
        Case{"bare.obj out.obj --source hill.glb --image-format webp", 2,
             "WebP images: the format of the result"},
        Case{"bare.obj out.glb", 2, "--source is required"});
    const Outcome outcome = run(folder, "bake " + arguments + " --force");
    CAPTURE(arguments, outcome.err);
    CHECK(outcome.code == code);
    CHECK(outcome.err.find(message) != std::string::npos);
    CHECK_FALSE(fs::exists(folder / "out.glb"));
}

TEST_CASE("bake warns if there is nothing to show, and of options without an effect") {
    const Folder folder;
    write(folder / "bare.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const std::string out =
        run(folder, "bake bare.obj out.glb --source bare.obj --compress none --uv-bits 12").out;
    CHECK(out.find("no texture was made, because the source has one colour") != std::string::npos);
    CHECK(out.find("--uv-bits") != std::string::npos);
}
