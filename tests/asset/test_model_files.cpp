// Which files a model refers to: those that load() reads, and all that must not be overwritten.

#include "asset/model_files.hpp"

#include <set>

#include "support/catch.hpp"
#include "support/format_support.hpp"

using namespace faqem;
using namespace faqem::testing;
using detail::References;

namespace {

using Names = std::set<std::string>;

/// The files that a model in the folder refers to, relative to the folder.
Names references(const TemporaryFolder& folder, const std::string& model,
                 References which = References::all) {
    Names names;
    for (const fs::path& file : detail::referenced_files(folder / model, which)) {
        const fs::path name = fs::canonical(file).lexically_relative(fs::canonical(folder.path()));
        CHECK(names.insert(name.generic_string()).second);
    }
    return names;
}

void write_files(const TemporaryFolder& folder, const Names& names) {
    for (const std::string& name : names) {
        fs::create_directories((folder / name).parent_path());
        put(folder / name, "content of " + name);
    }
}

}  // namespace

TEST_CASE("the references of glTF are every uri of the document, used or not, in any folder") {
    const TemporaryFolder folder;
    write_files(folder, {"in/a b.bin", "in/used.png", "in/unused.png", "in/t.ktx2", "in/film.mp4",
                         "in/schema.json", "in/note.txt", "shared/up.png", "absolute.bin", "in/other.txt"});
    put(folder / "in/m.gltf", R"({"asset": {"version": "2.0"},
        "buffers": [{"uri": "a%20b.bin"}, {"uri": "data:application/octet-stream;base64,AAAA"},
                    {"uri": "missing.bin"}, {"uri": "http://host/gone.txt"}],
        "images": [{"uri": "used.png"}, {"uri": "./unused.png"}, {"uri": "../shared/up.png"}],
        "textures": [{"extensions": {"KHR_texture_basisu": {"uri": "t.ktx2"}}}],
        "extensions": {"VENDOR_media": {"list": [{"uri": "film.mp4#track=1"}]},
                       "EXT_structural_metadata": {"schemaUri": "schema.json"}},
        "extras": [{"uri": "note.txt"}, {"uri": ")" +
                                  ("file://" + (folder / "absolute.bin").string()) +
                                  R"("}, {"name": "other.txt"}]})");
    CHECK(references(folder, "in/m.gltf") == Names{"in/a b.bin", "in/used.png", "in/unused.png", "in/t.ktx2",
                                                   "in/film.mp4", "in/schema.json", "in/note.txt",
                                                   "shared/up.png", "absolute.bin"});
    CHECK(references(folder, "in/m.gltf", References::readable) ==
          Names{"in/a b.bin", "in/used.png", "in/unused.png"});
}

TEST_CASE("the references of glTF are also the files that are read in place of missing ones") {
    const TemporaryFolder folder;
    write_files(folder, {"in/Tex/a.bin", "in/wood.png", "in/t.ktx2"});
    put(folder / "in/m.gltf", R"({"buffers": [{"uri": "tex\\A.bin"}], "images": [{"uri": "C:/job/Wood.png"}],
        "extras": [{"uri": "C:/T.ktx2"}]})");
    for (const References which : {References::readable, References::all})
        CHECK(references(folder, "in/m.gltf", which) == Names{"in/Tex/a.bin", "in/wood.png"});
}

TEST_CASE("the references of GLB are those of its JSON, and the format is detected by content") {
    const TemporaryFolder folder;
    save(one_part({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}), folder / "in.glb");
    write_files(folder, {"a.png", "b.png"});
    std::string glb = get(folder / "in.glb");
    // An image without a bufferView, written over the generator: the sizes of the chunks stay the same.
    const std::size_t generator = glb.find(R"("generator":"faqem)");
    REQUIRE(generator != std::string::npos);
    const std::size_t end = glb.find('"', generator + 13);
    std::string other = R"("uri":"a.png")";
    other.resize(end + 1 - generator, ' ');
    glb.replace(generator, other.size(), other);
    put(folder / "in.glb", glb);
    CHECK(references(folder, "in.glb") == Names{"a.png"});
    put(folder / "named.obj", glb);
    CHECK(references(folder, "named.obj") == Names{"a.png"});
    put(folder / "json.glb", R"({"images": [{"uri": "b.png"}]})");
    CHECK(references(folder, "json.glb") == Names{"b.png"});
}

