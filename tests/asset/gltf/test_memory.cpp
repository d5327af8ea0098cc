// Estimates of the memory for a glTF file, made before its buffers are read.

#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "asset/file_format.hpp"
#include "support/catch.hpp"
#include "support/temporary_folder.hpp"

using faqem::detail::FileFormat;
using Folder = faqem::testing::TemporaryFolder;

namespace {

const FileFormat& gltf = *faqem::detail::format_by_name("a.gltf");

using Document = nlohmann::json;

constexpr std::uint64_t any = std::numeric_limits<std::uint64_t>::max();

/// A document with a mesh of 10,000 vertices and 20,000 triangles. Its buffer is not needed here.
Document mesh_document() {
    return Document::parse(R"({"asset":{"version":"2.0"},
        "buffers":[{"uri":"a.bin","byteLength":360000}],
        "bufferViews":[{"buffer":0,"byteLength":120000},{"buffer":0,"byteOffset":120000,"byteLength":240000}],
        "accessors":[{"bufferView":0,"componentType":5126,"count":10000,"type":"VEC3"},
                     {"bufferView":1,"componentType":5125,"count":60000,"type":"SCALAR"}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}]})");
}

void write(const std::filesystem::path& file, const std::string& text) {
    std::ofstream(file, std::ios::binary) << text;
}

std::uint64_t decoding_memory_of(const Folder& folder, const Document& document) {
    write(folder / "a.gltf", document.dump());
    return gltf.decoding_memory(folder / "a.gltf", 360'000);
}

std::uint64_t json_memory_of(const Folder& folder, const Document& document) {
    write(folder / "a.gltf", document.dump());
    return gltf.document_memory(folder / "a.gltf", any);
}

}  // namespace

TEST_CASE("the memory of decoded accessors is counted once per use") {
    const Folder folder;
    const Document one = mesh_document();
    const std::uint64_t base = decoding_memory_of(folder, one);
    CHECK(base >= 10000 * 24 + 20000 * 16);
    CHECK(base < 10 * 360000);

    Document other = one;
    other["meshes"] = std::vector<Document>(2000, one["meshes"][0]);
    CHECK(decoding_memory_of(folder, other) >= 2000ull * (10000 * 24 + 20000 * 16));
    // Targets are counted for all vertices.
    other = one;
    other["meshes"][0]["primitives"][0]["targets"] =
        std::vector<Document>(4000, Document{{"POSITION", 0}, {"NORMAL", 0}});
    CHECK(decoding_memory_of(folder, other) >= 4000ull * 10000 * 24);
    // Primitives with the same vertices share them, others do not.
    other = one;
    const Document primitive = one["meshes"][0]["primitives"][0];
    other["meshes"][0]["primitives"] = std::vector<Document>(100, primitive);
    const std::uint64_t shared = decoding_memory_of(folder, other);
    CHECK(shared >= 100ull * 20000 * 16);
    for (std::size_t i = 0; i < 100; ++i)
        other["meshes"][0]["primitives"][i]["attributes"]["_" + std::to_string(i)] = 0;
    CHECK(decoding_memory_of(folder, other) >= shared + 99ull * 10000 * 24);
    // Custom attributes are read to four doubles.
    other = one;
    for (std::size_t i = 0; i < 100; ++i)
        other["meshes"][0]["primitives"][0]["attributes"]["_" + std::to_string(i)] = 0;
    CHECK(decoding_memory_of(folder, other) >= base + 100ull * 10000 * 32);
    // Lines and points are not decoded.
    other = one;
    other["meshes"][0]["primitives"][0]["mode"] = 1;
    CHECK(decoding_memory_of(folder, other) == 0);
}

TEST_CASE("the memory of repeated images and of compressed data is counted") {
    const Folder folder;
    const Document one = mesh_document();
    const std::uint64_t base = decoding_memory_of(folder, one);
    Document other = one;
    other["images"] = std::vector<Document>(50, {{"bufferView", 0}, {"mimeType", "image/png"}});
    CHECK(decoding_memory_of(folder, other) >= base + 50 * 2 * 120000);
    write(folder / "a.png", std::string(100'000, 'x'));
    other["images"] = std::vector<Document>(50, {{"uri", "a.png"}});
    CHECK(decoding_memory_of(folder, other) >= base + 49 * 2 * 100'000);
    other = one;
    other["accessors"][0].erase("bufferView");  // as with Draco
    CHECK(decoding_memory_of(folder, other) >= base + 10000 * 12);
    other = one;
    other["buffers"].push_back(
        {{"byteLength", 240000}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}});
    other["bufferViews"][1] = {{"buffer", 1}, {"byteLength", 240000}};
    other["bufferViews"][1]["extensions"]["EXT_meshopt_compression"] = {
        {"buffer", 0},     {"byteOffset", 120000}, {"byteLength", 240000},
        {"byteStride", 4}, {"count", 60000},       {"mode", "TRIANGLES"}};
#ifdef FAQEM_WITH_MESHOPT
    CHECK(decoding_memory_of(folder, other) >= base + 240000);
#endif
}

TEST_CASE("the memory of JSON is counted per value") {
    const Folder folder;
    const Document one = mesh_document();
    const std::uint64_t base = json_memory_of(folder, one);
    CHECK(base < 200'000);
    Document other = one;
    other["meshes"][0]["weights"] = std::vector<int>(100'000, 0);
    const std::uint64_t weights = json_memory_of(folder, other);
    CHECK(weights >= base + 100'000 * 100);
    // A node has a matrix and more.
    other["nodes"] = std::vector<Document>(1000, Document::object());
    CHECK(json_memory_of(folder, other) >= weights + 1000 * 1000);
    // The estimate ends when it exceeds the limit.
    CHECK(gltf.document_memory(folder / "a.gltf", 1'000'000) < 1'100'000);
}

TEST_CASE("sizes that the files cannot have are left out of the estimate, so that loading reports them") {
    const Folder folder;
    const Document one = mesh_document();
    Document other = one;
    for (const char* const key : {"count", "byteOffset"}) {
        other["accessors"][0][key] = std::uint64_t{1} << 62;
        CHECK(decoding_memory_of(folder, other) == 0);
    }
    other = one;
    other["bufferViews"][0]["byteLength"] = other["buffers"][0]["byteLength"] = std::uint64_t{1} << 40;
    other["accessors"][0]["count"] = std::uint64_t{1} << 32;
    other["images"] = std::vector<Document>(50, {{"bufferView", 0}, {"mimeType", "image/png"}});
    CHECK(decoding_memory_of(folder, other) == 0);
}

TEST_CASE("damaged documents and other files are estimated without an error") {
    const Folder folder;
    const std::string text = mesh_document().dump();
    for (std::size_t size = 0; size < text.size(); size += 7) {
        write(folder / "a.gltf", text.substr(0, size));
        CHECK(gltf.document_memory(folder / "a.gltf", any) < 200'000);
        CHECK(gltf.decoding_memory(folder / "a.gltf", 360'000) == 0);
    }
    for (const std::string other :
         {R"({"accessors":{"a":{"count":1}},"bufferViews":{"a":{"a":{"EXT_meshopt_compression":{}}}}})",
          R"({"meshes":[[[[[[[[]]]]]]]]})", R"({"meshes":{"primitives":{"a":{"b":{"POSITION":9}}}}})",
          "[[1]]"}) {
        write(folder / "a.gltf", other);
        CHECK(gltf.decoding_memory(folder / "a.gltf", 360'000) == 0);
    }
    write(folder / "a.gltf", std::string(1000, '['));
    CHECK(gltf.document_memory(folder / "a.gltf", any) < 1'000'000);
}
