#pragma once
/// \file
/// Generation of the manual page.

#include <string>
#include <string_view>

#include "cli/shell/command_tree.hpp"

namespace faqem::cli {

/// Returns the manual page faqem(1) in the man macros of troff. \param version  value of faqem::version()
std::string man_page(const CommandTree& tree, std::string_view version);

}  // namespace faqem::cli
