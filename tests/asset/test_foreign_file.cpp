#include <string>

#include "faqem/asset.hpp"
#include "support/catch.hpp"
#include "support/format_support.hpp"
#include "support/gltf_builder.hpp"

using namespace faqem;
using namespace faqem::testing;

namespace {

std::string refusal(const TemporaryFolder& folder, const std::string& name, const std::string& content) {
    put(folder / name, content);
    const std::string message = message_of<InputError>([&] { load(folder / name); });
    return message.substr(message.find(name));
}

}  // namespace

TEST_CASE("files of another kind are named under any name") {
    const TemporaryFolder folder;
    for (const auto& [content, kind] : {
             std::pair(std::string("\r\n <!doctype HTML><title>404</title>"), std::string("an HTML page")),
             {"\xef\xbb\xbf<html lang=en>", "an HTML page"},
             {"<!Doctype Html><TITLE>404</TITLE>", "an HTML page"},
             {"<?xml version='1.0'?><Error/>", "an XML file"},
             {"version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 1\n", "a Git LFS pointer"},
             {"PK\3\4 and more", "a ZIP archive"},
             {"\x1f\x8b\x08", "a gzip archive"},
             {"\x89PNG\r\n\x1a\n", "a PNG image"},
             {"%PDF-1.7\n", "a PDF document"},
         }) {
        CAPTURE(kind);
        for (const auto& [name, what] : {std::pair("a.glb", "a GLB"),
                                         {"a.GLTF", "a GLTF"},
                                         {"a.obj", "an OBJ"},
                                         {"a.ply", "a PLY"},
                                         {"a.stl", "an STL"},
                                         {"a.off", "an OFF"}})
            CHECK(refusal(folder, name, content)
                      .starts_with(std::string(name) + ": is not " + what + " file: it begins like " + kind));
        put(folder / "a.zip", content);
        CHECK(contains(message_of<UnsupportedError>([&] { load(folder / "a.zip"); }),
                       "a.zip: is not a model file: it begins like " + kind));
    }
}

TEST_CASE("an empty file is called empty under any name") {
    const TemporaryFolder folder;
    for (const char* name : {"a.glb", "a.gltf", "a.obj", "a.ply", "a.stl", "a.off", "a.txt"})
        CHECK(refusal(folder, name, "") == std::string(name) + ": is empty");
}

TEST_CASE("a file with a name of glTF that is neither GLB nor JSON is quoted") {
    const TemporaryFolder folder;
    CHECK(refusal(folder, "a.glb", "404: Not Found\nno") ==
          "a.glb: is not a GLB file: it begins with '404: Not Found'");
    CHECK(refusal(folder, "a.gltf", "gl") == "a.gltf: is not a GLTF file: it begins with 'gl'");
    put(folder / "mark.gltf", "\xef\xbb\xbf" + square_gltf().text());
    CHECK(contains(message_of<InputError>([&] { load(folder / "mark.gltf"); }), "/buffers/0"));
    put(folder / "off.glb", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    CHECK(load(folder / "off.glb").parts[0].triangles.size() == 1);
}

TEST_CASE("URLs and standard input are not taken for missing files") {
    for (const char* name : {"-", "https://example.org/a.glb", "file:///a.glb"})
        CHECK(message_of<ReadError>([&] { load(name); }) ==
              std::string(name) + ": only files are read, no URLs and no standard input");
}

TEST_CASE("the message about a format that is not read says how to get one that is") {
    const TemporaryFolder folder;
    for (const char* name : {"a.fbx", "a.usdz", "a.3MF", "a.dae", "a.blend"}) {
        std::ofstream(folder / name) << (std::string(name) == "a.dae" ? "<?xml" : "PK\3\4 and more");
        const std::string message = message_of<UnsupportedError>([&] { load(folder / name); });
        CAPTURE(message);
        CHECK(contains(message, std::string(name) + ": is not read: "));
        CHECK((contains(message, ".glb") || contains(message, ".stl")));
    }
    std::ofstream(folder / "b.fbx") << "version https://git-lfs.github.com/spec/v1\n";
    CHECK(contains(message_of<UnsupportedError>([&] { load(folder / "b.fbx"); }), "git lfs pull"));
    std::ofstream(folder / "c.fbx") << "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    CHECK(load(folder / "c.fbx").parts[0].triangles.size() == 1);
}
