#include <fstream>
#include <nlohmann/json.hpp>

#include "cli/process/shown_text.hpp"
#include "faqem/history.hpp"
#include "support/catch.hpp"
#include "support/cli_support.hpp"

using namespace tool_test;

namespace {

std::size_t files_in(const Folder& folder) {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder.path()), {}));
}

std::size_t face_count(const faqem::Asset& asset) {
    std::size_t faces = 0;
    for (const faqem::Part& part : asset.parts) faces += part.triangles.size();
    return faces;
}

}  // namespace

TEST_CASE("simplify writes a simplified model, a report and a summary") {
    const ModelFolder folder("in.glb", sheet(20));
    const Outcome outcome =
        run(folder, "simplify in.glb out.glb --faces 100 --texture-size 256 --report r.json");
    CHECK(outcome.code == 0);
    CHECK(outcome.err.empty());
    CHECK(outcome.out.find("\n800 -> ") != std::string::npos);
    CHECK(outcome.out.find(" faces (--faces 100, reached_target)\n") != std::string::npos);
    const auto bytes = [&](const char* name) {
        return faqem::cli::shown_bytes(fs::file_size(folder / name));
    };
    const std::string image =
        faqem::cli::shown_bytes(faqem::load(folder / "out.glb").images.at(0).encoded.size());
    CHECK(outcome.out.find(bytes("in.glb") + " -> " + bytes("out.glb") + " (geometry ") != std::string::npos);
    CHECK(outcome.out.find(", images " + image + ")\n") != std::string::npos);
    for (const char* word : {"rejected pairs", "rungs"}) CHECK(outcome.out.find(word) == std::string::npos);
    CHECK(outcome.out.find("warnings") != std::string::npos);

    const faqem::Asset simplified = faqem::load(folder / "out.glb");
    CHECK(face_count(simplified) <= 100);
    CHECK(face_count(simplified) >= 90);
    CHECK(!simplified.images.empty());
    CHECK(files_in(folder) == 3);

    const nlohmann::json report = nlohmann::json::parse(read(folder / "r.json"));
    for (const char* key : {"preset", "faces_in", "faces_out", "vertices_in", "vertices_out", "target_faces",
                            "stop_reason", "refusals", "warnings", "seconds", "peak_rss_bytes"}) {
        CAPTURE(key);
        CHECK(report.contains(key));
    }
    CHECK(report["faces_in"] == 800);
    CHECK(report["faces_out"] == face_count(simplified));
    CHECK(report["target_faces"] == 100);
    CHECK(report["stop_reason"] == "reached_target");
    CHECK(report["warnings"].is_array());
    double sum = 0;
    for (const char* phase : {"load", "simplify", "map", "bake", "save"}) {
        CAPTURE(phase);
        CHECK(report["seconds"][phase] > 0);
        sum += report["seconds"][phase].get<double>();
    }
    CHECK(report["seconds"].contains("weld"));
    CHECK(report["seconds"]["total"] >= 0.99 * sum);
    CHECK(report["peak_rss_bytes"] > 1'000'000);
}

TEST_CASE("simplify --bake auto adapts to the output format and to sources without materials") {
    const Folder folder;
    faqem::Asset bare = sheet(12);
    for (faqem::Part& part : bare.parts) {
        part.face_material.clear();
        part.uvs.clear();
        part.normals.clear();
    }
    bare.materials.clear();
    bare.images.clear();
    faqem::save(bare, folder / "bare.ply");
    faqem::save(sheet(12), folder / "textured.glb");
    const auto pages = [&](const std::string& files) {
        CAPTURE(files);
        const Outcome outcome = run(folder, "simplify " + files + " --ratio 0.5 --report r.json --force");
        CHECK(outcome.code == 0);
        return nlohmann::json::parse(read(folder / "r.json"))["pages"].size();
    };
    CHECK(pages("bare.ply bare.glb --normal-map on") == 1);
    CHECK(pages("bare.ply out.ply --normal-map on") == 0);
    CHECK(pages("bare.ply out.stl --normal-map on") == 0);
    // No warning about normals: the source has none, and none are computed.
    CHECK(read(folder / "r.json").find("cannot hold vertex normals") == std::string::npos);
    CHECK(pages("bare.ply out.obj --normal-map on") == 0);
    CHECK(pages("textured.glb out.obj") == 1);
    CHECK(pages("textured.glb coloured.ply") == 0);
    CHECK_FALSE(faqem::load(folder / "coloured.ply").parts[0].colors.empty());
}

