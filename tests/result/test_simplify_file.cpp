// Options::format, and simplify() of files: the library and the command give the same bytes.

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "asset/file_format.hpp"
#include "faqem/bake.hpp"
#include "faqem/error.hpp"
#include "support/catch.hpp"
#include "support/format_support.hpp"
#include "support/painted_sheet.hpp"

using namespace tool_test;
using faqem::testing::texts_in;

namespace {

faqem::Options options_for(faqem::ModelFormat format, std::uint64_t max_bytes) {
    faqem::Options options;
    options.format = format;
    if (max_bytes > 0) options.max_bytes = max_bytes;
    return options;
}

}  // namespace

TEST_CASE("load, simplify for a format, and save: the bytes of the command, for each format") {
    const ModelFolder folder("in.glb", painted_sheet(12));
    faqem::save(sheet(12), folder / "in.obj");
    faqem::Asset coloured = sheet(12, 0.3);
    coloured.materials.clear();
    coloured.images.clear();
    coloured.parts[0].face_material.clear();
    coloured.parts[0].uvs.clear();
    coloured.parts[0].colors.assign(coloured.parts[0].positions.size(), {0.5f, 0.25f, 1, 1});
    faqem::save(coloured, folder / "in.ply");
    for (const std::string in : {"in.glb", "in.obj", "in.ply"}) {
        for (const faqem::detail::FileFormat& format : faqem::detail::file_formats()) {
            if (!format.encode) continue;
            for (const std::uint64_t bytes : {0, 6000}) {
                if (bytes > 0 && (in != "in.glb" || format.extension == ".gltf")) continue;
                const std::string out = "out" + std::string(format.extension);
                INFO(in << " to " << out << " with " << bytes << " bytes");
                for (const char* by : {"command", "steps", "call"}) {
                    fs::remove_all(folder / by);
                    fs::create_directory(folder / by);
                }
                const std::string limit = bytes > 0 ? " --max-bytes " + std::to_string(bytes) : "";
                REQUIRE(run(folder, "simplify " + in + " command/" + out + limit).code == 0);
                const faqem::Options options = options_for(format.format, bytes);
                const auto result = simplify(faqem::load(folder / in), options);
                CHECK(result.asset.format == format.format);
                for (const std::string& warning : faqem::save(result.asset, folder / "steps" / out))
                    CHECK(warning.find("was made for") == std::string::npos);
                const faqem::Report report = faqem::simplify(folder / in, folder / "call" / out, options);
                CHECK(texts_in(folder / "steps") == texts_in(folder / "command"));
                CHECK(texts_in(folder / "call") == texts_in(folder / "command"));
                std::uint64_t total = 0;
                for (const auto& [name, text] : texts_in(folder / "call")) total += text.size();
                CHECK(report.bytes_out == total);
                CHECK(report.bytes_in ==
                      fs::file_size(folder / in) + (in == "in.obj" ? fs::file_size(folder / "in.mtl") +
                                                                         fs::file_size(folder / "in_0.png")
                                                                   : 0));
                if (bytes > 0) CHECK(total <= bytes);
            }
        }
    }
}

