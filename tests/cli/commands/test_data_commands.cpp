#include <nlohmann/json.hpp>

#include "support/catch.hpp"
#include "support/cli_support.hpp"

using namespace tool_test;

TEST_CASE("info prints counts and measures of meshes and images") {
    const ModelFolder folder("in.glb", sheet(5, 0));
    const Outcome outcome = run(folder, "info in.glb --json");
    REQUIRE(outcome.code == 0);
    const nlohmann::json info = nlohmann::json::parse(outcome.out);
    REQUIRE(info["parts"].size() == 1);
    const nlohmann::json& part = info["parts"][0];
    CHECK(part["name"] == "sheet");
    CHECK(part["faces"] == 50);
    CHECK(part["vertices"] == 36);
    CHECK(part["components"] == 1);
    CHECK(part["boundary_edges"] == 20);
    CHECK(part["nonmanifold_edges"] == 0);
    CHECK(part["uv_sets"] == 1);
    CHECK(part["normals"] == false);
    CHECK(info["precision"] == "float");
    CHECK(part["area"].get<double>() == Approx(4));
    CHECK(part["box_min"] == nlohmann::json({-1.0, -1.0, 0.0}));
    CHECK(info["total"]["faces"] == 50);
    CHECK(info["materials"] == 1);
    CHECK(info["instances"] == 1);
    REQUIRE(info["images"].size() == 1);
    CHECK(info["images"][0]["width"] == 64);
    CHECK(info["images"][0]["height"] == 32);
    CHECK(info["images"][0]["mime_type"] == "image/png");

    const std::string text = run(folder, "info in.glb").out;
    for (const char* word : {"50 faces", "36 vertices", "20 boundary edges", "64 x 32", "area 4"}) {
        CAPTURE(word);
        CHECK(text.find(word) != std::string::npos);
    }
}

TEST_CASE("info lists what was not understood, which --strict accepts") {
    const Folder folder;
    write(folder / "in.mtl", "newmtl m\nKs 1 1 1\nKd 1 0 0\nillum 2\n");
    write(folder / "in.obj", "mtllib in.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nusemtl m\nf 1 2 3 4\n");
    const Outcome outcome = run(folder, "info in.obj --json");
    REQUIRE(outcome.code == 0);
    const nlohmann::json info = nlohmann::json::parse(outcome.out);
    CHECK(info["not_understood"] == nlohmann::json({"'Ks': 1 statement", "'illum': 1 statement"}));
    CHECK(info["warnings"].empty());
    CHECK(run(folder, "info in.obj").out.find("not understood: 'Ks': 1 statement\n") != std::string::npos);
    CHECK(run(folder, "simplify in.obj out.glb --strict").code == 0);
}

TEST_CASE("compare --json prints two-sided distances and the settings of the measurement") {
    const Folder folder;
    faqem::Asset a = sheet(5, 0), b = sheet(7, 0);
    for (faqem::Vec3& p : b.parts[0].positions) p[2] += 0.5;
    faqem::save(a, folder / "a.glb");
    faqem::save(b, folder / "b.stl");
    const Outcome outcome = run(folder, "compare --json a.glb b.stl --samples 1000 --seed 7 --threads 2");
    REQUIRE(outcome.code == 0);
    const nlohmann::json result = nlohmann::json::parse(outcome.out);
    CHECK(result["hausdorff"].get<double>() == Approx(0.5));
    CHECK(result["chamfer"].get<double>() == Approx(0.5));
    CHECK(result["diagonal"].get<double>() == Approx(std::sqrt(8.0)));
    CHECK(result["hausdorff_rel"].get<double>() == Approx(0.5 / std::sqrt(8.0)));
    const double bound = result["hausdorff_bound"].get<double>();
    CHECK(bound >= result["hausdorff"].get<double>());
    CHECK(bound <= 0.5 * 1.01 + 1e-7);
    CHECK(result["hausdorff_bound_rel"].get<double>() == Approx(bound / std::sqrt(8.0)));
    CHECK(result["b_to_a"]["max_bound"].get<double>() >= result["b_to_a"]["max"].get<double>());
    CHECK(result["tolerance"] == 0.01);
    CHECK(result["chamfer_rel"].get<double>() == Approx(0.5 / 8));
    CHECK(result["a_to_b"]["mean"].get<double>() == Approx(0.5));
    CHECK(result["info_a"]["faces"] == 50);
    CHECK(result["info_b"]["faces"] == 98);
    CHECK(result["samples"] == 1000);
    CHECK(result["seed"] == 7);
    CHECK(run(folder, "compare --json a.glb b.stl --samples 1000 --seed 7 --threads 1").out == outcome.out);
}

