// Loading and saving of files and of models in memory, and the instances of scenes.

#include "faqem/asset.hpp"
#include "faqem/error.hpp"
#include "support/catch.hpp"
#include "support/gltf_builder.hpp"

using namespace faqem;
using namespace faqem::testing;

namespace {

Vec3 transformed(const Instance& instance, const Vec3& p) {
    const auto& m = instance.transform;
    Vec3 q;
    for (std::size_t row = 0; row < 3; ++row)
        q[row] = m[row] * p[0] + m[4 + row] * p[1] + m[8 + row] * p[2] + m[12 + row];
    return q;
}

void check_close(const Vec3& a, const Vec3& b) {
    for (std::size_t i = 0; i < 3; ++i) CHECK(a[i] == Approx(b[i]).margin(1e-12));
}

/// Loads the square with the given nodes and without a scene.
Asset with_nodes(const char* nodes) {
    GltfBuilder builder = square_gltf();
    builder.json.erase("scenes");
    builder.json["nodes"] = Json::parse(nodes);
    return load_glb(builder);
}

}  // namespace

TEST_CASE("the format is detected from the content before the file name") {
    const TemporaryFolder folder;
    put(folder / "scan.bin", square_gltf().glb());
    CHECK(load(folder / "scan.bin").parts.size() == 1);
    put(folder / "scan.obj", square_gltf().glb());
    CHECK(load(folder / "scan.obj").parts[0].triangles.size() == 2);
    put(folder / "text.GLTF", " \n" + GltfBuilder().text());
    CHECK(load(folder / "text.GLTF").parts.empty());
}

TEST_CASE("an empty asset can be saved and loaded") {
    const TemporaryFolder folder;
    save(Asset{}, folder / "a.glb");
    CHECK(load(folder / "a.glb").parts.empty());
}

TEST_CASE("without a scene each part has one instance with the identity transform") {
    Asset asset;
    asset.parts.resize(2);
    const std::vector<Instance> all = instances(asset);
    REQUIRE(all.size() == 2);
    CHECK(all[1].part == 1);
    check_close(transformed(all[1], {1, 2, 3}), {1, 2, 3});
}

TEST_CASE("node transforms apply scale, rotation and translation and accumulate from the root") {
    // The rotation by 90 degrees about z maps x to y.
    const Asset asset = with_nodes(R"([
        {"children":[1],"translation":[10,0,0]},
        {"mesh":0,"translation":[0,5,0],"rotation":[0,0,0.70710678118654752,0.70710678118654752],"scale":[2,3,4]}])");
    const std::vector<Instance> all = instances(asset);
    REQUIRE(all.size() == 1);
    check_close(transformed(all[0], {1, 0, 0}), {10, 7, 0});
    check_close(transformed(all[0], {0, 1, 0}), {7, 5, 0});
    check_close(transformed(all[0], {0, 0, 1}), {10, 5, 4});
}

TEST_CASE("mirrored matrices and zero scales are kept in instance transforms") {
    const Asset asset = with_nodes(R"([
        {"mesh":0,"matrix":[-1,0,0,0,0,1,0,0,0,0,1,0,4,5,6,1]},{"mesh":0,"scale":[0,0,0]}])");
    const std::vector<Instance> all = instances(asset);
    REQUIRE(all.size() == 2);
    CHECK(all[0].part == 0);
    CHECK(all[1].part == 0);
    check_close(transformed(all[0], {1, 1, 1}), {3, 6, 7});
    check_close(transformed(all[1], {1, 1, 1}), {0, 0, 0});
}

TEST_CASE("instances are those of the default scene in the order of its nodes") {
    GltfBuilder builder = square_gltf();
    builder.json["nodes"] = Json::parse(R"([{"mesh":0,"translation":[1,0,0]},{"mesh":0,"translation":[2,0,0]},
                                           {"mesh":0,"translation":[3,0,0]}])");
    builder.json["scenes"] = Json::parse(R"([{"nodes":[0]},{"nodes":[2,1]}])");
    builder.json["scene"] = 1;
    const std::vector<Instance> all = instances(load_glb(builder));
    REQUIRE(all.size() == 2);
    CHECK(all[0].transform[12] == 3);
    CHECK(all[1].transform[12] == 2);
}

TEST_CASE("a chain of 100000 nodes does not overflow the stack") {
    GltfBuilder builder = square_gltf();
    Json nodes = Json::array();
    for (int i = 0; i < 99999; ++i) nodes.push_back({{"children", {i + 1}}, {"translation", {1, 0, 0}}});
    nodes.push_back({{"mesh", 0}});
    builder.json["nodes"] = nodes;
    const std::vector<Instance> all = instances(load_glb(builder));
    REQUIRE(all.size() == 1);
    CHECK(all[0].transform[12] == 99999);
}

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
