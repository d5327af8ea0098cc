#pragma once
/// \file
/// Puts rendered frames side by side into one picture.

#include <string>
#include <vector>

#include "render/rasteriser.hpp"

namespace faqem::render {

/// The views of one model.
struct ContactSheetRow {
    std::vector<Frame> frames;  ///< all of the same size
    std::string label;          ///< digits, commas, spaces and the letters of "faces"
};

/// One row under the other on a neutral ground, labels at the left. sRGB, opaque.
Pixels compose_contact_sheet(const std::vector<ContactSheetRow>& rows);

}  // namespace faqem::render
