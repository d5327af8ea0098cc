// Writing of loaded and new assets as glTF.

#include "support/catch.hpp"
#include "support/gltf_builder.hpp"

using namespace faqem;
using namespace faqem::testing;

TEST_CASE("a part is unchanged by writing and reading") {
    Asset asset = new_square();
    Part& part = asset.parts[0];
    part.normals.assign(4, {0, 0, 1});
    part.tangents.assign(4, {1, 0, 0, -1});
    part.uvs = {{{0, 0}, {1, 0}, {0, 1}, {1, 1}}, {{0, 0}, {2, 0}, {0, 2}, {2, 2}}};
    part.colors = {{0, 0, 0, 1}, {1, 1, 1, 1}, {128 / 255.0f, 0, 1, 0.2f}, {1, 0, 0, 1}};
    part.joints = {{1, 0, 0, 0}, {1, 2, 0, 0}, {300, 0, 0, 0}, {4, 0, 0, 0}};
    part.weights = {{1, 0, 0, 0}, {0.5f, 0.5f, 0, 0}, {1, 0, 0, 0}, {1, 0, 0, 0}};
    part.morph_targets = {{{{0, 0, 1}, {0, 0, 2}, {0, 0, 3}, {0, 0, 4}}, {}}};
    const Asset back = load_glb(saved(asset));
    REQUIRE(back.parts.size() == 1);
    const Part& read = back.parts[0];
    CHECK(read.name == "square");
    CHECK(read.positions == part.positions);
    CHECK(read.triangles == part.triangles);
    CHECK(read.normals == part.normals);
    CHECK(read.tangents == part.tangents);
    CHECK(read.uvs == part.uvs);
    CHECK(read.joints == part.joints);
    CHECK(read.weights == part.weights);
    CHECK(read.morph_targets[0].positions == part.morph_targets[0].positions);
    for (std::size_t v = 0; v < 4; ++v)
        for (std::size_t c = 0; c < 4; ++c)
            CHECK(read.colors[v][c] == Approx(part.colors[v][c]).margin(1e-5));
}

TEST_CASE("writing a glTF file again after reading it gives the same bytes") {
    Asset asset = new_square();
    asset.parts[0].weights = {{0.1f, 0.2f, 0.3f, 0.4f}, {1, 1, 1, 0}, {3, 0, 0, 0}, {0.3f, 0.3f, 0.3f, 0}};
    asset.parts[0].joints.assign(4, {0, 1, 2, 3});
    asset.parts[0].normals = {{0.1f, 0, 3}, {1, 1, 1}, {0, 0, 1}, {0, 0, 0}};
    asset.materials.push_back({});
    asset.materials[0].base_color = {0.1f, 0.2f, 0.3f, 1};
    asset.parts[0].face_material = {0, 0};
    const std::string once = saved(asset), twice = saved(load_glb(once));
    CHECK(once == saved(asset));
    CHECK(once == twice);
}

TEST_CASE("faces are grouped by material into primitives with separate vertices") {
    Asset asset = new_square();
    asset.materials.resize(2);
    asset.materials[0].name = "first";
    asset.materials[1].name = "second";
    asset.parts[0].face_material = {1, 0};
    const Json json = json_of(saved(asset));
    const Json& primitives = json["meshes"][0]["primitives"];
    REQUIRE(primitives.size() == 2);
    CHECK(json["materials"][0]["name"] == "first");
    CHECK(primitives[0]["material"] == 1);
    CHECK(primitives[1]["material"] == 0);
    for (const Json& primitive : primitives)
        CHECK(json["accessors"][primitive["attributes"]["POSITION"].get<std::size_t>()]["count"] == 3);
}

TEST_CASE("position accessors have exact bounds") {
    Asset asset = new_square();
    asset.parts[0].positions[3] = {0.1, -7, 1e-30};
    const WrittenGltf written = write_gltf_of(asset);
    CHECK(written.positions()["min"] == Json({0.0, -7.0, 0.0}));
    CHECK(written.positions()["max"] == Json({1.0, 1.0, double{1e-30f}}));
}

TEST_CASE("indices have 16 bits up to 65535 vertices and 32 bits beyond") {
    const auto index_type = [](Index vertices) {
        Asset asset = one_part({}, {});
        Part& part = asset.parts[0];
        for (Index i = 0; i < vertices; ++i) part.positions.push_back({double(i), double(i % 2), 0});
        for (Index i = 0; i + 2 < vertices; ++i) part.triangles.push_back({i, i + 1, i + 2});
        part.face_material.assign(part.triangles.size(), no_index);
        const WrittenGltf written = write_gltf_of(asset);
        return written.accessor(written.primitive()["indices"])["componentType"].get<int>();
    };
    CHECK(index_type(65535) == u16);
    CHECK(index_type(65536) == u32);
}

TEST_CASE("a position too large for a float is an error") {
    Asset asset = new_square();
    asset.parts[0].positions[1][0] = 1e39;
    CHECK(contains(message_of<WriteError>([&] { saved(asset); }), "part 'square', vertex 1"));
}

