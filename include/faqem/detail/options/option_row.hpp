#pragma once
/// \file
/// A row of the table of options: name, kind, range and help text of a member of Options.

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <type_traits>
#include <utility>

#include "faqem/export.hpp"
#include "faqem/options.hpp"

FAQEM_DETAIL_BEGIN

/// Form of a value as text.
enum class OptionKind {
    number,
    integer,
    share,   ///< `0.1` or `10%`, which is 0.1
    length,  ///< `0.01` (model units) or `0.1%` (of the diagonal)
    size,    ///< bytes: `1000`, `2MB` (10^6 bytes each) or `2MiB` (2^20)
    choice,  ///< one of several words
    // Kinds of options that only commands have:
    flag,  ///< no value
    text,  ///< for example a file name
    list,  ///< words separated by commas
};

/// Range of a number. Infinity and NaN are never in it.
struct OptionRange {
    double min = 0, max = std::numeric_limits<double>::infinity();
    bool excludes_min = false, power_of_two = false;
};

/// Interfaces that have an option, besides Options.
enum EntryPoint : unsigned {
    in_c_and_python = 1,
    in_simplify = 2,
    in_lod = 4,
    in_truncate = 8,
    in_batch = 16,
    in_simplify_and_batch = in_c_and_python | in_simplify | in_batch,
    in_all_but_truncate = in_simplify_and_batch | in_lod,
    in_all = in_all_but_truncate | in_truncate,
};

/// Value of an option.
struct OptionValue {
    /// Number of the enumerator if the option is a choice; nothing: unset.
    std::optional<double> number = {};
    bool is_given = false;                    ///< false: unset, and `number` is the default if there is one
    Length::Unit unit = Length::Unit::model;  ///< of lengths
};

/// An option as data. Interfaces, messages and documentation are made from these rows.
struct OptionRow {
    /// Name in C, and in Python with underscores; in the command (`--NAME`) and in profiles, too, unless
    /// `command_name` is set.
    std::string_view name;
    std::string_view command_name = {};
    std::string_view letter = {};  ///< short name in the command
    /// Name in messages of the library; empty: `name` with underscores.
    std::string_view member_name = {};
    OptionKind kind = OptionKind::number;
    std::string_view choices = {};  ///< words separated by bars, in the order of the enumeration
    OptionRange range = {};
    std::string_view unit = {};
    std::string_view value_name = {};  ///< placeholder of the value in help; empty: the choices
    /// Not empty: the words `on` (this value) and `off` are values, too. Without a value_name, the option of the
    /// command is a flag with this value.
    std::string_view flag_value = {};
    std::string_view default_text = {};  ///< default in help if it is not a fixed value
    /// Without range and default. What precedes the first semicolon is the line in --help.
    std::string_view help = {};
    std::string_view group = {};  ///< heading of the option in --help; empty: only in --help-all
    /// `smooth:30` sets this choice, and the option `suffix_option` to 30.
    std::string_view suffix_choice = {}, suffix_option = {};
    std::string_view excludes = {};  ///< option that cannot be given together with this one
    unsigned entry_points = in_c_and_python;
    bool affects_result = true;

    /// Says why the option has no effect with the others; empty if it has one. Null: it always has one.
    /// \param options  what is automatic is resolved as far as it is known
    std::string_view (*idle)(const Options& options) = nullptr;

    OptionValue (*get)(const Options&) = nullptr;
    void (*set)(Options&, const OptionValue&) = nullptr;  ///< \pre the value is in the range
};

/// The member at the end of a path of pointers to members.
template <auto... path, class Struct>
constexpr auto& member_at(Struct& options) {
    return (options.*....*path);
}

/// The value of a member of Options: a number, an enumerator or a length, or an optional one of these.
template <class Member>
OptionValue option_value(const Member& member) {
    if constexpr (requires { member.has_value(); })
        return member ? option_value(*member) : OptionValue{};
    else if constexpr (std::is_same_v<Member, Length>)
        return {member.value, true, member.unit};
    else
        return {static_cast<double>(member), true};
}

/// Sets a member of Options. One that is not optional stays as it is if the value is unset.
template <class Member>
void assign_option(Member& member, const OptionValue& value) {
    if constexpr (requires { member.reset(); }) {
        member.reset();
        if (value.number) assign_option(member.emplace(), value);
    } else if constexpr (std::is_same_v<Member, Length>) {
        member = {*value.number, value.unit};
    } else if (value.number) {
        const bool is_size = std::is_same_v<Member, std::uint64_t>;
        member = static_cast<Member>(is_size ? std::min(*value.number, 0x1p63) : *value.number);
    }
}

/// Completes a row with the functions that read and write a member of Options.
/// \tparam path  pointers to members, for example `&Options::bake, &BakeOptions::samples`
template <auto... path>
constexpr OptionRow option_row(OptionRow row) {
    using Member = std::remove_cvref_t<decltype(member_at<path...>(std::declval<Options&>()))>;
    if constexpr (std::is_enum_v<Member>) row.kind = OptionKind::choice;
    if constexpr (std::is_integral_v<Member> || std::is_same_v<Member, std::optional<std::uint32_t>>)
        row.kind = OptionKind::integer;
    if constexpr (std::is_same_v<Member, std::optional<Length>>) row.kind = OptionKind::length;
    if constexpr (std::is_same_v<Member, std::optional<std::uint64_t>>) row.kind = OptionKind::size;
    row.get = [](const Options& options) { return option_value(member_at<path...>(options)); };
    row.set = [](Options& options, const OptionValue& value) {
        assign_option(member_at<path...>(options), value);
    };
    return row;
}

FAQEM_DETAIL_END
