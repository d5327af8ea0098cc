#include "asset/formats/formats.hpp"

#include <algorithm>
#include <array>
#include <bit>

#include "asset/image/srgb.hpp"
#include "support/catch.hpp"
#include "support/format_support.hpp"

using namespace faqem;
using namespace faqem::detail;
using namespace faqem::testing;

namespace {

Asset parse_ply(const std::string& text) { return read_ply(bytes_of(text), "a.ply"); }

std::string ply_error(const std::string& text) {
    return message_of([&] { parse_ply(text); });
}

/// Concatenates the bytes of values in little-endian or big-endian order.
class Binary {
public:
    explicit Binary(bool big) : big_(big) {}
    template <class T>
    Binary& put(T value) {
        auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
        if (big_ != (std::endian::native == std::endian::big)) std::reverse(raw.begin(), raw.end());
        text_.append(raw.data(), raw.size());
        return *this;
    }
    const std::string& text() const { return text_; }

private:
    bool big_;
    std::string text_;
};

const std::string xyz = "property float x\nproperty float y\nproperty float z\n";

std::string ascii(const std::string& vertex, const std::string& face, const std::string& data,
                  int vertices = 3, int faces = 1) {
    return "ply\nformat ascii 1.0\nelement vertex " + std::to_string(vertices) + "\n" + xyz + vertex +
           "element face " + std::to_string(faces) + "\n" + face + "end_header\n" + data;
}

const std::string indices = "property list uchar int vertex_indices\n";

}  // namespace

TEST_CASE("an ASCII PLY file is read", "[ply]") {
    const Asset asset = parse_ply(ascii("", indices, three_vertices + "3 0 1 2\n"));
    CHECK(asset.parts.at(0).positions == std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}});
    CHECK(asset.parts[0].triangles == std::vector<Triangle>{{0, 1, 2}});
    CHECK(asset.parts[0].face_material == std::vector<Index>{no_index});
    CHECK(asset.parts[0].name == "a");
    CHECK(asset.warnings.empty());
}

TEST_CASE("PLY headers with other line ends, comments, obj_info and other type names are read", "[ply]") {
    const std::string text =
        "ply\ncomment made by hand\nformat ascii 1.0\nobj_info num 1\nelement vertex 3\nproperty float64 x\n"
        "property double y\nproperty float32 z\ncomment between\nelement face 1\n"
        "property list uint8 uint32 vertex_index\nend_header\n0.1 0 0\n1 0 0\n\n1 1 0\n3 0 1 2";
    for (const std::string end : {"\n", "\r\n", "\r"}) {
        const Part part = parse_ply(with_each(text, "\n", end)).parts.at(0);
        CHECK(part.positions[0] == Vec3{0.1, 0, 0});
        CHECK(part.triangles.size() == 1);
    }
}

TEST_CASE("binary PLY files of both byte orders with all number and list types are read", "[ply]") {
    for (const bool big : {false, true}) {
        CAPTURE(big);
        const std::string header =
            std::string("ply\nformat binary_") + (big ? "big" : "little") +
            "_endian 1.0\nelement other 2\nproperty list ushort double a\nproperty char b\n"
            "element vertex 4\nproperty short x\nproperty list int8 float skip\nproperty double y\n"
            "property int z\nproperty uchar extra\nelement face 2\nproperty float before\n"
            "property list uint ushort vertex_indices\nproperty list short uint after\nend_header\n";
        Binary data(big);
        data.put<std::uint16_t>(2).put(1.5).put(2.5).put<std::int8_t>(-1);
        data.put<std::uint16_t>(0).put<std::int8_t>(-1);
        const std::array<std::array<double, 3>, 4> points = {
            {{0, 0, 0}, {1, 0.5, 0}, {1, 1, -70000}, {-300, 1, 0}}};
        for (const auto& p : points) {
            data.put(static_cast<std::int16_t>(p[0])).put<std::int8_t>(1).put(9.0f).put(p[1]);
            data.put(static_cast<std::int32_t>(p[2])).put<std::uint8_t>(7);
        }
        data.put(1.0f).put<std::uint32_t>(3);
        for (const std::uint16_t i : {0, 1, 2}) data.put(i);
        data.put<std::int16_t>(1).put<std::uint32_t>(5);
        data.put(1.0f).put<std::uint32_t>(4);
        for (const std::uint16_t i : {0, 1, 2, 3}) data.put(i);
        data.put<std::int16_t>(0);
        const Asset asset = parse_ply(header + data.text());
        const Part& part = asset.parts.at(0);
        for (std::size_t v = 0; v < 4; ++v) CHECK(part.positions[v] == points[v]);
        CHECK(part.triangles.size() == 3);
        CHECK(part.triangles[0] == Triangle{0, 1, 2});
        CHECK(asset.warnings.empty());
    }
}

