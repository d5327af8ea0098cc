#include "cli/memory_estimate.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "cli/exit_code.hpp"
#include "support/cli_support.hpp"
#include "support/sanitizers.hpp"

using namespace faqem::cli;
using namespace tool_test;
using Catch::Matchers::Contains;

TEST_CASE("the peak of a model grows with its faces, what is kept of it, its images and the page") {
    faqem::Options options;
    options.bake.kind = faqem::Bake::none;
    const faqem::Asset small = sheet(20);
    const auto more = [&](const faqem::Asset& asset, const faqem::Options& with) {
        return static_cast<double>(estimated_peak_memory(asset, with)) -
               static_cast<double>(estimated_peak_memory(small, options));
    };
    CHECK(more(sheet(40), options) > 0);
    faqem::Options other = options;
    other.preset = faqem::Preset::best;
    CHECK(more(small, other) > 0);
    other = options;
    other.max_error = faqem::of_diagonal(0.01);
    CHECK(more(small, other) > 0);
    other = options;
    other.bake.kind = faqem::Bake::keep;
    CHECK(more(small, other) >= 3 * 800 * 2 * sizeof(float));
    // The image that is decoded has 64 x 32 pixels.
    other.bake.kind = faqem::Bake::vertex;
    CHECK(more(small, other) >= 64 * 32 * 4);
    other.bake.kind = faqem::Bake::atlas;
    CHECK(more(small, other) >= 2048.0 * 2048 * 16);
    // What will be refused takes nothing.
    faqem::Asset claims = small;
    for (std::size_t i = 16; i < 24; ++i) claims.images[0].encoded[i] = 0xFF;
    other.bake.kind = faqem::Bake::vertex;
    CHECK(estimated_peak_memory(claims, other) < std::uint64_t{1} << 40);
}

TEST_CASE("too much memory is an error with the file and both numbers") {
    CHECK_NOTHROW(require_memory("a.glb", 100, 100));
    CHECK_THROWS_WITH(require_memory("a.glb", 3'000'001, 2'000'000),
                      "a.glb: may take 4 MB of memory, 2 MB are allowed (--max-memory)");
    CHECK_THROWS_AS(require_memory("a.glb", 101, 100), MemoryError);
    CHECK(exit_code_of(MemoryError("")) == exit_no_memory);
    CHECK(exit_code_of(std::bad_alloc()) == exit_no_memory);
}

TEST_CASE("files that are large are refused before they are read, and what is no file is not opened") {
    const Folder folder;
    std::uint64_t before = estimated_loading_memory(folder / "none.glb");
    write(folder / "a.glb", "not a model");
    fs::resize_file(folder / "a.glb", std::uint64_t{1} << 40);  // a hole
    CHECK(estimated_loading_memory(folder / "a.glb") >= before + (std::uint64_t{1} << 40));
    const Outcome outcome = run(folder, "simplify a.glb out.glb --max-memory 1TB");
    CHECK(outcome.code == exit_no_memory);
    CHECK_THAT(outcome.err, Contains("faqem: a.glb: may take ") && Contains("(--max-memory)"));
    CHECK_FALSE(fs::exists(folder / "out.glb"));
    // Of a glTF the buffers count.
    write(folder / "a.gltf", R"({"asset":{"version":"2.0"},"buffers":[{"uri":"a.bin","byteLength":1}]})");
    write(folder / "a.bin", "");
    fs::resize_file(folder / "a.bin", std::uint64_t{1} << 40);
    CHECK(estimated_loading_memory(folder / "a.gltf") >= before + (std::uint64_t{1} << 40));
    REQUIRE(std::system(("mkfifo '" + (folder / "pipe.glb").string() + "'").c_str()) == 0);
    before = estimated_loading_memory(folder / "none.glb");
    CHECK(estimated_loading_memory(folder / "pipe.glb") == before);
}

#ifndef FAQEM_SANITIZED

TEST_CASE("a run stays below the peak that was predicted, and the prediction is no more than thrice that") {
    const Folder folder;
    faqem::save(sheet(150), folder / "in.glb");  // 45,000 faces
    for (const std::string options :
         {"--preset fast --bake none", "--preset balanced --bake vertex", "--preset balanced --bake keep",
          "--preset qem --bake none", "--visibility weighted --bake none"}) {
        CAPTURE(options);
        const auto simplify = [&](const std::string& memory) {
            return run(folder, "simplify in.glb out.glb --force --report r.json " + options + memory);
        };
        REQUIRE(simplify("").code == 0);
        const auto report = nlohmann::json::parse(read(folder / "r.json"));
        const auto peak = report["peak_rss_bytes"].get<std::uint64_t>();
        const Outcome refused = simplify(" --max-memory " + std::to_string(peak));
        CHECK(refused.code == exit_no_memory);
        CHECK_THAT(refused.err, Contains("faqem: in.glb: may take "));
        CHECK(simplify(" --max-memory " + std::to_string(3 * peak)).code == 0);
    }
}

#endif
