#pragma once
/// \file
/// What `faqem lod --levels` says of one level.

#include <string>

#include "cli/commands/lod_manifest.hpp"
#include "faqem/levels.hpp"

namespace faqem::cli {

/// `pixels:2@50`, an error that covers at most 2 pixels where the eye is 50 model units away; else as
/// parse_level().
/// \throws OptionError
Level parse_lod_level(const std::string& text, const ViewSettings& view_settings);

}  // namespace faqem::cli
