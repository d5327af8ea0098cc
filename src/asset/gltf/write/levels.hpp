#pragma once
/// \file
/// Writing of levels of detail in glTF with the extension MSFT_lod.

#include <cstddef>
#include <filesystem>
#include <vector>

#include "asset/io/encoded_model.hpp"
#include "faqem/asset.hpp"

namespace faqem::detail {

/// The parts of all levels in one asset.
struct LeveledAsset {
    /// The parts of the first level, followed by the parts of the other levels, which have no source.
    Asset asset;
    std::size_t parts_per_level = 0;
    /// By part of the asset: the source mesh of the same part of the first level.
    std::vector<Index> sources = {};
    /// Values of MSFT_screencoverage: for each part, one value per level.
    std::vector<std::vector<double>> coverage;

    std::size_t levels() const { return parts_per_level == 0 ? 0 : asset.parts.size() / parts_per_level; }
};

struct GltfWriter;

/// Adds nodes with the meshes of the other levels to the nodes with a mesh of the first level.
/// \param writer   its scene is written and contains only the first level
/// \param leveled  the parts of all levels
/// \param mesh     output mesh of each part of `leveled`; no_index if it was left out
void attach_levels(GltfWriter& writer, const LeveledAsset& leveled, const std::vector<Index>& mesh);

/// Encodes all levels as one file. Same as encode_gltf() otherwise. Defined in write/write.cpp.
EncodedModel encode_gltf_levels(const LeveledAsset& leveled, const std::filesystem::path& file);

}  // namespace faqem::detail
