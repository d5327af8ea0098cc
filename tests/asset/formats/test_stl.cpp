#include "asset/formats/formats.hpp"

#include <bit>
#include <limits>

#include "support/catch.hpp"
#include "support/format_support.hpp"

using namespace faqem;
using namespace faqem::detail;
using namespace faqem::testing;

namespace {

Asset parse_stl(const std::string& text) { return read_stl(bytes_of(text), "a.stl"); }

std::string stl_error(const std::string& text) {
    return message_of([&] { parse_stl(text); });
}

std::string u32_text(std::uint32_t value) {
    std::string text;
    for (int shift = 0; shift < 32; shift += 8) text += static_cast<char>(value >> shift);
    return text;
}

std::string facet(const std::vector<float>& corners) {
    std::string text(12, '\0');
    for (const float x : corners) text += u32_text(std::bit_cast<std::uint32_t>(x));
    return text + std::string(2, '\0');
}

std::string binary(const std::string& start, const std::vector<std::string>& facets) {
    std::string text =
        start + std::string(80 - start.size(), ' ') + u32_text(static_cast<std::uint32_t>(facets.size()));
    for (const std::string& f : facets) text += f;
    return text;
}

const std::string ascii_facet =
    " facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 1 0 0\n   vertex 1 1 0\n  endloop\n "
    "endfacet\n";

}  // namespace

TEST_CASE("binary STL corners at equal positions share a vertex, and -0 equals 0", "[stl]") {
    for (const std::string start : {"", "solid like a text"}) {
        const Asset asset = parse_stl(
            binary(start, {facet({0, 0, 0, 1, 0, 0, 1, 1, 0}), facet({-0.0f, 0, -0.0f, 1, 1, 0, 0, 1, 0})}));
        const Part& part = asset.parts.at(0);
        CHECK(part.triangles == std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}});
        CHECK(part.positions == std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
        CHECK(!std::signbit(part.positions[0][0]));
        CHECK(part.face_material.size() == 2);
        CHECK(asset.warnings.empty());
    }
}

TEST_CASE("binary STL files with a wrong facet count or bytes at the end are read with a warning", "[stl]") {
    const std::string good =
        binary("solid x", {facet({0, 0, 0, 1, 0, 0, 1, 1, 0}), facet({0, 0, 0, 1, 1, 0, 0, 1, 0})});
    const auto with_count = [&](std::uint32_t count) {
        std::string text = good;
        return text.replace(80, 4, u32_text(count));
    };
    struct Deviation {
        std::string text;
        std::size_t facets;
        std::string warning;
    };
    const std::vector<Deviation> deviations = {
        {good + "x", 2, "1 byte after the last facet ignored"},
        {good + std::string(1000, 'x'), 2, "1000 bytes after the last facet ignored"},
        {with_count(1), 1, "50 bytes after the last facet ignored"},
        {with_count(0), 2, "the header states 0 facets, the file has room for 2, which are read"},
        {with_count(0xffffffff), 2, "the header states 4294967295 facets, the file has room for 2"},
        {good.substr(0, good.size() - 1), 1, "the header states 2 facets, the file has room for 1"}};
    for (const Deviation& deviation : deviations) {
        const Asset asset = parse_stl(deviation.text);
        CHECK(asset.parts.at(0).triangles.size() == deviation.facets);
        CHECK(any_contains(asset.warnings, deviation.warning));
    }
}

TEST_CASE("files that are hardly STL are errors", "[stl]") {
    CHECK(contains(stl_error(std::string(20, '\0')), "neither ASCII STL nor long enough"));
    CHECK(contains(stl_error(binary("", {})), "a.stl: no faces"));
    CHECK(contains(stl_error(binary("", {}) + "rest"), "a.stl: no faces"));
    const std::string cut = binary("", {facet({0, 0, 0, 1, 0, 0, 1, 1, 0})}).substr(0, 100);
    CHECK(contains(stl_error(cut), "a.stl: header: the header states 1 facet, the file has room for 0"));
    std::string junk = binary("", {facet({0, 0, 0, 1, 0, 0, 1, 1, 0})}) + std::string(50, '\xff');
    junk.replace(80, 4, u32_text(0));
    CHECK(contains(stl_error(junk), "facet 1 is not finite"));
}

TEST_CASE("a colour that does not fit into the header of an STL file is none", "[stl]") {
    const std::string header = std::string(72, ' ') + "COLOR=ab";
    CHECK(parse_stl(binary(header, {facet({0, 0, 0, 1, 0, 0, 1, 1, 0})})).parts.at(0).colors.empty());
}

