#include "asset/formats/formats.hpp"

#include <cmath>

#include "support/catch.hpp"
#include "support/format_support.hpp"

using namespace faqem;
using namespace faqem::detail;
using namespace faqem::testing;

namespace {

Asset parse_obj(const std::string& text) { return read_obj(bytes_of(text), "a.obj"); }

std::string obj_error(const std::string& text) {
    return message_of([&] { parse_obj(text); });
}

const std::string square_vertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

}  // namespace

TEST_CASE("vertices and faces keep their order and indices", "[obj]") {
    const Asset asset = parse_obj(square_vertices + "v 9 9 9\nf 1 2 3\nf 1 3 4\n");
    REQUIRE(asset.parts.size() == 1);
    const Part& part = asset.parts[0];
    CHECK(part.positions.size() == 5);  // the unreferenced vertex is kept
    CHECK(part.positions[2] == Vec3{1, 1, 0});
    CHECK(part.triangles == std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}});
    CHECK(part.face_material == std::vector<Index>{no_index, no_index});
    CHECK(part.normals.empty());
    CHECK(part.uvs.empty());
    CHECK(part.colors.empty());
    CHECK(part.name == "a");
    CHECK(asset.materials.empty());
    CHECK(asset.warnings.empty());
}

TEST_CASE("face corners with and without UVs and normals are read", "[obj]") {
    const std::string attributes = square_vertices + "vt 0.25 0.75\nvt 0.5 1\nvn 0 0 1\nvn 0 1 0\n";
    const Part plain = parse_obj(attributes + "f 1 2 3\n").parts[0];
    CHECK(plain.uvs.empty());
    CHECK(plain.normals.empty());
    const Part uv = parse_obj(attributes + "f 1/1 2/2 3/1\n").parts[0];
    REQUIRE(uv.uvs.size() == 1);
    CHECK(uv.uvs[0][0] == Vec2f{0.25f, 0.25f});  // v points down
    CHECK(uv.uvs[0][1] == Vec2f{0.5f, 0});
    CHECK(uv.normals.empty());
    const Part normal = parse_obj(attributes + "f 1//1 2//2 3//1\n").parts[0];
    CHECK(normal.uvs.empty());
    CHECK(normal.normals[1] == Vec3f{0, 1, 0});
    CHECK(normal.normals[3] == Vec3f{0, 0, 0});  // unreferenced vertex
    const Part both = parse_obj(attributes + "f 1/1/2 2/2/1 3/1/2\n").parts[0];
    CHECK(both.uvs[0][1] == Vec2f{0.5f, 0});
    CHECK(both.normals[0] == Vec3f{0, 1, 0});
    // Trailing slashes, which some exporters write.
    CHECK(parse_obj(attributes + "f 1/ 2/ 3/\n").parts[0].uvs.empty());
    CHECK(parse_obj(attributes + "f 1/1/ 2/1/ 3/1/\n").parts[0].normals.empty());
}

TEST_CASE("a position with several UVs or normals gives one vertex per combination", "[obj]") {
    const Part part =
        parse_obj(square_vertices + "vt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\nf 1/2 3/3 4/1\nf 1/2 2/2 4/1\n")
            .parts[0];
    CHECK(part.triangles == std::vector<Triangle>{{0, 1, 2}, {4, 2, 3}, {4, 1, 3}});
    CHECK(part.positions.size() == 5);
    CHECK(part.positions[4] == part.positions[0]);
    CHECK(part.uvs[0][4] == Vec2f{1, 1});
}

TEST_CASE("a fan of 20000 faces with different normals at its centre is split correctly", "[obj]") {
    std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    const int n = 20000;
    for (int i = 0; i < n; ++i) text += "vn 0 " + std::to_string(i + 1) + " 1\n";
    for (int i = 1; i <= n; ++i) text += "f 1//" + std::to_string(i) + " 2//1 3//1\n";
    const Part part = parse_obj(text).parts[0];
    CHECK(part.positions.size() == 3u + n - 1);
    bool right = true;
    for (int i = 0; i < n; ++i) right &= part.normals[part.triangles[i][0]][1] == float(i + 1);
    CHECK(right);
}

TEST_CASE("negative indices are relative to the elements read so far", "[obj]") {
    const std::string text =
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nvt 0 1\nf -3/-2 -2/-1 -1/1\n"
        "v 5 0 0\nv 6 0 0\nv 6 1 0\nf -3 -2 -1\nf 1 -2 2\n";
    const Part part = parse_obj(text).parts[0];
    CHECK(part.triangles == std::vector<Triangle>{{0, 1, 2}, {3, 4, 5}, {6, 4, 7}});
    CHECK(part.positions[6] == Vec3{0, 0, 0});  // vertex 1 without its UV
    CHECK(part.uvs[0][1] == Vec2f{0, 0});
}

