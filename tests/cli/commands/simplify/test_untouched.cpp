// Meshes that have no more faces than asked for are left as they are.

#include <nlohmann/json.hpp>
#include <string>

#include "support/catch.hpp"
#include "support/cli_support.hpp"

using namespace tool_test;

namespace {

/// The number of meshes that `faqem simplify IN OUT --faces 20000 OPTIONS` leaves as they are.
std::size_t untouched(const Folder& folder, const std::string& in_and_out, const std::string& options = "") {
    const Outcome outcome =
        run(folder, "simplify " + in_and_out + " --faces 20000 --force --report r.json " + options);
    CHECK(outcome.code == 0);
    const nlohmann::json report = nlohmann::json::parse(read(folder / "r.json"));
    const std::size_t count = report.at("untouched_parts").size();
    const bool is_said = outcome.out.find("left as they are: 1 mesh\n") != std::string::npos;
    CHECK(is_said == (count == 1));
    CHECK(report["faces_out"] == report["faces_in"]);
    return count;
}

}  // namespace

TEST_CASE("untouched: options for images and normals apply where they differ from their defaults") {
    const ModelFolder folder("hill.glb", sheet(8));
    for (const std::string options :
         {"--texture-size 128", "--image-format png", "--image-format jpeg", "--bake atlas",
          "--normal-map off", "--normals flat", "--correspondence c.bin"})
        CHECK(untouched(folder, "hill.glb out.glb", options) == 0);
    for (const std::string options : {"--texture-size 2048", "--image-format source", "--bake auto",
                                      "--bake keep --texture-size 128", "--history h.bin", "--preset best"})
        CHECK(untouched(folder, "hill.glb out.glb", options) == 1);
    write(folder / "profile.json", R"({"faqem-profile": 1, "texture-size": 1024})");
    CHECK(untouched(folder, "hill.glb out.glb", "--config profile.json") == 0);
}

TEST_CASE("untouched: other formats keep what they can store") {
    const ModelFolder folder("hill.glb", sheet(8));
    faqem::save(sheet(8), folder / "hill.obj");
    CHECK(untouched(folder, "hill.glb out.obj") == 0);  // glTF's materials do not fit into OBJ
    CHECK(untouched(folder, "hill.obj out.obj") == 1);
    CHECK(read(folder / "out_0.png") == read(folder / "hill_0.png"));
    CHECK(untouched(folder, "hill.obj out.glb") == 1);
    CHECK(untouched(folder, "hill.obj out.ply") == 0);
    CHECK(untouched(folder, "hill.obj out.stl") == 0);
    faqem::Asset bare = sheet(8);
    bare.materials.clear();
    bare.images.clear();
    bare.parts[0].face_material.assign(bare.parts[0].triangles.size(), faqem::no_index);
    faqem::save(bare, folder / "bare.obj");
    CHECK(untouched(folder, "bare.obj out.obj") == 1);
    CHECK(faqem::load(folder / "out.obj").parts[0].uvs == faqem::load(folder / "bare.obj").parts[0].uvs);
}
