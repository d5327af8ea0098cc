#pragma once
/// \file
/// Parts that keep their vertices or UVs, and their materials and images.

#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "asset/scene/material_textures.hpp"
#include "asset/scene/messages.hpp"
#include "asset/scene/part_arrays.hpp"
#include "asset/scene/source_traits.hpp"
#include "bake/keep/kept_images.hpp"
#include "bake/parts/corners.hpp"
#include "faqem/bake.hpp"
#include "scene/material_groups.hpp"

namespace faqem::detail {

inline bool keeps_untouched_parts(const BakeOptions& bake) {
    if (bake.untouched != UntouchedParts::automatic) return bake.untouched == UntouchedParts::kept;
    const BakeOptions standard;
    const bool has_usual_normals = bake.normals == Normals::automatic || bake.normals == Normals::transfer;
    if (!has_usual_normals || bake.crease_angle != standard.crease_angle) return false;
    if (bake.kind == Bake::keep) return true;
    const bool keeps_format =
        bake.image_format == standard.image_format || bake.image_format == ImageFormat::source;
    return bake.kind == Bake::automatic && bake.texture_size == standard.texture_size &&
           bake.texel_density == standard.texel_density && bake.normal_map == standard.normal_map &&
           bake.image_quality == standard.image_quality && keeps_format &&
           bake.correspondence == Recording::off;
}

/// Whether each face of the result has the corners of the face it is made from, and the others were dropped
/// before the run. The report tells apart results of a run from meshes that were made in another way.
inline bool is_untouched(const Part& part, const SimplifyResult& simplified) {
    const CollapseHistory& history = simplified.history;
    const TriangleMesh& mesh = simplified.mesh;
    if (mesh.triangles.empty() || simplified.report.faces_in != part.triangles.size() ||
        history.patch_count() > 0 || !history.deleted_faces.empty())
        return false;
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
        const Triangle &own = mesh.triangles[f], &from = part.triangles[history.remaining_faces[f]];
        for (std::size_t c = 0; c < 3; ++c)
            if (mesh.positions[own[c]] != part.positions[from[c]]) return false;
    }
    return true;
}

/// Copies materials and images of the source to the result when they are first needed.
class SourceMaterials {
public:
    SourceMaterials(const Asset& source, bool has_all, Asset& result)
        : source_(source),
          result_(result),
          materials_(source.materials.size(), no_index),
          images_(source.images.size(), no_index) {
        if (has_all) std::iota(materials_.begin(), materials_.end(), Index{0});
    }

    /// Index of a material in the result.
    Index operator()(Index material) {
        if (material == no_index || materials_[material] != no_index)
            return material == no_index ? no_index : materials_[material];
        Material copy = source_.materials[material];
        for_each_texture(copy, [&](TextureRef& ref) {
            if (ref) ref.image = image(ref.image);
        });
        materials_[material] = static_cast<Index>(result_.materials.size());
        result_.materials.push_back(std::move(copy));
        return materials_[material];
    }

private:
    Index image(Index source) {
        if (images_[source] == no_index) {
            images_[source] = static_cast<Index>(result_.images.size());
            result_.images.push_back(source_.images[source]);
        }
        return images_[source];
    }

    const Asset& source_;
    Asset& result_;
    std::vector<Index> materials_, images_;  // of the source to those of the result
};

/// The part with the faces that the result has.
inline Part part_with_faces(const Part& source, const std::vector<Index>& faces) {
    Part part = source;
    if (faces.size() != source.triangles.size()) select_faces(source, faces, part);
    return part;
}

/// By part of the source: whether it is kept as it is (BakeOptions::untouched). Such a part has as many faces
/// as its target allows, apart from duplicates and faces without area, and no vertex has moved.
/// \param simplified  matches the source
/// Complexity: O(faces).
inline std::vector<std::uint8_t> find_untouched_parts(const Asset& source, const SimplifiedParts& simplified,
                                                      const BakeOptions& bake) {
    std::vector<std::uint8_t> result(source.parts.size(), 0);
    if (!keeps_untouched_parts(bake)) return result;
    for (std::size_t p = 0; p < result.size(); ++p)
        result[p] = is_untouched(source.parts[p], simplified.parts[p]) ? 1 : 0;
    return result;
}

/// Replaces the empty parts that baking leaves for BakePart::is_kept, by those of the source or by those that keep their
/// UVs. Adds their materials, those of their variants, and images, and reports untouched parts.
/// \param untouched      by part: whether it is that of the source
/// \param with_uvs       has the other kept parts
/// \param has_materials  whether the result has all materials and images of the source
/// \return all kept parts
inline std::vector<KeptPart> add_kept_parts(const Asset& source, std::span<const BakePart> parts,
                                            std::span<const std::uint8_t> untouched, Asset with_uvs,
                                            bool has_materials, SimplifiedAsset& result) {
    SourceMaterials materials(source, has_materials, result.asset);
    std::vector<KeptPart> kept_parts;
    for (const BakePart& part : parts) {
        if (!part.is_kept) continue;
        const bool keeps_vertices = untouched[part.index] != 0;
        Part& to = result.asset.parts[part.index];
        to = keeps_vertices ? part_with_faces(*part.source, part.simplified->history.remaining_faces)
                            : std::move(with_uvs.parts[part.index]);
        for (Index& material : to.face_material) material = materials(material);
        for (const Index material : variant_materials(source, *part.source)) materials(material);
        if (keeps_vertices) result.report.untouched_parts.push_back(part_title(source, part.index));
        kept_parts.push_back({part.index, keeps_vertices});
    }
    return kept_parts;
}

}  // namespace faqem::detail
