#include "cli/shell/suggestion.hpp"

#include <algorithm>

#include "faqem/detail/base/closest_word.hpp"

namespace faqem::cli {

using detail::closest_word;

std::string suggestion(const CommandTree& tree, const std::vector<std::string>& words) {
    if (words.empty()) return {};
    std::vector<std::string> commands;
    for (const CommandInfo& command : tree.commands) commands.push_back(command.name);
    const auto chosen = std::find(commands.begin(), commands.end(), words[0]);
    if (chosen == commands.end()) {
        return closest_word(words[0], words[0].starts_with('-') ? names_of(tree.options) : commands);
    }
    const std::vector<std::string> known =
        names_of(tree.commands[static_cast<std::size_t>(chosen - commands.begin())].options);
    for (std::size_t i = 1; i < words.size() && words[i] != "--"; ++i) {
        if (!words[i].starts_with("--")) continue;
        const std::string name = words[i].substr(0, words[i].find('='));
        if (std::find(known.begin(), known.end(), name) == known.end()) return closest_word(name, known);
    }
    return {};
}

}  // namespace faqem::cli
