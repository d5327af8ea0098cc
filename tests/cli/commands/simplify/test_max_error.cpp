#include <nlohmann/json.hpp>
#include <string>

#include "faqem/compare.hpp"
#include "support/catch.hpp"
#include "support/cli_support.hpp"

using namespace tool_test;

namespace {

faqem::MeshView view(const faqem::Part& part) { return {part.positions, part.triangles, {}, nullptr, {}}; }

}  // namespace

TEST_CASE("simplify --max-error finds the smallest model within the distance and reports the bounds") {
    const ModelFolder folder("in.glb", sheet(30, 0.2));
    const Outcome outcome =
        run(folder, "simplify in.glb out.glb --max-error 0.01 --bake none --report r.json");
    CHECK(outcome.code == 0);
    CHECK(outcome.err.empty());
    CHECK(outcome.out.find("reached_max_error") != std::string::npos);
    CHECK(outcome.out.find("allowed 0.01") != std::string::npos);
    const nlohmann::json report = nlohmann::json::parse(read(folder / "r.json"));
    CHECK(report["stop_reason"] == "reached_max_error");
    const nlohmann::json& error = report["max_error"];
    CHECK(error["allowed"] == 0.01);
    CHECK(error["within"] == true);
    CHECK(error["value"] <= error["bound"]);
    CHECK(error["bound"] <= 0.01);
    CHECK(error["runs"] == 1);
    const faqem::Asset in = faqem::load(folder / "in.glb"), out = faqem::load(folder / "out.glb");
    CHECK(out.parts[0].triangles.size() == report["faces_out"]);
    CHECK(out.parts[0].triangles.size() < 900);
    // The tolerance accounts for positions stored as floats.
    CHECK(faqem::hausdorff(view(in.parts[0]), view(out.parts[0])).value <= 0.01 + 1e-6);
}

TEST_CASE("simplify --max-error in percent is relative to the diagonal of the transformed scene") {
    const ModelFolder folder("small.gltf", sheet(24, 0.2));
    nlohmann::json scene = nlohmann::json::parse(read(folder / "small.gltf"));
    const std::size_t node = scene["scenes"][0]["nodes"][0];
    scene["nodes"][node]["scale"] = {8, 8, 8};
    write(folder / "large.gltf", scene.dump());
    const auto report = [&](const std::string& in, const std::string& error) {
        const Outcome outcome = run(
            folder, "simplify " + in + " out.glb --bake none --force --report r.json --max-error " + error);
        REQUIRE(outcome.code == 0);
        return nlohmann::json::parse(read(folder / "r.json"));
    };
    const nlohmann::json small = report("small.gltf", "0.5%"), large = report("large.gltf", "0.5%");
    CHECK(small["faces_out"] < 576);
    CHECK(large["faces_out"] == small["faces_out"]);
    CHECK(large["max_error"]["allowed"].get<double>() ==
          Approx(8 * small["max_error"]["allowed"].get<double>()));
    CHECK(large["max_error"]["bound"].get<double>() == Approx(8 * small["max_error"]["bound"].get<double>()));
    CHECK(report("large.gltf", "0.08")["faces_out"] == report("small.gltf", "0.01")["faces_out"]);
    // A second, smaller instance of the mesh changes only the bounding box of the scene.
    scene["nodes"].push_back({{"mesh", scene["nodes"][node]["mesh"]}});
    scene["scenes"][0]["nodes"].push_back(scene["nodes"].size() - 1);
    write(folder / "both.gltf", scene.dump());
    CHECK(report("both.gltf", "0.08")["faces_out"] == report("small.gltf", "0.01")["faces_out"]);
}

TEST_CASE("a face count that exceeds --max-error exits with 6 and writes no model") {
    const ModelFolder folder("in.glb", sheet(20, 0.2));
    for (const char* target : {"--faces 30", "--ratio 0.04"}) {
        CAPTURE(target);
        const std::string common =
            std::string("simplify in.glb out.glb --bake none --force --report r.json ") + target;
        const Outcome refused = run(folder, common + " --max-error 0.001");
        CHECK(refused.code == 6);
        CHECK(refused.err.find("faqem: in.glb: max error exceeded: ") == 0);
        CHECK(refused.err.find("; out.glb was not written\n") != std::string::npos);
        CHECK(!fs::exists(folder / "out.glb"));
        const nlohmann::json report = nlohmann::json::parse(read(folder / "r.json"));
        CHECK(report["max_error"]["within"] == false);
        CHECK(report["max_error"]["bound"] > 0.001);
        CHECK(report["stop_reason"] == "reached_target");
        const Outcome within = run(folder, common + " --max-error 50%");
        CHECK(within.code == 0);
        CHECK(within.out.find("of the diagonal: less than a pixel where the diagonal has up to ") !=
              std::string::npos);
        CHECK(fs::exists(folder / "out.glb"));
        fs::remove(folder / "out.glb");
    }
}

TEST_CASE("a missed target has precedence over a missed --max-error") {
    const ModelFolder folder("in.glb", sheet(6, 0.2));
    CHECK(run(folder, "simplify in.glb out.glb --faces 4 --lock-boundary --strict-target --max-error 1e-9")
              .code == 5);
    // Without a target, --strict-target has no effect.
    CHECK(run(folder, "simplify in.glb out.glb --lock-boundary --strict-target --max-error 10 --bake none")
              .code == 0);
}
