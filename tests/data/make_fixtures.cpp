// Makes the fixtures of data/ (data/README.md says what each is for). Usage: make_fixtures FOLDER
#include <cmath>
#include <filesystem>
#include <iostream>

#include "faqem/asset.hpp"
#include "support/scenes.hpp"

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
    const auto color = [](std::uint32_t x, std::uint32_t y) {
        const auto i = static_cast<std::uint8_t>(40 + 20 * (x / 8)),
                   j = static_cast<std::uint8_t>(40 + 20 * (y / 8));
        return (x / 8 + y / 8) % 2 == 0 ? test::Rgba{i, j, 90, 255} : test::Rgba{220, 220, 200, 255};
    };
    return encode_png(test::paint(64, 64, color), "checkers");
}

/// The unit cube, n x n squares on each side. Every side has vertices of its own: normals and UVs have seams along
/// all edges of the cube.
Part cube_with_seams(Index n) {
    Part part = test::part_of(test::fine_cube(n));
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
    Part part = test::part_of(test::square(n, 1, 0));
    for (auto& [x, y, z] : part.positions) z = x * (1 - x) * y * (1 - y);
    return part;
}

/// Two triangles with the whole texture on them.
Asset textured_quad() {
    Part part = test::square();
    part.name = "quad";
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
