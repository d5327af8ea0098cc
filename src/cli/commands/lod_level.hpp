#pragma once
/// \file
/// What `faqem lod --levels` says of one level.

#include <string>

#include "faqem/levels.hpp"
#include "cli/commands/lod_manifest.hpp"

namespace faqem::tool {

/// `pixels:2@50`, an error that covers at most 2 pixels where the eye is 50 model units away; else as
/// level_of().
/// \throws OptionError
Level lod_level(const std::string& text, const Viewing& viewing);

}  // namespace faqem::tool
