// Writes small procedural models to a folder: `determinism_models FOLDER`.

#include <iostream>

#include "faqem/asset.hpp"
#include "support/scenes.hpp"

using namespace faqem;

namespace {

Part painted_part(const TriangleMesh& mesh, Index material) {
    const auto uv_of = [](const Vec3& p) { return std::array{p[0] / 3 + p[2], p[1] / 3}; };
    Part part = test::uv_mapped(test::part_of(mesh), uv_of);
    part.face_material.assign(mesh.triangles.size(), material);
    return part;
}

Asset asset_of(std::initializer_list<TriangleMesh> meshes) {
    Asset asset = test::textured_square(test::ramp(32));
    asset.parts.clear();
    asset.materials.push_back(asset.materials[0]);
    asset.materials[1].alpha_mode = AlphaMode::mask;
    for (const TriangleMesh& mesh : meshes)
        asset.parts.push_back(painted_part(mesh, static_cast<Index>(asset.parts.size() % 2)));
    return asset;
}

}  // namespace

int main(int count, char** arguments) try {
    if (count != 2) throw std::runtime_error("usage: determinism_models FOLDER");
    const std::filesystem::path folder = arguments[1];
    save(asset_of({test::icosphere(4)}), folder / "ball.glb");
    save(asset_of({test::shaken(test::torus(60, 30), 0.02, 1), test::shaken(test::grid(40), 0.3, 2)}),
         folder / "two.glb");
    save(asset_of({test::soup(3, 80, 400)}), folder / "soup.glb");
    save(asset_of({test::both(test::globe(24, 1), test::cylinder(30, 30, 4))}), folder / "open.glb");
    return 0;
} catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 1;
}