TEST_CASE("the references of a damaged glTF file are those before the damage") {
    const TemporaryFolder folder;
    write_files(folder, {"a.bin", "b.png"});
    put(folder / "cut.gltf", R"({"buffers": [{"uri": "a.bin"}], "images": [{"uri": "b.p)");
    CHECK(references(folder, "cut.gltf") == Names{"a.bin"});
    put(folder / "deep.gltf", R"({"buffers": [{"uri": "a.bin"}], "x": )" + std::string(1'000'000, '['));
    CHECK(references(folder, "deep.gltf") == Names{"a.bin"});
}

TEST_CASE("the references of OBJ are its libraries and every texture statement of these") {
    const TemporaryFolder folder;
    const Names textures = {"in/lib/kd.png",   "in/lib/bump.png",  "in/lib/my bump.png", "in/lib/disp.png",
                            "in/lib/refl.png", "in/lib/decal.png", "in/lib/norm.png",    "in/lib/ks.png",
                            "in/lib/odd.png",  "shared/up.png",    "in/lib/d/e.png"};
    write_files(folder, textures);
    write_files(folder, {"in/lib/unrelated.png", "in/kd.png", "shared/other.mtl", "in/shadow.obj"});
    put(folder / "in/m.obj",
        "# a comment\r\nmtllib lib/a.mtl\rmtllib \\\n ../shared/other.mtl\nshadow_obj shadow.obj\nv 0 0 0\n");
    put(folder / "in/lib/a.mtl",
        "map_Ks ks.png\n"  // before the first material
        "newmtl m\nKd 1,5\nmap_Kd -s 1 1 1 -o 0.5 0 kd.png\nmap_Bump -bm 0.2 bump.png\nbump my bump.png\n"
        "disp -mm 0 1 disp.png\nrefl -type sphere -mm 0 1 refl.png\ndecal decal.png\nnorm norm.png\n"
        "MAP_KA -unknown 3 odd.png -clamp on\nmap_d ..\\..\\shared\\up.png\nmap_Ns d\\e.png\n"
        "# map_Kd unrelated.png\n");
    Names all = textures;
    all.insert({"in/lib/a.mtl", "shared/other.mtl", "in/shadow.obj"});
    CHECK(references(folder, "in/m.obj") == all);
    // Files outside the folder of the model are never read.
    put(folder / "shared/other.mtl", "newmtl n\nmap_Kd unread.png\n");
    write_files(folder, {"shared/unread.png"});
    CHECK(references(folder, "in/m.obj") == all);
    for (const char* unread : {"shared/up.png", "shared/other.mtl", "in/shadow.obj"}) all.erase(unread);
    CHECK(references(folder, "in/m.obj", References::readable) == all);
}

TEST_CASE("libraries with blanks in their names, and several in one statement, are found") {
    const TemporaryFolder folder;
    write_files(folder, {"a b.mtl", "c.mtl", "d.MTL", "e.MTL"});
    put(folder / "m.obj", "mtllib a b.mtl c.mtl\nmtllib d.MTL e.MTL\n");
    CHECK(references(folder, "m.obj") == Names{"a b.mtl", "c.mtl", "d.MTL", "e.MTL"});
}

TEST_CASE("the libraries of an OBJ file of many megabytes are found anywhere in it") {
    const TemporaryFolder folder;
    write_files(folder, {"a.mtl", "b.mtl"});
    std::string text;
    while (text.size() < (std::size_t{3} << 20)) text += "v 0.125 0.25 0.5 \\\n0.75\n";
    // The first block of 1 MiB ends within this line.
    const std::string line = "mtllib a.mtl\n";
    text.replace((std::size_t{1} << 20) - 6, line.size() + 1, "\n" + line);
    put(folder / "m.obj", text + std::string(std::size_t{5} << 20, ' ') + "mtllib b.mtl");
    CHECK(references(folder, "m.obj") == Names{"a.mtl", "b.mtl"});
}

TEST_CASE("the references of PLY are the TextureFile comments, and STL and OFF have none") {
    const TemporaryFolder folder;
    write_files(folder, {"my tex.png", "b.png"});
    put(folder / "m.ply",
        "ply\nformat ascii 1.0\ncomment TextureFile my tex.png\nelement nothing\n"
        "comment TextureFile b.png\nend_header\ncomment TextureFile c.png\n");
    CHECK(references(folder, "m.ply") == Names{"my tex.png", "b.png"});
    CHECK(references(folder, "m.ply", References::readable) == Names{"my tex.png", "b.png"});
    for (const char* name : {"m.stl", "m.off", "missing.gltf", "."}) CHECK(references(folder, name).empty());
}
