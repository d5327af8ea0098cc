// Makes the fixtures of data/ (data/README.md says what each is for). Usage: make_fixtures FOLDER
#include <cmath>
#include <filesystem>
#include <iostream>

#include "faqem/asset.hpp"

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

/// The unit cube, n x n squares on each side. Every side has vertices of its own: normals and UVs have seams along
/// all edges of the cube.
Part cube_with_seams(Index n) {
    Part part;
    part.uvs.resize(1);
    for (int axis = 0; axis < 3; ++axis) {
        for (const double side : {0.0, 1.0}) {
            const auto first = static_cast<Index>(part.positions.size());
            const auto u = static_cast<std::size_t>((axis + 1) % 3),
                       v = static_cast<std::size_t>((axis + 2) % 3);
            for (Index j = 0; j <= n; ++j) {
                for (Index i = 0; i <= n; ++i) {
                    Vec3 p = {side, side, side};
                    p[u] = static_cast<double>(i) / n;
                    p[v] = static_cast<double>(j) / n;
                    part.positions.push_back(p);
                    Vec3f normal = {0, 0, 0};
                    normal[static_cast<std::size_t>(axis)] = side > 0 ? 1.0f : -1.0f;
                    part.normals.push_back(normal);
                    part.uvs[0].push_back({static_cast<float>(p[u]), static_cast<float>(p[v])});
                }
            }
            for (Index j = 0; j < n; ++j) {
                for (Index i = 0; i < n; ++i) {
                    const Index a = first + j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
                    const auto add = [&](Index x, Index y, Index z) {
                        if (side > 0)
                            part.triangles.push_back({x, y, z});
                        else
                            part.triangles.push_back({x, z, y});
                    };
                    add(a, b, d);
                    add(a, d, c);
                }
            }
        }
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
    Part part;
    for (Index j = 0; j <= n; ++j) {
        for (Index i = 0; i <= n; ++i) {
            const double x = static_cast<double>(i) / n, y = static_cast<double>(j) / n;
            part.positions.push_back({x, y, x * (1 - x) * y * (1 - y)});
        }
    }
    for (Index j = 0; j < n; ++j) {
        for (Index i = 0; i < n; ++i) {
            const Index a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
            part.triangles.push_back({a, b, d});
            part.triangles.push_back({a, d, c});
        }
    }
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
