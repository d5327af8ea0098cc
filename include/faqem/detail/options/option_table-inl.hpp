#pragma once

#include "faqem/detail/options/option_table.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>

#include "faqem/detail/base/closest_word.hpp"
#include "faqem/detail/base/lower_case.hpp"
#include "faqem/detail/options/appearance_rows.hpp"
#include "faqem/detail/options/geometry_rows.hpp"
#include "faqem/error.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

/// A combination of options that is allowed only under a condition.
struct OptionRule {
    bool (*holds)(const Options&);
    std::string_view message;  ///< with the names of options in braces
};

inline constexpr OptionRule option_rules[] = {
    {[](const Options& o) {
         return o.visibility != Visibility::weighted || !o.max_error || o.target.kind != Target::Kind::unset;
     },
     "{visibility} must not be weighted if {max-error} is given without {ratio} or {faces}: "
     "distances are not weighted"},
    {[](const Options& o) { return !o.max_bytes || !o.max_error; },
     "{max-bytes} cannot be given with {max-error}"},
    {[](const Options& o) {
         return o.bake.normals != Normals::none || !makes_atlas(o.bake.kind) ||
                (o.bake.kind == Bake::automatic && o.bake.normal_map != NormalMap::on);
     },
     "{normals} may be none only if {bake} is not atlas or per-triangle, and {normal-map} not on"},
};

FAQEM_INLINE OptionTable option_table() {
    static constexpr auto all = [] {
        std::array<OptionRow, std::size(geometry_rows) + std::size(appearance_rows)> rows;
        std::copy(std::begin(geometry_rows), std::end(geometry_rows), rows.begin());
        std::copy(std::begin(appearance_rows), std::end(appearance_rows),
                  rows.begin() + std::size(geometry_rows));
        return rows;
    }();
    return all;
}

FAQEM_INLINE std::string member_spelling(const OptionRow& row) {
    std::string text(row.member_name.empty() ? row.name : row.member_name);
    if (row.member_name.empty()) std::replace(text.begin(), text.end(), '-', '_');
    return text;
}
FAQEM_INLINE std::string name_spelling(const OptionRow& row) { return std::string(row.name); }
FAQEM_INLINE std::string command_spelling(const OptionRow& row) {
    return "--" + std::string(row.command_name.empty() ? row.name : row.command_name);
}

/// Options of the command that stand for no member of Options.
inline constexpr std::string_view command_options[] = {
    "config", "correspondence", "force", "help",   "help-all",      "max-memory",
    "output", "profile",        "quiet", "report", "strict-target", "strict"};

FAQEM_INLINE const OptionRow& named_option(std::string_view name, OptionTable table) {
    std::vector<std::string> known;
    const std::string problem = "unknown option '" + std::string(name) + "'";
    for (const OptionRow& row : table) {
        if (!name.empty() && row.command_name == name)
            throw OptionError(problem + " (of the command); use " + std::string(row.name) +
                              (row.flag_value.empty() ? "" : "='" + std::string(row.flag_value) + "'"));
        if (!(row.entry_points & in_c_and_python)) continue;
        if (row.name == name) return row;
        known.emplace_back(row.name);
    }
    if (std::find(std::begin(command_options), std::end(command_options), name) != std::end(command_options))
        throw OptionError(problem + ": only the command has it");
    const std::string closest = closest_word(name, known);
    throw OptionError(problem + (closest.empty() ? "" : "; did you mean '" + closest + "'?"));
}

FAQEM_INLINE std::vector<std::string> split_choices(std::string_view choices) {
    std::vector<std::string> words;
    while (!choices.empty()) {
        const std::size_t end = std::min(choices.find('|'), choices.size());
        words.emplace_back(choices.substr(0, end));
        choices.remove_prefix(std::min(end + 1, choices.size()));
    }
    return words;
}

FAQEM_INLINE std::string number_text(double number) {
    std::array<char, 32> digits;
    return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr};
}

