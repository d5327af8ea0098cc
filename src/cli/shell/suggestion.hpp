#pragma once
/// \file
/// Suggestions for misspelt commands and options.

#include <string>
#include <string_view>
#include <vector>

#include "cli/shell/command_tree.hpp"

namespace faqem::cli {

/// Returns the optimal string alignment distance: the number of insertions, deletions, replacements and swaps
/// of adjacent characters that turn one word into the other, where no substring is edited more than once.
/// Complexity: O(a.size() * b.size()).
std::size_t edit_distance(std::string_view a, std::string_view b);

/// Returns the closest known word; the first one if several are equally close. A word that begins with
/// `wrong` (of at least four characters) has distance 0. Empty if no word is within max(1, a third of the
/// length of `wrong`).
std::string closest_word(std::string_view wrong, const std::vector<std::string>& known);

/// Returns the known command or option that is closest to the first unknown one on a command line.
/// \param words  the command line without the name of the program
/// \return empty if no command or option is unknown or none is close
std::string suggestion(const CommandTree& tree, const std::vector<std::string>& words);

}  // namespace faqem::cli
