#pragma once
/// \file
/// Groups of materials that share a page of the atlas, and of their faces.

#include <cstdint>
#include <span>
#include <vector>

#include "asset/scene/material_textures.hpp"
#include "faqem/asset.hpp"
#include "faqem/export.hpp"
#include "faqem/options.hpp"

namespace faqem::detail {

/// Materials that are merged into one.
struct MaterialGroup {
    Material material;  ///< the first one
    /// Indices into Asset::materials, ascending; `no_index`, the default material, comes last.
    std::vector<Index> materials;
};

/// The groups of all materials that are used by faces of an asset.
struct MaterialGroups {
    std::vector<MaterialGroup> groups;  ///< sorted by smallest material
    /// Group of every material, the default material last; `no_index` for unused ones.
    std::vector<Index> group_of_material;

    /// The group of a material.
    /// \param material  index into Asset::materials, or `no_index`
    Index group_of(Index material) const {
        return group_of_material[material == no_index ? group_of_material.size() - 1 : material];
    }
};

/// Material index of a face of a part; `no_index` if the part has no materials.
inline Index face_material(const Part& part, std::size_t face) {
    return part.face_material.empty() ? no_index : part.face_material[face];
}

/// The materials of the faces of a part, each once, ascending, without the default material. O(faces log faces)
FAQEM_EXPORT std::vector<Index> materials_of(const Part& part);

/// Whether a face of the asset has each material, the default material last. O(faces + materials)
/// \param skipped_parts  by part: whether its faces are ignored; empty: none are
std::vector<bool> used_materials(const Asset& asset, std::span<const std::uint8_t> skipped_parts = {});

/// Whether all materials show one colour each, without textures and vertex colours, and `bake` requests neither
/// an atlas nor anything else that a page would hold, such as a normal map. Then no page is baked, and
/// materials with different factors are not merged. Scenes with skins or morph targets are not plain: what
/// moves with a vertex is transferred less exactly at the border of two materials than across it.
/// Complexity: O(materials + parts).
bool has_plain_materials(const Asset& asset, const BakeOptions& bake);

/// Groups the materials of an asset. Materials are merged if they agree in alpha mode (and cutoff), in
/// double-sidedness and in being unlit. A material with other extensions is a group of its own, since
/// extensions cannot be merged. With Bake::vertex, which bakes the base colour only, the other factors must
/// agree too. They must agree also if has_plain_materials().
/// \param skipped_parts  as in used_materials()
/// Complexity: O(faces + materials^2).
MaterialGroups group_materials(const Asset& asset, const BakeOptions& bake,
                               std::span<const std::uint8_t> skipped_parts = {});

/// Whether a part has UVs that no texture of its materials uses, and no vertex colours other than white, so that nothing
/// of it needs a page. Its UVs may be those of light maps that a program adds.
/// Complexity: O(vertices + faces log faces).
bool has_spare_uvs_only(const Asset& asset, const Part& part);

/// By part: nonzero if has_spare_uvs_only() and no page is baked for its material groups, so that it keeps its UVs.
/// Complexity: that of has_spare_uvs_only() and group_materials().
std::vector<std::uint8_t> parts_with_own_uvs(const Asset& asset, const BakeOptions& bake);

/// Whether a part has vertex colours other than white.
bool has_non_white_colors(const Part& part);

/// Moves coincident faces of different appearance to different groups.
/// The engine keeps only one of the faces of a group that have the same corners and winding. Such faces can
/// look different, since the materials of a group share a page and vertex normals can contradict the winding.
/// An example are touching faces of two boxes, one of which has the wrong winding.
/// \param part    the faces
/// \param groups  group of every face, or empty if there is only one group
/// \return `groups`, in which a face with the corners (by position) and winding of an earlier face of its
///         group, but with another material or the opposite orientation of its normals, has a new group.
///         Faces of a new group agree in material and orientation.
/// Complexity: O(n log n).
std::vector<Index> separate_coincident_faces(const Part& part, std::vector<Index> groups);

}  // namespace faqem::detail