TEST_CASE("positive indices may refer to later elements", "[obj]") {
    CHECK(parse_obj("f 1 2 3\n" + square_vertices).parts[0].triangles == std::vector<Triangle>{{0, 1, 2}});
    CHECK(contains(obj_error("f 1 2 5\n" + square_vertices),
                   "a.obj: line 1: index 5 of a position is out of range: there are 4"));
}

TEST_CASE("indices out of range are errors that name the line", "[obj]") {
    CHECK(contains(obj_error(square_vertices + "f 1 2 0\n"), "a.obj: line 5: index 0 of a position"));
    CHECK(contains(obj_error(square_vertices + "f 1 2 5\n"), "a.obj: line 5: index 5 of a position"));
    CHECK(contains(obj_error(square_vertices + "f 1 2 -5\n"), "a.obj: line 5: index -5 of a position"));
    CHECK(contains(obj_error(square_vertices + "vt 0 0\nf 1/1 2/2 3/1\n"),
                   "line 6: index 2 of a texture coordinate"));
    CHECK(contains(obj_error(square_vertices + "f 1//1 2//1 3//1\n"), "line 5: index 1 of a normal"));
    CHECK(contains(obj_error(square_vertices + "f 1//0 2//1 3//1\n"), "line 5: index 0 of a normal"));
    CHECK(contains(obj_error(square_vertices + "f 1 2 4294967296\n"), "line 5: index 4294967296"));
    CHECK(contains(obj_error(square_vertices + "f 1 2 99999999999999999999\n"), "line 5: "));
}

TEST_CASE("invalid numbers are errors that name the line", "[obj]") {
    CHECK(contains(obj_error("v 0 0 0\nv 1,5 0 0\n"), "a.obj: line 2: '1,5' is not a number"));
    CHECK(contains(obj_error("v 0 0\n"), "line 1: v has 2 numbers"));
    CHECK(contains(obj_error("v 0 0 0 1 1\n"), "line 1: v has 5 numbers"));
    CHECK(contains(obj_error("vn 0 0\n"), "line 1: expected a number"));
    CHECK(contains(obj_error("vt\n"), "line 1: expected a number"));
    CHECK(contains(obj_error("vn 0 0 1 1\n"), "line 1: unexpected '1'"));
    CHECK(contains(obj_error(square_vertices + "f 1 2 x\n"), "line 5: 'x' is not an index"));
    CHECK(contains(obj_error(square_vertices + "f 1 2 3.5\n"),
                   "line 5: '.5' is not part of a valid face corner"));
    CHECK(contains(obj_error(square_vertices + "f 1/1/1/1 2 3\n"), "line 5: "));
}

TEST_CASE("line ends, byte order mark, comments and continuation lines do not change the result", "[obj]") {
    const std::string text = square_vertices + "vt 0 1\nf 1/1 2/1 3/1 4/1\n";
    const Part expected = parse_obj(text).parts[0];
    const auto replaced = [&](const std::string& line_end) { return with_each(text, "\n", line_end); };
    for (const std::string& variant :
         {replaced("\r\n"), replaced("\r"), replaced("\n\n"), replaced(" # comment 1 2 3\n"),
          "\xEF\xBB\xBF" + text, text.substr(0, text.size() - 1), std::string("# a\\\n") + text,
          square_vertices + "vt \\\n 0\\\r\n 1\nf 1/1 2/1 \\\n3/1\\\n4/1", "  \t" + text}) {
        CAPTURE(variant);
        const Part part = parse_obj(variant).parts[0];
        CHECK(part.positions == expected.positions);
        CHECK(part.triangles == expected.triangles);
        CHECK(part.uvs == expected.uvs);
    }
}

TEST_CASE("errors after continuation lines name the correct line", "[obj]") {
    CHECK(contains(obj_error("v 0 \\\n0 \\\r\n0\nv 1 x 0\n"), "line 4: 'x'"));
}

TEST_CASE("a line of ten megabytes is read", "[obj]") {
    std::string text = "v 0 0 0\n#";
    text.append(10'000'000, 'x');
    text += '\n';
    const int n = 100'000;
    text += "v 1 0 0\nv 1 1 0\nf";
    for (int i = 0; i < n; ++i) text += " 1 2 3" + std::string(94, i % 2 ? ' ' : '\t');
    const Part part = parse_obj(text).parts[0];
    CHECK(part.triangles.size() == 3u * n - 2);
}

TEST_CASE("concave polygons are triangulated inside", "[obj]") {
    const Part part = parse_obj("v 0 0 0\nv 4 0 0\nv 1 1 0\nv 0 4 0\nf 1 2 3 4\n").parts[0];
    REQUIRE(part.triangles.size() == 2);
    for (const Triangle& t : part.triangles) {
        const Vec3 &a = part.positions[t[0]], &b = part.positions[t[1]], &c = part.positions[t[2]];
        CHECK((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) == Approx(4));
    }
}