FAQEM_INLINE std::string range_text(OptionKind kind, const OptionRange& range, std::string_view unit) {
    if (kind >= OptionKind::choice) return {};
    const std::string min = number_text(range.min);
    if (std::isinf(range.max)) {
        const bool is_whole = kind == OptionKind::integer || kind == OptionKind::size;
        return (is_whole ? "" : "finite and ") + std::string(range.excludes_min ? "> " : ">= ") + min;
    }
    return std::string(range.power_of_two ? "a power of two in " : "in ") + (range.excludes_min ? "(" : "[") +
           min + ", " + number_text(range.max) + "]" + (unit.empty() ? "" : " ") + std::string(unit);
}

FAQEM_INLINE bool is_in_range(double number, const OptionRange& range) {
    return std::isfinite(number) && (range.excludes_min ? number > range.min : number >= range.min) &&
           number <= range.max &&
           (!range.power_of_two || std::has_single_bit(static_cast<std::uint64_t>(number)));
}

FAQEM_INLINE std::string default_text(const OptionRow& row) {
    if (!row.default_text.empty()) return std::string(row.default_text);
    const OptionValue value = row.get({});
    if (!row.flag_value.empty()) return "off";
    return value.is_given ? option_text({}, row) : "";
}

FAQEM_INLINE std::string help_text(const OptionRow& row) {
    std::string text(row.help);
    if (std::isfinite(row.range.max)) text += "; " + range_text(row.kind, row.range, row.unit);
    const std::string by_default = default_text(row);
    return by_default.empty() || by_default == "off" ? text : text + "; default: " + by_default;
}

/// Bytes per unit of a size, in lower case; 0 if there is no such unit.
inline double bytes_per_unit(std::string_view unit) {
    const std::string lower =
        lower_case(std::string(unit.substr(std::min(unit.find_first_not_of(' '), unit.size()))));
    if (lower.empty() || lower == "b") return 1;
    const std::size_t power = std::string_view("kmgt").find(lower[0]);
    if (power == std::string_view::npos) return 0;
    const std::string_view rest = std::string_view(lower).substr(1);
    if (rest != "" && rest != "b" && rest != "ib") return 0;
    return std::pow(rest == "ib" ? 1024.0 : 1000.0, static_cast<double>(power) + 1);
}

FAQEM_INLINE OptionValue parse_option_number(std::string_view text, OptionKind kind, const OptionRange& range,
                                             std::string_view unit, const std::string& shown) {
    OptionValue value{0, true};
    const char* const end = text.data() + text.size();
    std::from_chars_result result{};
    const bool in_percent = (kind == OptionKind::share || kind == OptionKind::length) && text.ends_with('%');
    if (kind == OptionKind::integer || kind == OptionKind::size) {
        std::uint64_t number = 0;
        result = std::from_chars(text.data(), end, number);
        value.number = static_cast<double>(number);
        if (kind == OptionKind::size && result.ec == std::errc{}) {
            const double factor =
                bytes_per_unit(text.substr(static_cast<std::size_t>(result.ptr - text.data())));
            if (factor > 0) result.ptr = end;
            *value.number *= factor;
        }
    } else {
        double number = 0;
        result = std::from_chars(text.data(), end - in_percent, number);
        value.number = in_percent ? number / 100 : number;
    }
    if (result.ec != std::errc{} || result.ptr != end - in_percent) {
        throw OptionError(shown + ": '" + std::string(text) + "' is not a " +
                          (kind == OptionKind::size      ? "size, such as 500MB or 2GiB"
                           : kind == OptionKind::integer ? "whole number"
                                                         : "number"));
    }
    if (kind == OptionKind::length && in_percent) value.unit = Length::Unit::diagonal;
    if (!is_in_range(*value.number, range))
        throw OptionError(shown + " must be " + range_text(kind, range, unit) + ", not " + std::string(text));
    return value;
}

