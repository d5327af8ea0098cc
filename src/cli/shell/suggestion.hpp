#pragma once
/// \file
/// "Did you mean": the known word that a wrong one is closest to.

#include <string>
#include <string_view>
#include <vector>

#include "cli/shell/command_tree.hpp"

namespace faqem::cli {

/// Letters to insert, delete, replace, or swap with their neighbour, to make one word the other; each place
/// is changed once at most (optimal string alignment). O(product of the lengths)
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The first of the closest words: one that begins with the wrong one, or is at most a third of its letters
/// (and at least one) away. Empty: there is none.
std::string closest_word(std::string_view wrong, const std::vector<std::string>& known);

/// The known command or option that is closest to the first wrong one.
/// \param words  of the command line, without the program's name
/// \return empty where nothing is wrong or nothing is close
std::string suggestion(const CommandTree& tree, const std::vector<std::string>& words);

}  // namespace faqem::cli