TEST_CASE("a result is made for the format of the loaded file, and for GLB without one") {
    const ModelFolder folder("in.obj", sheet(8));
    faqem::Asset source = faqem::load(folder / "in.obj");
    CHECK(source.format == faqem::ModelFormat::obj);
    CHECK(simplify(source).asset.format == faqem::ModelFormat::obj);
    CHECK(simplify(sheet(8)).asset.format == faqem::ModelFormat::glb);
    write(folder / "in.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    CHECK(simplify(faqem::load(folder / "in.off")).asset.format == faqem::ModelFormat::glb);
}

TEST_CASE("saving to another format than a result was made for gives a warning") {
    const Folder folder;
    const auto is_warned = [&](const faqem::Asset& asset, const std::string& name) {
        for (const std::string& warning : faqem::save(asset, folder / name, faqem::Overwrite::yes))
            if (warning.find("was made for .glb files") != std::string::npos) return true;
        return false;
    };
    const faqem::SimplifiedAsset result = simplify(sheet(8));
    CHECK(is_warned(result.asset, "a.ply"));
    CHECK(is_warned(result.asset, "a.obj"));
    CHECK_FALSE(is_warned(result.asset, "a.gltf"));
    CHECK_FALSE(is_warned(sheet(8), "a.ply"));
    CHECK_FALSE(is_warned(faqem::load(folder / "a.gltf"), "b.ply"));
}

TEST_CASE("simplify of a file saves nothing that is cancelled, empty or beyond the maximum error") {
    const ModelFolder folder("in.glb", sheet(8, 0.4));
    faqem::Options options;
    options.progress = [](faqem::Phase, double) { return faqem::Continue::cancel; };
    const faqem::Report cancelled = faqem::simplify(folder / "in.glb", folder / "out.glb", options);
    CHECK(cancelled.stop == faqem::StopReason::cancelled);
    CHECK(cancelled.bytes_out == 0);
    options = {};
    options.target = faqem::faces(8);
    options.max_error = faqem::model_units(1e-9);
    CHECK_FALSE(faqem::simplify(folder / "in.glb", folder / "out.glb", options).max_error->within());
    CHECK_FALSE(fs::exists(folder / "out.glb"));

    CHECK_THROWS_AS(faqem::simplify(folder / "in.glb", folder / "out.off"), faqem::UnsupportedError);
    CHECK_THROWS_AS(faqem::simplify(folder / "in.glb", folder / "out"), faqem::UnsupportedError);
    faqem::simplify(folder / "in.glb", folder / "out.glb");
    CHECK_THROWS_AS(faqem::simplify(folder / "in.glb", folder / "out.glb"), faqem::WriteError);
    CHECK_NOTHROW(faqem::simplify(folder / "in.glb", folder / "out.glb", {}, faqem::Overwrite::yes));
}

TEST_CASE("options that only glTF files can hold are errors for other formats") {
    faqem::Options options;
    options.format = faqem::ModelFormat::ply;
    options.quantize.kind = faqem::Quantize::on;
    CHECK_THROWS_AS(simplify(sheet(4), options), faqem::OptionError);
    options.quantize = {};
    options.bake.image_format = faqem::ImageFormat::webp;
    CHECK_THROWS_AS(simplify(sheet(4), options), faqem::OptionError);
    options = {};
    options.max_bytes = 1000;
    options.max_error = faqem::of_diagonal(0.1);
    CHECK_THROWS_AS(simplify(sheet(4), options), faqem::OptionError);
}

TEST_CASE("the report says what holds the bytes of a result that is hardly smaller, and what helps") {
    const Folder folder;
    faqem::Options options;
    const auto saved = [&](const std::string& in, const std::string& out) {
        return faqem::simplify(folder / in, folder / out, options, faqem::Overwrite::yes).little_saved;
    };
    const auto has = [](const faqem::LittleSaved& one, const std::string& option) {
        return std::find(one.options.begin(), one.options.end(), option) != one.options.end();
    };
    faqem::save(sheet(60, 0.2), folder / "faces.obj");
    options.target = faqem::ratio(0.1);
    CHECK_FALSE(saved("faces.obj", "out.obj"));
    options.target = faqem::ratio(0.95);
    std::optional<faqem::LittleSaved> most = saved("faces.obj", "out.obj");
    REQUIRE(most);
    CHECK(most->geometry > most->images);
    CHECK(has(*most, "ratio"));
    std::ofstream(folder / "short.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 2 4 3\n";
    options.target = faqem::ratio(1);
    most = saved("short.obj", "out.obj");
    REQUIRE(most);
    CHECK(fs::file_size(folder / "out.obj") > fs::file_size(folder / "short.obj"));
    CHECK_FALSE(has(*most, "ratio"));

    faqem::Asset pictured = painted_sheet(4);
    faqem::save(pictured, folder / "image.glb");
    options.target = faqem::ratio(1);
    most = saved("image.glb", "out.glb");
    REQUIRE(most);
    CHECK(most->images == pictured.images[0].encoded.size());
    CHECK(most->images > most->geometry);
    CHECK(most->geometry + most->images + most->animation + most->other == fs::file_size(folder / "out.glb"));
    CHECK(has(*most, "texture-size"));
    CHECK(most->reason == "meshes that lose no face keep the images of the source");
    options.bake.image_format = faqem::ImageFormat::source;
    options.bake.kind = faqem::Bake::keep;
    options.target = faqem::ratio(0.5);
    most = saved("image.glb", "out.glb");
    REQUIRE(most);
    CHECK(most->options == std::vector<std::string>{"image-format"});

    const Outcome summary = run(folder, "simplify image.glb out.glb --force --ratio 1");
    CHECK(summary.out.find("little saved: meshes that lose no face keep the images") != std::string::npos);
    CHECK(summary.out.find("; less with --texture-size") != std::string::npos);
}

TEST_CASE("simplify() of files never replaces its input, and looks for an existing result before the work") {
    const ModelFolder folder("in.ply", sheet(8));
    const std::string before = read(folder / "in.ply");
    CHECK_THROWS_AS(faqem::simplify(folder / "in.ply", folder / "." / "in.ply", {}, faqem::Overwrite::yes),
                    faqem::OptionError);
    CHECK(read(folder / "in.ply") == before);
    write(folder / "out.ply", "mine");
    faqem::Options options;
    bool has_begun = false;
    options.progress = [&](faqem::Phase, double) {
        has_begun = true;
        return faqem::Continue::yes;
    };
    CHECK_THROWS_AS(faqem::simplify(folder / "in.ply", folder / "out.ply", options), faqem::WriteError);
    CHECK_FALSE(has_begun);
    CHECK(read(folder / "out.ply") == "mine");
}
