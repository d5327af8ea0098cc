#pragma once
/// \file
/// The manual page.

#include <string>
#include <string_view>

#include "cli/shell/command_tree.hpp"

namespace faqem::cli {

/// faqem(1), in the man macros of troff. \param version  as faqem::version()
std::string man_page(const CommandTree& tree, std::string_view version);

}  // namespace faqem::cli
