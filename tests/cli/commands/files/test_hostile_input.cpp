// Malicious files exit with 3 (or 4) and an error that names the file and the element; no output is written.

#include <algorithm>

#include "support/catch.hpp"
#include "support/cli_support.hpp"
#include "support/gltf_builder.hpp"

using namespace tool_test;
using faqem::testing::contains;
using faqem::testing::GltfBuilder;
using faqem::testing::square_gltf;

namespace {

/// Checks that `simplify` and `info` reject a file with an error message that contains all `words`.
void check_refused(const Folder& folder, const std::string& file, const std::vector<std::string>& words,
                   int code = 3) {
    for (const std::string& command : {"simplify " + file + " out.glb", "info " + file}) {
        const Outcome outcome = run(folder, command);
        INFO(command << ": " << outcome.err);
        CHECK(outcome.code == code);
        CHECK(contains(outcome.err, "faqem: " + file + ": "));
        for (const std::string& word : words) CHECK(contains(outcome.err, word));
        CHECK(outcome.out.empty());
    }
    CHECK(!fs::exists(folder / "out.glb"));
}

void check_refused(const GltfBuilder& builder, const std::vector<std::string>& words, int code = 3) {
    const Folder folder;
    write(folder / "a.glb", builder.glb());
    check_refused(folder, "a.glb", words, code);
}

}  // namespace

TEST_CASE("hostile: JSON with 20,000 nested arrays or objects is rejected") {
    const Folder folder;
    const std::string start = R"({"asset":{"version":"2.0"},"extras":)", open(20000, '[');
    write(folder / "open.gltf", start + open);
    write(folder / "closed.gltf", start + open + std::string(20000, ']') + "}");
    std::string objects = start;
    for (int i = 0; i < 20000; ++i) objects += "{\"a\":";
    write(folder / "objects.gltf", objects);
    for (const std::string file : {"open.gltf", "closed.gltf", "objects.gltf"})
        check_refused(folder, file, {"nested deeper than 64"});
}

TEST_CASE("hostile: counts near 2^62 and 2^64 are rejected") {
    GltfBuilder builder = square_gltf();
    builder.json["buffers"] = {{{"byteLength", UINT64_MAX}}};
    check_refused(builder, {"/buffers/0"});
    const Folder folder;
    write(folder / "a.ply",
          "ply\nformat binary_little_endian 1.0\nelement vertex 4611686018427387904\nproperty float x\n"
          "property float y\nproperty float z\nelement face 1\nproperty list uchar int vertex_indices\n"
          "end_header\n");
    check_refused(folder, "a.ply", {"vertex"});
    write(folder / "a.off", "OFF\n4611686018427387904 1 0\n0 0 0\n");
    check_refused(folder, "a.off", {"4611686018427387904", "32-bit indices"});
    write(folder / "a.stl", std::string(80, 'x') + "\xFF\xFF\xFF\xFF" + std::string(49, '\0'));
    check_refused(folder, "a.stl", {"header", "4294967295", "the file has room for 0"});
    write(folder / "a.obj", "v 0 0 0\nf 1 1 4611686018427387904\n");
    check_refused(folder, "a.obj", {"line 2"});
}

TEST_CASE("hostile: node transforms that overflow are rejected") {
    GltfBuilder builder = square_gltf();
    builder.json["nodes"] =
        nlohmann::json::parse(R"([{"scale":[1e200,1,1],"children":[1]},{"scale":[1e200,1,1],"mesh":0}])");
    builder.json["scenes"] = nlohmann::json::parse(R"([{"nodes":[0]}])");
    check_refused(builder, {"/meshes/0", "out of the range of double"});
}

