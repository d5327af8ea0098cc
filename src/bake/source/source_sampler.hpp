#pragma once
/// \file
/// Appearance of the source at a point of its surface.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <span>
#include <vector>

#include "asset/scene/material_textures.hpp"
#include "bake/source/extension_layers.hpp"
#include "bake/source/source_normals.hpp"
#include "faqem/surface_map.hpp"
#include "render/texture_sampling.hpp"
#include "scene/material_groups.hpp"

namespace faqem::detail {

/// Values of a material at a point, including its factors and the vertex colours.
struct Appearance {
    LinearColor base = {1, 1, 1, 1};                    ///< premultiplied
    std::array<Vec3f, plain_images.size()> plain = {};  ///< by image of `plain_images`
};

/// Textures of a material that can be baked to images.
struct Channels {
    constexpr Channels(std::initializer_list<CoreTexture> textures = {}) {
        for (const CoreTexture texture : textures) (*this)[texture] = true;
    }

    std::array<bool, core_slots.size()> core = {};  ///< by CoreTexture
    bool layers = false;                            ///< layers of extension textures, see ExtensionLayer
    bool layer_normals = false;                     ///< at least one of the layers is a normal map

    constexpr bool& operator[](CoreTexture texture) { return core[static_cast<std::size_t>(texture)]; }
    constexpr bool operator[](CoreTexture texture) const { return core[static_cast<std::size_t>(texture)]; }
    bool any() const { return layers || std::find(core.begin(), core.end(), true) != core.end(); }
    bool needs_tangents() const { return (*this)[CoreTexture::normal] || layer_normals; }

    /// Whether an image of `plain_images` is needed.
    bool has_plain(std::size_t image) const {
        bool result = false;
        for (std::size_t i = 0; i < core.size(); ++i)
            result = result || (core[i] && core_slots[i].image == image);
        return result;
    }

    /// Union of the channels.
    Channels operator|(const Channels& o) const {
        Channels result = *this;
        for (std::size_t i = 0; i < core.size(); ++i) result.core[i] = core[i] || o.core[i];
        result.layers = layers || o.layers;
        result.layer_normals = layer_normals || o.layer_normals;
        return result;
    }
};

/// Decodes the images of the asset's materials, and samples them. Immutable once constructed, so that
/// sampling is thread-safe.
class SourceSampler {
public:
    /// \param asset   must outlive this
    /// \param wanted  channels that will be sampled
    /// \param skipped_parts  by part: whether it will not be sampled; empty: all will be
    /// \param decoded  images of the asset that are decoded already; those that are missing are added. It may
    ///                 change or end before this
    /// \throws InputError if an image is damaged
    /// \throws UnsupportedError if an image has an unknown format
    SourceSampler(const Asset& asset, const Channels& wanted, const RunContext& context = {},
                  std::span<const std::uint8_t> skipped_parts = {}, DecodedImages* decoded = nullptr);

    /// Appearance at a point, without normals.
    /// \param part     index into Asset::parts
    /// \param point    on a face of the part
    /// \param spacing  distance between samples, in the part's units; finer detail is averaged
    Appearance sample(Index part, const SurfacePoint& point, double spacing) const;

    /// Linear base colour at a point as it is stored, whatever its alpha is, for points where alpha is 0: their
    /// premultiplied colour is black.
    Vec3f stored_base_color(Index part, const SurfacePoint& point) const;

    /// Shading normal at a point, in the part's coordinates, with the normal map if there is one.
    /// If both the winding and the normals of the source face are opposite to `face_normal`, it is seen from
    /// behind, and its normal is reversed, as viewers do.
    /// \param face_normal  normal of the simplified face
    Vector3 normal(Index part, const SurfacePoint& point, double spacing, const Vector3& face_normal) const;

    /// Index of the material at a point; `no_index` for the default material.
    Index material(Index part, const SurfacePoint& point) const {
        return face_material(asset_.parts[part], point.face);
    }

    /// Value of an extension layer at a point, without its factors.
    /// \param layer  of the material at this point, and not a normal map
    LinearColor layer(Index part, const SurfacePoint& point, double spacing,
                      const ExtensionLayer& layer) const;

