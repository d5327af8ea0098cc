#pragma once
/// \file
/// The original's appearance at a point of its surface.

#include <array>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "bake/groups.hpp"
#include "bake/sampling.hpp"
#include "bake/source_normals.hpp"
#include "faqem/surface_map.hpp"

namespace faqem::detail {

/// What a material shows at a point, factors and vertex colours included.
struct Appearance {
    Linear base = {1, 1, 1, 1};
    float metallic = 1, roughness = 1, occlusion = 1;
    Vec3f emissive = {0, 0, 0};
};

/// Channels of a material that images can hold.
struct Channels {
    bool base = false, metallic_roughness = false, occlusion = false, emissive = false, normal = false;
    bool any() const { return base || metallic_roughness || occlusion || emissive || normal; }

    /// Those of both.
    Channels operator|(const Channels& o) const {
        return {base || o.base, metallic_roughness || o.metallic_roughness, occlusion || o.occlusion,
                emissive || o.emissive, normal || o.normal};
    }
};

/// Decodes the images that the asset's materials show and reads them. Immutable once built.
class SourceSurface {
public:
    /// \param asset   must outlive this
    /// \param wanted  channels that will be asked for
    /// \throws InputError  an image is damaged.
    /// \throws UnsupportedError  of an unknown format
    /// \throws what the workers' poll throws
    SourceSurface(const Asset& asset, const Channels& wanted, const Workers& workers = {});

    /// \param part      into Asset::parts
    /// \param point     on one of its faces
    /// \param spacing   distance to the next sample, in the part's units: what is finer is averaged
    Appearance sample(Index part, const SurfacePoint& point, double spacing) const;

    /// The normal that the original is lit with, in the part's coordinates: its normal map's where it has
    /// one. A face that is wound the other way than `side`, and whose normals look away from it too, is seen
    /// from behind: its normal is turned round, as viewers do.
    /// \param side  the small face's normal
    engine::Vector3 normal(Index part, const SurfacePoint& point, double spacing,
                           const engine::Vector3& side) const;

    /// Texels per length at a face, those of its material's finest texture. Faces without a texture are given
    /// as many as make two texels per face of the part; those that get a normal map and have none, at least
    /// as many.
    double texel_density(Index part, Index face) const;

private:
    struct Slot {  // a texture of a material
        const MipImage* image = nullptr;
        const TextureRef* use = nullptr;
        double texels_per_uv = 0;
        UvTransform transform;
    };
    struct Surface {  // a material
        const Material* material = nullptr;
        Slot base, metallic_roughness, occlusion, emissive, normal;

        std::array<const Slot*, 5> slots() const {
            return {&base, &metallic_roughness, &occlusion, &emissive, &normal};
        }
    };
    struct PartScale {
        std::vector<std::vector<float>>
            uv_per_length;  // by UV set and face; empty where no texture needs the set
        double untextured = 1;
    };

    Slot slot(const TextureRef& use, Encoding encoding, Index material, const Workers& workers);
    void measure(const Part& part, engine::Poll poll, PartScale& scale) const;
    Linear fetch(const Slot& slot, Index part, const SurfacePoint& point, double spacing) const;
    const Surface& surface(Index material) const {
        return surfaces_[material == no_index ? surfaces_.size() - 1 : material];
    }

    const Asset& asset_;
    const Channels wanted_;
    std::map<std::pair<Index, Encoding>, std::unique_ptr<const MipImage>> images_;
    std::vector<Surface> surfaces_;             ///< by material, the default one last
    std::vector<PartScale> scales_;             ///< by part
    std::vector<std::vector<Vec4f>> tangents_;  ///< by part and corner; empty where there is no normal map
};

}  // namespace faqem::detail
