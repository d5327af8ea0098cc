#include "bake/keep/kept_parts.hpp"

#include <utility>
#include <vector>

#include "asset/scene/material_textures.hpp"
#include "asset/scene/messages.hpp"
#include "bake/keep/kept_images.hpp"
#include "bake/transfer/material_groups.hpp"

namespace faqem::detail {
namespace {

// Copies materials and images of the source to the result when they are first needed.
class SourceMaterials {
public:
    explicit SourceMaterials(BakeJob& job)
        : job_(job),
          materials_(job.source.materials.size(), no_index),
          images_(job.source.images.size(), no_index) {
        if (job.options.bake.kind != Bake::keep && !job.is_late) return;
        for (Index m = 0; m < materials_.size(); ++m) materials_[m] = m;  // bake_keep() has added all
    }

    /// Index of a material in the result.
    Index operator()(Index material) {
        if (material == no_index || materials_[material] != no_index)
            return material == no_index ? no_index : materials_[material];
        Material copy = job_.source.materials[material];
        for_each_texture(copy, [&](TextureRef& ref) {
            if (ref) ref.image = image(ref.image);
        });
        materials_[material] = static_cast<Index>(job_.result.asset.materials.size());
        job_.result.asset.materials.push_back(std::move(copy));
        return materials_[material];
    }

private:
    Index image(Index source) {
        if (images_[source] == no_index) {
            images_[source] = static_cast<Index>(job_.result.asset.images.size());
            job_.result.asset.images.push_back(job_.source.images[source]);
        }
        return images_[source];
    }

    BakeJob& job_;
    std::vector<Index> materials_, images_;  // of the source to those of the result
};

// The part with the faces that the result has.
Part part_with_kept_faces(const Part& source, const std::vector<Index>& kept) {
    Part part = source;
    if (kept.size() == source.triangles.size()) return part;
    for (std::size_t f = 0; f < kept.size(); ++f) {
        part.triangles[f] = source.triangles[kept[f]];
        if (!part.face_material.empty()) part.face_material[f] = source.face_material[kept[f]];
        if (!part.face_object.empty()) part.face_object[f] = source.face_object[kept[f]];
    }
    part.triangles.resize(kept.size());
    if (!part.face_material.empty()) part.face_material.resize(kept.size());
    if (!part.face_object.empty()) part.face_object.resize(kept.size());
    return part;
}

}  // namespace

void add_kept_parts(BakeJob& job, std::span<const std::uint8_t> untouched, KeptUvs kept) {
    SourceMaterials materials(job);
    std::vector<KeptPart> kept_parts;
    for (const BakePart& part : job.parts) {
        if (!job.skipped[part.index]) continue;
        const bool keeps_vertices = untouched[part.index] != 0;
        Part& to = job.result.asset.parts[part.index];
        to = keeps_vertices ? part_with_kept_faces(*part.source, part.simplified->history.kept_faces)
                            : std::move(kept.asset.parts[part.index]);
        for (Index& material : to.face_material) material = materials(material);
        if (keeps_vertices) job.result.report.untouched_parts.push_back(part_title(job.source, part.index));
        kept_parts.push_back({part.index, keeps_vertices});
    }
    if (!job.is_late) add_kept_images(job, kept_parts);
}

}  // namespace faqem::detail
