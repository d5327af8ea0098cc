// The table of formats: each row is read and written, and its properties are those of the files written. Files of no format
// are named.

#include <algorithm>
#include <map>
#include <set>
#include <string>

#include "asset/file_format.hpp"
#include "asset/gltf/write/levels.hpp"
#include "asset/io/file.hpp"
#include "asset/model_files.hpp"
#include "faqem/asset.hpp"
#include "faqem/save_levels.hpp"
#include "support/catch.hpp"
#include "support/format_support.hpp"
#include "support/gltf_builder.hpp"
#include "support/scenes.hpp"

using namespace faqem;
using namespace faqem::testing;
using detail::FileFormat;
using detail::FormatUse;

namespace {

/// Files with two triangles of the formats that are only read, by extension.
const std::map<std::string_view, std::string> read_only_samples = {
    {".off", "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n"}};

/// Two triangles with a textured material.
Asset textured_square() { return test::textured_square({1, 1, {255, 0, 0, 255}, false}); }

std::string upper_case(std::string text) {
    for (char& c : text)
        if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
    return text;
}

std::set<fs::path> canonical(const std::vector<fs::path>& files) {
    std::set<fs::path> paths;
    for (const fs::path& file : files) paths.insert(fs::canonical(file));
    return paths;
}

std::set<fs::path> files_in(const fs::path& folder) {
    std::set<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder)) files.insert(fs::canonical(entry.path()));
    return files;
}

std::string refusal(const TemporaryFolder& folder, const std::string& name, const std::string& content) {
    put(folder / name, content);
    const std::string message = message_of<InputError>([&] { load(folder / name); });
    return message.substr(message.find(name));
}

}  // namespace

TEST_CASE("formats: extensions are unique and in lower case, and every format is read") {
    std::set<std::string_view> known;
    for (const FileFormat& format : detail::file_formats()) {
        CHECK(known.insert(format.extension).second);
        CHECK(detail::lower_case_extension("a" + std::string(format.extension)) == format.extension);
        CHECK(format.read != nullptr);
        CHECK(format.min_bytes_per_face > 0);
        CHECK(detail::format_by_name("a.b" + upper_case(std::string(format.extension))) == &format);
    }
    CHECK(detail::format_by_name("glb") == nullptr);
    CHECK(detail::format_by_name("a.glb2") == nullptr);
}

TEST_CASE("formats: every format is read and written with its extension in lower and upper case") {
    for (const FileFormat& format : detail::file_formats()) {
        const std::string extension(format.extension);
        for (const std::string& name : {"model" + extension, "MODEL" + upper_case(extension)}) {
            INFO(name);
            const TemporaryFolder folder;
            if (format.encode)
                save(textured_square(), folder / name);
            else
                put(folder / name, read_only_samples.at(format.extension));
            CHECK(detail::format_of_file(folder / name)->read == format.read);
            const Asset read = load(folder / name);
            REQUIRE(read.parts.size() == 1);
            CHECK(read.parts[0].triangles.size() == 2);
        }
    }
}

TEST_CASE("formats: the files beside a model are found, and hold its images unless the model does") {
    for (const FileFormat& format : detail::file_formats()) {
        if (!format.encode) continue;
        for (const std::string& extension :
             {std::string(format.extension), upper_case(std::string(format.extension))}) {
            INFO(extension);
            const TemporaryFolder folder;
            const fs::path model = fs::canonical(folder.path()) / ("model" + extension);
            save(textured_square(), model);
            std::set<fs::path> beside = files_in(folder.path());
            REQUIRE(beside.erase(model) == 1);
            for (const detail::References which : {detail::References::readable, detail::References::all}) {
                const std::vector<fs::path> referenced = detail::referenced_files(model, which);
                CHECK(canonical(referenced) == beside);
            }
            const std::vector<fs::path> replaced = detail::existing_side_files({model});
            CHECK(canonical(replaced) == beside);
            CHECK(std::any_of(beside.begin(), beside.end(), [](const fs::path& file) {
                      return file.extension() == ".png";
                  }) == format.has_image_files);
            CHECK((format.side_file.name &&
                   beside.contains(model.parent_path() / format.side_file.name("model"))) ==
                  (format.side_file.name != nullptr));
            const bool has_image = !load(model).images.empty();
            CHECK(has_image == (detail::encode_model(textured_square(), model).image_bytes() > 0));
        }
    }
}

