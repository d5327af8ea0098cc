#pragma once
/// \file
/// Helpers for the fuzz targets. Each target defines LLVMFuzzerTestOneInput(), which libFuzzer or replay.cpp
/// calls.

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <span>
#include <string>

#include "faqem/asset.hpp"
#include "faqem/error.hpp"
#include "support/meshes.hpp"
#include "support/temporary_folder.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace faqem::fuzz {

using Bytes = std::span<const std::uint8_t>;

/// Aborts the process if a condition is false; libFuzzer reports this as a crash.
/// \param what  the expected condition
inline void expect(bool good, const char* what) {
    if (good) return;
    std::fprintf(stderr, "expected: %s\n", what);
    std::abort();
}

/// Reads values from the beginning of the input; zeros after its end.
class Input {
public:
    explicit Input(Bytes bytes) : left_(bytes) {}

    bool empty() const { return left_.empty(); }

    template <class T>
    T raw() {
        T value = {};
        const std::size_t size = std::min(left_.size(), sizeof value);
        if (size > 0) std::memcpy(&value, left_.data(), size);
        left_ = left_.subspan(size);
        return value;
    }

    std::uint8_t byte() { return raw<std::uint8_t>(); }
    bool flag() { return byte() & 1; }
    /// In [0, size).
    Index below(std::size_t size) { return static_cast<Index>(byte() % size); }

    /// Usually an integer or a fraction in a small range, so that positions coincide; sometimes an extreme
    /// value.
    double real() {
        static constexpr double worst[] = {NAN,     INFINITY, -INFINITY, DBL_MAX, -DBL_MAX, DBL_TRUE_MIN,
                                           DBL_MIN, 1e38,     -1e38,     1e30,    1e-30,    1e-38,
                                           1e7,     -0.0,     1e-300,    1e150};
        const std::uint8_t kind = byte();
        if (kind < 192) return (kind % 16) - 8.0;
        if (kind < 224) return (kind - 208.0) / 16;
        if (kind < 240) return worst[kind - 224];
        return kind < 248 ? static_cast<double>(raw<float>()) : raw<double>();
    }

private:
    Bytes left_;
};

/// A regular mesh or an empty one, with random vertices and faces added.
inline TriangleMesh mesh_of(Input& in) {
    TriangleMesh mesh;
    const int kind = in.byte() % 8;
    if (kind == 0) mesh = test::grid(1 + in.below(6));
    if (kind == 1) mesh = test::icosphere(1);
    if (kind == 2) mesh = test::cylinder(3 + in.below(6), 1 + in.below(5), 2);
    if (kind == 3) mesh = test::both(test::cube(), test::moved(test::cube(), {1.001, 0, 0}));
    if (kind == 4) mesh = test::fan(3 + in.below(40));
    const std::size_t old = mesh.positions.size(), moved = in.byte() % 8, vertices = in.byte() % 48;
    for (std::size_t i = 0; i < moved && old > 0; ++i)
        mesh.positions[in.below(old)] = {in.real(), in.real(), in.real()};
    for (std::size_t i = 0; i < vertices; ++i) mesh.positions.push_back({in.real(), in.real(), in.real()});
    if (mesh.positions.empty()) mesh.positions.push_back({0, 0, 0});
    const std::size_t faces = in.byte() % 64;
    for (std::size_t i = 0; i < faces && !in.empty(); ++i) {
        const auto corner = [&] { return in.below(mesh.positions.size()); };
        mesh.triangles.push_back({corner(), corner(), corner()});
    }
    return mesh;
}

inline bool is_finite(const Vec3& p) {
    return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
}

/// True if a per-vertex array is empty or has one entry per vertex.
template <class T>
bool fits(const std::vector<T>& values, const Part& part) {
    return values.empty() || values.size() == part.positions.size();
}

/// Aborts unless the asset is valid as documented for load().
inline void expect_sound(const Asset& asset) {
    for (const Part& part : asset.parts) {
        for (const Vec3& p : part.positions) expect(is_finite(p), "finite positions");
        for (const Triangle& t : part.triangles)
            for (const Index v : t) expect(v < part.positions.size(), "vertex indices in range");
        expect(part.face_material.size() == part.triangles.size(), "a material for every face");
        for (const Index m : part.face_material)
            expect(m == no_index || m < asset.materials.size(), "material indices in range");
        for (const auto& set : part.uvs) expect(set.size() == part.positions.size(), "UVs for every vertex");
        expect(fits(part.normals, part) && fits(part.tangents, part) && fits(part.colors, part) &&
                   fits(part.joints, part) && fits(part.weights, part),
               "attributes for every vertex");
        for (const MorphTarget& target : part.morph_targets)
            expect(fits(target.positions, part) && fits(target.normals, part), "whole morph targets");
    }
    for (const Material& m : asset.materials) {
        for (const float x : {m.base_color[0], m.base_color[3], m.metallic, m.normal_scale, m.emissive[0]})
            expect(std::isfinite(x), "finite factors");
        for (const TextureRef* ref : {&m.base_color_texture, &m.metallic_roughness_texture, &m.normal_texture,
                                      &m.occlusion_texture, &m.emissive_texture})
            expect(!*ref || ref->image < asset.images.size(), "image indices in range");
    }
    for (const Instance& instance : instances(asset))
        expect(instance.part < asset.parts.size(), "instances of parts that exist");
}

/// Result of the call, or nullopt if it throws an InputError. Aborts if the message does not begin with the
/// file name.
template <class Call>
auto refusable(const std::string& file, Call&& call) -> std::optional<decltype(call())> {
    try {
        return call();
    } catch (const InputError& error) {
        expect(std::string(error.what()).compare(0, file.size(), file) == 0, "the message names the file");
    }
    return {};
}

/// Writes an asset and reads it again; aborts if the result is invalid. TMPDIR should be a memory file system, since
/// the writers flush their files to the disk.
/// \return the asset read back; nullopt if it cannot be written, or if it shows no face and the format has no
///         scene
inline std::optional<Asset> written_and_read(const Asset& asset, const std::string& name) {
    static const testing::TemporaryFolder folder;
    const std::string file = folder / name;
    const bool holds_scene = name.ends_with(".glb") || name.ends_with(".gltf");
    const auto has_faces = [&](const Instance& i) { return !asset.parts[i.part].triangles.empty(); };
    const std::vector<Instance> shown = instances(asset);
    if (!holds_scene && std::none_of(shown.begin(), shown.end(), has_faces)) return {};
    try {
        save(asset, file, Overwrite::yes);
    } catch (const WriteError&) {
        return {};  // a position exceeds the range of float
    }
    Asset back = load(file);
    expect_sound(back);
    return back;
}

inline std::uint64_t face_count(const Asset& asset) {
    std::uint64_t faces = 0;
    for (const Part& part : asset.parts) faces += part.triangles.size();
    return faces;
}

/// Reads bytes as a file of one format. Aborts unless an accepted asset is valid and can be written and read
/// again.
/// \param read     (bytes, file name) -> Asset
/// \param written  name of the file to write
/// \return the asset, or nullopt if the bytes were refused
template <class Read>
std::optional<Asset> read_sound(Bytes bytes, Read read, const std::string& written) {
    const std::string file = "no-such-folder/a";
    std::optional<Asset> asset = refusable(file, [&] { return read(bytes, file); });
    if (!asset) return {};
    expect_sound(*asset);
    if (face_count(*asset) > 0) written_and_read(*asset, written);
    return asset;
}

}  // namespace faqem::fuzz
