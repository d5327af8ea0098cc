#pragma once
/// \file
/// The original's appearance at a point of its surface.

#include <array>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "bake/transfer/extension_layers.hpp"
#include "bake/transfer/material_groups.hpp"
#include "bake/transfer/source_normals.hpp"
#include "bake/transfer/texture_sampling.hpp"
#include "faqem/surface_map.hpp"

namespace faqem::detail {

/// What a material shows at a point, factors and vertex colours included.
struct Appearance {
    LinearColor base = {1, 1, 1, 1};
    float metallic = 1, roughness = 1, occlusion = 1;
    Vec3f emissive = {0, 0, 0};
};

/// Channels of a material that images can hold.
struct Channels {
    bool base = false, metallic_roughness = false, occlusion = false, emissive = false, normal = false;
    bool layers = false;         ///< of extensions
    bool layer_normals = false;  ///< one of these at least has normals

    bool any() const { return base || metallic_roughness || occlusion || emissive || normal || layers; }
    bool needs_tangents() const { return normal || layer_normals; }

    /// Those of both.
    Channels operator|(const Channels& o) const {
        return {base || o.base,
                metallic_roughness || o.metallic_roughness,
                occlusion || o.occlusion,
                emissive || o.emissive,
                normal || o.normal,
                layers || o.layers,
                layer_normals || o.layer_normals};
    }
};

/// Decodes the images that the asset's materials show and reads them. Immutable once built.
class SourceSampler {
public:
    /// \param asset   must outlive this
    /// \param wanted  channels that will be asked for
    /// \throws InputError  an image is damaged.
    /// \throws UnsupportedError  of an unknown format
    /// \throws what the workers' poll throws
    SourceSampler(const Asset& asset, const Channels& wanted, const Workers& workers = {});

    /// \param part      into Asset::parts
    /// \param point     on one of its faces
    /// \param spacing   distance to the next sample, in the part's units: what is finer is averaged
    Appearance sample(Index part, const SurfacePoint& point, double spacing) const;

    /// The normal that the original is lit with, in the part's coordinates: its normal map's where it has
    /// one. A face that is wound the other way than `face_normal`, and whose normals look away from it too, is seen
    /// from behind: its normal is turned round, as viewers do.
    /// \param face_normal  the simplified face's normal
    engine::Vector3 normal(Index part, const SurfacePoint& point, double spacing,
                           const engine::Vector3& face_normal) const;

    /// The material at a point, no_index for the default one.
    Index material(Index part, const SurfacePoint& point) const {
        return face_material(asset_.parts[part], point.face);
    }

    /// What a layer of the material at a point holds there, without its factors.
    /// \param layer  one of that material's that holds no normals
    LinearColor layer(Index part, const SurfacePoint& point, double spacing,
                      const ExtensionLayer& layer) const;

    /// As normal(), of a layer that holds normals.
    engine::Vector3 layer_normal(Index part, const SurfacePoint& point, double spacing,
                                 const engine::Vector3& face_normal, const ExtensionLayer& layer) const;

    /// Texels per length at a face, those of its material's finest texture. Faces without a texture are given
    /// as many as make two texels per face of the part; those that get a normal map and have none, at least
    /// as many.
    double texel_density(Index part, Index face) const;

private:
    struct TextureSlot {  // a texture of a material
        const MipImage* image = nullptr;
        const TextureRef* texture_ref = nullptr;
        double texels_per_uv = 0;
        UvTransform transform;
    };
    struct MaterialSlots {  // a material
        const Material* material = nullptr;
        TextureSlot base, metallic_roughness, occlusion, emissive, normal;
        std::vector<TextureSlot> extensions;  // by Material::extension_textures; the first of each layer

        template <class Visit>
        void for_each_image(const Visit& visit) const {
            for (const TextureSlot* slot : {&base, &metallic_roughness, &occlusion, &emissive, &normal})
                if (slot->image) visit(*slot);
            for (const TextureSlot& slot : extensions)
                if (slot.image) visit(slot);
        }
    };
    struct PartDensity {
        std::vector<std::vector<float>>
            uv_per_length;  // by UV set and face; empty where no texture needs the set
        double untextured_density = 1;
    };

    MaterialSlots load_material(Index material, const Workers& workers);
    TextureSlot load_slot(const TextureRef& texture_ref, TexelEncoding encoding, Index material,
                          const Workers& workers);
    void measure_densities(const Part& part, engine::CancellationCheck check_cancelled,
                           PartDensity& density) const;
    LinearColor fetch(const TextureSlot& slot, Index part, const SurfacePoint& point, double spacing) const;
    engine::Vector3 perturbed_normal(const TextureSlot& slot, double scale, Index part,
                                     const SurfacePoint& point, double spacing,
                                     const engine::Vector3& face_normal) const;
    const MaterialSlots& slots(Index part, const SurfacePoint& point) const {
        return slots(material(part, point));
    }
    const MaterialSlots& slots(Index material) const {
        return material_slots_[material == no_index ? material_slots_.size() - 1 : material];
    }

    const Asset& asset_;
    const Channels wanted_;
    std::map<std::pair<Index, TexelEncoding>, std::unique_ptr<const MipImage>> images_;
    std::vector<MaterialSlots> material_slots_;  ///< by material, the default one last
    std::vector<PartDensity> densities_;         ///< by part
    std::vector<std::vector<Vec4f>> tangents_;   ///< by part and corner; empty where there is no normal map
};

}  // namespace faqem::detail
