#include "result/memory_estimate.hpp"

#include <nlohmann/json.hpp>

#include "cli/process/exit_code.hpp"
#include "faqem/options.hpp"
#include "support/catch.hpp"
#include "support/cli_support.hpp"
#include "support/sanitizers.hpp"

using namespace faqem::cli;
using namespace faqem::detail;
using namespace tool_test;

TEST_CASE("the memory estimate of a model grows with faces, preserved attributes, images and texture size") {
    faqem::Options options{.preset = faqem::Preset::fast, .bake = {.kind = faqem::Bake::none}};
    const faqem::Asset small = sheet(20);
    const auto more = [&](const faqem::Asset& asset, const faqem::Options& with) {
        return static_cast<double>(estimated_simplify_memory(asset, with)) -
               static_cast<double>(estimated_simplify_memory(small, options));
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
    // The decoded image has 64 x 32 pixels.
    other.bake.kind = faqem::Bake::vertex;
    CHECK(more(small, other) >= 64 * 32 * 4);
    other.bake.kind = faqem::Bake::atlas;
    CHECK(more(small, other) >= 2048.0 * 2048 * 16);
    // Images that will be rejected are not counted.
    faqem::Asset claims = small;
    for (std::size_t i = 16; i < 24; ++i) claims.images[0].encoded[i] = 0xFF;
    other.bake.kind = faqem::Bake::vertex;
    CHECK(estimated_simplify_memory(claims, other) < std::uint64_t{1} << 40);
}

TEST_CASE("files that exceed the memory limit are rejected before they are read and pipes are not opened") {
    const Folder folder;
    CHECK(estimated_model_memory(folder / "none.glb") == 0);
    write(folder / "a.glb", "not a model");
    fs::resize_file(folder / "a.glb", std::uint64_t{1} << 40);  // a sparse file
    CHECK(estimated_model_memory(folder / "a.glb") >= std::uint64_t{1} << 40);
    const Outcome outcome = run(folder, "simplify a.glb out.glb --max-memory 1TB");
    CHECK(outcome.code == exit_no_memory);
    CHECK_THAT(outcome.err,
               ContainsSubstring("faqem: a.glb: may need ") && ContainsSubstring("(--max-memory)"));
    CHECK_FALSE(fs::exists(folder / "out.glb"));
    for (const auto& [size, megabytes] : {std::pair("2GB", "2000 MB"), std::pair("2GiB", "2148 MB")}) {
        const std::string command = std::string("simplify a.glb out.glb --max-memory ") + size;
        CHECK_THAT(run(folder, command).err, ContainsSubstring(std::string("but only ") + megabytes));
    }
    // The buffers of a .gltf file are counted, too.
    write(folder / "a.gltf", R"({"asset":{"version":"2.0"},"buffers":[{"uri":"a.bin","byteLength":1}]})");
    write(folder / "a.bin", "");
    fs::resize_file(folder / "a.bin", std::uint64_t{1} << 40);
    CHECK(estimated_model_memory(folder / "a.gltf") >= std::uint64_t{1} << 40);
    REQUIRE(std::system(("mkfifo '" + (folder / "pipe.glb").string() + "'").c_str()) == 0);
    CHECK(estimated_model_memory(folder / "pipe.glb") == 0);
}

TEST_CASE("small files that need much memory are rejected before they are decoded") {
    const Folder folder;
    write(folder / "a.bin", std::string(360000, '\0'));
    auto document = nlohmann::json::parse(R"({"asset":{"version":"2.0"},
        "buffers":[{"uri":"a.bin","byteLength":360000}], "bufferViews":[{"buffer":0,"byteLength":360000}],
        "accessors":[{"bufferView":0,"componentType":5126,"count":30000,"type":"VEC3"}]})");
    const nlohmann::json mesh = {{"primitives", {{{"attributes", {{"POSITION", 0}}}}}}};
    document["meshes"] = std::vector(2000, mesh);
    write(folder / "meshes.gltf", document.dump());
    document["meshes"] = {mesh};
    document["meshes"][0]["weights"] = std::vector<int>(4'000'000, 0);
    write(folder / "json.gltf", document.dump());
    for (const std::string name : {"meshes", "json"}) {
        const Outcome outcome =
            run(folder, "simplify " + name + ".gltf out.glb --bake none --max-memory 500MB");
        CHECK(outcome.code == exit_no_memory);
        CHECK_THAT(outcome.err, ContainsSubstring("faqem: " + name + ".gltf: may need "));
    }
}

#ifndef FAQEM_SANITIZED

TEST_CASE("the estimated peak memory is between one and three times the measured peak") {
    const Folder folder;
    faqem::save(sheet(150), folder / "in.glb");  // 45,000 faces
    for (const std::string options :
         {"--preset fast --bake none", "--preset balanced --bake vertex", "--preset balanced --bake keep",
          "--preset qem --bake none", "--visibility weighted --bake none", "--bake none --max-bytes 200KB",
          "--bake keep --max-bytes 200KB", "--max-bytes 200KB"}) {
        CAPTURE(options);
        const auto simplify = [&](const std::string& memory) {
            return run(folder, "simplify in.glb out.glb --force --report r.json " + options + memory);
        };
        REQUIRE(simplify("").code == 0);
        const auto report = nlohmann::json::parse(read(folder / "r.json"));
        const auto peak = report["peak_rss_bytes"].get<std::uint64_t>();
        const Outcome refused = simplify(" --max-memory " + std::to_string(peak));
        CAPTURE(peak, refused.err);
        CHECK(refused.code == exit_no_memory);
        CHECK_THAT(refused.err, ContainsSubstring("faqem: in.glb: may need "));
        CHECK(simplify(" --max-memory " + std::to_string(3 * peak)).code == 0);
    }
}

#endif

TEST_CASE("the memory estimate of a file grows with its size, the texture size and the preset") {
    faqem::Options options;
    const auto peak = [&](const char* file, std::uint64_t bytes) {
        return estimated_work_memory(file, bytes, options);
    };
    CHECK(peak("a.glb", 2'000'000) > peak("a.glb", 1'000'000));
    // A binary file has more faces than a text file of the same size.
    CHECK(peak("a.PLY", 1'000'000) > peak("a.obj", 1'000'000));
    const std::uint64_t balanced = peak("a.glb", 1'000'000);
    options.preset = faqem::Preset::best;
    CHECK(peak("a.glb", 1'000'000) > balanced);
    options.bake.kind = faqem::Bake::none;
    CHECK(peak("a.glb", 0) < 100'000'000);
}

TEST_CASE("batch and simplify estimate the same memory per face") {
    faqem::Options options{.bake = {.kind = faqem::Bake::none}};
    for (const auto preset :
         {faqem::Preset::fast, faqem::Preset::balanced, faqem::Preset::best, faqem::Preset::qem}) {
        options.preset = preset;
        const auto of_asset = [&](std::size_t faces) {
            faqem::Asset asset;
            asset.parts.resize(1);
            asset.parts[0].triangles.resize(faces);
            return static_cast<double>(estimated_simplify_memory(asset, options));
        };
        // Of a binary STL file of as many faces.
        const auto of_file = [&](std::uint64_t faces) {
            return static_cast<double>(estimated_work_memory("a.stl", 50 * faces, options));
        };
        CHECK(of_file(200'000) - of_file(100'000) ==
              Approx(of_asset(200'000) - of_asset(100'000)).margin(1e6));
    }
}
