#pragma once
/// \file
/// Levels of detail in glTF: the extension MSFT_lod.

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "faqem/asset.hpp"

namespace faqem::detail {

/// The parts of all levels in one asset.
struct LeveledAsset {
    /// The parts of the first level, then those of the second, which have no source ...
    Asset asset;
    std::size_t parts_per_level = 0;  ///< of a level
    /// By part, what MSFT_screencoverage is to be: one value per level.
    std::vector<std::vector<double>> coverage;

    std::size_t levels() const { return parts_per_level == 0 ? 0 : asset.parts.size() / parts_per_level; }
};

struct GltfWriter;

/// Gives nodes with a mesh of the first level nodes with those of the others.
/// \param writer  its scene is written, with the first level alone
/// \param mesh    output mesh of each part of `leveled`, no_index: left out
void attach_levels(GltfWriter& writer, const LeveledAsset& leveled, const std::vector<Index>& mesh);

/// As write_gltf(). Defined in gltf_write.cpp.
std::vector<std::string> write_gltf_levels(const LeveledAsset& leveled, const std::filesystem::path& file,
                                           Overwrite overwrite);

}  // namespace faqem::detail
