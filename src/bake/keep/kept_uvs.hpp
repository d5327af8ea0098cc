#pragma once
/// \file
/// Parts that keep the UVs of the source because their pictures are as good as with new images.

#include <optional>
#include <span>
#include <vector>

#include "bake/parts/corners.hpp"
#include "bake/texture/picture_difference.hpp"
#include "faqem/bake.hpp"
#include "faqem/detail/base/parallel.hpp"
#include "render/texture_sampling.hpp"

namespace faqem::detail {

/// Indices of parts that share images, so that either all or none of them keep their UVs.
using PartSet = std::vector<Index>;

/// The parts that could keep their UVs.
struct PartsWithUvs {
    std::vector<PartSet> sets;
    /// With these parts, from SimplifiedParts::with_uvs, and the materials and images of the source.
    Asset asset;
};

/// Outcome of compare_uvs().
struct ComparedUvs {
    std::vector<Index> good;  ///< the parts of all sets whose pictures are as good with UVs, ascending
    std::optional<PictureDifference> pictures;  ///< of the sets, as they are afterwards
};

/// The sets of parts that could keep their UVs: each part has reached the face count of its simplification without UVs, up
/// to a hundredth if the model reaches its target nevertheless, and lost no more faces and hardly more components.
/// \param parts       from SimplifiedParts::parts; kept ones are ignored
/// \param simplified  has as many parts in `with_uvs` as in `parts`
/// Complexity: O(faces).
std::vector<PartSet> sets_with_uvs(const Asset& source, std::span<const BakePart> parts,
                                   const SimplifiedParts& simplified);

/// Compares pictures of parts that keep their UVs with those of perfect new images. A set is good if pictures of it have
/// a PSNR at most 0.8 dB lower, and 0.25 dB in the mean of small and large ones (unlit and lit pictures each), 2 dB
/// where new images would have less than an eighth of the resolution. It is also good if its textures are shown without
/// filter, or if something else refers to its UVs (parts_that_need_uvs()).
/// \param parts       as they would be baked; those that are not kept have maps and normals
/// \param candidates  at least one set
/// \param decoded     images of the source that are decoded already; those that are missing are added
/// \throws engine::Cancelled
/// Complexity: that of compare_pictures() for each set.
ComparedUvs compare_uvs(const Asset& source, const BakeOptions& bake, std::span<const BakePart> parts,
                        const PartsWithUvs& candidates, DecodedImages& decoded, const RunContext& context);

/// Makes parts kept ones: their simplified meshes are those with UVs.
/// \param simplified  must outlive the parts
/// \param which       indices of parts with UVs; kept ones are ignored
void keep_uvs(const SimplifiedParts& simplified, std::span<const Index> which, std::span<BakePart> parts);

}  // namespace faqem::detail
