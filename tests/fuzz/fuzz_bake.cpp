// Simplifies and bakes a small textured scene, valid or invalid.

#include "faqem/bake.hpp"
#include "faqem/simplify.hpp"
#include "fuzz/fuzz.hpp"
#include "fuzz/random_options.hpp"

using namespace faqem;

namespace {

const Image& picture(std::size_t kind) {
    static const std::vector<Image> pictures = [] {
        std::vector<Image> all;
        for (const std::uint32_t size : {1u, 2u, 5u}) {
            Pixels pixels{size, size + 1, {}, size == 5};
            for (std::uint32_t i = 0; i < size * (size + 1); ++i)
                for (const std::uint32_t c : {i * 40, 255 - i * 7, i * 90, size == 5 ? i * 8 : 255})
                    pixels.rgba.push_back(static_cast<std::uint8_t>(c));
            all.push_back(encode_png(pixels, "p"));
        }
        Image broken = all[2];
        broken.encoded.resize(broken.encoded.size() / 2);
        all.push_back(broken);
        all.push_back({});
        return all;
    }();
    return pictures[kind % pictures.size()];
}

TextureRef texture_of(fuzz::Input& in, std::size_t images) {
    TextureRef ref;
    const std::uint8_t bits = in.byte();
    if (bits & 1) ref.image = in.below(images + (bits == 255 ? 1 : 0));
    if (bits & 2) ref.uv_set = 1;
    ref.wrap_u = static_cast<Wrap>((bits >> 2) % 3);
    ref.wrap_v = static_cast<Wrap>((bits >> 3) % 3);
    if (bits & 32) ref.filter = Filter::nearest;
    if (bits & 64) {
        ref.offset = {static_cast<float>(in.real()), static_cast<float>(in.real())};
        ref.scale = {static_cast<float>(in.real()), static_cast<float>(in.real())};
        ref.rotation = static_cast<float>(in.real());
    }
    return ref;
}

Material material_of(fuzz::Input& in, std::size_t images) {
    Material m;
    const std::uint8_t bits = in.byte();
    m.alpha_mode = static_cast<AlphaMode>(bits % 3);
    m.unlit = bits & 4;
    m.double_sided = bits & 8;
    if (bits & 16) m.base_color = {static_cast<float>(in.real()), 0.5f, 1, static_cast<float>(in.real())};
    m.base_color_texture = texture_of(in, images);
    if (bits & 32) m.normal_texture = texture_of(in, images);
    if (bits & 64) m.metallic_roughness_texture = texture_of(in, images);
    if (bits & 128) m.emissive_texture = texture_of(in, images), m.emissive = {1, 1, 1};
    return m;
}

template <class T>
std::vector<T> per_vertex(fuzz::Input& in, const Part& part, std::uint8_t bits) {
    std::vector<T> values(part.positions.size() + (bits == 0xFF ? 1 : 0));
    for (T& value : values)
        for (auto& x : value) x = static_cast<typename T::value_type>(in.real());
    return values;
}

Part part_of(fuzz::Input& in, std::size_t materials) {
    Part part;
    TriangleMesh mesh = fuzz::mesh_of(in);
    part.positions = std::move(mesh.positions);
    part.triangles = std::move(mesh.triangles);
    const std::uint8_t bits = in.byte();
    if (bits & 1) part.uvs.push_back(per_vertex<Vec2f>(in, part, bits));
    if (bits & 2) part.uvs.push_back(per_vertex<Vec2f>(in, part, 0));
    if (bits & 4) part.normals = per_vertex<Vec3f>(in, part, bits);
    if (bits & 8) part.tangents = per_vertex<Vec4f>(in, part, bits);
    if (bits & 16) part.colors = per_vertex<Vec4f>(in, part, bits);
    if (bits & 32) part.weights = per_vertex<Vec4f>(in, part, 0), part.joints.resize(part.positions.size());
    if (bits & 64) part.morph_targets.push_back({per_vertex<Vec3f>(in, part, bits), {}});
    for (std::size_t f = 0; f < part.triangles.size(); ++f) {
        const Index m = in.below(materials + 2);
        part.face_material.push_back(m == materials ? no_index : m == materials + 1 ? 0 : m);
    }
    if (bits & 128) part.triangles.push_back({0, in.byte(), in.byte()});
    return part;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzz::Input in(fuzz::Bytes(data, size));
    Options options = fuzz::options_of(in);
    const std::uint8_t bits = in.byte(), kinds = in.byte(), more = in.byte();
    options.bake.kind = static_cast<Bake>(kinds % 6);
    options.bake.normals = static_cast<Normals>(kinds / 6 % 5);
    options.bake.normal_map = static_cast<NormalMap>(more % 3);
    options.bake.image_format = static_cast<ImageFormat>(more / 3 % 4);
    options.bake.crease_angle = more / 9 * 8;
    if (makes_atlas(options.bake.kind) && bits & 4) options.bake.correspondence = Recording::on;
    options.bake.texture_size = bits & 8 ? 128 : 64;
    options.bake.samples = bits & 16 ? 2 : 1;
    options.budget = bits & 32 ? Budget::mesh : Budget::scene;
    Asset asset;
    for (std::size_t i = 0; i < 1u + (bits >> 7); ++i) asset.images.push_back(picture(in.byte()));
    for (std::size_t i = 0; i < 2; ++i) asset.materials.push_back(material_of(in, asset.images.size()));
    for (std::size_t i = 0; i < 1u + (bits >> 6) % 2; ++i) asset.parts.push_back(part_of(in, 2));
    try {
        const SimplifiedAsset simplified = simplify(asset, options);
        fuzz::expect_sound(simplified.asset);
        for (const PageOrigins& page : simplified.correspondence)
            fuzz::expect(page.texels.size() == std::size_t{page.width} * page.height,
                         "an origin for every texel");
        if (fuzz::face_count(simplified.asset) > 0) fuzz::written_and_read(simplified.asset, "a.glb");
    } catch (const InputError&) {
    } catch (const OptionError&) {
    }
    return 0;
}
