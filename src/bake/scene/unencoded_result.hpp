#pragma once
/// \file
/// A baked asset whose images are encoded afterwards, so that a larger result can be encoded with less.

#include "bake/texture/pending_images.hpp"
#include "faqem/bake.hpp"

namespace faqem::detail {

/// bake() without the encoding of images. \throws engine::Cancelled, also if the parts are those of a cancelled run
/// \throws as bake()
UnencodedResult bake_unencoded(const Asset& source, const SimplifiedParts& simplified, const Options& options,
                               const RunContext& context);

/// bake() without the rules about the size of results and without histories. \throws as bake_unencoded()
SimplifiedAsset bake_encoded(const Asset& source, const SimplifiedParts& simplified, const Options& options,
                             const RunContext& context);

/// bake() of parts that were simplified with Bake::keep. All keep their UVs and, other than in bake_unencoded(), their
/// images are pending, unless BakeOptions::image_format is ImageFormat::source. No part is untouched
/// (BakeOptions::untouched), and all have FileOrder::for_gpu. The result has all materials and
/// images of the source, with the same indices.
/// \throws as bake()
UnencodedResult bake_with_uvs(const Asset& source, const SimplifiedParts& simplified, const Options& options,
                              const RunContext& context);

/// Encodes the pending images, which stay pending, and reports all images.
/// \param options  those of BakeOptions that are about the encoding
/// \param context  if its time is over, images that ImageFormat::automatic is about get the format of the source
void encode_images(UnencodedResult& result, const Options& options, const RunContext& context);

/// Halves pending images that have a side of more than `side` texels, as long as their sides are even. Images that are
/// shown without filter keep their resolution.
/// Complexity: O(texels).
void limit_image_sides(UnencodedResult& result, std::uint32_t side);

/// Removes the materials that neither a face nor a variant of a part has, and the images that no material has.
/// Complexity: O(faces + variants * materials + images).
void remove_unused_materials(UnencodedResult& result);

/// Removes the normal maps of materials without one in the source, and the tangents for them.
/// \return whether there were any
bool remove_new_normal_maps(UnencodedResult& result);

/// Copies the histories of the parts to the result, if Options::history is on.
void add_histories(const SimplifiedParts& simplified, const Options& options, SimplifiedAsset& result);

}  // namespace faqem::detail
