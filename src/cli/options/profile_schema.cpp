#include "cli/options/profile_schema.hpp"

#include <cmath>
#include <map>
#include <vector>

#include "cli/options/profile.hpp"
#include "cli/process/json.hpp"

namespace faqem::cli {

namespace {

using detail::OptionKind;

void add_range(Json& schema, const detail::OptionRange& range) {
    if (range.power_of_two) {
        for (double n = range.min; n <= range.max; n *= 2) schema["enum"].push_back(std::llround(n));
        return;
    }
    const auto number = [](double value) {  // 1024 and not 1024.0
        return value == std::floor(value) ? Json(std::llround(value)) : Json(value);
    };
    schema[range.excludes_min ? "exclusiveMinimum" : "minimum"] = number(range.min);
    if (range.max < 0x1p53) schema["maximum"] = number(range.max);
}

void add_choices(Json& schema, const OptionInfo& option) {
    if (option.suffix_choice.empty()) {
        schema["enum"] = choices_of(option);
        return;
    }
    std::string pattern;
    for (const std::string& choice : choices_of(option))
        pattern +=
            (pattern.empty() ? "" : "|") + choice + (choice == option.suffix_choice ? "(:[0-9.]+)?" : "");
    schema["type"] = "string";
    schema["pattern"] = "^(" + pattern + ")$";
}

Json schema_of(const OptionInfo& option, const std::string& description) {
    static const std::map<OptionKind, Json> types = {{OptionKind::number, "number"},
                                                     {OptionKind::integer, "integer"},
                                                     {OptionKind::share, {"number", "string"}},
                                                     {OptionKind::length, {"number", "string"}},
                                                     {OptionKind::flag, "boolean"},
                                                     {OptionKind::text, "string"},
                                                     {OptionKind::size, {"number", "string"}},
                                                     {OptionKind::list, {"string", "array"}}};
    Json schema = {{"description", description}};
    if (option.kind == OptionKind::choice)
        add_choices(schema, option);
    else if (!option.range.power_of_two)
        schema["type"] = types.at(option.kind);
    if (option.kind < OptionKind::choice) add_range(schema, option.range);
    if (option.kind == OptionKind::list) schema["items"] = {{"type", {"number", "string"}}};
    return schema;
}

}  // namespace

std::string profile_schema(const CommandTree& tree) {
    std::vector<std::pair<std::string, const OptionInfo*>> options;
    std::map<std::string, std::string> commands;  // of each option
    std::string all;
    for (const CommandInfo& command : tree.commands) {
        if (!reads_profiles(command)) continue;
        all.append(all.empty() ? "" : ", ").append(command.name);
        for (const OptionInfo& option : command.options) {
            const std::string key = profile_key(option);
            if (key.empty()) continue;
            std::string& names = commands[key];
            if (names.empty()) options.emplace_back(key, &option);
            names.append(names.empty() ? "" : ", ").append(command.name);
        }
    }
    std::string text = R"({
  "$schema": "https://json-schema.org/draft/2020-12/schema",
  "title": "Profile of faqem",
  "type": "object",
  "required": ["faqem-profile"],
  "additionalProperties": false,
  "properties": {
    "$schema": {"type": "string"},
    "faqem-profile": {"description": "Version of the format", "const": 1})";
    for (const auto& [key, option] : options) {
        const std::string prefix = commands[key] == all ? "" : commands[key] + ": ";
        text += ",\n    \"" + key + "\": " + schema_of(*option, prefix + option->description).dump();
    }
    return text + "\n  }\n}\n";
}

}  // namespace faqem::cli
