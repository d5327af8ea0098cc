#pragma once
/// \file
/// The table of options: all members of Options but the progress callback, with what the interfaces, messages
/// and documentation need. CONTRIBUTING.md describes how to add an option.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "faqem/detail/options/option_row.hpp"

FAQEM_DETAIL_BEGIN

using OptionTable = std::span<const OptionRow>;
using OptionSpelling = std::string (*)(const OptionRow&);

/// All options: geometry_rows, then appearance_rows.
FAQEM_EXPORT OptionTable option_table();

/// Name in messages of the library, for example `texel_density`.
FAQEM_EXPORT std::string member_spelling(const OptionRow& row);
/// Name in C, for example `texel-density`.
FAQEM_EXPORT std::string name_spelling(const OptionRow& row);
/// Name in the command, for example `--texel-density`.
FAQEM_EXPORT std::string command_spelling(const OptionRow& row);

/// Returns the option with a name of C. \throws OptionError  there is none; the message suggests one,
/// or says what stands for an option of the command
FAQEM_EXPORT const OptionRow& named_option(std::string_view name, OptionTable table = option_table());

/// The words of a choice.
FAQEM_EXPORT std::vector<std::string> split_choices(std::string_view choices);

/// A number with as few digits as identify it.
FAQEM_EXPORT std::string number_text(double number);

/// Describes a range, for example `in [0, 180] degrees` or `finite and > 0`; empty for kinds without one.
FAQEM_EXPORT std::string range_text(OptionKind kind, const OptionRange& range, std::string_view unit = {});

/// Tests whether a number is in a range.
FAQEM_EXPORT bool is_in_range(double number, const OptionRange& range);

/// Default in help and documentation; empty if there is none.
FAQEM_EXPORT std::string default_text(const OptionRow& row);

/// Help text with range and default.
FAQEM_EXPORT std::string help_text(const OptionRow& row);

/// Parses a number as OptionKind says.
/// \param shown  name of the option for messages
/// \throws OptionError  the text has another form, or the number is not in the range
FAQEM_EXPORT OptionValue parse_option_number(std::string_view text, OptionKind kind, const OptionRange& range,
                                             std::string_view unit, const std::string& shown);

/// Sets an option from text.
/// \throws OptionError  the text has another form, or the value is not in the range; the message begins with
/// the spelling of the option, and the options are unchanged
FAQEM_EXPORT void set_option(Options& options, const OptionRow& row, std::string_view text,
                             OptionSpelling spelling, OptionTable table = option_table());

/// Text of the value of an option. Different values have different texts.
FAQEM_EXPORT std::string option_text(const Options& options, const OptionRow& row);

/// Checks all ranges and combinations. \throws OptionError  with the spelling of the options
FAQEM_EXPORT void check_options(const Options& options, OptionSpelling spelling,
                                OptionTable table = option_table());

/// Warnings of options that a user has given, and that have no effect with the others (OptionRow::idle).
/// \param names  OptionRow::name, once each
FAQEM_EXPORT std::vector<std::string> idle_options(const Options& options,
                                                   std::span<const std::string_view> names,
                                                   OptionSpelling spelling);

/// All options that the result depends on as text. Options with equal texts give equal results.
FAQEM_EXPORT std::string options_key(const Options& options, OptionTable table = option_table());

FAQEM_DETAIL_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/options/option_table-inl.hpp"
#endif
