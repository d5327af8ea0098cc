#include "cli/shell/deprecated_names.hpp"

#include <array>
#include <string_view>

namespace faqem::cli {

namespace {

struct Renamed {
    std::string_view old_name, name;
};

constexpr std::array renamed_commands = {Renamed{"cut", "truncate"}};
constexpr std::array renamed_options = {Renamed{"--lock-border", "--lock-boundary"}};

struct RenamedValue {
    std::string_view option, old_value, value;
};

constexpr std::array renamed_values = {RenamedValue{"--visibility", "weighs", "weighted"}};

void replace(std::string& word, std::string_view name, std::vector<std::string>& warnings) {
    warnings.push_back("'" + word + "' is deprecated: use '" + std::string(name) + "'");
    word = name;
}

/// Replaces the value of an option, which is the following word or follows a `=`.
void replace_value(const RenamedValue& renamed, std::string& word, const std::string& previous,
                   std::vector<std::string>& warnings) {
    const std::string prefix = std::string(renamed.option) + "=";
    if (previous == renamed.option && word == renamed.old_value) replace(word, renamed.value, warnings);
    if (word == prefix + std::string(renamed.old_value))
        replace(word, prefix + std::string(renamed.value), warnings);
}

}  // namespace

std::string current_option_name(const std::string& option) {
    for (const Renamed& renamed : renamed_options) {
        if (option == renamed.old_name) return std::string(renamed.name);
    }
    return option;
}

std::vector<std::string> replace_deprecated_names(std::vector<std::string> words,
                                                  std::vector<std::string>& warnings) {
    for (const Renamed& renamed : renamed_commands) {
        if (!words.empty() && words.front() == renamed.old_name)
            replace(words.front(), renamed.name, warnings);
    }
    for (std::size_t i = 1; i < words.size() && words[i] != "--"; ++i) {
        const std::string current = current_option_name(words[i]);
        if (current != words[i]) replace(words[i], current, warnings);
        for (const RenamedValue& renamed : renamed_values)
            replace_value(renamed, words[i], words[i - 1], warnings);
    }
    return words;
}

}  // namespace faqem::cli