TEST_CASE("PLY data after a header with CR line ends may start with a line feed", "[ply]") {
    std::string header =
        "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty uchar x\nproperty uchar y\n"
        "property uchar z\nelement face 1\nproperty list uchar uchar vertex_indices\nend_header\n";
    std::replace(header.begin(), header.end(), '\n', '\r');
    const Part part = parse_ply(header + std::string("\x0A\0\0\1\0\0\0\1\0\3\0\1\2", 13)).parts.at(0);
    CHECK(part.positions[0] == Vec3{10, 0, 0});
}

TEST_CASE("PLY vertex normals, colours and UVs are read", "[ply]") {
    const std::string properties =
        "property float nx\nproperty float ny\nproperty float nz\nproperty uchar red\nproperty uchar green\n"
        "property uchar blue\nproperty uchar alpha\nproperty float s\nproperty float t\n";
    const Part part = parse_ply(ascii(properties, indices,
                                      "0 0 0 0 0 1 255 128 0 51 0.5 0.25\n1 0 0 0 0 1 0 0 0 255 0 0\n"
                                      "1 1 0 0 0 1 0 0 0 255 0 0\n3 0 1 2\n"))
                          .parts.at(0);
    CHECK(part.normals.at(0) == Vec3f{0, 0, 1});
    CHECK(part.colors.at(0) == Vec4f{1, static_cast<float>(linear_from_srgb(128 / 255.0)), 0, 0.2f});
    CHECK(part.uvs.at(0).at(0) == Vec2f{0.5f, 0.75f});
}

TEST_CASE("alternative names and types of PLY colours and UVs are read", "[ply]") {
    const std::string data = "0 0 0 1 0.5 0 0.5 1\n1 0 0 1 0.5 0 0 0\n1 1 0 1 0.5 0 0 0\n3 0 1 2\n";
    for (const std::string names :
         {"r g b u v", "red green blue texture_u texture_v", "diffuse_red diffuse_green diffuse_blue s t"}) {
        const std::string properties = "property float " + with_each(names, " ", "\nproperty float ");
        const Part part = parse_ply(ascii(properties + "\n", indices, data)).parts.at(0);
        CHECK(part.colors.at(0) == Vec4f{1, static_cast<float>(linear_from_srgb(0.5)), 0, 1});
        CHECK(part.uvs.at(0).at(0) == Vec2f{0.5f, 0});
    }
    const Part wide = parse_ply(ascii("property ushort red\nproperty ushort green\nproperty ushort blue\n",
                                      indices, "0 0 0 65535 0 0\n1 0 0 0 0 0\n1 1 0 0 0 0\n3 0 1 2\n"))
                          .parts.at(0);
    CHECK(wide.colors.at(0) == Vec4f{1, 0, 0, 1});
}

TEST_CASE("float colours slightly above 1 are not from 0 to 255", "[ply]") {
    const std::string rgb = "property float red\nproperty float green\nproperty float blue\n";
    const Asset bright =
        parse_ply(ascii(rgb, indices, "0 0 0 1.5 0.5 0\n1 0 0 0 0 0\n1 1 0 0 0 0\n3 0 1 2\n"));
    CHECK(bright.warnings.empty());
    CHECK(bright.parts.at(0).colors[0][1] == static_cast<float>(linear_from_srgb(0.5)));
}

