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
    CHECK(run(folder, bake + "--force --uvs keep").code == 3);
    CHECK(run(folder, bake + "--force --bake vertex").code == 2);
    CHECK(run(folder, bake + "--force --max-distance 0").code == 2);
    CHECK(run(folder, "bake bare.stl textured.glb --force").code == 2);
}
