#include "support/catch.hpp"
#include "support/gltf_builder.hpp"

using namespace faqem;
using namespace faqem::testing;

namespace {

// The square with a custom attribute.
template <class T>
GltfBuilder square_with(const std::string& name, const std::vector<T>& values, int component,
                        const std::string& type) {
    GltfBuilder builder = square_gltf();
    builder.json["accessors"][builder.attribute(name, values, component, type)]["count"] = 4;
    return builder;
}

}  // namespace

TEST_CASE("custom attributes of all kinds are read and written") {
    const auto check = [](const GltfBuilder& builder, std::uint32_t components,
                          const std::vector<std::array<double, 4>>& values) {
        const Asset asset = load_glb(builder);
        CHECK(asset.warnings.empty());
        const Asset again = load_glb(saved(asset));
        for (const Asset* read : {&asset, &again}) {
            REQUIRE(read->parts[0].custom_attributes.size() == 1);
            CHECK(read->parts[0].custom_attributes[0].components == components);
            CHECK(read->parts[0].custom_attributes[0].values == values);
        }
    };
    // Elements of vertex attributes begin at multiples of 4 bytes.
    check(square_with<float>("_BATCHID", {1, 2, 2, 70000}, f32, "SCALAR"), 1,
          {{1, 0, 0, 0}, {2, 0, 0, 0}, {2, 0, 0, 0}, {70000, 0, 0, 0}});
    check(square_with<std::uint16_t>("_FEATURE_ID_0", {1, 2, 3, 4, 5, 6, 7, 65535}, u16, "VEC2"), 2,
          {{1, 2, 0, 0}, {3, 4, 0, 0}, {5, 6, 0, 0}, {7, 65535, 0, 0}});
    check(square_with<std::int8_t>("_A", {1, -2, 3, -128, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16}, i8,
                                   "VEC4"),
          4, {{1, -2, 3, -128}, {5, 6, 7, 8}, {9, 10, 11, 12}, {13, 14, 15, 16}});
}

TEST_CASE("an attribute that some primitives lack is left out with a warning") {
    GltfBuilder builder = square_with<float>("_BATCHID", {1, 2, 2, 3}, f32, "SCALAR");
    Json other = builder.primitive();
    other["attributes"].erase("_BATCHID");
    builder.json["meshes"][0]["primitives"].push_back(other);
    const Asset lacking = load_glb(builder);
    CHECK(lacking.parts[0].custom_attributes.empty());
    REQUIRE(lacking.warnings.size() == 1);
    CHECK(contains(lacking.warnings[0], "the attribute _BATCHID was left out"));
}
