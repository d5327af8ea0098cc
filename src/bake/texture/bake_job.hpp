#pragma once
/// \file
/// The kinds of baking.

#include <span>

#include "bake/parts/corners.hpp"
#include "bake/texture/pending_images.hpp"
#include "faqem/asset.hpp"
#include "faqem/detail/base/parallel.hpp"
#include "faqem/options.hpp"
#include "render/texture_sampling.hpp"

namespace faqem::detail {

/// What is baked, and how. The functions below add materials, images and parts to an empty result; a part that is
/// kept is empty in it.
struct BakeJob {
    const Asset& source;
    const BakeOptions& options;
    std::span<const BakePart> parts;  ///< by part of the source, as map_parts() makes them
    const RunContext& context;
    /// Whether bake_keep() throws instead of transferring UVs and vertex colours.
    bool needs_attributes = false;
};

/// Bakes new images with a new atlas.
/// \param decoded  images of the source that are decoded already
/// \return false, without changing anything, if a page has more charts than texels or, for an atlas by
///     triangle, more triangles
bool bake_pages(const BakeJob& job, DecodedImages decoded, UnencodedResult& out);

/// Bakes the base colour into vertex colours. The result has no textures.
void bake_vertex(const BakeJob& job, UnencodedResult& out);

/// Keeps the source's UVs and vertex colours, and all of its materials and images.
/// \throws InputError if BakeJob::needs_attributes and a simplified mesh has no UVs and vertex colours; otherwise these
///     are transferred from the source
void bake_keep(const BakeJob& job, UnencodedResult& out);

/// Removes UVs, vertex colours and images.
void bake_none(const BakeJob& job, UnencodedResult& out);

}  // namespace faqem::detail
