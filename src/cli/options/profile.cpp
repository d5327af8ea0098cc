#include "cli/options/profile.hpp"

#include <algorithm>
#include <optional>
#include <set>

#include "asset/io/file.hpp"
#include "cli/files/protected_files.hpp"
#include "cli/options/bound_options.hpp"
#include "cli/options/builtin_profiles.hpp"
#include "cli/process/json.hpp"
#include "faqem/detail/base/closest_word.hpp"
#include "faqem/error.hpp"

namespace faqem::cli {

namespace {

constexpr const char* version_key = "faqem-profile";
constexpr int profile_version = 1;
constexpr std::uint64_t max_file_size = 1'000'000;

/// Returns the value of an option with a long name on the command line; empty if the option is the last word;
/// nothing if it is not given.
std::optional<std::string> value_of(const std::string& option, const std::vector<std::string>& words) {
    for (std::size_t i = 0; i < words.size() && words[i] != "--"; ++i) {
        if (words[i].starts_with(option + "=")) return words[i].substr(option.size() + 1);
        if (words[i] == option) return i + 1 < words.size() ? words[i + 1] : std::string();
    }
    return std::nullopt;
}

/// Parses a profile. Rejects duplicate keys, of which nlohmann::json would silently keep the last.
Json parse_profile(const std::string& file) {
    const std::vector<std::uint8_t> bytes = detail::read_file(file, max_file_size);
    std::set<std::string> keys;
    const auto reject_duplicate_keys = [&](int depth, Json::parse_event_t event, Json& value) {
        if (event == Json::parse_event_t::key && depth == 1 && !keys.insert(value.get<std::string>()).second)
            throw InputError(file, value.get<std::string>(), "duplicate key");
        return true;
    };
    try {
        Json profile = Json::parse(bytes, reject_duplicate_keys);
        if (!profile.is_object()) throw InputError(file, "", "is not a JSON object");
        return profile;
    } catch (const Json::exception& error) {
        throw InputError(file, "", std::string("is not valid JSON: ") + error.what());
    }
}

/// Tests whether a command has --config.
bool reads_profiles(const CommandInfo& command) {
    return std::any_of(command.options.begin(), command.options.end(),
                       [](const OptionInfo& option) { return option.names.back() == "--config"; });
}

/// The key of an option in profiles: its name without dashes; empty if profiles do not have it.
std::string profile_key(const OptionInfo& option) {
    const std::string& name = option.names.back();
    const bool is_key = option.read && !option.is_positional && name != "--config" && name != "--profile";
    return is_key ? name.substr(2) : "";
}

const OptionInfo* find_option(const CommandInfo& command, const std::string& key) {
    for (const OptionInfo& option : command.options) {
        if (!key.empty() && profile_key(option) == key) return &option;
    }
    return nullptr;
}

[[noreturn]] void throw_unknown_key(const CommandTree& tree, const CommandInfo& command,
                                    const std::string& file, const std::string& key) {
    std::string text = file + ": '" + key + "' is not an option of faqem " + command.name;
    std::vector<std::string> known;
    for (const OptionInfo& option : command.options) {
        if (const std::string name = profile_key(option); !name.empty()) known.push_back(name);
    }
    const std::string suggested = detail::closest_word(key, known);
    const auto other = std::find_if(tree.commands.begin(), tree.commands.end(),
                                    [&](const CommandInfo& c) { return find_option(c, key) != nullptr; });
    if (!suggested.empty())
        text += "; did you mean '" + suggested + "'?";
    else if (other != tree.commands.end())
        text += ", but of faqem " + other->name;
    throw OptionError(text);
}

std::string text_of(const Json& value, const std::string& where) {
    if (value.is_string()) return value.get<std::string>();
    if (value.is_number()) return value.dump();
    throw OptionError(where + ": must be a number or a string");
}

/// Converts an entry of a profile to words of the command line; none for a flag that is false.
std::vector<std::string> to_words(const OptionInfo& option, const Json& value, const std::string& where) {
    const std::string& name = option.names.back();
    if (option.kind == detail::OptionKind::flag) {
        if (value.is_boolean()) return value.get<bool>() ? std::vector{name} : std::vector<std::string>();
        throw OptionError(where + ": must be true or false");
    }
    if (!value.is_array()) return {name + "=" + text_of(value, where)};
    std::string list;
    for (const Json& one : value) list.append(list.empty() ? "" : ",").append(text_of(one, where));
    return {name + "=" + list};
}

/// Tests whether a word has the short name of an option, which letters of flags may precede: `-fr.2`.
bool has_letter(const CommandInfo& command, const OptionInfo& option, const std::string& word) {
    for (std::size_t i = 1; word.starts_with('-') && i < word.size(); ++i) {
        const auto found = std::find_if(
            command.options.begin(), command.options.end(),
            [name = std::string("-") + word[i]](const OptionInfo& one) { return one.names.front() == name; });
        if (found == command.options.end()) return false;
        if (&*found == &option) return true;
        if (found->kind != detail::OptionKind::flag) return false;
    }
    return false;
}

bool is_overridden(const CommandInfo& command, const OptionInfo& option,
                   const std::vector<std::string>& words) {
    const auto end = std::find(words.begin(), words.end(), "--");
    return std::any_of(command.options.begin(), command.options.end(), [&](const OptionInfo& other) {
        const std::string& name = other.names.back();
        if (&other != &option && !std::binary_search(option.excludes.begin(), option.excludes.end(), name))
            return false;
        return value_of(name, words) || std::any_of(words.begin(), end, [&](const std::string& word) {
                   return has_letter(command, other, word);
               });
    });
}

void check_version(const Json& profile, const std::string& file) {
    if (!profile.contains(version_key))
        throw OptionError(file + ": is not a profile: \"" + version_key + "\": 1 is missing");
    if (profile[version_key] != profile_version)
        throw OptionError(file + ": " + version_key + ": version " + profile[version_key].dump() +
                          " is not supported, only version 1");
}

// Inserts options before `--`, because words after it are not options.
void insert_options(std::vector<std::string>& words, const std::vector<std::string>& added) {
    words.insert(std::find(words.begin(), words.end(), "--"), added.begin(), added.end());
}

void add_profile_file(const CommandTree& tree, const CommandInfo& command, const std::string& file,
                      std::vector<std::string>& words) {
    protect_input(file);
    const Json profile = parse_profile(file);
    check_version(profile, file);
    std::vector<std::string> added;
    for (const auto& [key, value] : profile.items()) {
        if (key == version_key) continue;
        const OptionInfo* option = find_option(command, key);
        if (!option) throw_unknown_key(tree, command, file, key);
        const std::vector<std::string> more = to_words(*option, value, file + ": " + key);
        if (!is_overridden(command, *option, words)) added.insert(added.end(), more.begin(), more.end());
    }
    insert_options(words, added);
}

void add_builtin_profile(const CommandInfo& command, const BuiltinProfile& profile,
                         std::vector<std::string>& words) {
    std::vector<std::string> added;
    for (const auto& [key, value] : profile.options) {
        const OptionInfo* option = find_option(command, std::string(key));
        if (option && !is_overridden(command, *option, words))
            added.push_back(option->names.back() + "=" + std::string(value));
    }
    insert_options(words, added);
}

}  // namespace

OptionInfo profile_option() {
    OptionInfo info =
        rare({{"--config"}, "FILE", "Read options from a profile (JSON file); those typed take precedence"});
    info.read = [](const std::vector<std::string>&, bool) {};
    return info;
}

std::vector<std::string> expand_profile(const CommandTree& tree, std::vector<std::string> words) {
    const auto command = std::find_if(tree.commands.begin(), tree.commands.end(), [&](const CommandInfo& c) {
        return !words.empty() && c.name == words[0];
    });
    if (command == tree.commands.end() || !reads_profiles(*command)) return words;
    const std::optional<std::string> file = value_of("--config", words), name = value_of("--profile", words);
    if (file && !file->empty()) add_profile_file(tree, *command, *file, words);
    if (name && !name->empty()) add_builtin_profile(*command, builtin_profile(*name), words);
    return words;
}

}  // namespace faqem::cli
