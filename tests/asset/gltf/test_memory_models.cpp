// Models as bytes in memory.

#include "faqem/asset.hpp"
#include "faqem/error.hpp"
#include "support/catch.hpp"
#include "support/gltf_builder.hpp"

using namespace faqem;
using namespace faqem::testing;

TEST_CASE("to_glb gives the bytes of the saved file, and from_glb reads them as load does") {
    const Asset asset = load_glb(square_gltf());
    const std::vector<std::uint8_t> bytes = to_glb(asset);
    CHECK(std::string(bytes.begin(), bytes.end()) == saved(asset));
    const Asset back = from_glb(bytes);
    CHECK(message_of<InputError>([] { from_glb({}); }) == "is empty");
    CHECK(message_of<InputError>([&] { from_glb(std::span(bytes).subspan(4)); }) ==
          "is not a GLB file, which begins with 'glTF'");
    CHECK(back.parts.at(0).positions == asset.parts.at(0).positions);
    CHECK(back.format == ModelFormat::glb);
    CHECK(back.file_bytes == bytes.size());
}

TEST_CASE("a model in memory cannot refer to files, also not to those of the current directory") {
    GltfBuilder builder = square_gltf();
    builder.json["images"] = Json::parse(R"([{"uri":"picture.png"}])");
    builder.json["textures"] = Json::parse(R"([{"source":0}])");
    builder.json["materials"] = Json::parse(R"([{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}])");
    const auto read = [&] {
        const std::string glb = builder.glb();
        return from_glb({reinterpret_cast<const std::uint8_t*>(glb.data()), glb.size()});
    };
    const Asset asset = read();
    REQUIRE(asset.warnings.size() == 1);
    CHECK(asset.warnings[0] ==
          "/images/0/uri: a model in memory cannot refer to files; the textures that use it were left "
          "out");
    builder.json["buffers"][0] = {{"uri", "data.bin"}, {"byteLength", 1000}};
    CHECK_THROWS_WITH(read(), "/buffers/0/uri: a model in memory cannot refer to files");
}