TEST_CASE("PLY polygons are triangulated, and faces may precede vertices", "[ply]") {
    const Asset asset = parse_ply("ply\nformat ascii 1.0\nelement face 2\n" + indices + "element vertex 4\n" +
                                  xyz + "end_header\n4 0 1 2 3\n2 0 1\n0 0 0\n4 0 0\n1 1 0\n0 4 0\n");
    REQUIRE(asset.parts.at(0).triangles.size() == 2);
    CHECK(any_contains(asset.warnings, "1 face with fewer than three"));
    // Corner 2 is reflex: the diagonal starts at it and does not connect 1 and 3.
    for (const Triangle& t : asset.parts[0].triangles) CHECK(std::count(t.begin(), t.end(), 2u) == 1);
}

//  0---2---4        strip 0 1 2 3 4 5: the winding of every second triangle is reversed
//   \ / \ / \       .
//    1---3---5
TEST_CASE("PLY triangle strips are read with consistent winding", "[ply]") {
    const std::string header = "ply\nformat ascii 1.0\nelement vertex 6\n" + xyz +
                               "element tristrips 1\nproperty list int int vertex_indices\nend_header\n";
    const Part part =
        parse_ply(header + "0 1 0\n0 0 0\n1 1 0\n1 0 0\n2 1 0\n2 0 0\n10 0 1 2 3 4 5 -1 3 4 5\n").parts.at(0);
    CHECK(part.triangles == std::vector<Triangle>{{0, 1, 2}, {2, 1, 3}, {2, 3, 4}, {4, 3, 5}, {3, 4, 5}});
    CHECK(contains(ply_error(header + three_vertices + three_vertices + "3 0 1 -2\n"),
                   "vertex -2 is out of range"));
}

TEST_CASE("PLY counts are checked against the file size before memory is allocated", "[ply]") {
    const auto file = [](const std::string& format, const std::string& vertices, const std::string& faces) {
        return "ply\nformat " + format + " 1.0\nelement vertex " + vertices + "\n" + xyz + "element face " +
               faces + "\n" + indices + "end_header\n";
    };
    for (const std::string format : {"ascii", "binary_little_endian"}) {
        CHECK(contains(ply_error(file(format, "4000000000", "1")),
                       "a.ply: element vertex: the file is too short"));
        CHECK(contains(ply_error(file(format, "0", "4000000000")),
                       "a.ply: element face: the file is too short"));
        CHECK(contains(ply_error(file(format, "4294967296", "1")), "more than the 4294967295"));
        CHECK(contains(ply_error(file(format, "18446744073709551615", "1")), "more than the 4294967295"));
        CHECK(contains(ply_error(file(format, "99999999999999999999", "1")), "a.ply: line 3: "));
        CHECK(contains(ply_error(file(format, "-1", "1")), "a.ply: line 3: "));
    }
    const std::string long_list = "ply\nformat binary_little_endian 1.0\nelement vertex 0\n" + xyz +
                                  "element face 1\nproperty list uint double vertex\nproperty list uint int "
                                  "vertex_indices\nend_header\n";
    CHECK(contains(ply_error(long_list + std::string("\xFF\xFF\xFF\xFF\0\0\0\0", 8)),
                   "a.ply: the file is too short for a list of 4294967295 (face 0)"));
    // Rows without properties take no bytes, so any number of them is valid.
    CHECK(parse_ply("ply\nformat ascii 1.0\nelement nothing 4000000000\nelement vertex 3\n" + xyz +
                    "element face 1\n" + indices + "end_header\n" + three_vertices + "3 0 1 2\n")
              .parts.size() == 1);
}

TEST_CASE("PLY errors name the element and its index", "[ply]") {
    CHECK(contains(ply_error(ascii("", indices, "0 0 0\n1 0 x\n1 1 0\n3 0 1 2\n")),
                   "a.ply: line 11: 'x' is not a number (vertex 1)"));
    CHECK(contains(ply_error(ascii("", indices, "0 0 0\n1 0\n1 1 0\n3 0 1 2\n")), "(vertex 1)"));
    CHECK(contains(ply_error(ascii("", indices, "0 0 0\n1 0 0 7\n1 1 0\n3 0 1 2\n")),
                   "unexpected '7' (vertex 1)"));
    CHECK(contains(ply_error(ascii("", indices, three_vertices + "3 0 1 3\n")),
                   "vertex 3 is out of range: there are 3 (face 0)"));
    CHECK(
        contains(ply_error(ascii("", indices, three_vertices + "3 0 1 -1\n")), "vertex -1 is out of range"));
    CHECK(contains(ply_error(ascii("", indices, three_vertices + "300 0 1 2\n")), "'300' is not a number"));
    CHECK(contains(ply_error(ascii("", indices, three_vertices + "3 0 1 2.0\n")), "(face 0)"));
    CHECK(contains(
        ply_error(ascii("", "property list char int vertex_indices\n", three_vertices + "-3 0 1 2\n")),
        "negative length (face 0)"));
}

