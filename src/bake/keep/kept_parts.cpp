#include "bake/keep/kept_parts.hpp"

#include <numeric>
#include <utility>
#include <vector>

#include "asset/scene/material_textures.hpp"
#include "asset/scene/messages.hpp"
#include "asset/scene/part_arrays.hpp"
#include "asset/scene/source_traits.hpp"
#include "scene/material_groups.hpp"

namespace faqem::detail {
namespace {

// Copies materials and images of the source to the result when they are first needed.
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

// The part with the faces that the result has.
Part part_with_faces(const Part& source, const std::vector<Index>& faces) {
    Part part = source;
    if (faces.size() != source.triangles.size()) select_faces(source, faces, part);
    return part;
}

}  // namespace

std::vector<KeptPart> add_kept_parts(const Asset& source, std::span<const BakePart> parts,
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
