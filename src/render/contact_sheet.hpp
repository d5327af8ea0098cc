#pragma once
/// \file
/// Composition of rendered frames to one image.

#include <string>
#include <vector>

#include "render/rasterizer.hpp"

namespace faqem::render {

/// A row of the contact sheet: the views of one model.
struct ContactSheetRow {
    std::vector<Frame> frames;  ///< all of the same size
    std::string label;          ///< digits, commas, spaces and the letters of "faces"; others are not drawn
};

/// Composes rows of frames from top to bottom on a grey background, with labels at the lower left of each
/// row. The result is opaque sRGB.
/// \pre at least one row with at least one frame; all rows have the same number of frames of the same size
FAQEM_EXPORT Pixels compose_contact_sheet(const std::vector<ContactSheetRow>& rows);

}  // namespace faqem::render