TEST_CASE("invalid PLY headers are errors that name the line", "[ply]") {
    const std::string good = ascii("", indices, three_vertices + "3 0 1 2\n");
    const auto with = [&](const std::string& what, const std::string& by) {
        return ply_error(with_first(good, what, by));
    };
    CHECK(contains(ply_error("solid"), "does not start with 'ply'"));
    CHECK(contains(with("ascii 1.0", "ascii 2.0"), "line 2: only version 1.0"));
    CHECK(contains(with("ascii", "text"), "line 2: unknown format 'text'"));
    CHECK(contains(with("format ascii 1.0\n", ""), "no format"));
    CHECK(contains(with("float x", "quad x"), "line 4: unknown type 'quad'"));
    CHECK(contains(with("float x", "float q"), "must have the properties x, y and z"));
    CHECK(contains(with("element vertex 3", "property float w"), "line 3: a property before"));
    CHECK(contains(with("element vertex 3", "element points 3"), "no element vertex"));
    CHECK(contains(with("element face 1", "element vertex 1"), "more than one element vertex"));
    CHECK(contains(with("end_header", "end_headers"), "unknown statement 'end_headers'"));
    CHECK(contains(with("list uchar int", "list float int"), "must be an integer"));
    CHECK(contains(with("list uchar int", "list uchar float"),
                   "must have an integer list property vertex_indices"));
    CHECK(contains(with("vertex_indices", "indices"), "must have an integer list property"));
    CHECK(contains(ply_error("ply\nformat ascii 1.0\n"), "no end_header"));
}

TEST_CASE("invalid PLY texture coordinates are errors that name the face", "[ply]") {
    const std::string face = indices + "property list uchar float texcoord\n";
    CHECK(contains(ply_error(ascii("", face, three_vertices + "3 0 1 2 4 0 0 0 0\n")),
                   "'texcoord' has 4 values instead of 6 (face 0)"));
    CHECK(contains(ply_error(ascii("", face, three_vertices + "3 0 1 2 200 0 0\n")), "(face 0)"));
    const std::string binary = "ply\nformat binary_little_endian 1.0\nelement vertex 3\n" + xyz +
                               "element face 1\nproperty list uchar uchar vertex_indices\n"
                               "property list int float texcoord\nend_header\n" +
                               std::string(36, '\0') + std::string("\3\0\1\2\xff\xff\xff\x7f", 8);
    CHECK(contains(ply_error(binary), "the file is too short for a list of 2147483647 (face 0)"));
}

TEST_CASE("trailing bytes of a PLY file give a warning", "[ply]") {
    CHECK(any_contains(parse_ply(ascii("", indices, three_vertices + "3 0 1 2\n3 0 1 2\n")).warnings,
                       "8 bytes after"));
    CHECK(parse_ply(ascii("", indices, three_vertices + "3 0 1 2\n\n \n")).warnings.empty());
}

TEST_CASE("a PLY file without faces is an error and non-finite positions are repaired", "[ply]") {
    CHECK(contains(ply_error(ascii("", indices, three_vertices, 3, 0)), "a.ply: no faces"));
    CHECK(contains(
        ply_error("ply\nformat ascii 1.0\nelement vertex 3\n" + xyz + "end_header\n" + three_vertices),
        "a.ply: no faces"));
    const Asset asset =
        parse_ply(ascii("", indices, "0 0 0\n1 0 0\n1 1 0\nnan 0 0\n3 0 1 2\n4 0 1 2 3\n", 4, 2));
    CHECK(asset.parts[0].triangles.size() == 1);
    CHECK(asset.parts[0].positions.size() == 3);
    CHECK(any_contains(asset.warnings, "1 vertex with a non-finite position and 1 adjacent face left out"));
}

