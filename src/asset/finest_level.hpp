#pragma once
/// \file
/// The finest level of detail of a glTF scene whose nodes or materials have coarser ones (MSFT_lod).

#include <optional>
#include <string>
#include <utility>

#include "faqem/asset.hpp"
#include "faqem/export.hpp"

namespace faqem::detail {

/// An asset without the coarser levels of its file.
struct FinestLevel {
    /// As the source, with equal indices of parts. Parts that only coarser levels show are empty, and save() writes
    /// nothing of them. The nodes of coarser levels, and the skins, animations, materials and images of these alone,
    /// are removed; where an extension that is not known may refer to nodes by number, empty nodes stay in their place.
    Asset asset;
    std::string warning;  ///< how many levels were left out; empty if there were none
};

/// Leaves out the coarser levels of an asset, and MSFT_lod. Nodes of coarser levels that are joints of a skin in the
/// finest one, and their ancestors, stay without their meshes.
/// \return nothing if the asset has no levels of detail
/// Complexity: O(nodes + materials), and O(size of the asset) if there are levels.
FAQEM_EXPORT std::optional<FinestLevel> finest_level(const Asset& asset);

/// Replaces an asset by its finest level, if it has others.
/// \return FinestLevel::warning
inline std::string keep_finest_level(Asset& asset) {
    std::optional<FinestLevel> finest = finest_level(asset);
    if (!finest) return {};
    asset = std::move(finest->asset);
    return std::move(finest->warning);
}

}  // namespace faqem::detail
