#include "asset/formats/obj_smoothing.hpp"

#include <cmath>

#include "asset/formats/formats.hpp"
#include "support/catch.hpp"
#include "support/format_support.hpp"

using namespace faqem;
using namespace faqem::detail;
using namespace faqem::testing;

namespace {

Part parse_part(const std::string& text) { return read_obj(bytes_of(text), "a.obj").parts[0]; }

Vec3f normal_at(const Part& part, std::size_t face, std::size_t corner) {
    return part.normals.at(part.triangles.at(face)[corner]);
}

void check_near(const Vec3f& a, const Vec3f& b) {
    for (std::size_t k = 0; k < 3; ++k) CHECK(a[k] == Approx(b[k]).margin(1e-6));
}

// A floor and a wall, which share the edge 1 2. The wall consists of two triangles.
const std::string corner_of_room = "v 0 0 0\nv 0 1 0\nv 1 1 0\nv 1 0 0\nv 0 0 1\nv 0 1 1\n";
const std::string floor_face = "f 1 4 3 2\n", wall_faces = "f 1 2 6\nf 1 6 5\n";
constexpr Vec3f up = {0, 0, 1}, right = {1, 0, 0};
const float half = std::sqrt(0.5f);

}  // namespace

TEST_CASE("a group is smooth at the vertices that its faces share, whatever its triangles are", "[obj]") {
    const Part part = parse_part(corner_of_room + "s 7\n" + floor_face + wall_faces);
    CHECK(part.positions.size() == 6);
    check_near(normal_at(part, 0, 0), {half, 0, half});  // the angles of floor and wall at vertex 1 are equal
    check_near(normal_at(part, 2, 0), {half, 0, half});
    check_near(normal_at(part, 2, 1), {half, 0, half});
    check_near(normal_at(part, 0, 1), up);
    check_near(normal_at(part, 3, 2), right);
}

TEST_CASE("faces are flat without smoothing, and there is a crease between groups", "[obj]") {
    for (const std::string statements :
         {"off/0", "0/off", "null/00", "1/2", "off/3", "3/off", "/4", "on/off", "+5/6"}) {
        CAPTURE(statements);
        const std::size_t slash = statements.find('/');
        const Part part = parse_part(corner_of_room + "s " + statements.substr(0, slash) + "\n" + floor_face +
                                     "s " + statements.substr(slash + 1) + "\n" + wall_faces);
        for (std::size_t face = 0; face < 4; ++face)
            for (std::size_t corner = 0; corner < 3; ++corner)
                check_near(normal_at(part, face, corner), face < 2 ? up : right);
        CHECK(part.positions.size() == 8);
    }
    CHECK(smoothing_group("on") == smoothing_group("1"));
    CHECK(smoothing_group("off") == 0);
    CHECK(smoothing_group("-3") == 0);
}

TEST_CASE("normals of the file stay, and faces before the first s have none", "[obj]") {
    const Part part =
        parse_part(corner_of_room + "vn 0 1 0\n" + floor_face + "s 1\nf 1//1 2//1 6\ns off\nf 1 6 5\n");
    CHECK(normal_at(part, 0, 1) == Vec3f{0, 0, 0});
    CHECK(normal_at(part, 2, 0) == Vec3f{0, 1, 0});
    CHECK(normal_at(part, 2, 1) == Vec3f{0, 1, 0});
    check_near(normal_at(part, 2, 2), right);
    check_near(normal_at(part, 3, 0), right);
    CHECK(parse_part(corner_of_room + floor_face).normals.empty());
}

TEST_CASE("faces without an area, and faces that cancel each other, give no normal", "[obj]") {
    const Part part =
        parse_part(corner_of_room + "s off\nf 1 2 2\ns 1\nf 1 2 6\nf 1 6 2\ns 2\n" + floor_face);
    CHECK(normal_at(part, 0, 0) == Vec3f{0, 0, 0});
    CHECK(normal_at(part, 1, 0) == Vec3f{0, 0, 0});
    check_near(normal_at(part, 3, 0), up);
}

TEST_CASE("one smoothing group for all faces of a file without normals is recorded and written again",
          "[obj]") {
    const auto smoothing = [](const std::string& faces) {
        return read_obj(bytes_of(corner_of_room + "vn 0 0 1\n" + faces), "a.obj").smoothing;
    };
    CHECK(smoothing("s off\n" + floor_face + wall_faces) == Smoothing::off);
    CHECK(smoothing("s 3\n" + floor_face + wall_faces) == Smoothing::on);
    CHECK(smoothing(floor_face + wall_faces) == Smoothing::unknown);
    CHECK(smoothing(floor_face + "s 1\n" + wall_faces) == Smoothing::unknown);
    CHECK(smoothing("s 1\nf 1//1 4//1 3//1\n") == Smoothing::unknown);

    Asset asset = read_obj(bytes_of(corner_of_room + "s off\n" + floor_face), "a.obj");
    asset.parts[0].normals.clear();
    const TemporaryFolder folder;
    save(asset, folder / "b.obj");
    CHECK(load(folder / "b.obj").smoothing == Smoothing::off);
}