TEST_CASE("objects have faces, and are continued by an equal name", "[obj]") {
    const auto read = [](const std::string& text) {
        return parse_obj(square_vertices + "v 0 0 nan\n" + text).parts.at(0);
    };
    Part part = read("o empty\no b\nf 1 2 3 4\no a\nf 1 2 3\no b\nf 1 3 4\n");
    CHECK(part.name == "empty");
    CHECK(part.object_names == std::vector<std::string>{"b", "a"});
    CHECK(part.face_object == std::vector<Index>{0, 0, 1, 0});  // one for each triangle
    part = read("f 1 2 3\no b\nf 1 2 3\n");
    CHECK(part.object_names == std::vector<std::string>{"a", "b"});  // the first is named after the file
    part = read("o empty\no b\nf 1 2 3\n");
    CHECK(part.face_object.empty());
    CHECK(part.object_names.empty());
    part = read("o a\nf 1 2 5\nf 1 2 3\no b\nf 1 3 4\n");  // a face with a non-finite position is left out
    CHECK(part.face_object == std::vector<Index>{0, 1});
}

TEST_CASE("warnings count lines, points and unknown statements", "[obj]") {
    const Asset asset =
        parse_obj(square_vertices + "l 1 2\nl 2 3\np 1\ncurv 0 1\\\n 2 3\nfoo\nf 1 2 3\nf 1 2\n");
    CHECK(asset.parts[0].triangles.size() == 1);
    CHECK(any_contains(asset.warnings, "3 line or point statements"));
    CHECK(any_contains(asset.warnings, "2 unknown statements ignored, first 'curv' in line 8"));
    CHECK(any_contains(asset.warnings, "1 face with fewer than three corners"));
    CHECK(asset.not_understood.empty());
}

TEST_CASE("groups are names of faces, and the default group is none", "[obj]") {
    const Asset asset = parse_obj(square_vertices +
                                  "v 0 0 nan\nf 1 2 3\ng empty\ng a  b\nf 1 2 3 4\nf 1 2 5\ng\nf 1 2 3\ng c\n"
                                  "f 1 2 3\ng default\nf 1 2 3\ng a  b\nf 1 2 3\n");
    const Part& part = asset.parts[0];
    CHECK(part.group_names == std::vector<std::string>{"a  b", "c"});
    CHECK(part.face_group == std::vector<Index>{no_index, 0, 0, no_index, 1, no_index, 0});
    CHECK(part.face_object.empty());
    CHECK(asset.not_understood.empty());
    CHECK(parse_obj(square_vertices + "g default\nf 1 2 3\ng x\n").parts[0].face_group.empty());
}

TEST_CASE("non-finite numbers are repaired and counted", "[obj]") {
    const std::string text =
        "v 0 0 0\nv nan 0 0\nv 1 0 0\nv 1 1 0\nv 0 1e999 0\nvt nan 0\nvn inf 0 0\n"
        "f 1/1/1 3/1/1 4/1/1\nf 1 2 3 4\nf 1 3 5\n";
    const Asset asset = parse_obj(text);
    const Part& part = asset.parts[0];
    CHECK(part.triangles == std::vector<Triangle>{{0, 1, 2}});
    CHECK(part.positions[1] == Vec3{1, 0, 0});
    CHECK(part.uvs[0][0] == Vec2f{0, 0});
    CHECK(part.normals[0] == Vec3f{0, 0, 0});
    CHECK(
        any_contains(asset.warnings, "2 vertices with a non-finite position and 2 adjacent faces left out"));
    CHECK(any_contains(asset.warnings, "3 non-finite vectors of uvs 0"));
    CHECK(any_contains(asset.warnings, "3 non-finite vectors of normals"));
    for (const Vec3& p : part.positions)
        for (const double x : p) CHECK(std::isfinite(x));
    CHECK(contains(obj_error("v nan 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n"),
                   "a.obj: no faces with finite positions"));
}

TEST_CASE("a file without faces is an error", "[obj]") {
    for (const std::string text : {"", "# nothing\n", "v 0 0 0\n", "\xEF\xBB\xBF", "hello world\n"})
        CHECK(contains(obj_error(text), "a.obj: no faces"));
}

TEST_CASE("coordinates from 1e-30 to 1e30 are read exactly", "[obj]") {
    const Part part = parse_obj("v 1e30 1e-30 -0.1\nv 1 0 0\nv 1 1 0\nf 1 2 3\n").parts[0];
    CHECK(part.positions[0] == Vec3{1e30, 1e-30, -0.1});
}
