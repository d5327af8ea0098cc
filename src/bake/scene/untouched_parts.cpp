#include "bake/scene/untouched_parts.hpp"

#include <utility>

#include "asset/scene/material_textures.hpp"
#include "asset/scene/messages.hpp"
#include "bake/transfer/material_groups.hpp"

namespace faqem::detail {
namespace {

bool keeps_untouched_parts(const BakeOptions& bake) {
    if (bake.untouched != UntouchedParts::automatic) return bake.untouched == UntouchedParts::kept;
    const BakeOptions standard;
    if (bake.normals != standard.normals || bake.crease_angle != standard.crease_angle) return false;
    if (bake.kind == Bake::keep) return true;
    const bool keeps_format =
        bake.image_format == standard.image_format || bake.image_format == ImageFormat::source;
    return bake.kind == Bake::automatic && bake.texture_size == standard.texture_size &&
           bake.texel_density == standard.texel_density && bake.normal_map == standard.normal_map &&
           bake.image_quality == standard.image_quality && keeps_format &&
           bake.correspondence == Recording::off;
}

// Whether each face of the result has the corners of the face it is made from, and the others were dropped
// before the run. The report tells apart results of a run from meshes that were made in another way.
bool is_untouched(const Part& part, const SimplifyResult& simplified) {
    const CollapseHistory& history = simplified.history;
    const TriangleMesh& mesh = simplified.mesh;
    if (mesh.triangles.empty() || simplified.report.faces_in != part.triangles.size() ||
        history.patch_count() > 0 || !history.deleted_faces.empty())
        return false;
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
        const Triangle &own = mesh.triangles[f], &from = part.triangles[history.kept_faces[f]];
        for (std::size_t c = 0; c < 3; ++c)
            if (mesh.positions[own[c]] != part.positions[from[c]]) return false;
    }
    return true;
}

// Copies materials and images of the source to the result when they are first needed.
class SourceMaterials {
public:
    explicit SourceMaterials(BakeJob& job)
        : job_(job),
          materials_(job.source.materials.size(), no_index),
          images_(job.source.images.size(), no_index) {
        if (job.options.bake.kind != Bake::keep) return;
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
    }
    part.triangles.resize(kept.size());
    if (!part.face_material.empty()) part.face_material.resize(kept.size());
    return part;
}

}  // namespace

std::vector<std::uint8_t> find_untouched_parts(const Asset& source, const SimplifiedParts& simplified,
                                               const BakeOptions& bake) {
    std::vector<std::uint8_t> result(source.parts.size(), 0);
    if (!keeps_untouched_parts(bake)) return result;
    for (std::size_t p = 0; p < result.size(); ++p)
        result[p] = is_untouched(source.parts[p], simplified.parts[p]) ? 1 : 0;
    return result;
}

void add_untouched_parts(BakeJob& job) {
    SourceMaterials materials(job);
    for (const BakePart& part : job.parts) {
        if (!job.untouched[part.index]) continue;
        Part& to = job.result.asset.parts[part.index];
        to = part_with_kept_faces(*part.source, part.simplified->history.kept_faces);
        for (Index& material : to.face_material) material = materials(material);
        job.result.report.untouched_parts.push_back(part_title(job.source, part.index));
    }
}

}  // namespace faqem::detail
