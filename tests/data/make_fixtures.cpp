// Makes the fixtures of data/ (data/README.md says what each is for). Usage: make_fixtures FOLDER
#include <cmath>
#include <filesystem>
#include <iostream>

#include "faqem/asset.hpp"
#include "support/meshes.hpp"

namespace {

using namespace faqem;

Asset with_part(Part part, const char* name) {
    Asset asset;
    part.name = name;
    part.face_material.assign(part.triangles.size(), asset.materials.empty() ? no_index : 0);
    asset.parts.push_back(std::move(part));
    return asset;
}

/// A texture of 8 x 8 coloured squares.
Image checkers() {
    Pixels pixels{64, 64, {}, false};
    for (std::uint32_t y = 0; y < pixels.height; ++y) {
        for (std::uint32_t x = 0; x < pixels.width; ++x) {
            const std::uint32_t i = x / 8, j = y / 8;
            const bool dark = (i + j) % 2 == 0;
            for (const std::uint32_t c :
                 {dark ? 40 + 20 * i : 220u, dark ? 40 + 20 * j : 220u, dark ? 90u : 200u, 255u})
                pixels.rgba.push_back(static_cast<std::uint8_t>(c));
        }
    }
    return encode_png(pixels, "checkers");
}

Part part_of(const TriangleMesh& mesh) {
    Part part;
    part.positions = mesh.positions;
    part.triangles = mesh.triangles;
    return part;
}

/// The unit cube, n x n squares on each side. Every side has vertices of its own: normals and UVs have seams along
/// all edges of the cube.
Part cube_with_seams(Index n) {
    Part part = part_of(test::fine_cube(n));
    part.uvs.resize(1);
    for (std::size_t v = 0; v < part.positions.size(); ++v) {
        const std::size_t side = v / ((n + 1) * (n + 1)), axis = side / 2;
        const Vec3& p = part.positions[v];
        part.normals.push_back({0, 0, 0});
        part.normals[v][axis] = side % 2 ? 1.0f : -1.0f;
        part.uvs[0].push_back({static_cast<float>(p[(axis + 1) % 3]), static_cast<float>(p[(axis + 2) % 3])});
    }
    return part;
}

/// Faces around one edge, like the pages of a book.
Part nonmanifold_fan(Index pages) {
    Part part;
    part.positions = {{0, 0, 0}, {0, 0, 1}};
    for (Index k = 0; k < pages; ++k) {
        const double angle = 6.283185307179586 * k / pages;
        part.positions.push_back(
            {std::round(1e6 * std::cos(angle)) / 1e6, std::round(1e6 * std::sin(angle)) / 1e6, 0.5});
        part.triangles.push_back({0, 1, k + 2});
    }
    return part;
}

/// n x n squares over [0, 1]^2 with a low bump: a surface with one boundary.
Part open_grid(Index n) {
    Part part = part_of(test::square(n, 1, 0));
    for (auto& [x, y, z] : part.positions) z = x * (1 - x) * y * (1 - y);
    return part;
}

/// Two triangles with the whole texture on them.
Asset textured_quad() {
    Part part;
    part.name = "quad";
    part.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    part.triangles = {{0, 1, 2}, {0, 2, 3}};
    part.uvs = {{{0, 1}, {1, 1}, {1, 0}, {0, 0}}};
    part.face_material = {0, 0};
    Asset asset;
    asset.images.push_back(checkers());
    Material material;
    material.name = "checkers";
    material.base_color_texture.image = 0;
    material.metallic = 0;
    asset.materials.push_back(material);
    asset.parts.push_back(part);
    return asset;
}

}  // namespace

int main(int count, char** arguments) {
    if (count != 2) {
        std::cerr << "usage: make_fixtures FOLDER\n";
        return 2;
    }
    const std::filesystem::path folder = arguments[1];
    std::filesystem::create_directories(folder);
    save(with_part(cube_with_seams(4), "cube"), folder / "cube_with_seams.obj", Overwrite::yes);
    save(with_part(nonmanifold_fan(12), "fan"), folder / "nonmanifold_fan.ply", Overwrite::yes);
    save(with_part(open_grid(8), "grid"), folder / "open_grid.stl", Overwrite::yes);
    save(textured_quad(), folder / "textured_quad.glb", Overwrite::yes);
}
