#include <nlohmann/json.hpp>
#include <string>

#include "support/catch.hpp"
#include "support/cli_support.hpp"

using namespace tool_test;

namespace {

std::string faces_of_level(const Folder& folder, const std::string& manifest, std::size_t level) {
    const nlohmann::json json = nlohmann::json::parse(read(folder / manifest));
    return std::to_string(json["levels"].at(level)["report"]["faces_out"].get<int>());
}

}  // namespace

TEST_CASE("truncate writes the same bytes as the level of the run that wrote the history") {
    const ModelFolder folder("hill.glb", sheet(24, 0.2));
    const std::string texture = " --texture-size 128";
    REQUIRE(
        run(folder, "lod hill.glb out --levels 0.5,200,60 --preset best --history h.bin" + texture).code ==
        0);
    for (std::size_t i = 1; i <= 3; ++i) {
        const std::string faces = faces_of_level(folder, "out/hill_LOD.json", i);
        const Outcome outcome =
            run(folder, "truncate h.bin cut.glb --force --source hill.glb --faces " + faces + texture);
        CHECK(outcome.code == 0);
        CHECK(outcome.out.find(" " + faces + " faces") != std::string::npos);
        CHECK(read(folder / "cut.glb") == read(folder / ("out/hill_LOD" + std::to_string(i) + ".glb")));
    }
}

TEST_CASE("truncate without --source writes the geometry") {
    const ModelFolder folder("hill.glb", sheet(24, 0.2));
    REQUIRE(run(folder,
                "lod hill.glb out --levels 0.5,100 --bake none --normals none --format ply --history h.bin")
                .code == 0);
    REQUIRE(run(folder, "truncate h.bin cut.ply --faces 100 --quiet").code == 0);
    const bool is_same = read(folder / "cut.ply") == read(folder / "out/hill_LOD2.ply");
    CHECK(is_same);
}

TEST_CASE("truncate writes the same bytes as simplify with the presets qem and paper") {
    const ModelFolder folder("hill.glb", sheet(24, 0.2));
    for (const std::string preset : {"qem", "paper"}) {
        const std::string options = " --preset " + preset + " --bake none --force";
        REQUIRE(run(folder, "lod hill.glb out --levels 0.5,40 --history h.bin" + options).code == 0);
        for (const std::string faces : {"777", "300", "40"}) {
            REQUIRE(run(folder, "simplify hill.glb own.glb --faces " + faces + options).code == 0);
            REQUIRE(
                run(folder, "truncate h.bin cut.glb --source hill.glb --bake none --force --faces " + faces)
                    .code == 0);
            CHECK(read(folder / "cut.glb") == read(folder / "own.glb"));
        }
    }
}

TEST_CASE("truncate reads the history of simplify and rejects invalid arguments") {
    const ModelFolder folder("a.glb", sheet(16, 0.2));
    faqem::save(sheet(12, 0.2), folder / "b.glb");
    REQUIRE(run(folder, "simplify a.glb simplified.glb --faces 80 --bake none --history h.bin").code == 0);
    REQUIRE(run(folder, "truncate h.bin cut.glb --faces 80 --source a.glb --bake none").code == 0);
    CHECK(read(folder / "cut.glb") == read(folder / "simplified.glb"));
    const auto refused = [&](const std::string& arguments) {
        const Outcome outcome = run(folder, "truncate " + arguments);
        CHECK_FALSE(outcome.err.empty());
        return outcome.code;
    };
    CHECK(refused("h.bin cut.glb --faces 200") == 7);
    CHECK(refused("h.bin new.glb --faces 40") == 5);
    CHECK(refused("h.bin new.glb --faces 200 --source b.glb") == 3);
    CHECK(refused("h.bin new.glb --faces 200 --source a.glb --bake keep") == 2);
    CHECK(refused("h.bin new.glb") == 2);
    CHECK(refused("h.bin new.xyz --faces 200") == 2);
    CHECK(refused("a.glb new.glb --faces 200") == 3);
    CHECK(refused("none.bin new.glb --faces 200") == 3);
    CHECK_FALSE(fs::exists(folder / "new.glb"));
}

TEST_CASE("lod and truncate print what was repaired in the model, which --strict rejects") {
    const ModelFolder folder("hill.obj", sheet(12, 0.2));
    write(folder / "hill.mtl", read(folder / "hill.mtl") + "disp d.png\n");
    const std::string warning = "'disp' is not supported (1 statement)\n", size = " --texture-size 64";
    const Outcome lod = run(folder, "lod hill.obj out --levels 0.5,100 --history h.bin" + size);
    CHECK(lod.code == 0);
    CHECK(lod.out.find("1 warning\n  ") != std::string::npos);
    CHECK(lod.out.find(warning) != std::string::npos);
    const std::string cut = "truncate h.bin cut.glb --faces 100" + size;
    const Outcome lenient = run(folder, cut + " --source hill.obj");
    CHECK(lenient.code == 0);
    CHECK(lenient.out.find(warning) != std::string::npos);
    const Outcome strict = run(folder, cut + " --force --strict --source hill.obj");
    CHECK(strict.code == 3);
    CHECK(strict.err.find("rejected by --strict: ") != std::string::npos);
    CHECK(run(folder, cut + " --force --strict").code == 2);
}