TEST_CASE("the solids of an ASCII STL file are objects", "[stl]") {
    const Part part = parse_stl("solid a b\n" + ascii_facet + ascii_facet +
                                "endsolid\nsolid none\nendsolid\nsolid\n" + ascii_facet + "endsolid\n")
                          .parts.at(0);
    CHECK(part.name == "a");
    CHECK(part.object_names == std::vector<std::string>{"a b", "a"});  // without a name: that of the file
    CHECK(part.face_object == std::vector<Index>{0, 0, 1});
    CHECK(parse_stl("solid x\n" + ascii_facet + "endsolid x\n").parts.at(0).face_object.empty());
}

TEST_CASE("ASCII STL files with several solids, any letter case and any line end are read", "[stl]") {
    const std::string text =
        "solid a b c\n" + ascii_facet + ascii_facet + "endsolid a b c\n\nsolid\n" + ascii_facet + "endsolid";
    std::string upper = text;
    for (char& c : upper) c = static_cast<char>(std::toupper(c));
    for (const std::string& variant : {text, upper, with_each(text, "\n", "\r"), "\xEF\xBB\xBF" + text}) {
        const Part part = parse_stl(variant).parts.at(0);
        CHECK(part.triangles.size() == 3);
        CHECK(part.positions.size() == 3);
    }
    CHECK(parse_stl("solid\nfacet normal nan nan nan\nouter loop\nvertex 1e-3 0 0\nvertex +1 0 0\nvertex 1 1 "
                    "0\nendloop\n"
                    "endfacet\nendsolid\n")
              .parts[0]
              .positions[0] == Vec3{0.001, 0, 0});
}

TEST_CASE("invalid ASCII STL is an error that names the line", "[stl]") {
    const std::string good = "solid\n" + ascii_facet + "endsolid\n";
    const auto with = [&](const std::string& what, const std::string& by) {
        return stl_error(with_first(good, what, by));
    };
    CHECK(contains(with("vertex 1 0 0", "vertex 1,5 0 0"), "a.stl: line 5: '1,5' is not a number"));
    CHECK(contains(with("   vertex 1 1 0\n", ""), "line 6: 'endloop' instead of 'vertex'"));
    CHECK(contains(with("  endloop", "vertex 0 1 0\n  endloop"), "instead of 'endloop'"));
    CHECK(contains(with("endsolid\n", ""), "the file ends where 'endsolid'"));
    CHECK(contains(stl_error("solid\nendsolid\n"), "a.stl: no faces"));
    CHECK(contains(stl_error(" "), "the file ends where 'solid'"));
    CHECK(contains(stl_error("hello"), "'hello' instead of 'solid'"));
    CHECK(contains(stl_error(good + "sold\n" + ascii_facet), "'sold' instead of 'solid'"));
}

TEST_CASE("non-finite STL positions are repaired", "[stl]") {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const Asset asset =
        parse_stl(binary("", {facet({0, 0, 0, 1, 0, 0, 1, 1, 0}), facet({0, 0, 0, 1, 0, 0, nan, 1, 0})}));
    CHECK(asset.parts[0].triangles.size() == 1);
    CHECK(asset.parts[0].positions.size() == 3);
    CHECK(asset.warnings.size() == 1);
}

TEST_CASE("an STL file is unchanged by reading and writing", "[stl]") {
    const TemporaryFolder folder;
    const Asset asset = one_part({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0.25, 3}}, {{0, 1, 2}, {0, 2, 3}});
    CHECK(save(asset, folder / "a.stl", Overwrite::no).empty());
    const std::string bytes = get(folder / "a.stl");
    CHECK(bytes.size() == 84 + 2 * 50);
    CHECK(bytes.substr(84, 12) ==
          u32_text(0) + u32_text(0) + u32_text(std::bit_cast<std::uint32_t>(1.0f)));  // facet normal
    const Asset back = load(folder / "a.stl");
    CHECK(back.parts[0].positions == asset.parts[0].positions);
    CHECK(back.parts[0].triangles == asset.parts[0].triangles);
    save(back, folder / "b.stl", Overwrite::no);
    CHECK(get(folder / "b.stl") == bytes);
}

TEST_CASE("the STL writer reports what it leaves out and rejects coordinates too large for float", "[stl]") {
    const TemporaryFolder folder;
    Asset asset = one_part({{0.1, 0, 0}, {1, 0, 0}, {1, 1, 0}}, {{0, 1, 2}});
    asset.materials.emplace_back();
    asset.parts[0].uvs.resize(1, std::vector<Vec2f>(3));
    asset.parts[0].normals.resize(3);
    asset.parts[0].colors.resize(3);
    const auto losses = save(asset, folder / "a.stl", Overwrite::no);
    for (const char* what : {"double precision", "normals", "texture coordinates", "colours", "materials"})
        CHECK(any_contains(losses, what));
    asset.parts[0].positions[0][0] = 1e39;
    CHECK_THROWS_AS(save(asset, folder / "b.stl", Overwrite::no), WriteError);
}
