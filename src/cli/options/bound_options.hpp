#pragma once
/// \file
/// Options that write their value to a variable, which must exist until the command has run, and options that
/// several commands share.

#include <cstdint>
#include <functional>
#include <iterator>
#include <string>
#include <type_traits>
#include <vector>

#include "cli/shell/command_tree.hpp"
#include "faqem/compare.hpp"

namespace faqem::cli {

/// A number of pixels, faces or others that must not be 0. \param max  largest number
constexpr detail::OptionRange from_one(double max = 0x1p53) { return {.min = 1, .max = max}; }

/// A flag, which sets the variable to true. \param names  one name, or two with a comma between
OptionInfo flag_option(const std::string& names, bool& value, const std::string& description);

/// A text, such as a file name. If `value_name` has bars, it lists the possible values.
/// \param names  one name, or two with a comma between
OptionInfo text_option(const std::string& names, const std::string& value_name, std::string& value,
                       const std::string& description);

/// A number of a kind in a range, which `set` receives.
/// \param names  one name, or two with a comma between
OptionInfo numeric_option(const std::string& names, const std::string& value_name, detail::OptionKind kind,
                          const detail::OptionRange& range, const std::string& description,
                          std::function<void(double)> set);

/// A number, or an integer if the variable is one. \pre range.max can be represented by the type
template <class Number>
OptionInfo number_option(const std::string& names, const std::string& value_name, Number& value,
                         const detail::OptionRange& range, const std::string& description) {
    const auto kind = std::is_integral_v<Number> ? detail::OptionKind::integer : detail::OptionKind::number;
    return numeric_option(names, value_name, kind, range, description,
                          [&value](double number) { value = static_cast<Number>(number); });
}

/// A number of bytes above 0: `1000`, `2MB` (10^6 bytes each) or `2MiB` (2^20).
OptionInfo size_option(const std::string& name, std::uint64_t& bytes, const std::string& description);

/// Words separated by commas or spaces.
OptionInfo list_option(const std::string& name, std::vector<std::string>& words,
                       const std::string& description);

/// A required positional argument. \param choices  its possible values with bars between; empty: any text
OptionInfo positional(const std::string& name, std::string& value, const std::string& description,
                      const std::string& choices = "");

/// Adds the output file or directory, which is the last word of a command or follows -o.
/// \param name  in help
void add_output(CommandInfo& command, const std::string& name, std::string& value,
                const std::string& description);

/// -f and --force.
OptionInfo force_option(bool& force);
/// -q and --quiet.
OptionInfo quiet_option(bool& quiet);

/// --report of the commands that make one model.
OptionInfo report_option(std::string& file);

/// --format of the commands that write several models.
OptionInfo format_option(std::string& format);

/// --up of the commands that draw.
OptionInfo up_option(std::string& up);

/// The options of comparing two models (`faqem compare` and `faqem report`).
std::vector<OptionInfo> compare_options(CompareOptions& options);

/// The option without a group: --help omits it.
OptionInfo rare(OptionInfo option);

/// Appends to a list, for example options to those of a command.
template <class T>
void append(std::vector<T>& all, std::type_identity_t<std::vector<T>> more) {
    all.insert(all.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

}  // namespace faqem::cli