TEST_CASE("far from the origin, new meshes keep their shape by a translation of their nodes") {
    Asset asset = new_square();
    asset.parts.push_back(asset.parts[0]);
    for (Part& part : asset.parts) {
        for (Vec3& p : part.positions) p = {1e7 + 0.1 * p[0], 0.1 * p[1] - 3, 0.1 * p[2]};
    }
    for (Vec3& p : asset.parts[1].positions) p[0] += 0.1;  // the parts share an edge
    const Json json = json_of(saved(asset));
    for (const Json& node : json["nodes"]) {
        CHECK(node["translation"][0].get<double>() == Approx(1e7).epsilon(1e-7));
        CHECK(node["translation"][1].get<double>() == Approx(-3).margin(0.1));
        CHECK(node["translation"][2] == 0);
    }
    const Asset back = load_glb(saved(asset));
    const std::vector<Instance> where = instances(back);
    REQUIRE(where.size() == 2);
    for (std::size_t i = 0; i < 2; ++i) {
        for (std::size_t v = 0; v < 4; ++v) {
            for (std::size_t k = 0; k < 3; ++k) {
                const double moved = back.parts[i].positions[v][k] + where[i].transform[12 + k];
                CHECK(moved == Approx(asset.parts[i].positions[v][k]).epsilon(0).margin(2e-8));
            }
        }
    }
    CHECK(back.parts[0].positions[1] == back.parts[1].positions[0]);
    CHECK(back.parts[0].positions[3] == back.parts[1].positions[2]);
    CHECK(saved(back) == saved(load_glb(saved(back))));
}

TEST_CASE("near the origin and beyond the range of float, nodes of new meshes are not translated") {
    Asset asset = new_square();
    for (Vec3& p : asset.parts[0].positions) p[0] += 3;
    CHECK_FALSE(json_of(saved(asset))["nodes"][0].contains("translation"));
    for (Vec3& p : asset.parts[0].positions) p = {1e300, 0, p[2]};
    CHECK(contains(message_of<WriteError>([&] { saved(asset); }), "too large"));
    for (Vec3& p : asset.parts[0].positions) p = {1e7, 1e7, 1e7};
    CHECK_FALSE(json_of(saved(asset))["nodes"][0].contains("translation"));
}

TEST_CASE("faces that become degenerate in float precision are counted") {
    // Vertices 1 and 2 differ by 1e-50, so the first face becomes degenerate in float precision.
    Asset asset = one_part({{0, 0, 0}, {1, 0, 0}, {1, 1e-50, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}});
    CHECK(write_gltf_of(asset).warns("1 face became degenerate"));
    asset.parts[0].positions[2][1] = 1e-3;
    CHECK(write_gltf_of(asset).warnings.empty());
}

TEST_CASE("zero positions without a buffer view can be read again after writing") {
    GltfBuilder builder = square_gltf();
    const auto zeros = builder.add("accessors", {{"componentType", f32}, {"type", "VEC3"}, {"count", 4}});
    builder.json["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", zeros}}}, {"mode", 0}});
    Asset asset = load_glb(builder);
    asset.parts[0].triangles.clear();
    asset.parts[0].face_material.clear();
    const WrittenGltf written = write_gltf_of(asset);
    REQUIRE(written.json["accessors"].size() == 1);
    CHECK(written.json["accessors"][0]["count"] == 4);
    CHECK(written.json["accessors"][0]["max"] == Json::parse("[0, 0, 0]"));
    CHECK(written.json["buffers"][0]["byteLength"] == 48);
    CHECK_NOTHROW(load_glb(written.glb));
}

TEST_CASE("meshes without an instance are left out with a warning in formats without a scene") {
    GltfBuilder builder = square_gltf();
    builder.json["scenes"][0].erase("nodes");
    const Asset asset = load_glb(builder);
    const TemporaryFolder folder;
    CHECK(any_contains(save(asset, folder / "out.ply"),
                       "no node of the scene references 1 mesh, which was left out"));
    CHECK_FALSE(any_contains(save(asset, folder / "out.glb"), "left out"));
    CHECK_FALSE(any_contains(save(load_glb(square_gltf()), folder / "shown.ply"), "no node"));
}

TEST_CASE("a mesh without primitives is removed with the references to it") {
    GltfBuilder builder = square_gltf();
    builder.mesh({{"attributes", {{"POSITION", 0}}}, {"indices", 1}});
    builder.json["nodes"][0]["name"] = "empty now";
    Asset asset = load_glb(builder);
    asset.parts[0].triangles.clear();
    asset.parts[0].face_material.clear();
    const WrittenGltf written = write_gltf_of(asset);
    CHECK(written.warns("has no primitives left"));
    CHECK(written.json["meshes"].size() == 1);
    CHECK(written.json["nodes"].size() == 2);
    CHECK_FALSE(written.json["nodes"][0].contains("mesh"));
    CHECK(written.json["nodes"][1]["mesh"] == 0);
}

