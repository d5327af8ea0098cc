// --max-bytes where the faces are not chosen by it: lod and truncate; and in batch.

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "support/catch.hpp"
#include "support/painted_sheet.hpp"

using namespace tool_test;

namespace {

/// The number of bytes that a message says the smallest result has.
std::string size_in_message(const Outcome& outcome) {
    const std::size_t at = outcome.err.find(" has ");
    REQUIRE(at != std::string::npos);
    return std::to_string(std::stoul(outcome.err.substr(at + 5)));
}

}  // namespace

TEST_CASE("lod: each level has at most --max-bytes and the same faces as without, and more bytes show more") {
    const ModelFolder folder("in.glb", painted_sheet(40));
    const std::string command = "lod in.glb out --force --levels 0.5,0.1 ";
    REQUIRE(run(folder, command).code == 0);
    const auto faces = [&](int level) {
        return faqem::load(folder / ("out/in_LOD" + std::to_string(level) + ".glb")).parts[0].triangles;
    };
    const auto first = faces(1), second = faces(2);
    const std::string unlimited = read(folder / "out/in_LOD1.glb");
    const std::uint64_t smallest = std::stoul(size_in_message(run(folder, command + "--max-bytes 1000")));
    REQUIRE(smallest < unlimited.size());
    double last = 0;
    for (const std::uint64_t bytes : {smallest, (smallest + unlimited.size()) / 2}) {
        CAPTURE(bytes);
        REQUIRE(run(folder, command + "--max-bytes " + std::to_string(bytes)).code == 0);
        for (const std::string file : {"out/in_LOD1.glb", "out/in_LOD2.glb"})
            CHECK(fs::file_size(folder / file) <= bytes);
        CHECK(faces(1) == first);
        CHECK(faces(2) == second);
        const double psnr = psnr_of(folder, "out/in_LOD1.glb");
        CHECK(psnr > last);
        last = psnr;
    }
    REQUIRE(run(folder, command + "--max-bytes 10MB").code == 0);
    CHECK(read(folder / "out/in_LOD1.glb") == unlimited);
}

TEST_CASE("lod and truncate refuse a limit below the smallest result, and take its size") {
    const ModelFolder folder("in.glb", painted_sheet(24));
    const std::string lod = "lod in.glb out --force --levels 200 --history h.bin --max-bytes ";
    const Outcome refused = run(folder, lod + "1000");
    CHECK(refused.code == 10);
    CHECK(refused.err.find("in_LOD1.glb: the smallest result with ") != std::string::npos);
    CHECK_FALSE(fs::exists(folder / "out/in_LOD1.glb"));
    const std::string bytes = size_in_message(refused);
    REQUIRE(run(folder, lod + bytes).code == 0);
    CHECK(fs::file_size(folder / "out/in_LOD1.glb") <= std::stoul(bytes));

    const std::string truncate = "truncate h.bin cut.glb --faces 200 --source in.glb --max-bytes ";
    CHECK(run(folder, truncate + "1000").code == 10);
    CHECK_FALSE(fs::exists(folder / "cut.glb"));
    REQUIRE(run(folder, truncate + bytes).code == 0);
    CHECK(read(folder / "cut.glb") == read(folder / "out/in_LOD1.glb"));
    CHECK(run(folder, "truncate h.bin cut2.glb --faces 200 --max-bytes 5000").code == 2);
    CHECK(run(folder, "lod in.glb out2 --textures shared --max-bytes 5000").code == 2);
    CHECK(run(folder, "lod in.glb out2.glb --max-bytes 5000").code == 2);
}

TEST_CASE("batch --max-bytes writes the same bytes as simplify, and repeats models when it changes") {
    const Folder folder;
    fs::create_directories(folder / "in");
    faqem::save(painted_sheet(24), folder / "in/a.glb");
    faqem::save(painted_sheet(30), folder / "in/b.glb");
    const std::string batch = "batch in out --resume --max-bytes ";
    REQUIRE(run(folder, batch + "12000").code == 0);
    for (const std::string name : {"a.glb", "b.glb"}) {
        REQUIRE(run(folder, "simplify in/" + name + " own.glb --force --max-bytes 12000").code == 0);
        CHECK(read(folder / "own.glb") == read(folder / ("out/" + name)));
    }
    CHECK(run(folder, batch + "12000").out.find("\"done\"") == std::string::npos);
    REQUIRE(run(folder, batch + "8000").code == 0);
    CHECK(fs::file_size(folder / "out/a.glb") <= 8000);
    CHECK(fs::file_size(folder / "out/b.glb") <= 8000);

    const Outcome refused = run(folder, "batch in small --max-bytes 200");
    CHECK(refused.code != 0);
    CHECK(refused.out.find("the smallest result has ") != std::string::npos);
    CHECK(refused.out.find("\"code\":10") != std::string::npos);
}
