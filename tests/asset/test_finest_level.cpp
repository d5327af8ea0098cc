#include "asset/finest_level.hpp"

#include "asset/gltf/source_document.hpp"
#include "faqem/save_levels.hpp"
#include "support/catch.hpp"
#include "support/gltf_builder.hpp"

using namespace faqem;
using namespace faqem::testing;

namespace {

/// Adds a triangle as a mesh with a material of its own colour. \return the mesh
std::size_t add_mesh(GltfBuilder& builder, float size) {
    const auto positions =
        builder.accessor(std::vector<Vec3f>{{0, 0, 0}, {size, 0, 0}, {0, size, 0}}, f32, "VEC3");
    const auto material =
        builder.add("materials", {{"pbrMetallicRoughness", {{"metallicFactor", size / 10}}}});
    const Json primitive = {{"attributes", {{"POSITION", positions}}}, {"material", material}};
    return builder.add("meshes", {{"primitives", Json::array({primitive})}});
}

/// A chain of three levels, with meshes 0 to 2 at nodes 0 to 2, of which the scene has the first.
GltfBuilder chain() {
    GltfBuilder builder;
    for (const float size : {3.0f, 2.0f, 1.0f})
        builder.add("nodes",
                    {{"mesh", add_mesh(builder, size)}, {"name", "size " + std::to_string(int(size))}});
    builder.json["scenes"] = Json::parse(R"([{"nodes":[0]}])");
    builder.json["nodes"][0]["extensions"]["MSFT_lod"]["ids"] = {1, 2};
    builder.json["nodes"][0]["extras"]["MSFT_screencoverage"] = {0.5, 0.2, 0.01};
    return builder;
}

Asset finest_of(const GltfBuilder& builder) {
    Asset asset = load_glb(builder);
    detail::keep_finest_level(asset);
    return asset;
}

std::string warning_of(const GltfBuilder& builder) {
    Asset asset = load_glb(builder);
    return detail::keep_finest_level(asset);
}

/// What is written of the finest level.
Json finest_json(const GltfBuilder& builder) {
    const WrittenGltf written = write_gltf_of(finest_of(builder));
    for (const std::string& warning : written.warnings)
        CHECK(warning.find("unknown and was passed through") != std::string::npos);
    return written.json;
}

}  // namespace

TEST_CASE("of nodes with levels the finest one is kept, without a trace of the others") {
    const Asset asset = finest_of(chain());
    REQUIRE(asset.parts.size() == 3);
    CHECK(asset.parts[0].triangles.size() == 1);
    CHECK(asset.parts[1].triangles.empty());
    CHECK(asset.parts[2].positions.empty());
    CHECK(asset.materials.size() == 1);
    CHECK(instances(asset).size() == 1);
    const Json json = finest_json(chain());
    CHECK(json["nodes"] == Json::array({{{"mesh", 0}, {"name", "size 3"}}}));
    CHECK(json["meshes"].size() == 1);
    CHECK(json["materials"].size() == 1);
    CHECK_FALSE(json.contains("extensionsUsed"));
    CHECK(warning_of(chain()) ==
          "2 coarser levels of 1 node (MSFT_lod) left out: the finest one is simplified");
}

TEST_CASE("an asset without levels is left as it is") {
    CHECK_FALSE(detail::finest_level(load_glb(square_gltf())));
    CHECK_FALSE(detail::finest_level(new_square()));
}

TEST_CASE("load and save keep the levels of nodes and materials") {
    GltfBuilder builder = chain();
    builder.json["materials"][2]["extensions"]["MSFT_lod"]["ids"] = {0};
    builder.add("materials", {{"name", "far"}});
    builder.json["materials"][0]["extensions"]["MSFT_lod"]["ids"] = {3, 1};
    const Json json = through(builder);
    CHECK(json["meshes"].size() == 3);
    CHECK(json["nodes"][0]["extensions"]["MSFT_lod"]["ids"] == Json({1, 2}));
    REQUIRE(json["materials"].size() == 4);
    const Json& of_first =
        json["materials"][json["meshes"][0]["primitives"][0]["material"].get<std::size_t>()];
    const Json& ids = of_first["extensions"]["MSFT_lod"]["ids"];
    REQUIRE(ids.size() == 2);
    CHECK(json["materials"][ids[0].get<std::size_t>()]["name"] == "far");
    CHECK(ids[1] == json["meshes"][1]["primitives"][0]["material"]);
}

