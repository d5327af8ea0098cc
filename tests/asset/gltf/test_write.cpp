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
    const Json json = json_of(saved(asset));
    const Json& positions =
        json["accessors"][json["meshes"][0]["primitives"][0]["attributes"]["POSITION"].get<std::size_t>()];
    CHECK(positions["min"] == Json({0.0, -7.0, 0.0}));
    CHECK(positions["max"] == Json({1.0, 1.0, double{1e-30f}}));
}

TEST_CASE("indices have 16 bits up to 65535 vertices and 32 bits beyond") {
    const auto index_type = [](Index vertices) {
        Asset asset = one_part({}, {});
        Part& part = asset.parts[0];
        for (Index i = 0; i < vertices; ++i) part.positions.push_back({double(i), double(i % 2), 0});
        for (Index i = 0; i + 2 < vertices; ++i) part.triangles.push_back({i, i + 1, i + 2});
        part.face_material.assign(part.triangles.size(), no_index);
        const Json json = json_of(saved(asset));
        return json["accessors"][json["meshes"][0]["primitives"][0]["indices"].get<std::size_t>()]
                   ["componentType"]
                       .get<int>();
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
    const TemporaryFolder folder;
    CHECK(any_contains(save(asset, folder / "a.glb"), "1 face became degenerate"));
    asset.parts[0].positions[2][1] = 1e-3;
    CHECK(save(asset, folder / "b.glb").empty());
}

TEST_CASE("the scene graph and other objects of the source are preserved") {
    GltfBuilder builder = square_gltf();
    builder.json["asset"] = Json::parse(
        R"({"version":"2.0","generator":"someone","copyright":"(c) me","extras":{"big":1234567890123456789}})");
    builder.json["nodes"] = Json::parse(R"([
        {"name":"root","children":[1,2],"translation":[1,2,3],"extras":{"note":[1,{"a":null}]}},
        {"name":"seen","mesh":0,"matrix":[2,0,0,0,0,2,0,0,0,0,2,0,5,6,7,1],"extensions":{"ACME_tag":{"id":"x"}}},
        {"name":"eye","camera":0,"extensions":{"KHR_lights_punctual":{"light":0}}}])");
    builder.json["scenes"] = Json::parse(R"([{"nodes":[0],"name":"s","extras":7}])");
    builder.json["scene"] = 0;
    builder.json["cameras"] =
        Json::parse(R"([{"type":"perspective","perspective":{"yfov":0.7,"znear":0.01},"name":"c"}])");
    builder.json["extensions"] =
        Json::parse(R"({"KHR_lights_punctual":{"lights":[{"type":"spot","spot":{"innerConeAngle":0.1}}]}})");
    builder.json["extensionsUsed"] = {"KHR_lights_punctual", "ACME_tag", "KHR_materials_sheen"};
    builder.json["extras"] = {{"huge", std::uint64_t{1} << 40}};
    builder.json["meshes"][0]["extras"] = {{"kept", true}};
    const Json json = through(builder);
    for (const char* key : {"nodes", "scenes", "scene", "cameras", "extensions", "extras"}) {
        INFO(key);
        CHECK(json[key] == builder.json[key]);
    }
    CHECK(json["asset"]["copyright"] == "(c) me");
    CHECK(json["asset"]["extras"]["big"] == 1234567890123456789);
    CHECK(json["asset"]["generator"].get<std::string>().substr(0, 6) == "faqem ");
    CHECK(json["meshes"][0]["extras"] == Json({{"kept", true}}));
    CHECK(json["extensionsUsed"] == Json({"ACME_tag", "KHR_lights_punctual"}));
}

