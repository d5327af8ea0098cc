// Files that an input refers to are never overwritten: exit code 7, and nothing is written.

#include <map>
#include <nlohmann/json.hpp>

#include "support/catch.hpp"
#include "support/cli_support.hpp"
#include "support/format_support.hpp"

using namespace tool_test;
using faqem::testing::contains;
using Json = nlohmann::json;

namespace {

const std::string quick = " --force --quiet --texture-size 64 --image-format png --ratio 0.5";

/// All files of a folder and below with their contents; links are listed with what they point to.
std::map<std::string, std::string> contents(const Folder& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder.path()))
        files[entry.path()] = entry.is_regular_file() ? read(entry.path()) : "";
    return files;
}

/// Checks that a command exits with 7, names the output and the input, and changes no file.
void check_refused(const Folder& folder, const std::string& command, const std::string& output,
                   const std::string& input) {
    CAPTURE(command);
    const auto before = contents(folder);
    const Outcome outcome = run(folder, command);
    CAPTURE(outcome.err);
    CHECK(outcome.code == 7);
    CHECK(outcome.out.empty());
    CHECK(contains(outcome.err, "faqem: " + output + ": is needed by the input " + input +
                                    "; choose another output name"));
    CHECK(contents(folder) == before);
}

/// Saves a small model with one texture as .gltf with the given names of its buffer and image.
void save_gltf(const Folder& folder, const std::string& name, const std::string& buffer,
               const std::string& image) {
    const Folder saved;
    faqem::save(sheet(6), saved / "m.gltf");
    Json document = Json::parse(read(saved / "m.gltf"));
    document["buffers"][0]["uri"] = buffer;
    document["images"][0]["uri"] = image;
    write(folder / name, document.dump());
    const fs::path beside = (folder / name).parent_path();
    fs::copy_file(saved / "m.bin", beside / buffer);
    fs::copy_file(saved / "m_0.png", beside / image);
}

/// Adds a member to a .gltf file.
void add_member(const fs::path& file, const std::string& pointer, const Json& value) {
    Json document = Json::parse(read(file));
    document[Json::json_pointer(pointer)] = value;
    write(file, document.dump());
}

/// Saves a small model with one texture as .obj with the given names of its library and image.
void save_obj(const Folder& folder, const std::string& name, const std::string& library,
              const std::string& image) {
    const Folder saved;
    faqem::save(sheet(6), saved / "m.obj");
    std::string obj = read(saved / "m.obj"), mtl = read(saved / "m.mtl");
    obj.replace(obj.find("m.mtl"), 5, library);
    mtl.replace(mtl.find("m_0.png"), 7, image);
    write(folder / name, obj);
    write(folder / library, mtl);
    fs::copy_file(saved / "m_0.png", folder / image);
}

}  // namespace

TEST_CASE("simplify does not overwrite the buffer or an image of its glTF input") {
    const Folder folder;
    save_gltf(folder, "in.gltf", "Avocado.bin", "small_0.png");
    check_refused(folder, "simplify in.gltf Avocado.gltf" + quick, "Avocado.bin", "in.gltf");
    check_refused(folder, "simplify in.gltf Avocado.gltf", "Avocado.bin", "in.gltf");  // without --force
    check_refused(folder, "simplify in.gltf small.gltf" + quick, "small_0.png", "in.gltf");
    check_refused(folder, "simplify in.gltf small.obj" + quick, "small_0.png", "in.gltf");
    const std::string others = " --history a.history --correspondence a.correspondence --report a.json";
    check_refused(folder, "simplify in.gltf small.gltf" + others + quick, "small_0.png", "in.gltf");
}

TEST_CASE("simplify does not overwrite the library or an image of its OBJ input") {
    const Folder folder;
    save_obj(folder, "in.obj", "lib.mtl", "small_0.png");
    check_refused(folder, "simplify in.obj lib.obj" + quick, "lib.mtl", "in.obj");
    check_refused(folder, "simplify in.obj small.obj" + quick, "small_0.png", "in.obj");
    check_refused(folder, "simplify in.obj small.gltf" + quick, "small_0.png", "in.obj");
}

