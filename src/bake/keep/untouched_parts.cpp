#include "bake/keep/untouched_parts.hpp"

namespace faqem::detail {
namespace {

bool keeps_untouched_parts(const BakeOptions& bake) {
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

// Whether each face of the result has the corners of the face it is made from, and the others were dropped
// before the run. The report tells apart results of a run from meshes that were made in another way.
bool is_untouched(const Part& part, const SimplifyResult& simplified) {
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

}  // namespace

std::vector<std::uint8_t> find_untouched_parts(const Asset& source, const SimplifiedParts& simplified,
                                               const BakeOptions& bake) {
    std::vector<std::uint8_t> result(source.parts.size(), 0);
    if (!keeps_untouched_parts(bake)) return result;
    for (std::size_t p = 0; p < result.size(); ++p)
        result[p] = is_untouched(source.parts[p], simplified.parts[p]) ? 1 : 0;
    return result;
}

}  // namespace faqem::detail