TEST_CASE("animations and skins keep their data, also of sparse accessors") {
    GltfBuilder builder = square_gltf();
    const auto times = builder.accessor(std::vector<float>{0, 1, 2}, f32, "SCALAR");
    const auto moves = builder.accessor(std::vector<Vec3f>{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}}, f32, "VEC3");
    const auto index_view = builder.view(std::vector<std::uint8_t>{1});
    const auto value = builder.view(std::vector<Vec3f>{{40, 50, 60}});
    builder.json["accessors"][moves]["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", index_view}, {"componentType", u8}}},
        {"values", {{"bufferView", value}}}};
    const auto matrices = builder.accessor(
        std::vector<std::array<float, 16>>{{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 9, 8, 7, 1}}, f32, "MAT4");
    builder.json["animations"] = {
        {{"name", "walk"},
         {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}},
         {"samplers", {{{"input", times}, {"output", moves}, {"interpolation", "STEP"}}}}}};
    builder.json["skins"] = {{{"joints", {0}}, {"inverseBindMatrices", matrices}}};
    const std::string glb = saved(load_glb(builder));
    const Json json = json_of(glb);
    const auto floats = [&](const Json& index, std::size_t count) {
        const Json& accessor = json["accessors"][index.get<std::size_t>()];
        const Json& view = json["bufferViews"][accessor["bufferView"].get<std::size_t>()];
        const std::size_t bin =
            glb.size() - (json["buffers"][0]["byteLength"].get<std::size_t>() + 3) / 4 * 4;
        std::vector<float> values(count);
        std::memcpy(
            values.data(),
            glb.data() + bin + view["byteOffset"].get<std::size_t>() + accessor.value("byteOffset", 0u),
            4 * count);
        return values;
    };
    const Json& sampler = json["animations"][0]["samplers"][0];
    CHECK(json["animations"][0]["channels"] == builder.json["animations"][0]["channels"]);
    CHECK(sampler["interpolation"] == "STEP");
    CHECK(floats(sampler["input"], 3) == std::vector<float>{0, 1, 2});
    CHECK(floats(sampler["output"], 9) == std::vector<float>{1, 2, 3, 40, 50, 60, 7, 8, 9});
    CHECK(floats(json["skins"][0]["inverseBindMatrices"], 16)[12] == 9);
    CHECK(json["accessors"][sampler["input"].get<std::size_t>()]["min"] == Json({0.0}));
    // Matrices and animation data must not share a buffer view.
    const auto view_of = [&](const Json& index) {
        return json["accessors"][index.get<std::size_t>()]["bufferView"];
    };
    CHECK(view_of(sampler["input"]) != view_of(json["skins"][0]["inverseBindMatrices"]));
}

TEST_CASE("points and lines of a mesh are preserved") {
    GltfBuilder builder = square_gltf();
    const auto ends = builder.accessor(std::vector<std::uint8_t>{0, 3}, u8, "SCALAR");
    builder.json["materials"] = Json::parse(R"([{"name":"unused"},{"name":"ink"}])");
    builder.json["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", 0}}},
                                                       {"indices", ends},
                                                       {"mode", 1},
                                                       {"material", 1},
                                                       {"extras", "line"}});
    const Json json = through(builder);
    const Json& primitives = json["meshes"][0]["primitives"];
    REQUIRE(primitives.size() == 2);
    CHECK(primitives[1]["mode"] == 1);
    CHECK(primitives[1]["extras"] == "line");
    CHECK(json["accessors"][primitives[1]["indices"].get<std::size_t>()]["count"] == 2);
    REQUIRE(json["materials"].size() == 1);
    CHECK(json["materials"][primitives[1]["material"].get<std::size_t>()]["name"] == "ink");
}

TEST_CASE("zero positions without a buffer view can be read again after writing") {
    GltfBuilder builder = square_gltf();
    const auto zeros = builder.add("accessors", {{"componentType", f32}, {"type", "VEC3"}, {"count", 4}});
    builder.json["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", zeros}}}, {"mode", 0}});
    Asset asset = load_glb(builder);
    asset.parts[0].triangles.clear();
    asset.parts[0].face_material.clear();
    const TemporaryFolder folder;
    save(asset, folder / "out.glb");
    const Json json = json_of(get(folder / "out.glb"));
    REQUIRE(json["accessors"].size() == 1);
    CHECK(json["accessors"][0]["count"] == 4);
    CHECK(json["accessors"][0]["max"] == Json::parse("[0, 0, 0]"));
    CHECK(json["buffers"][0]["byteLength"] == 48);
    CHECK_NOTHROW(load(folder / "out.glb"));
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
    const TemporaryFolder folder;
    const std::vector<std::string> warnings = save(asset, folder / "out.glb");
    const Json json = json_of(get(folder / "out.glb"));
    CHECK(any_contains(warnings, "has no primitives left"));
    CHECK(json["meshes"].size() == 1);
    CHECK(json["nodes"].size() == 2);
    CHECK_FALSE(json["nodes"][0].contains("mesh"));
    CHECK(json["nodes"][1]["mesh"] == 0);
}

