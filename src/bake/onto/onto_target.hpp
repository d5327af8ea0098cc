#pragma once
/// \file
/// The mesh that bake_onto() textures: as one part in scene space, and with the result in its own parts.

#include <memory>
#include <vector>

#include "bake/parts/corners.hpp"
#include "faqem/asset.hpp"
#include "faqem/detail/base/parallel.hpp"
#include "faqem/options.hpp"

namespace faqem::detail {

/// A part as baking needs it: with welded positions, and with normals.
struct TargetMesh {
    SimplifyResult mesh;  ///< of its history, only remaining_faces, which are to be set
    BakePart part;        ///< without a map; refers to `mesh`
};

/// Makes the mesh of a part. Corners without a normal get that of make_normals() with Normals::smooth.
/// \param part  must outlive the result
std::unique_ptr<TargetMesh> target_mesh(const Part& part, const BakeOptions& bake, const RunContext& context);

/// The faces of a scene in world space, in the order of the parts. Each part with an instance has its first one.
struct FlatTarget {
    struct Piece {
        Index part = 0;  ///< of the scene
        Index first_face = 0, first_vertex = 0;
    };
    std::vector<Piece> pieces;
    Part flat;
};

/// Puts the first instance of each part into world space.
/// \throws InputError  there are more faces or vertices than an Index can count
FlatTarget flat_target(const Asset& target);

/// By corner of the flat part: the UVs of the first set of the target. Empty if a part has none, if any is outside of
/// [0, 1], or if faces overlap on the page.
/// \param fault  receives the reason why they are empty
std::vector<Vec2f> usable_uvs(const Asset& target, const FlatTarget& flat, std::string& fault);

/// A part of the target with its part of the result.
/// \param part   of the target
/// \param piece  that of the part
/// \param baked  has the faces of the flat part, with UVs and materials
/// \param keeps_uvs  whether the UVs are those of the part
/// \param materials  of the result
Part textured_part(const Part& part, const FlatTarget& target, const FlatTarget::Piece& piece,
                   const Part& baked, bool keeps_uvs, const std::vector<Material>& materials,
                   const BakeOptions& bake, const RunContext& context);

}  // namespace faqem::detail
