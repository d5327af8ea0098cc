#pragma once
/// \file
/// Division of parts into the objects that a file names.

#include <cstddef>
#include <optional>
#include <vector>

#include "faqem/asset.hpp"

namespace faqem::detail {

/// An asset whose parts are objects.
struct DividedAsset {
    Asset asset;
    std::vector<std::size_t> part;  ///< by part of `asset`: the part that it is taken from
};

/// Makes a part of each object. Objects have the vertices that their faces use, in the same order; those that
/// share vertices each get a copy. Objects without faces become parts without faces, so that all levels of detail have
/// the same parts. Parts without objects are copied.
/// \return none if no part has objects
/// Complexity: O(size of the asset).
std::optional<DividedAsset> divided_into_objects(const Asset& asset);

}  // namespace faqem::detail