TEST_CASE("baking options determine maps and image format and the report describes the pages") {
    const ModelFolder folder("in.glb", sheet(12));
    const Outcome outcome = run(folder,
                                "simplify in.glb out.glb --texture-size 64 --normal-map on --image-format "
                                "jpeg:60 --correspondence map.bin --report r.json");
    CHECK(outcome.code == 0);
    const faqem::Asset simplified = faqem::load(folder / "out.glb");
    CHECK(simplified.materials.at(0).normal_texture);
    CHECK(!simplified.parts.at(0).tangents.empty());
    for (const faqem::Image& image : simplified.images) CHECK(image.mime_type == "image/jpeg");
    const nlohmann::json pages = nlohmann::json::parse(read(folder / "r.json"))["pages"];
    REQUIRE(pages.size() == 1);
    for (const char* key :
         {"material", "width", "height", "fill", "density", "samples", "uncertain_texels"}) {
        CAPTURE(key);
        CHECK(pages[0].contains(key));
    }
    CHECK(pages[0]["samples"]["history"] > 0);
    const std::size_t texels = pages[0]["width"].get<std::size_t>() * pages[0]["height"].get<std::size_t>();
    CHECK(fs::file_size(folder / "map.bin") == 24 + 20 * texels);
}

TEST_CASE("a missed target is an error only with --strict-target, and then no model is written") {
    const ModelFolder folder("in.glb", sheet(6, 0.2));  // 24 vertices on the boundary, which is locked
    const std::string common =
        "simplify in.glb out.glb --faces 10 --lock-boundary --bake none --report r.json ";
    CHECK(run(folder, common).code == 0);
    CHECK(nlohmann::json::parse(read(folder / "r.json"))["stop_reason"] == "no_legal_collapse");
    CHECK(face_count(faqem::load(folder / "out.glb")) > 10);

    fs::remove(folder / "out.glb");
    const Outcome strict = run(folder, common + "--strict-target --force");
    CHECK(strict.code == 5);
    CHECK(!strict.err.empty());
    CHECK(!fs::exists(folder / "out.glb"));
    CHECK(nlohmann::json::parse(read(folder / "r.json"))["faces_out"] > 10);
    CHECK(run(folder, "simplify in.glb ok.glb --ratio 1 --lock-boundary --bake none --strict-target").code ==
          0);
}

TEST_CASE("simplify --history writes the histories of all parts one after the other") {
    const Folder folder;
    faqem::Asset two = sheet(12);
    two.parts.push_back(sheet(8).parts[0]);
    for (faqem::Vec3& p : two.parts[1].positions) p[2] += 3;
    faqem::save(two, folder / "in.glb");
    const faqem::Asset loaded = faqem::load(folder / "in.glb");
    REQUIRE(loaded.parts.size() == 2);
    CHECK(run(folder, "simplify in.glb out.glb --history h.bin --bake none --quiet").code == 0);
    std::ifstream in(folder / "h.bin", std::ios::binary);
    const faqem::Asset simplified = faqem::load(folder / "out.glb");
    for (std::size_t p = 0; p < 2; ++p) {
        const faqem::CollapseHistory history = faqem::read_history(in);
        CHECK(history.triangles.size() == loaded.parts[p].triangles.size());
        CHECK(faqem::replay(history).triangles.size() == simplified.parts[p].triangles.size());
    }
    CHECK(in.peek() == std::ifstream::traits_type::eof());
}

TEST_CASE("SIGTERM and SIGINT end simplify with 8 and no temporary files") {
    for (const int number : {SIGTERM, SIGINT}) {
        const ModelFolder folder("in.glb", sheet(200));
        CHECK(signal_and_wait(start(folder, "simplify", "in.glb", "out.glb", "--quiet"), number) == 8);
        CHECK(!fs::exists(folder / "out.glb"));
        CHECK(files_in(folder) == 2);  // in.glb, lines
    }
}
