#include <nlohmann/json.hpp>
#include <string>

#include "support/catch.hpp"
#include "support/cli_support.hpp"

using namespace tool_test;

namespace {

const std::string no_time = " --max-seconds 1e-9";

nlohmann::json report_in(const Folder& folder) { return nlohmann::json::parse(read(folder / "r.json")); }

}  // namespace

TEST_CASE("simplify without time writes the model with its faces and images and exits with 0") {
    const ModelFolder folder("in.glb", sheet(20, 0.2));
    const Outcome outcome = run(folder, "simplify in.glb out.glb --report r.json" + no_time);
    CHECK(outcome.code == 0);
    CHECK(outcome.out.find("reached_time_limit") != std::string::npos);
    const nlohmann::json report = report_in(folder);
    CHECK(report["stop_reason"] == "reached_time_limit");
    CHECK(report["faces_out"] == 800);
    CHECK(report["target_faces"] == 80);
    const faqem::Asset in = faqem::load(folder / "in.glb"), out = faqem::load(folder / "out.glb");
    REQUIRE(out.images.size() == 1);
    CHECK(out.images[0].encoded == in.images[0].encoded);
    CHECK(run(folder, "simplify in.glb strict.glb --strict-target" + no_time).code == 5);
}

TEST_CASE("simplify with much time writes the same bytes as without a limit") {
    const ModelFolder folder("in.glb", sheet(20, 0.2));
    REQUIRE(run(folder, "simplify in.glb a.glb --history a.history").code == 0);
    REQUIRE(run(folder, "simplify in.glb b.glb --history b.history --max-seconds 1e8").code == 0);
    CHECK(read(folder / "a.glb") == read(folder / "b.glb"));
    CHECK(read(folder / "a.history") == read(folder / "b.history"));
}

TEST_CASE("simplify exits with 12 if there is no result that the other options allow in time") {
    const ModelFolder folder("in.glb", sheet(20, 0.2));
    for (const std::string other : {"--correspondence out.bin", "--max-bytes 300"}) {
        CAPTURE(other);
        const Outcome outcome = run(folder, "simplify in.glb out.glb " + other + no_time);
        CHECK(outcome.code == 12);
        CHECK(outcome.err.find("faqem: ") == 0);
        CHECK(outcome.err.find("max") != std::string::npos);
        CHECK(!fs::exists(folder / "out.glb"));
    }
    CHECK(run(folder, "simplify in.glb out.glb --max-bytes 1GB" + no_time).code == 0);
}

TEST_CASE("the time limit of batch holds for each model") {
    const Folder folder;
    fs::create_directories(folder / "in");
    for (const std::string name : {"a", "b"}) faqem::save(sheet(20, 0.2), folder / ("in/" + name + ".glb"));
    const Outcome outcome = run(folder, "batch in out" + no_time);
    CHECK(outcome.code == 0);
    std::istringstream lines(outcome.out);
    int models = 0;
    for (std::string line; std::getline(lines, line); ++models) {
        const nlohmann::json model = nlohmann::json::parse(line);
        CHECK(model["status"] == "done");
        CHECK(model["faces_out"] == 800);
        CHECK(model["warnings"].dump().find("max_seconds was over") != std::string::npos);
    }
    CHECK(models == 2);
    CHECK(run(folder, "batch in out --resume" + no_time).out.find("\"done\"") == std::string::npos);
    CHECK(run(folder, "batch in out --resume --max-seconds 1e8").out.find("\"done\"") != std::string::npos);
}