TEST_CASE("formats: files have at least the stated number of bytes per face") {
    // A grid, which has half a vertex per face.
    TriangleMesh grid = test::grid(260);  // more vertices than 16-bit indices can name
    for (Vec3& p : grid.positions) p = {p[0] / 7, p[1] / 7, 0};
    const auto faces = static_cast<double>(grid.triangles.size());
    const Asset asset = one_part(grid.positions, grid.triangles);
    for (const FileFormat& format : detail::file_formats()) {
        if (!format.encode) continue;
        INFO(format.extension);
        const TemporaryFolder folder;
        save(asset, folder / ("a" + std::string(format.extension)));
        double bytes = 0;
        for (const fs::path& file : files_in(folder.path()))
            bytes += static_cast<double>(fs::file_size(file));
        CHECK(bytes >= format.min_bytes_per_face * faces);
    }
}

TEST_CASE("formats: levels are saved in formats that hold them, and rejected in others") {
    for (const FileFormat& format : detail::file_formats()) {
        INFO(format.extension);
        const TemporaryFolder folder;
        const fs::path file = folder / ("a" + upper_case(std::string(format.extension)));
        const auto write = [&] { save_levels({{textured_square(), {0}}, {textured_square(), {0}}}, file); };
        if (format.encode_levels)
            CHECK_NOTHROW(write());
        else
            CHECK(contains(message_of<UnsupportedError>(write),
                           detail::listed_extensions(FormatUse::write_levels)));
    }
}

TEST_CASE("formats: messages about unknown extensions list the known ones") {
    const TemporaryFolder folder;
    put(folder / "a.xyz", "1 2 3");
    const std::string read = message_of<UnsupportedError>([&] { load(folder / "a.xyz"); });
    const std::string written = message_of<UnsupportedError>([&] { save(Asset{}, folder / "b.xyz"); });
    for (const FileFormat& format : detail::file_formats()) {
        CHECK(contains(read, std::string(format.extension)));
        CHECK(contains(written, std::string(format.extension)) == (format.encode != nullptr));
    }
    CHECK(detail::listed_extensions(FormatUse::read, "and") ==
          ".glb, .gltf, .vrm, .obj, .ply, .stl and .off");
}

TEST_CASE("formats: a model is encoded as the files that save() writes, with the bytes of its images") {
    // Also images whose kinds faqem cannot decode, in files with other extensions.
    for (const std::string type : {"image/png", "image/ktx2", "image/avif", "image/bmp"}) {
        for (const FileFormat& format : detail::file_formats()) {
            if (!format.encode) continue;
            INFO(type << " in " << format.extension);
            Asset asset = textured_square();
            asset.images[0].mime_type = type;
            const TemporaryFolder folder;
            const fs::path model = folder / ("model" + std::string(format.extension));
            const detail::EncodedModel encoded = detail::encode_model(asset, model);
            CHECK(save(asset, model) == encoded.losses);
            std::set<fs::path> names;
            std::uint64_t bytes = 0;
            for (const detail::EncodedFile& file : encoded.files) {
                names.insert(fs::canonical(folder / file.name));
                const std::string written = get(folder / file.name);
                CHECK(std::equal(file.bytes.begin(), file.bytes.end(), bytes_of(written).begin(),
                                 bytes_of(written).end()));
                bytes += written.size();
            }
            CHECK(names == files_in(folder.path()));
            CHECK(encoded.bytes() == bytes);
            const bool has_images = format.extension != ".ply" && format.extension != ".stl";
            CHECK(encoded.image_bytes() == (has_images ? asset.images[0].encoded.size() : 0));
            CHECK(encoded.views.empty() == !format.is_gltf);
        }
    }
}

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
