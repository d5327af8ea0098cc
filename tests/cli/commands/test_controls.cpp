// The options --prune, --keep-groups, --strict-target and --strict.
#include <nlohmann/json.hpp>
#include <string>

#include "support/catch.hpp"
#include "support/cli_support.hpp"

using namespace tool_test;

namespace {

// A bumpy sheet and a separate small triangle whose bounding box has the diagonal 0.01 sqrt(2).
faqem::Asset sheet_with_small_component() {
    faqem::Asset asset = sheet(20, 0.2);
    faqem::Part& part = asset.parts[0];
    const auto first = static_cast<faqem::Index>(part.positions.size());
    for (const faqem::Vec3& p : {faqem::Vec3{1.5, 0, 0}, {1.51, 0, 0}, {1.5, 0.01, 0}}) {
        part.positions.push_back(p);
        part.uvs[0].push_back({0, 0});
    }
    part.triangles.push_back({first, first + 1, first + 2});
    part.face_material.push_back(0);
    return asset;
}

nlohmann::json report_of(const Folder& folder, const std::string& arguments) {
    const Outcome outcome = run(folder, "simplify " + arguments + " --bake none --force --report r.json");
    REQUIRE(outcome.code == 0);
    return nlohmann::json::parse(read(folder / "r.json"));
}

}  // namespace

TEST_CASE("simplify --prune deletes small components by model units or relative to the scene's diagonal") {
    const ModelFolder folder("in.gltf", sheet_with_small_component());
    for (const char* size : {"0.015", "1%"}) {
        CAPTURE(size);
        const nlohmann::json report = report_of(folder, std::string("in.gltf out.glb --prune ") + size);
        CHECK(report["components_pruned"] == 1);
        CHECK(report["faces_pruned"] == 1);
        CHECK(report["faces_in"] == 801);
        CHECK(report["warnings"][0].get<std::string>().find("pruned") != std::string::npos);
    }
    for (const char* size : {"0.014", "0.1%"}) {
        CAPTURE(size);
        CHECK(report_of(folder, std::string("in.gltf out.glb --prune ") + size)["components_pruned"] == 0);
    }
    CHECK(report_of(folder, "in.gltf out.glb")["components_pruned"] == 0);
}

TEST_CASE("simplify --prune measures components at the largest scale of their mesh in the scene") {
    const ModelFolder folder("small.gltf", sheet_with_small_component());
    nlohmann::json scene = nlohmann::json::parse(read(folder / "small.gltf"));
    const std::size_t node = scene["scenes"][0]["nodes"][0];
    scene["nodes"][node]["scale"] = {8, 8, 8};
    write(folder / "large.gltf", scene.dump());
    CHECK(report_of(folder, "large.gltf out.glb --prune 0.015")["components_pruned"] == 0);
    CHECK(report_of(folder, "large.gltf out.glb --prune 0.12")["components_pruned"] == 1);
    CHECK(report_of(folder, "large.gltf out.glb --prune 1%")["components_pruned"] == 1);
    // A second, unscaled instance does not change the largest scale.
    scene["nodes"].push_back({{"mesh", scene["nodes"][node]["mesh"]}});
    scene["scenes"][0]["nodes"].push_back(scene["nodes"].size() - 1);
    write(folder / "both.gltf", scene.dump());
    CHECK(report_of(folder, "both.gltf out.glb --prune 0.015")["components_pruned"] == 0);
    CHECK(report_of(folder, "both.gltf out.glb --prune 0.12")["components_pruned"] == 1);
}

TEST_CASE("a target that --keep-groups prevents exits with 5 with --strict-target") {
    const Folder folder;
    faqem::Asset asset = sheet(6, 0.2);
    asset.materials.resize(72, asset.materials[0]);
    for (faqem::Index f = 0; f < 72; ++f) asset.parts[0].face_material[f] = f;
    faqem::save(asset, folder / "in.glb");
    const Outcome outcome = run(folder, "simplify in.glb out.glb --bake none --keep-groups --strict-target");
    CHECK(outcome.code == 5);
    CHECK(!fs::exists(folder / "out.glb"));
    // Without the option the boundaries are given up for the target.
    const nlohmann::json given_up = report_of(folder, "in.glb given_up.glb --strict-target");
    CHECK(given_up["stop_reason"] == "reached_target");
    CHECK(given_up["rungs"]["group_boundaries"] == 1);
    CHECK(run(folder, "simplify in.glb out.glb --bake none --strict-target").code == 0);
}

TEST_CASE("simplify --strict rejects input that would be repaired and names the element") {
    const Folder folder;
    const auto refused = [&](const std::string& text, const std::string& why) {
        write(folder / "in.obj", text);
        const Outcome lenient = run(folder, "simplify in.obj out.ply --quiet --force");
        CHECK(lenient.code == 0);
        fs::remove(folder / "out.ply");
        const Outcome strict = run(folder, "simplify in.obj out.ply --quiet --strict");
        INFO(strict.err);
        CHECK(strict.code == 3);
        CHECK(strict.err.find("faqem: in.obj: ") == 0);
        CHECK(strict.err.find(why) != std::string::npos);
        CHECK(!fs::exists(folder / "out.ply"));
    };
    const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\n";
    refused(square + "v nan 0 0\nf 1 2 3\nf 1 3 4\nf 1 2 6\n", "non-finite");
    refused(square + "f 1 2 3\nf 1 3 4\nf 1 2 5\n", "part 'in': face 2: has zero area");
    refused(square + "f 1 2 3\nf 1 3 4\nf 4 1 3\n", "face 2: is a duplicate of face 1");
    refused("mtllib none.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n", "none.mtl");
    // Two faces of opposite orientation and an unreferenced vertex need no repair.
    write(folder / "in.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 7 7 7\nf 1 2 3\nf 1 3 2\n");
    CHECK(run(folder, "simplify in.obj out.ply --quiet --strict").code == 0);
}
