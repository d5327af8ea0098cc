// Listing of the buffer views of written documents.

#include <map>

#include "asset/gltf/source_document.hpp"
#include "support/catch.hpp"
#include "support/gltf_builder.hpp"

using namespace faqem;
using namespace faqem::testing;

TEST_CASE("the buffer views of a document are listed with what they store, without images") {
    GltfBuilder builder;
    const auto indices = builder.accessor(std::vector<std::uint16_t>{0, 1, 2}, u16, "SCALAR");
    const auto positions = builder.accessor(std::vector<std::array<float, 3>>(3), f32, "VEC3");
    const auto shared =
        builder.add("accessors", {{"bufferView", builder.json["accessors"][positions]["bufferView"]},
                                  {"componentType", f32},
                                  {"type", "VEC3"},
                                  {"count", 3}});
    const auto moved = builder.accessor(std::vector<std::array<float, 3>>(3), f32, "VEC3");
    const auto times = builder.accessor(std::vector<float>{0, 1}, f32, "SCALAR");
    const auto unused = builder.view(std::vector<std::uint8_t>(10));
    builder.add("images", {{"bufferView", builder.view(std::vector<std::uint8_t>(100))}});
    builder.json["animations"] =
        Json::array({{{"samplers", Json::array({{{"input", times}, {"output", times}}})}}});
    builder.json["meshes"] = Json::array(
        {{{"primitives", Json::array({{{"indices", indices},
                                       {"attributes", {{"POSITION", positions}, {"NORMAL", shared}}},
                                       {"targets", Json::array({{{"POSITION", moved}}})}}})}}});
    Json& compressed = builder.json["bufferViews"][unused]["extensions"]["EXT_meshopt_compression"];
    compressed = {{"byteLength", 7}};

    std::map<std::string, std::uint64_t> views;
    for (const ResultView& view : detail::buffer_views(builder.json)) views[view.content] += view.bytes;
    CHECK(views == std::map<std::string, std::uint64_t>{{"indices", 6},
                                                        {"NORMAL, POSITION", 36},
                                                        {"target POSITION", 36},
                                                        {"animation", 8},
                                                        {"other", 7}});
}
