#pragma once
/// \file
/// Parsing of one entry of `faqem lod --levels`.

#include <string>

#include "cli/commands/lod_manifest.hpp"
#include "faqem/levels.hpp"

namespace faqem::cli {

/// Parses one level. `pixels:2@50` is an error that covers at most 2 pixels at a distance of 50 model units
/// from the camera; other texts are parsed by parse_level().
/// \throws OptionError  the text has another form
Level parse_lod_level(const std::string& text, const ViewSettings& view_settings);

}  // namespace faqem::cli