TEST_CASE("zero normals are computed from the faces unless all normals are zero") {
    Asset asset = new_square();
    asset.parts[0].normals = {{0, 0, 0}, {0, 0, 2}, {0, 0, 1}, {0, 0, 1}};
    CHECK(load_glb(saved(asset)).parts[0].normals == std::vector<Vec3f>(4, Vec3f{0, 0, 1}));
    asset.parts[0].normals.assign(4, {0, 0, 0});
    CHECK(load_glb(saved(asset)).parts[0].normals.empty());
}

TEST_CASE("joint weights are normalised and duplicate joints are merged") {
    Asset asset = new_square();
    asset.parts[0].joints.assign(4, {5, 5, 2, 9});
    asset.parts[0].weights.assign(4, {0.5f, 0.5f, 1, 0});
    const Asset back = load_glb(saved(asset));
    CHECK(back.parts[0].weights[0] == Vec4f{0.5f, 0, 0.5f, 0});
    CHECK(back.parts[0].joints[0] == std::array<std::uint16_t, 4>{5, 0, 2, 0});
}

TEST_CASE("morph weights and their animations are removed with the morph targets") {
    GltfBuilder builder = square_gltf();
    const auto delta = builder.accessor(std::vector<Vec3f>(4, Vec3f{0, 0, 1}), f32, "VEC3");
    const auto times = builder.accessor(std::vector<float>{0, 1}, f32, "SCALAR");
    builder.primitive()["targets"] = Json::array({{{"POSITION", delta}}});
    builder.json["meshes"][0]["weights"] = {0.5};
    builder.json["nodes"][0]["weights"] = {0.25};
    builder.json["animations"] = {
        {{"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}}},
         {"samplers", {{{"input", times}, {"output", times}}}}}};
    Asset asset = load_glb(builder);
    Json json = json_of(saved(asset));
    CHECK(json["meshes"][0]["weights"] == Json({0.5}));
    CHECK(json["nodes"][0]["weights"] == Json({0.25}));
    CHECK(json["animations"].size() == 1);
    asset.parts[0].morph_targets.clear();
    json = json_of(saved(asset));
    CHECK_FALSE(json["meshes"][0].contains("weights"));
    CHECK_FALSE(json["nodes"][0].contains("weights"));
    CHECK_FALSE(json.contains("animations"));
}

TEST_CASE("equal geometry is stored once") {
    Asset asset = new_square();
    asset.parts.push_back(asset.parts[0]);
    asset.materials.resize(2);
    asset.materials[1].name = "other";
    asset.parts[0].face_material = {0, 0};
    asset.parts[1].face_material = {1, 1};
    const Json json = json_of(saved(asset));
    CHECK(json["meshes"].size() == 2);
    CHECK(json["accessors"].size() == 2);
}

TEST_CASE("a .gltf file is written with its buffer and images, or not at all if one exists") {
    Asset asset = new_square();
    asset.images = {small_png()};
    asset.materials.resize(1);
    asset.materials[0].emissive_texture.image = 0;
    asset.parts[0].face_material = {0, 0};
    const TemporaryFolder folder;
    save(asset, folder / "a b.gltf");
    CHECK(Json::parse(get(folder / "a b.gltf"))["images"][0]["uri"] == "a%20b_0.png");
    CHECK(get(folder / "a b_0.png").size() == asset.images[0].encoded.size());
    const Asset back = load(folder / "a b.gltf");
    CHECK(back.parts[0].positions == asset.parts[0].positions);
    CHECK(back.images[0].encoded == asset.images[0].encoded);

    put(folder / "c.bin", "mine");
    CHECK_THROWS_AS(save(asset, folder / "c.gltf"), WriteError);
    CHECK(get(folder / "c.bin") == "mine");
    CHECK_FALSE(std::filesystem::exists(folder / "c.gltf"));
    CHECK_FALSE(std::filesystem::exists(folder / "c_0.png"));
}

TEST_CASE("a part added to a loaded scene gets a new node") {
    Asset asset = load_glb(square_gltf());
    asset.parts.push_back(new_square().parts[0]);
    const Json json = json_of(saved(asset));
    CHECK(json["meshes"].size() == 2);
    CHECK(json["nodes"].size() == 2);
    CHECK(json["scenes"][0]["nodes"] == Json({0, 1}));
    CHECK(json["nodes"][1]["name"] == "square");
}

TEST_CASE("primitives have the names of the groups of their faces, if the mesh has several") {
    Asset asset = new_square();
    asset.materials.resize(2);
    Part& part = asset.parts[0];
    part.face_material = {0, 1};
    part.face_group = {1, 0};
    part.group_names = {"b", "a"};
    const Json json = json_of(saved(asset));
    REQUIRE(json["meshes"][0]["primitives"].size() == 2);
    CHECK(json["meshes"][0]["primitives"][0]["extras"] == Json({{"groups", {"a"}}}));
    CHECK(json["meshes"][0]["primitives"][1]["extras"] == Json({{"groups", {"b"}}}));
}
