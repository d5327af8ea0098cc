#pragma once
/// \file
/// Which materials may share a page of the atlas.

#include <vector>

#include "faqem/asset.hpp"
#include "faqem/export.hpp"
#include "faqem/options.hpp"

namespace faqem::detail {

/// Materials that become one.
struct MaterialGroup {
    Material material;             ///< the first one
    std::vector<Index> materials;  ///< into Asset::materials, ascending; no_index (the default material) last
};

/// The groups of the materials that an asset's faces use.
struct MaterialGroups {
    std::vector<MaterialGroup> groups;     ///< by smallest material
    std::vector<Index> group_of_material;  ///< materials + 1: group of each, no_index where no face uses it

    /// \param material  into Asset::materials, or no_index
    Index group_of(Index material) const {
        return group_of_material[material == no_index ? group_of_material.size() - 1 : material];
    }
};

/// The material of that index; a default one for no_index.
const Material& material_or_default(const Asset& asset, Index material);

/// The material of a face of a part; no_index where the part names none.
inline Index face_material(const Part& part, std::size_t face) {
    return part.face_material.empty() ? no_index : part.face_material[face];
}

/// Materials merge where alpha mode (and cutoff), double-sidedness and unlitness agree. One with other
/// extensions stays alone: what those say cannot be merged. `vertex` has one colour per vertex and nothing
/// else, so there the factors that are no base colour must agree too. O(faces + materials^2)
FAQEM_EXPORT MaterialGroups group_materials(const Asset& asset, Bake kind);

}  // namespace faqem::detail