TEST_CASE("compare --json measures colour differences if both models have colours") {
    const Folder folder;
    const faqem::Asset sheet = tool_test::sheet(5, 0);
    faqem::Asset blue = sheet;
    blue.materials[0].base_color_texture = {};
    blue.materials[0].base_color = {0, 0, 1, 1};
    faqem::save(sheet, folder / "sheet.glb");
    faqem::save(blue, folder / "blue.glb");
    faqem::save(sheet, folder / "bare.stl");

    // The red half of the sheet differs from blue by 1 in two of three channels.
    const nlohmann::json result =
        nlohmann::json::parse(run(folder, "compare --json sheet.glb blue.glb --samples 10000").out);
    const nlohmann::json& colors = result["colors"];
    CHECK(colors["psnr"].get<double>() == Approx(10 * std::log10(3)).epsilon(0.02));
    CHECK(colors["a_to_b"]["outliers"].get<double>() == Approx(0.5).epsilon(0.04));
    CHECK(colors["b_to_a"]["unmatched"] == 0);

    const nlohmann::json same =
        nlohmann::json::parse(run(folder, "compare --json blue.glb blue.glb --samples 1000").out);
    CHECK(same["colors"]["rmse"] == 0);
    CHECK(same["colors"]["psnr"].is_null());
    CHECK(nlohmann::json::parse(run(folder, "compare --json sheet.glb bare.stl --samples 1000").out)["colors"]
              .is_null());
}

TEST_CASE("compare --json measures distances even if an image cannot be read") {
    const Folder folder;
    faqem::Asset asset = sheet(5, 0);
    asset.images[0].encoded.resize(60);
    faqem::save(asset, folder / "broken.glb");
    const Outcome outcome = run(folder, "compare --json broken.glb broken.glb --samples 1000");
    REQUIRE(outcome.code == 0);
    CHECK(nlohmann::json::parse(outcome.out)["colors"].is_null());
    CHECK(nlohmann::json::parse(outcome.out)["hausdorff"].get<double>() < 1e-12);
    CHECK(outcome.err.find("warning: colours are not compared") != std::string::npos);
}

TEST_CASE("compare --json transforms instances by their nodes") {
    const Folder folder;
    // Two instances of one triangle; the second is translated by 10 and mirrored.
    write(folder / "two.gltf", R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
        "nodes": [{"mesh": 0}, {"mesh": 0, "translation": [10, 0, 0], "scale": [-1, 1, 1]}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                       "min": [0, 0, 0], "max": [1, 1, 0]}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"byteLength": 36,
            "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})");
    write(folder / "two.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 10 0 0\nv 9 0 0\nv 10 1 0\nf 1 2 3\nf 4 6 5\n");
    const Outcome outcome = run(folder, "compare --json two.gltf two.obj --samples 1000");
    REQUIRE(outcome.code == 0);
    const nlohmann::json result = nlohmann::json::parse(outcome.out);
    CHECK(result["hausdorff"].get<double>() < 1e-6);
    CHECK(result["mean_normal_degrees"].get<double>() < 1e-3);
    CHECK(result["info_a"]["faces"] == 2);

    const nlohmann::json info = nlohmann::json::parse(run(folder, "info two.gltf --json").out);
    CHECK(info["parts"].size() == 1);
    CHECK(info["parts"][0]["instances"] == 2);
    CHECK(info["instances"] == 2);
    CHECK(info["total"]["faces"] == 2);
    CHECK(info["total"]["box_max"][0] == 10.0);
}
