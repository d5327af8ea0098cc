// Textures and face colours of PLY files.

#include "asset/formats/polygon_content.hpp"

#include "asset/formats/formats.hpp"
#include "asset/model_files.hpp"
#include "support/catch.hpp"
#include "support/format_support.hpp"

using namespace faqem;
using namespace faqem::detail;
using namespace faqem::testing;

namespace {

// A square of two triangles with the given properties and values of vertices and faces.
struct SquareFile {
    std::string comments, vertex_properties, face_properties;
    std::array<std::string, 4> vertices;
    std::array<std::string, 2> faces;

    std::string text() const {
        const std::array<std::string, 4> positions = {"0 0 0 ", "1 0 0 ", "1 1 0 ", "0 1 0 "};
        std::string text = "ply\nformat ascii 1.0\n" + comments + "element vertex 4\nproperty float x\n" +
                           "property float y\nproperty float z\n" + vertex_properties +
                           "element face 2\nproperty list uchar int vertex_indices\n" + face_properties +
                           "end_header\n";
        for (std::size_t v = 0; v < 4; ++v) text += positions[v] + vertices[v] + "\n";
        return text + "3 0 1 2 " + faces[0] + "\n3 0 2 3 " + faces[1] + "\n";
    }
};

const std::string rgb = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
const std::string texcoord = "property list uchar float texcoord\n";

Asset read(const SquareFile& square, const std::string& name = "a.ply") {
    return read_ply(bytes_of(square.text()), name);
}

/// The texture coordinates of the corners of a face.
std::vector<Vec2f> uvs(const Part& part, std::size_t face) {
    std::vector<Vec2f> result;
    for (const Index v : part.triangles.at(face)) result.push_back(part.uvs.at(0).at(v));
    return result;
}

const std::vector<Vec2f> upright = {{0, 1}, {1, 1}, {1, 0}};

}  // namespace

TEST_CASE("PLY texture coordinates of corners split the vertices that differ", "[ply]") {
    SquareFile square;
    square.face_properties = texcoord;
    square.faces = {"6 0 0 1 0 1 1", "6 0 0 1 1 0.25 1"};
    Part part = read(square).parts.at(0);
    CHECK(part.positions.size() == 4);
    CHECK(uvs(part, 0) == upright);
    CHECK(uvs(part, 1) == std::vector<Vec2f>{{0, 1}, {1, 0}, {0.25f, 0}});
    square.faces[1] = "6 0.5 0 1 1 0.25 1";
    part = read(square).parts.at(0);
    REQUIRE(part.positions.size() == 5);
    CHECK(part.positions[4] == part.positions[0]);
    CHECK(uvs(part, 0) == upright);
    CHECK(uvs(part, 1)[0] == Vec2f{0.5f, 1});
    square.faces[1] = "0";  // a face without coordinates
    CHECK(uvs(read(square).parts.at(0), 0) == upright);
}

TEST_CASE("texture files of PLY become materials, also those named as on another computer", "[ply]") {
    const TemporaryFolder folder;
    put(folder / "a b.png", png_signature);
    put(folder / "c.jpg", jpeg_signature);
    const std::string file = (folder / "m.ply").string();
    SquareFile square;
    square.comments = "comment TextureFile a b.png\ncomment TextureFile X:\\y\\C.JPG\n";
    square.face_properties = texcoord + "property int texnumber\n";
    square.faces = {"6 0 0 1 0 1 1 1", "6 0 0 1 1 0 1 0"};
    const Asset asset = read(square, file);
    REQUIRE(asset.materials.size() == 2);
    CHECK(asset.materials[0].name == "a b");
    CHECK(asset.materials[0].metallic == 0);
    CHECK(asset.images.at(asset.materials[1].base_color_texture.image).uri == "c.jpg");
    CHECK(asset.parts.at(0).face_material == std::vector<Index>{1, 0});
    REQUIRE(asset.warnings.size() == 1);
    CHECK(contains(asset.warnings[0], "the file 'c.jpg' is read"));
    put(folder / "m.ply", square.text());
    CHECK(referenced_files(folder / "m.ply", References::readable).size() == 2);

    square.comments = "comment TextureFile ../c.jpg\ncomment TextureFile\n";
    const Asset outside = read(square, (folder / "in/m.ply").string());
    CHECK(outside.materials.empty());
    CHECK(any_contains(outside.warnings, "texture left out"));
}

TEST_CASE("PLY face colours become vertex colours that are constant on each face", "[ply]") {
    SquareFile square;
    square.face_properties = rgb + "property uchar alpha\n";
    square.faces = {"255 0 0 255", "0 0 255 51"};
    const Asset asset = read(square);
    CHECK(asset.warnings.empty());
    const Part& part = asset.parts.at(0);
    CHECK(part.positions.size() == 6);
    for (const Index v : part.triangles.at(0)) CHECK(part.colors.at(v) == Vec4f{1, 0, 0, 1});
    for (const Index v : part.triangles.at(1)) CHECK(part.colors.at(v) == Vec4f{0, 0, 1, 0.2f});
    square.faces[1] = square.faces[0];
    CHECK(read(square).parts.at(0).positions.size() == 4);
}

TEST_CASE("PLY faces with a texture have no colours, others keep theirs", "[ply]") {
    const TemporaryFolder folder;
    put(folder / "t.png", png_signature);
    const std::string file = (folder / "m.ply").string();
    SquareFile square;
    square.comments = "comment TextureFile t.png\n";
    square.vertex_properties = rgb;
    square.vertices.fill("0 255 0");
    square.face_properties = texcoord;
    square.faces = {"6 0 0 1 0 1 1", "0"};
    const Asset mixed = read(square, file);
    CHECK(any_contains(mixed.warnings, "colours of 1 face with a texture left out"));
    const Part& part = mixed.parts.at(0);
    for (const Index v : part.triangles.at(0)) CHECK(part.colors.at(v) == Vec4f{1, 1, 1, 1});
    for (const Index v : part.triangles.at(1)) CHECK(part.colors.at(v) == Vec4f{0, 1, 0, 1});
}
