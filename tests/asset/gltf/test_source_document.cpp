#include "asset/scene/source_traits.hpp"
#include "support/catch.hpp"
#include "support/gltf_builder.hpp"

using namespace faqem;
using namespace faqem::testing;

TEST_CASE("motion is as exact as the integers of the file, and exact for floats") {
    GltfBuilder builder = square_gltf();
    const auto add = [&](const auto& values, int type, const char* kind, bool normalized) {
        const auto accessor = builder.accessor(values, type, kind);
        builder.json["accessors"][accessor]["normalized"] = normalized;
        return accessor;
    };
    const std::vector<std::array<std::uint8_t, 4>> bytes(4, {1, 1, 1, 1});
    const std::vector<std::array<std::int16_t, 4>> shorts(4, {1, 1, 1, 1});
    Json& primitive = builder.primitive();
    primitive["attributes"]["JOINTS_0"] = add(bytes, u8, "VEC4", false);
    primitive["attributes"]["WEIGHTS_0"] = add(bytes, u8, "VEC4", true);
    primitive["targets"] = {{{"POSITION", add(shorts, i16, "VEC3", true)}},
                            {{"POSITION", add(shorts, i16, "VEC3", false)}},
                            {{"POSITION", 0}}};
    for (const std::size_t accessor : {4u, 5u}) builder.json["bufferViews"][accessor]["byteStride"] = 8;
    const Asset asset = load_glb(builder);
    const detail::MotionSteps steps = detail::motion_steps(asset, asset.parts[0]);
    CHECK(steps.weight == 1.0 / 255);
    CHECK(steps.shift == std::vector<double>{1.0 / 32767, 1, 0});
    Asset bare = asset;
    bare.source = nullptr;
    CHECK(detail::motion_steps(bare, bare.parts[0]).shift == std::vector<double>{0, 0, 0});
}

TEST_CASE("variants and moved textures need the UVs of the parts that show them") {
    GltfBuilder builder = square_gltf();
    builder.json["meshes"].push_back(builder.json["meshes"][0]);
    builder.json["meshes"].push_back(builder.json["meshes"][0]);
    for (int m = 0; m < 12; ++m) builder.add("materials", Json::object());
    const auto primitive = [&](int mesh) -> Json& { return builder.json["meshes"][mesh]["primitives"][0]; };
    for (const auto& [mesh, material] : {std::pair(0, 1), std::pair(1, 11), std::pair(2, 2)})
        primitive(mesh)["material"] = material;
    primitive(2)["extensions"]["KHR_materials_variants"]["mappings"] = {{{"material", 7}, {"variants", {0}}},
                                                                        {{"material", 3}, {"variants", {1}}},
                                                                        {{"material", 7}, {"variants", {2}}}};
    const auto times = builder.accessor(std::vector<float>{0, 1}, f32, "SCALAR");
    const auto output = builder.accessor(std::vector<Vec2f>{{0, 0}, {1, 0}}, f32, "VEC2");
    const Json moved = {{"path", "pointer"},
                        {"extensions",
                         {{"KHR_animation_pointer",
                           {{"pointer",
                             "/materials/11/pbrMetallicRoughness/baseColorTexture/extensions/"
                             "KHR_texture_transform/offset"}}}}}};
    builder.add("animations", {{"samplers", {{{"input", times}, {"output", output}}}},
                               {"channels", {{{"sampler", 0}, {"target", moved}}}}});
    const Asset asset = load_glb(builder);
    CHECK(detail::variant_materials(asset, asset.parts[2]) == std::vector<Index>{3, 7});
    std::vector<std::uint8_t> moving(12, 0);
    moving[11] = 1;  // and not material 1
    CHECK(detail::materials_with_moving_textures(asset) == moving);
    CHECK(detail::parts_that_need_uvs(asset) == std::vector<std::uint8_t>{0, 1, 1});
}
