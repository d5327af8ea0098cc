#pragma once
/// \file
/// Images of parts that keep their UVs, with as many texels and bytes as what is shown of them needs.

#include <span>

#include "bake/texture/pending_images.hpp"

namespace faqem::detail {

/// A part of the result that was not baked.
struct KeptPart {
    Index part = 0;
    bool keeps_images = false;  ///< whether its images stay as they are
};

/// Adds the images of parts that keep their UVs to the pending ones, so that they are encoded again; only the texels
/// that the parts show count for their loss. An image with a side of more than BakeOptions::texture_size texels is
/// halved first. Images stay as they are if another part keeps its images, or if it is not known what they hold.
/// Images that are shown with Filter::nearest keep their resolution.
/// \param bake   size and encoding of images
/// \param parts  all parts of the result that were not baked
/// \param out    the result, with the images of the source
/// \throws InputError if an image is damaged, engine::Cancelled
/// Complexity: that of decoding each image, and O(faces).
void add_kept_images(const Asset& source, const BakeOptions& bake, std::span<const KeptPart> parts,
                     const RunContext& context, UnencodedResult& out);

}  // namespace faqem::detail
