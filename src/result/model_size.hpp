#pragma once
/// \file
/// The size of the files of a model.

#include <cstdint>

#include "faqem/asset.hpp"
#include "faqem/option_types.hpp"

namespace faqem::detail {

/// Size of the files of a model, bytes.
struct ModelSize {
    std::uint64_t geometry = 0;  ///< other than images
    std::uint64_t images = 0;    ///< encoded images

    std::uint64_t total() const { return geometry + images; }
};

/// Returns the size of the files that save() would write. Files beside a model are named after it, and it refers to them
/// by these names: they are counted for a name with 64 characters, so that results do not depend on the name.
/// \param format  not ModelFormat::automatic
/// \throws WriteError  the format cannot hold the asset
/// Complexity: that of save() without writing.
ModelSize model_size(const Asset& asset, ModelFormat format);

}  // namespace faqem::detail
