// Simplifies a textured asset with a new texture, saves it and loads it again.
#include <faqem/bake.hpp>

#include <filesystem>

int main() {
    faqem::Asset source;
    faqem::Pixels pixels{2, 2, {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 0, 255}, false};
    source.images.push_back(faqem::encode_png(pixels, "four colours"));
    source.materials.emplace_back();
    source.materials[0].base_color_texture.image = 0;
    faqem::Part part;
    part.uvs.emplace_back();
    for (int i = 0; i <= 16; ++i) {
        for (int j = 0; j <= 16; ++j) {
            part.positions.push_back({i / 16.0, j / 16.0, 0.02 * (i * j % 5)});
            part.uvs[0].push_back({float(i) / 16, float(j) / 16});
        }
    }
    for (faqem::Index i = 0; i < 16; ++i) {
        for (faqem::Index j = 0; j < 16; ++j) {
            const faqem::Index a = i * 17 + j;
            part.triangles.push_back({a, a + 17, a + 18});
            part.triangles.push_back({a, a + 18, a + 1});
        }
    }
    part.face_material.assign(part.triangles.size(), 0);
    source.parts.push_back(part);

    const auto simplified =
        faqem::simplify(source, {.target = faqem::ratio(0.25), .bake = {.texture_size = 256}});
    const auto file = std::filesystem::temp_directory_path() / "faqem-consumer.glb";
    faqem::save(simplified.asset, file, faqem::Overwrite::yes);
    const auto again = faqem::load(file);
    std::filesystem::remove(file);
    // two images: base colour and normal map
    return again.images.size() == 2 && again.parts.size() == 1 && again.parts[0].triangles.size() <= 128 ? 0
                                                                                                         : 1;
}
