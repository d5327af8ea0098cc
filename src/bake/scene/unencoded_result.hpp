#pragma once
/// \file
/// A baked asset whose images are encoded afterwards, so that a larger result can be encoded with less.

#include "bake/texture/pending_images.hpp"
#include "faqem/bake.hpp"
#include "faqem/export.hpp"

namespace faqem::detail {

/// bake() without the encoding of images. \throws as bake()
FAQEM_EXPORT UnencodedResult bake_unencoded(const Asset& source, const SimplifiedParts& simplified,
                                            const Options& options);

/// Encodes the pending images, which stay pending, and reports all images. Does nothing for a cancelled result.
/// \param options  those of BakeOptions that are about the encoding, the threads, the progress callback, and
///     max_seconds, which counts from the call: if it is over, images that ImageFormat::automatic is about get
///     the format of the source
FAQEM_EXPORT void encode_images(UnencodedResult& result, const Options& options);

/// Removes the normal maps of materials without one in the source, and the tangents for them.
/// \return whether there were any
FAQEM_EXPORT bool remove_new_normal_maps(UnencodedResult& result);

/// Makes the result that of a run whose progress callback has cancelled.
void set_cancelled(SimplifiedAsset& result);

}  // namespace faqem::detail