TEST_CASE("every output file that a command is given is compared with the files of the input") {
    const Folder folder;
    save_gltf(folder, "in.gltf", "in.bin", "in.png");
    write(folder / "page.html", "a page");
    add_member(folder / "in.gltf", "/extras", {{"uri", "page.html"}});
    faqem::save(sheet(4), folder / "other.glb");
    for (const char* option : {"--report", "--history", "--correspondence"})
        check_refused(folder, std::string("simplify in.gltf a.glb ") + option + " in.bin" + quick, "in.bin",
                      "in.gltf");
    fs::copy_file(folder / "in.png", folder / "copy.ply");
    add_member(folder / "in.gltf", "/extras", {{"uri", "page.html"}, {"list", {{{"uri", "copy.ply"}}}}});
    check_refused(folder, "simplify in.gltf copy.ply" + quick, "copy.ply", "in.gltf");
    check_refused(folder, "render other.glb in.gltf in.png --force", "in.png", "in.gltf");
    check_refused(folder, "report other.glb in.gltf -o page.html --force", "page.html", "in.gltf");
    check_refused(folder, "report in.gltf other.glb -o page.html --force", "page.html", "in.gltf");
}

TEST_CASE("files are compared by identity: links and paths do not matter") {
    const Folder folder;
    fs::create_directories(folder / "in");
    fs::create_directories(folder / "out");
    fs::create_directory_symlink("in", folder / "alias");
    save_gltf(folder, "in/m.gltf", "m.bin", "m.png");
    fs::create_hard_link(folder / "in/m.bin", folder / "out/hard.bin");
    fs::create_symlink("../in/m.bin", folder / "out/soft.bin");
    fs::create_hard_link(folder / "in/m.png", folder / "out/image_0.png");
    check_refused(folder, "simplify in/m.gltf out/hard.gltf" + quick, "out/hard.bin", "in/m.gltf");
    check_refused(folder, "simplify in/m.gltf out/soft.gltf" + quick, "out/soft.bin", "in/m.gltf");
    check_refused(folder, "simplify in/m.gltf out/image.gltf" + quick, "out/image_0.png", "in/m.gltf");
    check_refused(folder, "simplify in/m.gltf a.glb --report out/../in/m.bin" + quick, "out/../in/m.bin",
                  "in/m.gltf");
    check_refused(folder, "simplify in/m.gltf a.glb --report alias/m.png" + quick, "alias/m.png",
                  "in/m.gltf");
    check_refused(folder, "render alias/m.gltf in/m.png --force", "in/m.png", "alias/m.gltf");

    // The input refers to a link: the file that it points to is protected.
    fs::rename(folder / "in/m.png", folder / "in/real.png");
    fs::create_symlink("real.png", folder / "in/m.png");
    check_refused(folder, "render in/m.gltf in/real.png --force", "in/real.png", "in/m.gltf");
}

TEST_CASE("lod writes no level if a file of a later level belongs to the input") {
    const Folder folder;
    save_gltf(folder, "in.gltf", "in.bin", "in.png");
    const std::string lod =
        "lod in.gltf . --format gltf --levels 0.5,0.25 --texture-size 64 --image-format png --force --quiet";
    for (const char* name : {"in_LOD2_0.png", "in_LOD2.bin", "in_LOD.json", "in_LOD2.gltf"}) {
        write(folder / name, "precious");
        add_member(folder / "in.gltf", "/extras", {{"uri", name}});
        check_refused(folder, lod, "./" + std::string(name), "in.gltf");
    }
    check_refused(folder, "lod in.gltf new --history in.bin --force --quiet", "in.bin", "in.gltf");
    write(folder / "in_LOD.bin", "precious");
    add_member(folder / "in.gltf", "/extras", {{"uri", "in_LOD.bin"}});
    check_refused(folder, "lod in.gltf in_LOD.gltf --levels 0.5 --force --quiet", "in_LOD.bin", "in.gltf");

    save_obj(folder, "o.obj", "o_LOD1.mtl", "tex.png");
    check_refused(
        folder, "lod o.obj . --format obj --levels 0.5 --texture-size 64 --image-format png --force --quiet",
        "./o_LOD1.mtl", "o.obj");
}