TEST_CASE("unused objects are not written") {
    GltfBuilder builder = square_gltf();
    builder.accessor(std::vector<float>(1000, 1.0f), f32, "SCALAR");
    add_texture(builder, 10);
    add_texture(builder, 20);
    builder.json["samplers"] = Json::parse(R"([{}, {"magFilter":9728}])");
    builder.json["textures"][1]["sampler"] = 1;
    builder.json["materials"] =
        Json::parse(R"([{"normalTexture":{"index":0}},{"emissiveTexture":{"index":1}}])");
    builder.json["meshes"][0]["primitives"][0]["material"] = 1;
    const std::string glb = saved(load_glb(builder));
    const Json json = json_of(glb);
    CHECK(json["accessors"].size() == 2);
    CHECK(json["materials"].size() == 1);
    CHECK(json["textures"].size() == 1);
    CHECK(json["samplers"] == Json::parse(R"([{"magFilter":9728}])"));
    CHECK(json["images"].size() == 1);
    CHECK(glb.size() < 3000);
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
    builder.json["meshes"][0]["primitives"][0]["targets"] = Json::array({{{"POSITION", delta}}});
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

    CHECK_THROWS_AS(save(asset, folder / "a b.gltf"), WriteError);
    CHECK_NOTHROW(save(asset, folder / "a b.gltf", Overwrite::yes));
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

TEST_CASE("unknown extensions are preserved, with a warning if they contain numbers") {
    GltfBuilder builder = square_gltf();
    builder.json["nodes"][0]["extensions"] = Json::parse(R"({"ACME_rig":{"bone":3}})");
    const TemporaryFolder folder;
    CHECK(any_contains(save(load_glb(builder), folder / "out.glb"), "ACME_rig"));
    CHECK(json_of(get(folder / "out.glb"))["nodes"][0] == builder.json["nodes"][0]);
}

TEST_CASE("extensions that describe triangles are left out, and unknown ones if the triangles changed") {
    GltfBuilder builder = square_gltf();
    builder.json["extensionsUsed"] = {"CESIUM_primitive_outline", "EXT_mesh_manifold", "VENDOR_note"};
    builder.json["meshes"][0]["extensions"] = Json::parse(R"({"EXT_mesh_manifold":{"mergeIndices":0}})");
    builder.json["meshes"][0]["primitives"][0]["extensions"] =
        Json::parse(R"({"CESIUM_primitive_outline":{"indices":0},"VENDOR_note":{"text":"a"}})");
    Asset asset = load_glb(builder);
    const TemporaryFolder folder;
    const auto written = [&](std::vector<std::string>& warnings) {
        warnings = save(asset, folder / "out.glb", Overwrite::yes);
        return json_of(get(folder / "out.glb"));
    };
    std::vector<std::string> warnings;
    Json json = written(warnings);
    CHECK(warnings.size() == 2);
    CHECK(any_contains(warnings, "CESIUM_primitive_outline does not fit"));
    CHECK(any_contains(warnings, "EXT_mesh_manifold does not fit"));
    CHECK(json["meshes"][0]["primitives"][0]["extensions"] == Json::parse(R"({"VENDOR_note":{"text":"a"}})"));
    CHECK(json["extensionsUsed"] == Json({"VENDOR_note"}));
    asset.parts[0].file_order = FileOrder::for_gpu;
    json = written(warnings);
    CHECK(any_contains(warnings, "VENDOR_note is not known"));
    CHECK_FALSE(json["meshes"][0]["primitives"][0].contains("extensions"));
    CHECK_FALSE(json.contains("extensionsUsed"));
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
    part.face_material.clear();
    CHECK(json_of(saved(asset))["meshes"][0]["primitives"][0]["extras"] == Json({{"groups", {"b", "a"}}}));
    part.face_group = {0, 0};
    part.group_names = {"b"};
    CHECK_FALSE(json_of(saved(asset))["meshes"][0]["primitives"][0].contains("extras"));
    part.group_names.resize(257);
    const WrittenGltf many = write_gltf_of(asset);
    CHECK_FALSE(many.primitive().contains("extras"));
    CHECK(many.warns("'square': the names of 257 groups were left out"));
}
