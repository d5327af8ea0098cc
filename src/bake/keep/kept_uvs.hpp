#pragma once
/// \file
/// Parts that keep the UVs of the source because their pictures are as good as with new images.

#include <vector>

#include "bake/texture/bake_job.hpp"
#include "faqem/bake.hpp"

namespace faqem::detail {

/// Whether the options leave it to bake() to keep UVs: Bake::automatic without any option that is about a new atlas
/// or about the collapses.
bool may_keep_uvs(const Options& options);

/// The parts that could keep their UVs.
struct KeptUvs {
    Asset asset;                    ///< the candidates, with the materials and images of the source
    std::vector<Index> candidates;  ///< the parts that could keep their UVs
};

/// Compares pictures of SimplifiedParts::kept with those of perfect new images. Parts that share images are accepted
/// together: if each of them has reached the face count of its simplification without UVs and lost no more faces and
/// hardly more components, and if pictures of them have a PSNR at most 0.8 dB lower, and 0.25 dB in the mean of small
/// and large ones (unlit and lit pictures each), 2 dB where new images would have less than an eighth of the
/// resolution, or if their textures are shown without filter. Accepted parts are skipped in the job, and their
/// simplified meshes and reports are those with UVs. If the time is over before the comparison is complete, no part
/// is accepted.
/// \param job         after map_parts()
/// \param simplified  must outlive the job
/// \throws engine::Cancelled
/// Complexity: that of bake_keep() and of compare_pictures() for each set of parts that share images.
KeptUvs choose_kept_uvs(BakeJob& job, const SimplifiedParts& simplified);

/// Accepts all candidates without comparing pictures, for lack of time.
/// \param simplified, kept  argument and result of choose_kept_uvs()
void keep_all_candidates(BakeJob& job, const SimplifiedParts& simplified, const KeptUvs& kept);

}  // namespace faqem::detail