TEST_CASE("coarser levels of materials are left out where no primitive has them") {
    GltfBuilder builder = square_gltf();
    for (const std::uint8_t shade : {10, 20, 30}) {
        add_texture(builder, shade);
        builder.add("materials",
                    {{"pbrMetallicRoughness",
                      {{"baseColorTexture", {{"index", builder.json["textures"].size() - 1}}}}}});
    }
    builder.json["materials"][0]["extensions"]["MSFT_lod"]["ids"] = {1, 2};
    builder.json["materials"][0]["extras"] = {{"MSFT_screencoverage", {0.5, 0.2, 0.0}}, {"own", 1}};
    builder.json["meshes"][0]["primitives"][0]["material"] = 0;
    CHECK(warning_of(builder) ==
          "2 coarser levels of 1 material (MSFT_lod) left out: the finest one is simplified");
    const Asset asset = finest_of(builder);
    CHECK(asset.materials.size() == 1);
    CHECK(asset.images.size() == 1);
    const Json json = finest_json(builder);
    REQUIRE(json["materials"].size() == 1);
    CHECK_FALSE(json["materials"][0].contains("extensions"));
    CHECK(json["materials"][0]["extras"] == Json({{"own", 1}}));
    CHECK(json["images"].size() == 1);

    builder.json["meshes"][0]["primitives"].push_back(builder.json["meshes"][0]["primitives"][0]);
    builder.json["meshes"][0]["primitives"][1]["material"] = 2;
    CHECK(finest_of(builder).materials.size() == 2);
}

TEST_CASE("levels of nodes and of materials are counted apart") {
    GltfBuilder builder = chain();
    builder.json["materials"][0]["extensions"]["MSFT_lod"]["ids"] = {1};
    CHECK(warning_of(builder) ==
          "2 coarser levels of 1 node and 1 coarser level of 1 material (MSFT_lod) left "
          "out: the finest one is simplified");
}

TEST_CASE("the descendants of a coarser level are left out, and other nodes are renumbered") {
    GltfBuilder builder;
    for (const float size : {3.0f, 2.0f, 1.0f}) add_mesh(builder, size);
    builder.json["nodes"] = Json::parse(R"([
        {"name":"coarse","children":[1]}, {"name":"coarse part","mesh":1},
        {"name":"fine","children":[3],"extensions":{"MSFT_lod":{"ids":[0]}}}, {"name":"fine part","mesh":0},
        {"name":"other","mesh":2,"children":[5]}, {"name":"lamp"}])");
    builder.json["scenes"] = Json::parse(R"([{"nodes":[2,0,4]},{"nodes":[0]}])");
    const auto times = builder.accessor(std::vector<float>{0, 1}, f32, "SCALAR");
    const auto moves = builder.accessor(std::vector<Vec3f>{{1, 2, 3}, {4, 5, 6}}, f32, "VEC3");
    const auto turns = builder.accessor(std::vector<Vec3f>{{7, 2, 3}, {4, 5, 6}}, f32, "VEC3");
    builder.json["animations"] = Json::parse(R"([{"channels":[
        {"sampler":0,"target":{"node":1,"path":"translation"}},
        {"sampler":1,"target":{"node":5,"path":"translation"}},
        {"sampler":1,"target":{"path":"pointer","extensions":{"KHR_animation_pointer":{
            "pointer":"/nodes/4/translation"}}}},
        {"sampler":1,"target":{"path":"pointer","extensions":{"KHR_animation_pointer":{
            "pointer":"/nodes/0/translation"}}}}]},
        {"channels":[{"sampler":0,"target":{"node":0,"path":"translation"}}]}])");
    for (Json& animation : builder.json["animations"])
        animation["samplers"] = {{{"input", times}, {"output", moves}},
                                 {{"input", times}, {"output", turns}}};
    const Json json = finest_json(builder);
    REQUIRE(json["nodes"].size() == 4);
    CHECK(json["nodes"][0] == Json::parse(R"({"name":"fine","children":[1]})"));
    CHECK(json["nodes"][1]["name"] == "fine part");
    CHECK(json["nodes"][2]["children"] == Json({3}));
    CHECK(json["nodes"][3]["name"] == "lamp");
    CHECK(json["scenes"][0]["nodes"] == Json({0, 2}));
    CHECK(json["scenes"][1] == Json::object());
    REQUIRE(json["animations"].size() == 1);
    const Json& animation = json["animations"][0];
    REQUIRE(animation["channels"].size() == 2);
    CHECK(animation["channels"][0]["target"]["node"] == 3);
    CHECK(animation["channels"][0]["sampler"] == 0);
    CHECK(animation["channels"][1]["target"]["extensions"]["KHR_animation_pointer"]["pointer"] ==
          "/nodes/2/translation");
    CHECK(animation["samplers"].size() == 1);
    CHECK(json["meshes"].size() == 2);
}

TEST_CASE("nodes keep their numbers beside extensions that are not known") {
    GltfBuilder builder = chain();
    builder.json["nodes"].insert(builder.json["nodes"].begin() + 3, Json{{"name", "target"}});
    std::swap(builder.json["nodes"][2], builder.json["nodes"][3]);
    builder.json["nodes"][0]["extensions"]["MSFT_lod"]["ids"] = {1, 3};
    builder.json["nodes"][0]["children"] = {2};
    builder.json["nodes"][0]["extensions"]["EXT_own"] = {{"node", 2}};
    const Json json = finest_json(builder);
    REQUIRE(json["nodes"].size() == 4);
    CHECK(json["nodes"][1] == Json::object());
    CHECK(json["nodes"][2]["name"] == "target");
    CHECK(json["nodes"][3] == Json::object());
    CHECK(json["meshes"].size() == 1);
}