TEST_CASE("a PLY file is unchanged by reading and writing", "[ply]") {
    const TemporaryFolder folder;
    Asset asset = one_part({{0, 0, 0}, {0.5f, 0.25f, 0}, {1, 1, 0}, {0.1f, 7, 9}}, {{0, 1, 2}, {2, 1, 0}});
    Part& part = asset.parts[0];
    part.normals = {{0, 0, 1}, {0, 1, 0}, {0.6f, 0.8f, 0}, {0, 0, 0}};
    part.colors = {{1, 0.5f, 0.01f, 1}, {0, 0.2f, 0.7f, 1}, {0.1f, 0.3f, 0.9f, 0.999f}, {1, 1, 1, 1}};
    part.uvs = {{{0.1f, 0.2f}, {0.3f, 0.7f}, {-4, 5.5f}, {1e-9f, 1e-9f}}};
    for (const bool doubles : {false, true}) {
        if (doubles) part.positions[0][0] = 0.1;
        CHECK(save(asset, folder / "a.ply", Overwrite::yes).empty());
        const Asset back = load(folder / "a.ply");
        CHECK(back.warnings.empty());
        CHECK(back.parts[0].positions == part.positions);
        CHECK(back.parts[0].triangles == part.triangles);
        CHECK(back.parts[0].normals == part.normals);
        CHECK(save(back, folder / "b.ply", Overwrite::yes).empty());
        CHECK(get(folder / "a.ply") == get(folder / "b.ply"));
        CHECK(contains(get(folder / "a.ply"), doubles ? "property double x" : "property float x"));
        for (std::size_t v = 0; v < 4; ++v)
            for (std::size_t k = 0; k < 2; ++k)
                CHECK(back.parts[0].uvs.at(0)[v][k] == Approx(part.uvs[0][v][k]).margin(1e-7));
    }
}

TEST_CASE("PLY files keep all 256 values of a colour channel", "[ply]") {
    const TemporaryFolder folder;
    std::vector<Vec3> positions(256, Vec3{0, 0, 0});
    Asset asset = one_part(positions, {{0, 1, 2}});
    for (int i = 0; i < 256; ++i) {
        const auto c = static_cast<float>(linear_from_srgb(i / 255.0));
        asset.parts[0].colors.push_back({c, c, c, static_cast<float>(i) / 255.0f});
    }
    save(asset, folder / "a.ply", Overwrite::no);
    CHECK(load(folder / "a.ply").parts[0].colors == asset.parts[0].colors);
}

TEST_CASE("the PLY writer reports what it leaves out", "[ply]") {
    const TemporaryFolder folder;
    Asset asset = one_part({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, {{0, 1, 2}});
    asset.materials.emplace_back().metallic = 0;
    asset.parts[0].uvs.resize(2, std::vector<Vec2f>(3));
    asset.parts[0].tangents.resize(3);
    asset.parts[0].joints.resize(3);
    asset.parts[0].morph_targets.resize(1);
    CHECK_FALSE(any_contains(save(asset, folder / "a.ply", Overwrite::no), "materials"));  // it says nothing
    asset.materials[0].metallic = 0.5;
    const auto losses = save(asset, folder / "a.ply", Overwrite::yes);
    for (const char* what : {"materials", "more than one set", "tangents", "skins", "morph targets"})
        CHECK(any_contains(losses, what));
}

TEST_CASE("PLY: doubles stay doubles even if all values are floats") {
    const TemporaryFolder folder;
    Asset asset;
    asset.parts.resize(1);
    asset.parts[0].positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    asset.parts[0].triangles = {{0, 1, 2}};
    for (const auto type : {StoredPrecision::Type::float32, StoredPrecision::Type::float64}) {
        asset.precision.type = type;
        save(asset, folder / "a.ply", Overwrite::yes);
        CHECK(load(folder / "a.ply").precision.type == type);
    }
}
