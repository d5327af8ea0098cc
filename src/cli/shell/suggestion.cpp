#include "cli/shell/suggestion.hpp"

#include <algorithm>

namespace faqem::cli {

namespace {

std::vector<std::string> names_of(const std::vector<OptionInfo>& options) {
    std::vector<std::string> names;
    for (const OptionInfo& option : options)
        names.insert(names.end(), option.names.begin(), option.names.end());
    return names;
}

bool is_known(const std::string& word, const std::vector<std::string>& known) {
    return std::find(known.begin(), known.end(), word) != known.end();
}

}  // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
    for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
    for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = d[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
            d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, replaced});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
        }
    }
    return d[a.size()][b.size()];
}

std::string closest_word(std::string_view wrong, const std::vector<std::string>& known) {
    constexpr std::size_t longest = 64;  // limits the work; all options are shorter
    if (wrong.size() > longest) return {};
    std::size_t best = std::max<std::size_t>(1, wrong.size() / 3) + 1;
    std::string found;
    for (const std::string& word : known) {
        const bool begins = wrong.size() >= 4 && word.starts_with(wrong);
        const std::size_t distance = begins ? 0 : edit_distance(wrong, word);
        if (distance >= best) continue;
        best = distance;
        found = word;
    }
    return found;
}

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
        if (!is_known(name, known)) return closest_word(name, known);
    }
    return {};
}

}  // namespace faqem::cli
