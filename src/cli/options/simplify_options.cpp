#include "cli/options/simplify_options.hpp"

#include "cli/options/bound_options.hpp"

namespace faqem::cli {

namespace {

using detail::OptionKind;
using detail::OptionRow;

OptionInfo option_of(const OptionRow& row, GivenOptions& given) {
    const bool is_flag = !row.flag_value.empty() && row.value_name.empty();
    OptionInfo info{{command_spelling(row)}, std::string(row.value_name), help_text(row), row.kind};
    if (is_flag)
        info.kind = OptionKind::flag;
    else if (row.value_name.empty())
        info.value_name = row.choices;
    if (!row.letter.empty()) info.names.insert(info.names.begin(), "-" + std::string(row.letter));
    info.group = row.group;
    info.read = [&row, &given, is_flag](const std::vector<std::string>& values, bool is_typed) {
        given.push_back({&row, is_flag ? std::string(row.flag_value) : values.back(), is_typed});
    };
    return info;
}

}  // namespace

std::vector<OptionInfo> table_options(detail::EntryPoint command, GivenOptions& given,
                                      detail::OptionTable table) {
    std::vector<OptionInfo> options;
    for (const OptionRow& row : table) {
        if (!(row.entry_points & command)) continue;
        OptionInfo& info = options.emplace_back(option_of(row, given));
        if (!row.excludes.empty() && (named_option(row.excludes, table).entry_points & command))
            info.excludes = "--" + std::string(row.excludes);
    }
    return options;
}

OptionInfo strict_option(bool& strict) {
    return rare(flag_option("--strict", strict,
                            "Exit with 3 if the input would be repaired; invalid elements, faces of zero "
                            "area, duplicate faces"));
}

std::vector<OptionInfo> strict_options(bool& strict, bool& strict_target) {
    return {strict_option(strict),
            rare(flag_option("--strict-target", strict_target,
                             "Exit with 5, and write no model, if the target is missed"))};
}

std::vector<std::string_view> typed_names(const GivenOptions& given) {
    std::vector<std::string_view> names;
    for (const GivenOption& option : given)
        if (option.is_typed) names.push_back(option.row->name);
    return names;
}

Options make_options(const GivenOptions& given, detail::OptionTable table) {
    Options options;
    for (const GivenOption& option : given)
        set_option(options, *option.row, option.value, detail::command_spelling, table);
    check_options(options, detail::command_spelling, table);
    return options;
}

}  // namespace faqem::cli
