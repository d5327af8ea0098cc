#pragma once
/// \file
/// The size of the files of a model, and images of a result within a number of bytes.

#include <cstdint>

#include "bake/scene/unencoded_result.hpp"
#include "faqem/asset.hpp"
#include "faqem/options.hpp"

namespace faqem::detail {

/// Size of the files of a model, bytes.
struct ModelSize {
    std::uint64_t geometry = 0;  ///< other than images
    std::uint64_t images = 0;    ///< encoded images
    std::uint64_t fixed = 0;     ///< of the geometry: animations, whose size does not depend on the faces

    std::uint64_t total() const { return geometry + images; }
};

/// Returns the size of the files that save() would write. Files beside a model are named after it, and it refers to them
/// by these names: they are counted for a name with 64 characters, so that results do not depend on the name.
/// \param format  not ModelFormat::automatic
/// \throws WriteError  the format cannot hold the asset
/// Complexity: that of save() without writing.
ModelSize model_size(const Asset& asset, ModelFormat format);

/// Gives the pending images of a result the sizes and encodings that give the best pictures for the bytes. Faces,
/// positions and UVs stay.
/// \param result   has pending images; afterwards these are encoded, and none is pending
/// \param options  resolved; BakeOptions::image_quality is ignored
/// \param bytes    of all files
/// \return the size of the result. It is above `bytes` if even the smallest images do not fit; the result has these
/// \throws TimeLimitError  Options::max_seconds was over before images were chosen
/// \throws engine::Cancelled
/// Complexity: about ten encodings of each image, and renderings of six views.
ModelSize fit_images(UnencodedResult& result, const Options& options, const RunContext& context,
                     std::uint64_t bytes);

}  // namespace faqem::detail