TEST_CASE("joints of the finest level that are nodes of a coarser one stay, and skins of coarser ones go") {
    GltfBuilder builder = chain();
    const auto joints = builder.accessor(std::vector<std::array<std::uint8_t, 4>>(3), u8, "VEC4");
    const auto weights = builder.accessor(std::vector<Vec4f>(3, Vec4f{1, 0, 0, 0}), f32, "VEC4");
    for (Json& mesh : builder.json["meshes"]) {
        mesh["primitives"][0]["attributes"]["JOINTS_0"] = joints;
        mesh["primitives"][0]["attributes"]["WEIGHTS_0"] = weights;
    }
    builder.json["nodes"].push_back({{"name", "own joint"}});
    builder.json["nodes"].push_back({{"name", "shared joint"}, {"mesh", 1}, {"translation", {1, 2, 3}}});
    builder.json["nodes"][1]["children"] = {3, 4};
    builder.json["nodes"][0]["skin"] = 1;
    builder.json["nodes"][1]["skin"] = 0;
    builder.json["skins"] = Json::parse(R"([{"joints":[3]},{"joints":[4],"skeleton":4}])");
    const Json json = finest_json(builder);
    REQUIRE(json["nodes"].size() == 3);
    CHECK(json["nodes"][0]["skin"] == 0);
    CHECK(json["nodes"][1] == Json::parse(R"({"name":"size 2","children":[2]})"));
    CHECK(json["nodes"][2]["name"] == "shared joint");
    CHECK_FALSE(json["nodes"][2].contains("mesh"));
    CHECK(json["nodes"][2]["translation"] == Json({1, 2, 3}));
    REQUIRE(json["skins"].size() == 1);
    CHECK(json["skins"][0]["joints"] == Json({2}));
    CHECK(json["skins"][0]["skeleton"] == 2);
}

TEST_CASE("a mesh of both levels stays, levels of levels are left out, and no node is its own level") {
    GltfBuilder shared = chain();
    shared.json["nodes"][1]["mesh"] = 0;
    CHECK(finest_of(shared).parts[0].triangles.size() == 1);

    GltfBuilder linked = chain();
    linked.json["nodes"][0]["extensions"]["MSFT_lod"]["ids"] = {1};
    linked.json["nodes"][1]["extensions"]["MSFT_lod"]["ids"] = {2, 0};
    CHECK(finest_json(linked)["nodes"].size() == 1);

    GltfBuilder own = chain();
    own.json["nodes"][2]["children"] = {0};
    own.json["scenes"][0]["nodes"] = {2};
    own.json["nodes"][0]["extensions"]["MSFT_lod"]["ids"] = {0, 2, 1};
    const Json json = finest_json(own);
    CHECK(json["nodes"].size() == 2);
    CHECK(json["meshes"].size() == 2);

    GltfBuilder none = chain();
    none.json["nodes"][0]["extensions"]["MSFT_lod"]["ids"] = Json::array();
    CHECK(warning_of(none).empty());
    CHECK_FALSE(finest_json(none).contains("extensionsUsed"));
}

TEST_CASE("the finest level of a chain that was saved is that of its first asset") {
    const Asset first = load_glb(square_gltf());
    const TemporaryFolder folder;
    save_levels({{first, {1}}, {first, {0.5}}}, folder / "chain.glb");
    Asset chain = load(folder / "chain.glb");
    CHECK(chain.parts.size() == 2);
    detail::keep_finest_level(chain);
    CHECK(saved(chain) == saved(first));
    save_levels({{load(folder / "chain.glb"), {1, 1}}, {chain, {0.5, 0.5}}}, folder / "again.glb");
    CHECK(json_of(get(folder / "again.glb")) == json_of(get(folder / "chain.glb")));
}

TEST_CASE("levels may be required, and refer to nodes and materials that exist") {
    GltfBuilder builder = chain();
    builder.json["extensionsRequired"] = {"MSFT_lod"};
    CHECK(load_glb(builder).parts.size() == 3);
    builder.json["nodes"][0]["extensions"]["MSFT_lod"]["ids"] = {1, 3};
    CHECK(refusal(builder).find("/nodes/0/extensions/MSFT_lod/ids/1") != std::string::npos);
    builder.json["nodes"][0]["extensions"]["MSFT_lod"]["ids"] = {{"1", 2}};
    CHECK(refusal(builder).find("/nodes/0/extensions/MSFT_lod/ids") != std::string::npos);
    builder.json["nodes"][0].erase("extensions");
    builder.json["materials"][1]["extensions"]["MSFT_lod"]["ids"] = {-1};
    CHECK(refusal(builder).find("/materials/1/extensions/MSFT_lod/ids/0") != std::string::npos);
}
