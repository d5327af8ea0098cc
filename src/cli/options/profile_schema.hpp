#pragma once
/// \file
/// The JSON schema of profiles, docs/profile.schema.json.

#include <string>

#include "cli/shell/command_tree.hpp"

namespace faqem::cli {

/// Returns a schema with the options of all commands that read profiles. An option of several commands is
/// described as for the first one.
std::string profile_schema(const CommandTree& tree);

}  // namespace faqem::cli
