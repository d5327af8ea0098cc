#pragma once
/// \file
/// UVs and vertex colours of the source at the corners of a mesh that was simplified without regard to them.

#include <cstdint>
#include <string>
#include <vector>

#include "bake/parts/corners.hpp"
#include "faqem/detail/base/parallel.hpp"

namespace faqem::detail {

/// Attributes at the corners of a simplified mesh.
struct TransferredCorners {
    /// By corner: UVs of all sets, then the colour if the source has vertex colours.
    std::vector<float> values;
    std::vector<Index> faces;  ///< by face: the face of the source at its centre
    /// Faces that cross a border of a UV chart. Images are distorted there.
    std::uint64_t crossing_faces = 0;
};

/// Reads the attributes from the source through the map of the part. A face that crosses a border of a UV chart shows
/// the chart at its centre up to the border, stretched over the whole face.
/// \pre part.map is not null
/// \throws whatever `context` throws
/// Complexity: 4 queries of the map per face, and 6 more for each corner beyond a border.
TransferredCorners transfer_corners(const BakePart& part, const RunContext& context);

/// Whether the simplified mesh of a part has the UVs and vertex colours of the source as attributes.
bool has_corner_attributes(const BakePart& part);

/// What a part keeps.
struct KeptCorners {
    CornerValues values;               ///< UVs and vertex colours
    std::vector<Index> materials;      ///< by face: those of the source
    std::uint64_t crossing_faces = 0;  ///< as in TransferredCorners
};

/// The UVs and vertex colours of a part: the attributes of the simplified mesh or, if it has none, those of
/// transfer_corners().
KeptCorners kept_corners(const BakePart& part, const RunContext& context);

/// Adds a warning about faces that cross borders of UV charts, if there are any.
void warn_of_crossing_faces(std::uint64_t count, std::vector<std::string>& warnings);

}  // namespace faqem::detail