TEST_CASE("truncate does not overwrite the files of its source or its history") {
    const Folder folder;
    save_gltf(folder, "in.gltf", "Avocado.bin", "small_0.png");
    REQUIRE(run(folder, "simplify in.gltf a.glb --history m.bin" + quick).code == 0);
    const std::string options =
        " --faces 40 --source in.gltf --force --quiet --texture-size 64 --image-format png";
    check_refused(folder, "truncate m.bin Avocado.gltf" + options, "Avocado.bin", "in.gltf");
    check_refused(folder, "truncate m.bin small.gltf" + options, "small_0.png", "in.gltf");
    const auto before = contents(folder);
    const Outcome outcome = run(folder, "truncate m.bin m.gltf" + options);
    CHECK(outcome.code == 2);  // the output is an input itself
    CHECK(contains(outcome.err, "m.bin: is the same file as the input m.bin"));
    CHECK(contents(folder) == before);
}

TEST_CASE("batch writes no result if one would overwrite a file that any of its models refers to") {
    const Folder folder;
    fs::create_directories(folder / "in/out");
    save_gltf(folder, "in/a.gltf", "a.bin", "a.png");
    faqem::save(sheet(4), folder / "in/b.glb");
    const std::string batch =
        "batch in in/out --texture-size 64 --image-format png --ratio 0.5 --force --format ";
    for (const auto& [name, format] : std::map<std::string, std::string>{{"b.bin", "gltf"},
                                                                         {"b_3.png", "gltf"},
                                                                         {"b.mtl", "obj"},
                                                                         {"b_0.jpg", "obj"},
                                                                         {"b.ply", "ply"}}) {
        write(folder / ("in/out/" + name), "precious");
        add_member(folder / "in/a.gltf", "/extras", {{"uri", "out/" + name}});
        check_refused(folder, batch + format, "in/out/" + name, "in/a.gltf");
        fs::remove(folder / ("in/out/" + name));
    }
    // A model that cannot be loaded is protected as well.
    write(folder / "in/c.gltf", R"({"images": [{"uri": "out/b.bin"}], )");
    write(folder / "in/out/b.bin", "precious");
    check_refused(folder, batch + "gltf", "in/out/b.bin", "in/c.gltf");
    fs::remove(folder / "in/c.gltf");
    CHECK(run(folder, batch + "gltf").code == 0);
    CHECK(run(folder, batch + "gltf").code == 0);  // its own results are no files of the models
}

TEST_CASE("a profile is an input: it is not overwritten") {
    const ModelFolder folder("in.glb", sheet(4));
    write(folder / "p.json", R"({"faqem-profile": 1, "ratio": 0.5})");
    const auto before = contents(folder);
    const Outcome outcome = run(folder, "simplify in.glb a.glb --config p.json --report p.json --force");
    CHECK(outcome.code == 2);
    CHECK(contains(outcome.err, "p.json: is the same file as the input p.json"));
    CHECK(contents(folder) == before);
}

TEST_CASE("files of other models, missing files and similar names may be written") {
    const Folder folder;
    // The names of a model with a number differ from those of the images of a model without.
    save_gltf(folder, "m_0.gltf", "m_0.bin", "m_0.jpg");
    add_member(folder / "m_0.gltf", "/extras", {{"uri", "later.json"}});
    const auto before = contents(folder);
    REQUIRE(run(folder, "simplify m_0.gltf m.gltf --report later.json" + quick).code == 0);
    const auto after = contents(folder);
    for (const char* name : {"m.gltf", "m.bin", "m_0.png", "later.json"})
        CHECK(after.contains(folder / name));
    for (const auto& [file, content] : before) CHECK(after.at(file) == content);
    // Results are replaced with --force, and the input may be one of the results, with other names.
    CHECK(run(folder, "simplify m_0.gltf m.gltf" + quick).code == 0);
    CHECK(run(folder, "simplify m.gltf m.glb" + quick).code == 0);
    CHECK(run(folder, "lod m.gltf . --format gltf --levels 0.5 --texture-size 64 --image-format png --quiet")
              .code == 0);
}
