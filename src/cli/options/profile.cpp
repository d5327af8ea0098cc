#include "cli/options/profile.hpp"

#include <CLI/StringTools.hpp>
#include <algorithm>
#include <array>
#include <set>
#include <sstream>
#include <string_view>
#include <utility>

#include "asset/io/file.hpp"
#include "cli/files/protected_files.hpp"
#include "cli/options/bound_options.hpp"
#include "cli/process/json.hpp"
#include "faqem/detail/base/closest_word.hpp"
#include "faqem/error.hpp"

namespace faqem::cli {

namespace {

constexpr const char* version_key = "faqem-profile";
constexpr int profile_version = 1;
constexpr std::uint64_t max_file_size = 1'000'000;

/// A named set of options that is part of the command.
struct BuiltinProfile {
    std::string_view name, purpose;
    std::string_view options;  ///< as in a file, without the version
};

constexpr std::array<BuiltinProfile, 2> all_profiles = {
    {{"web",
      "the fewest bytes for web viewers that know EXT_texture_webp, EXT_meshopt_compression and "
      "KHR_mesh_quantization",
      R"({"image-format": "webp", "image-quality": "34", "compress": "meshopt", "quantize": "on"})"},
     {"game", "files that every importer of glTF reads: PNG and JPEG images, and geometry without extensions",
      R"({"image-format": "png-or-jpeg", "compress": "none", "quantize": "off"})"}}};

std::string names(const std::string& separator) {
    return CLI::detail::join(
        all_profiles, [](const BuiltinProfile& profile) { return profile.name; }, separator);
}

const BuiltinProfile& builtin_profile(std::string_view name) {
    const auto found = std::ranges::find(all_profiles, name, &BuiltinProfile::name);
    if (found != all_profiles.end()) return *found;
    throw OptionError("--profile: unknown value '" + std::string(name) + "' (known: " + names(", ") +
                      "); --config reads a profile from a file");
}

/// Reads a profile. Rejects duplicate keys, of which nlohmann::json would silently keep the last.
Json read_profile(const std::string& file) {
    protect_input(file);
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
        if (!profile.contains(version_key))
            throw OptionError(file + ": is not a profile: \"" + version_key + "\": 1 is missing");
        if (profile[version_key] != profile_version)
            throw OptionError(file + ": " + version_key + ": version " + profile[version_key].dump() +
                              " is not supported, only version 1");
        profile.erase(version_key);
        return profile;
    } catch (const Json::exception& error) {
        throw InputError(file, "", std::string("is not valid JSON: ") + error.what());
    }
}

/// The key of an option in profiles: its name without dashes; empty if profiles do not have it.
std::string profile_key(const OptionInfo& option) {
    const std::string& name = option.names.back();
    const bool is_key = option.read && !option.is_positional && name != "--config" && name != "--profile";
    return is_key ? name.substr(2) : "";
}

const OptionInfo* find_option(const CommandInfo& command, const std::string& key) {
    for (const OptionInfo& option : command.options)
        if (!key.empty() && profile_key(option) == key) return &option;
    return nullptr;
}

[[noreturn]] void throw_unknown_key(const CommandTree& tree, const CommandInfo& command,
                                    const std::string& file, const std::string& key) {
    std::string text = file + ": '" + key + "' is not an option of faqem " + command.name;
    std::vector<std::string> known;
    for (const OptionInfo& option : command.options)
        if (const std::string name = profile_key(option); !name.empty()) known.push_back(name);
    const std::string suggested = detail::closest_word(key, known);
    const auto other = std::ranges::find_if(
        tree.commands, [&](const CommandInfo& c) { return find_option(c, key) != nullptr; });
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

/// Converts an entry of a profile to the words of a value; none for a flag that is false.
std::vector<std::string> words_of(const OptionInfo& option, const Json& value, const std::string& where) {
    if (option.kind == detail::OptionKind::flag) {
        if (value.is_boolean()) return std::vector<std::string>(value.get<bool>() ? 1 : 0, "true");
        throw OptionError(where + ": must be true or false");
    }
    if (option.kind != detail::OptionKind::list) return {text_of(value, where)};
    std::vector<std::string> words;
    for (const Json& one : value.is_array() ? value : Json::array({value})) {
        std::istringstream texts(text_of(one, where));
        for (std::string text; std::getline(texts, text, ',');) words.push_back(text);
    }
    return words;
}

/// The value by which an entry of a profile for an option is overridden; null if there is none.
const ParsedValue* overriding(const std::vector<ParsedValue>& values, const OptionInfo& option) {
    const auto found = std::ranges::find_if(values, [&](const ParsedValue& value) {
        return value.option == &option || value.option->names.back() == option.excludes ||
               value.option->excludes == option.names.back();
    });
    return found == values.end() ? nullptr : &*found;
}

/// Adds the entries of a profile. \param file  empty: a built-in one, which also has options of other commands
void add_entries(const CommandTree& tree, const CommandInfo& command, const std::string& file,
                 const Json& profile, std::vector<ParsedValue>& values) {
    std::vector<ParsedValue> added;
    for (const auto& [key, entry] : profile.items()) {
        const OptionInfo* option = find_option(command, key);
        if (!option && file.empty()) continue;
        if (!option) throw_unknown_key(tree, command, file, key);
        ParsedValue value{option, words_of(*option, entry, file + ": " + key), false};
        if (value.words.empty() || overriding(values, *option)) continue;
        if (const ParsedValue* other = overriding(added, *option))
            throw OptionError(file + ": " + key + ": cannot be used with " + profile_key(*other->option));
        added.push_back(std::move(value));
    }
    values.insert(values.end(), added.begin(), added.end());
}

}  // namespace

OptionInfo profile_option() {
    OptionInfo info =
        rare({{"--config"}, "FILE", "Read options from a profile (JSON file); those typed take precedence"});
    info.read = [](const std::vector<std::string>&, bool) {};
    return info;
}

OptionInfo builtin_profile_option() {
    OptionInfo info{{"--profile"},
                    names("|"),
                    "Options for web viewers or game engines; faqem profiles shows them. Those typed and "
                    "those of --config take precedence",
                    detail::OptionKind::choice};
    info.read = [](const std::vector<std::string>& values, bool) { builtin_profile(values.back()); };
    return info;
}

std::string profile_file(const std::string& name) {
    Json json = {{version_key, profile_version}};
    json.update(Json::parse(builtin_profile(name).options));
    return json_text(json);
}

std::string profile_list() {
    std::string text;
    for (const BuiltinProfile& profile : all_profiles) {
        text.append(profile.name).append(": ").append(profile.purpose).append("\n ");
        const Json options = Json::parse(profile.options);
        for (const auto& [key, value] : options.items())
            text.append(" --").append(key).append("=").append(value.get<std::string>());
        text.append("\n");
    }
    return text;
}

void add_profile_values(const CommandTree& tree, const CommandInfo& command,
                        std::vector<ParsedValue>& values) {
    const auto word_of = [&](const std::string& name) {
        for (const ParsedValue& value : values)
            if (value.option->names.back() == name) return value.words.back();
        return std::string();
    };
    const std::string file = word_of("--config"), name = word_of("--profile");
    if (!file.empty()) add_entries(tree, command, file, read_profile(file), values);
    if (!name.empty()) add_entries(tree, command, "", Json::parse(builtin_profile(name).options), values);
}

}  // namespace faqem::cli