TEST_CASE("hostile: an image whose header has more pixels than its bytes can encode is rejected") {
    // IHDR of 16384 x 16384 RGBA with its checksum, an empty IDAT, IEND.
    const unsigned char png[] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n', 0,    0,    0,
                                 13,   'I', 'H', 'D', 'R',  0,    0,    0x40, 0,    0,    0,
                                 0x40, 0,   8,   6,   0,    0,    0,    0x4d, 0x37, 0x0e, 0x2d};
    GltfBuilder builder = square_gltf();
    std::vector<unsigned char> bytes(std::begin(png), std::end(png));
    bytes.resize(200);
    const auto view = builder.view(bytes);
    builder.json["images"] = {{{"bufferView", view}, {"mimeType", "image/png"}}};
    builder.json["textures"] = nlohmann::json::parse(R"([{"source":0}])");
    builder.json["materials"] =
        nlohmann::json::parse(R"([{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}])");
    builder.primitive()["material"] = 0;
    builder.attribute("TEXCOORD_0", std::vector<faqem::Vec2f>(4), faqem::testing::f32, "VEC2");
    const Folder folder;
    write(folder / "a.glb", builder.glb());
    const Outcome outcome = run(folder, "simplify a.glb out.glb --texture-size 64");
    INFO(outcome.err);
    CHECK(outcome.code == 3);
    CHECK(contains(outcome.err, "faqem: a.glb: material 0: image: "));
    CHECK(!fs::exists(folder / "out.glb"));
    // --bake keep copies the encoded image without decoding it.
    CHECK(run(folder, "simplify a.glb out.glb --bake keep --quiet").code == 0);
}

TEST_CASE("hostile: nothing but the error of faqem is printed for a damaged PNG") {
    // libpng prints its errors itself unless it is prevented from doing so.
    const Folder folder;
    fs::create_directory(folder / "in");
    const std::vector<std::uint8_t> good = two_colours().encoded;
    std::vector<std::vector<std::uint8_t>> damaged(5, good);
    damaged[0][20] ^= 1;                                // height: the checksum of IHDR is wrong
    damaged[1][good.size() - 30] ^= 0x55;               // in the last IDAT
    damaged[2].resize(good.size() - 40);                // truncated
    damaged[3].insert(damaged[3].begin() + 33, 12, 0);  // a chunk whose type is zeros
    std::fill(damaged[4].begin() + 60, damaged[4].end() - 20, std::uint8_t{0xff});
    for (std::size_t i = 0; i < damaged.size(); ++i) {
        CAPTURE(i);
        faqem::Asset asset = sheet(4);
        asset.images[0].encoded = damaged[i];
        const std::string file = "in/" + std::to_string(i) + ".glb";
        faqem::save(asset, folder / file);
        const Outcome outcome = run(folder, "simplify " + file + " out.glb --bake atlas");
        INFO(outcome.err);
        CHECK(outcome.code == 3);
        CHECK(outcome.err.rfind("faqem: " + file + ": ", 0) == 0);
        CHECK(outcome.err.find('\n') == outcome.err.size() - 1);
    }
    const Outcome batch = run(folder, "batch in out --bake atlas --jobs 2");
    CHECK(batch.code == 9);
    CHECK(batch.err.starts_with("faqem: "));
    CHECK(batch.err.find(" failed\n") == batch.err.size() - 8);
}

TEST_CASE("hostile: references to files outside the model's directory are rejected") {
    const Folder folder;
    fs::create_directory(folder / "in");
    const std::string bytes(60, 'x');
    write(folder / "secret.bin", bytes);
    fs::create_symlink("../secret.bin", folder / "in/link.bin");
    fs::create_directory_symlink("..", folder / "in/up");
    const auto refused = [&](const std::string& uri, const std::string& why) {
        GltfBuilder builder = square_gltf();
        builder.bin.clear();
        builder.json["buffers"] = {{{"byteLength", 60}, {"uri", uri}}};
        write(folder / "in/a.gltf", builder.text());
        check_refused(folder, "in/a.gltf", {"/buffers/0/uri", why});
    };
    for (const char* uri : {"../secret.bin", "link.bin", "up/secret.bin"})
        refused(uri, "is outside the folder");
    refused("file://" + (folder / "secret.bin").string(), "not a relative path");
    // The command runs in the outer directory, which has a file of this name, but the asset's directory has
    // none.
    refused("secret.bin", "No such file");
}

TEST_CASE("hostile: other versions of glTF exit with 4") {
    GltfBuilder builder = square_gltf();
    builder.json["asset"]["version"] = "1.0";
    check_refused(builder, {"/asset/version"}, 4);
}

TEST_CASE("hostile: directories and devices are rejected as input") {
    const Folder folder;
    fs::create_directory(folder / "a.glb");
    check_refused(folder, "a.glb", {"not a regular file"});
    check_refused(folder, "/dev/zero", {"not a regular file"});
}
