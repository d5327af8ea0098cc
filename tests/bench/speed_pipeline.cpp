#include <algorithm>

#include "faqem/asset.hpp"
#include "faqem/bake.hpp"
#include "faqem/detail/base/stopwatch.hpp"
#include "faqem/report_json.hpp"
#include "speed.hpp"

namespace faqem::bench {

namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t image_side = 2048;
constexpr std::uint64_t pipeline_faces = 10'000;

/// Returns an image with a pattern that does not compress extremely well.
Image pattern() {
    Pixels pixels;
    pixels.width = pixels.height = image_side;
    for (std::uint32_t y = 0; y < image_side; ++y) {
        for (std::uint32_t x = 0; x < image_side; ++x) {
            const std::uint32_t stripe = (x / 32 + y / 32) % 2 * 80;
            for (const std::uint32_t byte : {x / 16 + stripe, y / 16 + stripe, (x * y) / 64 % 256, 255u})
                pixels.rgba.push_back(static_cast<std::uint8_t>(std::min(byte, 255u)));
        }
    }
    return encode_png(pixels, "pattern");
}

Asset bare_asset(const FloatMesh& mesh) {
    Asset asset;
    Part part;
    part.name = mesh.name;
    part.triangles = mesh.triangles;
    for (const Vec3f& p : mesh.positions) part.positions.push_back({p[0], p[1], p[2]});
    part.face_material.assign(part.triangles.size(), no_index);
    asset.parts.push_back(std::move(part));
    return asset;
}

/// Returns an asset with the pattern projected along z.
Asset textured_asset(const FloatMesh& mesh) {
    Asset asset = bare_asset(mesh);
    Vec3f low = mesh.positions.front(), high = low;
    for (const Vec3f& p : mesh.positions) {
        for (std::size_t k = 0; k < 3; ++k) {
            low[k] = std::min(low[k], p[k]);
            high[k] = std::max(high[k], p[k]);
        }
    }
    Part& part = asset.parts.front();
    part.uvs.resize(1);
    for (const Vec3f& p : mesh.positions)
        part.uvs[0].push_back({(p[0] - low[0]) / (high[0] - low[0]), (p[1] - low[1]) / (high[1] - low[1])});
    std::fill(part.face_material.begin(), part.face_material.end(), 0);
    asset.images.push_back(pattern());
    Material material;
    material.metallic = 0;
    material.base_color_texture.image = 0;
    asset.materials.push_back(material);
    return asset;
}

/// Elapsed time and CPU time of repeated runs, seconds.
struct Cost {
    std::vector<double> wall, cpu;

    template <class Work>
    void add(const Work& work) {
        const double before = cpu_now();
        const detail::Stopwatch watch;
        work();
        wall.push_back(watch.seconds());
        cpu.push_back(cpu_now() - before);
    }
};

}  // namespace

void measure_files(const FloatMesh& mesh, const fs::path& folder, int repetitions, const WriteRow& write) {
    for (const bool textured : {false, true}) {
        const Asset asset = textured ? textured_asset(mesh) : bare_asset(mesh);
        for (const char* ending : {".glb", ".ply", ".obj", ".stl"}) {
            const fs::path file = folder / (std::string("speed") + ending);
            Cost loading, saving;
            for (int i = 0; i < repetitions; ++i) {
                saving.add([&] { save(asset, file, Overwrite::yes); });
                loading.add([&] { load(file); });
            }
            write({{"section", "files"},
                   {"mesh", mesh.name},
                   {"faces", mesh.triangles.size()},
                   {"format", std::string(ending + 1)},
                   {"uvs", textured},
                   {"megabytes", static_cast<double>(fs::file_size(file)) / 1e6},
                   {"load", {{"median", median(loading.wall)}, {"cpu", median(loading.cpu)}}},
                   {"save", {{"median", median(saving.wall)}, {"cpu", median(saving.cpu)}}}});
            fs::remove(file);
        }
    }
}

void measure_pipeline(const FloatMesh& mesh, const fs::path& folder, const WriteRow& write) {
    const fs::path in = folder / "speed-in.glb", out = folder / "speed-out.glb";
    save(textured_asset(mesh), in, Overwrite::yes);
    for (const Preset preset : {Preset::fast, Preset::balanced}) {
        for (const std::uint32_t samples : {1u, 2u}) {
            Options options;
            options.preset = preset;
            options.target = faces(pipeline_faces);
            options.bake.texture_size = image_side;
            options.bake.samples = samples;
            const double cpu = cpu_now();
            const detail::Stopwatch total;
            const Asset source = load(in);
            const double loaded = total.seconds();
            SimplifiedAsset simplified = simplify(source, options);
            const detail::Stopwatch saving;
            save(simplified.asset, out, Overwrite::yes);
            PhaseSeconds& s = simplified.report.seconds;
            s.load = loaded;
            s.save = saving.seconds();
            s.total = total.seconds();
            const double cpu_total = cpu_now() - cpu;
            write({{"section", "pipeline"},
                   {"mesh", mesh.name},
                   {"faces", mesh.triangles.size()},
                   {"faces_out", simplified.report.faces_out},
                   {"preset", name(preset)},
                   {"samples", samples},
                   {"phases", Json::parse(to_json(simplified.report))["seconds"]},
                   {"cpu", cpu_total}});
        }
    }
    fs::remove(in);
    fs::remove(out);
}

}  // namespace faqem::bench
