#pragma once
/// \file
/// Parsing of one entry of `faqem lod --levels`.

#include <string>

#include "cli/commands/lod_manifest.hpp"
#include "faqem/levels.hpp"

namespace faqem::cli {

/// Parses one level: `0.5` or `50%` (ratio of faces), `5000` (number of faces), `error:0.01` (distance in model units),
/// `error:0.1%` (distance relative to the diagonal) or `pixels:2@50` (an error that covers at most 2 pixels at a distance
/// of 50 model units from the camera).
/// \throws OptionError  the text has another form
Level parse_level(const std::string& text, const ViewSettings& view_settings);

}  // namespace faqem::cli
