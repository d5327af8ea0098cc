// Malicious files exit with 3 and an error that names the file and the element; no output is written.

#include <algorithm>

#include "support/catch.hpp"
#include "support/cli_support.hpp"
#include "support/message_of.hpp"

using namespace tool_test;
using faqem::testing::contains;

namespace {

/// Checks that `simplify` and `info` reject a file with an error message that contains the words.
void check_refused(const Folder& folder, const std::string& file, const std::string& words) {
    for (const std::string& command : {"simplify " + file + " out.glb", "info " + file}) {
        const Outcome outcome = run(folder, command);
        INFO(command << ": " << outcome.err);
        CHECK(outcome.code == 3);
        CHECK(contains(outcome.err, "faqem: " + file + ": "));
        CHECK(contains(outcome.err, words));
        CHECK(outcome.out.empty());
    }
    CHECK(!fs::exists(folder / "out.glb"));
}

}  // namespace

TEST_CASE("hostile: JSON with 20,000 nested arrays or objects is rejected") {
    const Folder folder;
    const std::string start = R"({"asset":{"version":"2.0"},"extras":)", open(20000, '[');
    write(folder / "open.gltf", start + open);
    write(folder / "closed.gltf", start + open + std::string(20000, ']') + "}");
    std::string objects = start;
    for (int i = 0; i < 20000; ++i) objects += "{\"a\":";
    write(folder / "objects.gltf", objects);
    for (const std::string file : {"open.gltf", "closed.gltf", "objects.gltf"})
        check_refused(folder, file, "nested deeper than 64");
}

TEST_CASE("hostile: nothing but the error of faqem is printed for a damaged PNG") {
    // libpng prints its errors itself unless it is prevented from doing so.
    const Folder folder;
    fs::create_directory(folder / "in");
    const std::vector<std::uint8_t> good = two_colours().encoded;
    std::vector<std::vector<std::uint8_t>> damaged(5, good);
    damaged[0][20] ^= 1;                                // height: the checksum of IHDR is wrong
    damaged[1][good.size() - 30] ^= 0x55;               // in the last IDAT
    damaged[2].resize(good.size() - 40);                // truncated
    damaged[3].insert(damaged[3].begin() + 33, 12, 0);  // a chunk whose type is zeros
    std::fill(damaged[4].begin() + 60, damaged[4].end() - 20, std::uint8_t{0xff});
    for (std::size_t i = 0; i < damaged.size(); ++i) {
        CAPTURE(i);
        faqem::Asset asset = sheet(4);
        asset.images[0].encoded = damaged[i];
        const std::string file = "in/" + std::to_string(i) + ".glb";
        faqem::save(asset, folder / file);
        const Outcome outcome = run(folder, "simplify " + file + " out.glb --bake atlas");
        INFO(outcome.err);
        CHECK(outcome.code == 3);
        CHECK(outcome.err.rfind("faqem: " + file + ": ", 0) == 0);
        CHECK(outcome.err.find('\n') == outcome.err.size() - 1);
    }
    const Outcome batch = run(folder, "batch in out --bake atlas --jobs 2");
    CHECK(batch.code == 9);
    CHECK(batch.err.starts_with("faqem: "));
    CHECK(batch.err.find(" failed\n") == batch.err.size() - 8);
}

TEST_CASE("hostile: directories and devices are rejected as input") {
    const Folder folder;
    fs::create_directory(folder / "a.glb");
    check_refused(folder, "a.glb", "not a regular file");
    check_refused(folder, "/dev/zero", "not a regular file");
}
