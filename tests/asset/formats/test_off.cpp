#include "asset/formats/formats.hpp"

#include "asset/image/srgb.hpp"
#include "support/catch.hpp"
#include "support/format_support.hpp"

using namespace faqem;
using namespace faqem::detail;
using namespace faqem::testing;

namespace {

Asset parse_off(const std::string& text) { return read_off(bytes_of(text), "a.off"); }

std::string off_error(const std::string& text) {
    return message_of([&] { parse_off(text); });
}

}  // namespace

TEST_CASE("all variants of the OFF header are read", "[off]") {
    for (const std::string header :
         {"OFF\n3 1 3\n", "OFF\n3 1\n", "OFF 3 1 3\n", "3 1 3\n", "# c\nOFF # c\n# c\n\n3 1 0 # c\n",
          "OFF\n3\n1\n", "\xEF\xBB\xBFOFF\n3 1 0\n"}) {
        CAPTURE(header);
        const Asset asset = parse_off(header + three_vertices + "3 0 1 2\n");
        CHECK(asset.parts.at(0).positions == std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}});
        CHECK(asset.parts[0].triangles == std::vector<Triangle>{{0, 1, 2}});
        CHECK(asset.parts[0].face_material == std::vector<Index>{no_index});
        CHECK(asset.warnings.empty());
    }
}

TEST_CASE("comments and blank lines are allowed anywhere in an OFF file", "[off]") {
    const std::string text =
        "OFF\n# x\n3 1 0\n0 0 0 # first\n\n# 9 9 9\n1 0 0\n\t1 1 0\n#\n3 0 1 2 # the face\n# end";
    for (const std::string end : {"\n", "\r", "\r\n"}) {
        const Asset asset = parse_off(with_each(text, "\n", end));
        CHECK(asset.parts.at(0).triangles.size() == 1);
        CHECK(asset.warnings.empty());
    }
}

TEST_CASE("OFF normals, colours and UVs are read in the order N, C, ST", "[off]") {
    const Part normals =
        parse_off("NOFF\n3 1 0\n0 0 0 0 0 1\n1 0 0 0 0 1\n1 1 0 0 1 0\n3 0 1 2\n").parts.at(0);
    CHECK(normals.normals.at(2) == Vec3f{0, 1, 0});
    const Part colors =
        parse_off("COFF\n3 1 0\n0 0 0 255 0 51 51\n1 0 0 0 255 0\n1 1 0 1.0 0.5 0\n3 0 1 2\n").parts.at(0);
    CHECK(colors.colors.at(0) == Vec4f{1, 0, static_cast<float>(linear_from_srgb(0.2)), 0.2f});
    CHECK(colors.colors.at(1) == Vec4f{0, 1, 0, 1});
    CHECK(colors.colors.at(2) == Vec4f{1, static_cast<float>(linear_from_srgb(0.5)), 0, 1});
    const Part uvs = parse_off("STOFF\n3 1 0\n0 0 0 0.25 0.25\n1 0 0 1 0\n1 1 0 1 1\n3 0 1 2\n").parts.at(0);
    CHECK(uvs.uvs.at(0).at(0) == Vec2f{0.25f, 0.75f});
    const Part all = parse_off(
                         "STCNOFF\n3 1 0\n0 0 0 0 0 1 255 0 0 0.5 0\n1 0 0 0 0 1 0 0 0 255 1 0\n1 1 0 0 0 1 "
                         "0 0 0 1 1\n3 0 1 2\n")
                         .parts.at(0);
    CHECK(all.normals.at(0) == Vec3f{0, 0, 1});
    CHECK(all.colors.at(0) == Vec4f{1, 0, 0, 1});
    CHECK(all.uvs.at(0).at(0) == Vec2f{0.5f, 1});
    CHECK(all.uvs.at(0).at(1) == Vec2f{1, 1});
}

TEST_CASE("OFF polygons are triangulated and faces with two corners left out", "[off]") {
    const Asset asset = parse_off("OFF\n4 4 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n3 0 1 2\n2 0 1\n1 0\n");
    CHECK(asset.parts[0].triangles == std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {0, 1, 2}});
    CHECK(any_contains(asset.warnings, "2 faces with fewer than three"));
}

TEST_CASE("other kinds of OFF are reported as unsupported", "[off]") {
    for (const std::string keyword : {"4OFF", "nOFF", "4nOFF", "C4OFF", "OFF BINARY", "COFF BINARY"}) {
        CAPTURE(keyword);
        CHECK_THROWS_AS(parse_off(keyword + "\n3 1 0\n"), UnsupportedError);
    }
}

TEST_CASE("OFF errors name the line", "[off]") {
    CHECK(contains(off_error("PLY\n"), "a.off: line 1: is not an OFF file: 'PLY'"));
    CHECK(contains(off_error("# none\n"), "the file is empty"));
    CHECK(contains(off_error("OFF\n3 1 0\n0 0 0\n1,5 0 0\n1 1 0\n3 0 1 2\n"), "a.off: line 4: '1,5'"));
    CHECK(contains(off_error("OFF\n3 1 0\n0 0 0\n1 0\n1 1 0\n3 0 1 2\n"), "line 4: expected a number"));
    CHECK(contains(off_error("OFF\n3 1 0\n0 0 0 1\n1 0 0\n1 1 0\n3 0 1 2\n"), "line 3: unexpected '1'"));
    CHECK(contains(off_error("OFF\n3 1 0\n" + three_vertices + "3 0 1 3\n"),
                   "line 6: face 0: vertex 3 is out of range"));
    CHECK(contains(off_error("OFF\n3 1 0\n" + three_vertices + "3 0 1 -1\n"), "line 6: face 0: vertex -1"));
    CHECK(contains(off_error("OFF\n3 1 0\n" + three_vertices + "3 0 1 2 x\n"), "line 6: 'x'"));
    CHECK(contains(off_error("OFF\n3 2 0\n" + three_vertices + "3 0 1 2\n"), "ends before face 1"));
    CHECK(contains(off_error("OFF\n3 0 0\n" + three_vertices), "a.off: no faces"));
    CHECK(contains(off_error("OFF\n4000000000 1 0\n" + three_vertices), "too short for 4000000000 vertices"));
    CHECK(contains(off_error("OFF\n3 4000000000 0\n" + three_vertices), "4000000000 faces"));
    CHECK(contains(off_error("OFF\n4294967296 1 0\n"), "more than the 4294967295"));
    CHECK(contains(off_error("OFF\n3 1 0\n" + three_vertices + "4000000000 0 1 2\n"),
                   "too short for 4000000000 corners"));
}

TEST_CASE("trailing bytes of an OFF file give a warning and non-finite positions are repaired", "[off]") {
    CHECK(any_contains(parse_off("OFF\n3 1 0\n" + three_vertices + "3 0 1 2\n3 0 1 2").warnings,
                       "7 bytes after"));
    const Asset asset = parse_off("OFF\n4 2 0\n" + three_vertices + "inf 0 0\n3 0 1 2\n3 0 1 3\n");
    CHECK(asset.parts[0].triangles.size() == 1);
    CHECK(any_contains(asset.warnings, "1 vertex with a non-finite position"));
}