/// Parses one of the words of a choice, or `on` and `off` if the command has a flag for it.
inline OptionValue parse_choice(std::string_view text, const OptionRow& row, const std::string& shown) {
    const std::vector<std::string> words = split_choices(row.choices);
    const auto found = std::find(words.begin(), words.end(), text);
    if (found != words.end()) return {static_cast<double>(found - words.begin()), true};
    if (!row.flag_value.empty() && text == "on") return parse_choice(row.flag_value, row, shown);
    if (!row.flag_value.empty() && text == "off") return {0, true};
    std::string known;
    for (const std::string& word : words) known.append(known.empty() ? "" : ", ").append(word);
    throw OptionError(shown + ": unknown value '" + std::string(text) + "' (known: " + known + ")");
}

FAQEM_INLINE void set_option(Options& options, const OptionRow& row, std::string_view text,
                             OptionSpelling spelling, OptionTable table) {
    const std::string shown = spelling(row);
    if (row.kind == OptionKind::choice) {
        const std::string_view suffix_choice = row.suffix_choice;
        const bool has_suffix = !suffix_choice.empty() && text.starts_with(suffix_choice) &&
                                text.substr(suffix_choice.size()).starts_with(':');
        if (has_suffix) {
            const OptionRow& other = named_option(row.suffix_option, table);
            set_option(options, other, text.substr(suffix_choice.size() + 1), spelling, table);
        }
        row.set(options, parse_choice(has_suffix ? suffix_choice : text, row, shown));
    } else if (!row.flag_value.empty() && text == "off") {
        row.set(options, {});
    } else {
        const bool is_on = !row.flag_value.empty() && text == "on";
        row.set(options,
                parse_option_number(is_on ? row.flag_value : text, row.kind, row.range, row.unit, shown));
    }
}

FAQEM_INLINE std::string option_text(const Options& options, const OptionRow& row) {
    const OptionValue value = row.get(options);
    if (!value.number) return {};
    if (row.kind == OptionKind::choice)
        return split_choices(row.choices).at(static_cast<std::size_t>(*value.number));
    return (value.is_given ? "" : "unset, ") + number_text(*value.number) +
           (value.unit == Length::Unit::diagonal ? " of the diagonal" : "");
}

FAQEM_INLINE void check_options(const Options& options, OptionSpelling spelling, OptionTable table) {
    for (const OptionRow& row : table) {
        const OptionValue value = row.get(options);
        if (!value.number) continue;
        if (row.kind == OptionKind::choice) {
            const auto words = static_cast<double>(split_choices(row.choices).size());
            if (!(*value.number >= 0 && *value.number < words))
                throw OptionError(spelling(row) + " is not an enumerator");
        } else if (!is_in_range(*value.number, row.range)) {
            throw OptionError(spelling(row) + " must be " + range_text(row.kind, row.range, row.unit) +
                              ", not " + number_text(*value.number));
        }
    }
    for (const OptionRule& rule : option_rules) {
        if (rule.holds(options)) continue;
        std::string message;
        std::string_view rest = rule.message;
        for (std::size_t open; (open = rest.find('{')) != rest.npos;) {
            const std::size_t close = rest.find('}');
            message += rest.substr(0, open);
            message += spelling(named_option(rest.substr(open + 1, close - open - 1), table));
            rest.remove_prefix(close + 1);
        }
        throw OptionError(message.append(rest));
    }
}

FAQEM_INLINE std::vector<std::string> idle_options(const Options& options,
                                                   std::span<const std::string_view> names,
                                                   OptionSpelling spelling) {
    std::vector<std::string> warnings;
    for (const OptionRow& row : option_table()) {
        if (!row.idle || std::find(names.begin(), names.end(), row.name) == names.end()) continue;
        if (const std::string_view reason = row.idle(options); !reason.empty())
            warnings.push_back(spelling(row) + " has no effect: " + std::string(reason));
    }
    return warnings;
}

FAQEM_INLINE std::string options_key(const Options& options, OptionTable table) {
    std::string key;
    for (const OptionRow& row : table)
        if (row.affects_result)
            key.append(row.name).append("=").append(option_text(options, row)).append(";");
    return key;
}

}  // namespace detail

FAQEM_INLINE void validate(const Options& options) {
    detail::check_options(options, detail::member_spelling);
}

FAQEM_NAMESPACE_END
