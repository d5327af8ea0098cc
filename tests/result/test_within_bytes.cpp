#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "faqem/asset.hpp"
#include "support/catch.hpp"
#include "support/cli_support.hpp"

using namespace tool_test;

namespace {

// A sheet whose image is noise, which does not compress.
faqem::Asset noisy_sheet(faqem::Index n) {
    faqem::Asset asset = sheet(n, 0.2);
    faqem::Pixels pixels{256, 256, {}, false};
    std::uint32_t state = 1;
    for (int i = 0; i < 256 * 256 * 4; ++i) {
        state = state * 1664525u + 1013904223u;
        pixels.rgba.push_back(i % 4 == 3 ? 255 : static_cast<std::uint8_t>(state >> 24));
    }
    asset.images[0] = faqem::encode_png(pixels, "noise");
    return asset;
}

std::uintmax_t bytes_in(const fs::path& folder) {
    std::uintmax_t sum = 0;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (entry.is_regular_file()) sum += entry.file_size();
    }
    return sum;
}

std::string warnings(const Folder& folder) {
    return nlohmann::json::parse(read(folder / "r.json"))["warnings"].dump();
}

}  // namespace

TEST_CASE("simplify --max-bytes does not change a result that fits") {
    const ModelFolder folder("in.glb", sheet(20));
    REQUIRE(run(folder, "simplify in.glb a.glb --ratio 0.5").code == 0);
    REQUIRE(run(folder, "simplify in.glb b.glb --ratio 0.5 --max-bytes 10MB --report r.json").code == 0);
    CHECK(read(folder / "a.glb") == read(folder / "b.glb"));
    CHECK(warnings(folder).find("max_bytes") == std::string::npos);
}

TEST_CASE("simplify --max-bytes reduces faces and images and adds a warning to the report") {
    const ModelFolder folder("in.glb", noisy_sheet(60));
    REQUIRE(run(folder, "simplify in.glb full.glb --ratio 0.9 --allow-larger").code == 0);
    REQUIRE(fs::file_size(folder / "full.glb") > 300000);
    const Outcome outcome =
        run(folder, "simplify in.glb out.glb --ratio 0.9 --max-bytes 60000 --report r.json");
    REQUIRE(outcome.code == 0);
    CHECK(fs::file_size(folder / "out.glb") <= 60000);
    CHECK(fs::file_size(folder / "out.glb") > 15000);
    CHECK(warnings(folder).find("reduced to fit max_bytes") != std::string::npos);
    const faqem::Asset out = faqem::load(folder / "out.glb");
    REQUIRE(out.images.size() == 1);
    const std::size_t faces = out.parts[0].triangles.size();
    CHECK(faces < 6480);
    CHECK(faces > 300);
    CHECK(fs::file_size(folder / "out.glb") - out.images[0].encoded.size() <= 30000);
}

TEST_CASE("--max-bytes does not depend on the name of the result") {
    const ModelFolder folder("in.glb", noisy_sheet(60));
    for (const std::string name : {"out.glb", "OUTPUT.GLB"})
        REQUIRE(run(folder, "simplify in.glb " + name + " --ratio 1 --max-bytes 60000").code == 0);
    CHECK(read(folder / "OUTPUT.GLB") == read(folder / "out.glb"));
}

TEST_CASE("simplify --max-bytes reduces only faces if there are no images") {
    const ModelFolder folder("in.ply", sheet(60, 0.2));
    REQUIRE(run(folder, "simplify in.ply out.ply --bake none --ratio 1 --max-bytes 20KB").code == 0);
    const std::uintmax_t bytes = fs::file_size(folder / "out.ply");
    CHECK(bytes <= 20000);
    CHECK(bytes > 15000);
}

TEST_CASE("simplify --max-bytes counts all files of a model") {
    const ModelFolder folder("in.glb", noisy_sheet(30));
    for (const std::string name : {"out.gltf", "out.obj"}) {
        fs::create_directory(folder / "to");
        REQUIRE(run(folder, "simplify in.glb to/" + name + " --ratio 1 --max-bytes 50000").code == 0);
        CHECK(bytes_in(folder / "to") <= 50000);
        fs::remove_all(folder / "to");
    }
}

TEST_CASE("--max-bytes is kept wherever the same command without it has as few bytes") {
    const Folder folder;
    faqem::Asset asset = noisy_sheet(12);
    for (faqem::Vec3& p : asset.parts[0].positions) p[2] = 0.2 * std::sin(9 * p[0]) * std::cos(7 * p[1]);
    faqem::save(asset, folder / "in.glb");
    REQUIRE(run(folder, "simplify in.glb plain.glb --faces 60").code == 0);
    const std::string bytes = std::to_string(fs::file_size(folder / "plain.glb"));
    REQUIRE(run(folder, "simplify in.glb out.glb --faces 60 --report r.json --max-bytes " + bytes).code == 0);
    CHECK(fs::file_size(folder / "out.glb") <= fs::file_size(folder / "plain.glb"));
    CHECK(faqem::load(folder / "out.glb").parts[0].triangles.size() ==
          faqem::load(folder / "plain.glb").parts[0].triangles.size());
}

TEST_CASE("--max-bytes with a face count makes images smaller before it takes faces") {
    const ModelFolder folder("in.glb", noisy_sheet(30));
    const std::string command = "simplify in.glb out.glb --force --faces 400 --bake atlas --report r.json";
    REQUIRE(run(folder, command + " --allow-larger").code == 0);
    const faqem::Asset plain = faqem::load(folder / "out.glb");
    const std::uintmax_t geometry = fs::file_size(folder / "out.glb") - plain.images[0].encoded.size();
    REQUIRE(run(folder, command + " --max-bytes " + std::to_string(geometry * 5 / 4)).code == 0);
    CHECK(faqem::load(folder / "out.glb").parts[0].triangles.size() == plain.parts[0].triangles.size());
    CHECK(warnings(folder).find("size and quality of the images") != std::string::npos);
    // The target of the report is the one that was asked for, also where the bytes hold fewer faces.
    REQUIRE(run(folder, command + " --max-bytes " + std::to_string(geometry / 2)).code == 0);
    CHECK(faqem::load(folder / "out.glb").parts[0].triangles.size() < 300);
    CHECK(nlohmann::json::parse(read(folder / "r.json"))["target_faces"] == 400);
}