    /// As normal(), for an extension layer that is a normal map.
    Vector3 layer_normal(Index part, const SurfacePoint& point, double spacing, const Vector3& face_normal,
                         const ExtensionLayer& layer) const;

    /// Texels per unit of length at a face, for the finest texture of its material, but not less than with a mean of two
    /// texels per face of the part. Faces without a texture have this density, and those whose UVs cover hardly any
    /// texels: a page needs texels to show where their colours end.
    double texel_density(Index part, Index face) const;

    /// Texels per unit of length that show the region of a face, see region_densities(); 0 if any do.
    double region_density(Index part, Index face) const {
        const std::vector<float>& of_part = densities_[part].of_regions;
        return of_part.empty() ? 0 : of_part[face];
    }

private:
    struct TextureSlot {  // a texture of a material; no image: not sampled
        std::shared_ptr<const MipImage> image;
        const TextureRef* texture_ref = nullptr;
        double texels_per_uv = 0;
        UvTransform transform;
    };
    struct MaterialSlots {  // a material and its textures
        const Material* material = nullptr;
        std::array<TextureSlot, core_slots.size()> core;  // by CoreTexture
        bool shares_occlusion = false;        // with metalness and roughness, which are the same texture
        std::vector<TextureSlot> extensions;  // by Material::extension_textures; only the first of each layer

        template <class Visit>
        void for_each_image(const Visit& visit) const {
            for (const auto& slots : {std::span<const TextureSlot>(core), std::span(extensions)})
                for (const TextureSlot& slot : slots)
                    if (slot.image) visit(slot);
        }
        const TextureSlot& operator[](CoreTexture texture) const {
            return core[static_cast<std::size_t>(texture)];
        }
    };
    struct FetchCache {  // what most textures of a material have in common at one point and spacing
        std::uint32_t set = no_index;  // of UVs
        std::array<double, 2> uv = {};
        double uv_per_length = 0;
        double footprint = -1, lod = 0;  // in texels, and its logarithm for footprints above 1
    };
    struct PartDensity {
        // By UV set and face; empty for sets that no texture uses.
        std::vector<std::vector<float>> uv_per_length;
        double untextured_density = 1;
        std::vector<float> of_regions;  // see region_densities()
    };

    struct MissingImage;

    // The textures of a material. Images that are not decoded are added to `missing` and not in the result.
    MaterialSlots load_material(Index material, const DecodedImages& images,
                                std::vector<MissingImage>& missing);
    TextureSlot load_slot(const TextureRef& texture_ref, TexelEncoding encoding, Index material,
                          const DecodedImages& images, std::vector<MissingImage>& missing);
    void decode_images(std::vector<MissingImage>& missing, const RunContext& context,
                       DecodedImages& images) const;
    void measure_densities(const Part& part, PartDensity& density) const;
    bool has_jump(Index part, const SurfacePoint& a, const SurfacePoint& b) const;
    Vec4f base_factor(const Material& material, const Part& part, const SurfacePoint& point) const;
    std::array<double, 2> uv_at(const TextureSlot& slot, const Part& part, const SurfacePoint& point) const;
    LinearColor fetch(const TextureSlot& slot, Index part, const SurfacePoint& point, double spacing,
                      FetchCache& cache) const;
    Vector3 perturbed_normal(const TextureSlot& slot, double scale, Index part, const SurfacePoint& point,
                             double spacing, const Vector3& face_normal) const;
    const MaterialSlots& slots(Index part, const SurfacePoint& point) const {
        return slots(material(part, point));
    }
    const MaterialSlots& slots(Index material) const {
        return material_slots_[material == no_index ? material_slots_.size() - 1 : material];
    }

    const Asset& asset_;
    const Channels wanted_;
    std::vector<MaterialSlots> material_slots_;  ///< by material, the default material last
    std::vector<PartDensity> densities_;         ///< by part
    std::vector<std::vector<Vec4f>> tangents_;   ///< by part and corner; empty for parts without normal map
};

}  // namespace faqem::detail
