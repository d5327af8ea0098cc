#include "cli/options/bound_options.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <utility>

#include "cli/files/output_file.hpp"
#include "faqem/error.hpp"

namespace faqem::cli {

using detail::OptionKind;

OptionInfo flag_option(const std::string& names, bool& value, const std::string& description) {
    OptionInfo info{CLI::detail::split(names, ','), "", description, OptionKind::flag};
    info.read = [&value](const std::vector<std::string>&, bool) { value = true; };
    return info;
}

OptionInfo text_option(const std::string& names, const std::string& value_name, std::string& value,
                       const std::string& description) {
    OptionInfo info{CLI::detail::split(names, ','), value_name, description};
    const std::vector<std::string> choices = choices_of(info);
    if (!choices.empty()) info.kind = OptionKind::choice;
    info.read = [&value, choices, name = info.names.back()](const std::vector<std::string>& values, bool) {
        value = values.back();
        if (choices.empty() || std::find(choices.begin(), choices.end(), value) != choices.end()) return;
        throw OptionError(name + ": unknown value '" + value +
                          "' (known: " + CLI::detail::join(choices, ", ") + ")");
    };
    return info;
}

OptionInfo numeric_option(const std::string& names, const std::string& value_name, OptionKind kind,
                          const detail::OptionRange& range, const std::string& description,
                          std::function<void(double)> set) {
    OptionInfo info{CLI::detail::split(names, ','), value_name, description, kind};
    info.read = [set = std::move(set), name = info.names.back(), range, kind](
                    const std::vector<std::string>& values, bool) {
        const std::string unit = kind == OptionKind::size ? "bytes" : "";
        set(*detail::parse_option_number(values.back(), kind, range, unit, name).number);
    };
    return info;
}

OptionInfo size_option(const std::string& name, std::uint64_t& bytes, const std::string& description) {
    return numeric_option(name, "SIZE", OptionKind::size, {.max = 0x1p63, .excludes_min = true}, description,
                          [&bytes](double number) { bytes = static_cast<std::uint64_t>(number); });
}

OptionInfo list_option(const std::string& name, std::vector<std::string>& words,
                       const std::string& description) {
    OptionInfo info{{name}, "LIST", description, OptionKind::list};
    info.max_words = CLI::detail::expected_max_vector_size;
    info.read = [&words](const std::vector<std::string>& values, bool) { words = values; };
    return info;
}

OptionInfo positional(const std::string& name, std::string& value, const std::string& description,
                      const std::string& choices) {
    OptionInfo info = text_option(name, choices, value, description);
    info.is_required = true;
    return info;
}

void add_output(CommandInfo& command, const std::string& name, std::string& value,
                const std::string& description) {
    command.positionals.push_back({{name}, "", description});
    OptionInfo& output = command.options.emplace_back(
        rare(text_option("-o,--output", name, value, "The same as " + name + " as the last word")));
    output.is_positional = output.is_required = true;
}

OptionInfo force_option(bool& force) { return flag_option("-f,--force", force, "Overwrite existing files"); }
OptionInfo quiet_option(bool& quiet) {
    return flag_option("-q,--quiet", quiet, "Print no summary and no progress bar");
}

OptionInfo report_option(std::string& file) {
    return text_option("--report", "FILE", file, "Write counts, warnings and times to this JSON file");
}

OptionInfo format_option(std::string& format) {
    return text_option("--format", format_names(), format,
                       "Output format (default " + default_format() + ")");
}

OptionInfo up_option(std::string& up) {
    return text_option("--up", "y|z", up,
                       "Axis that points up; y is that of glTF (default), z that of many scans");
}

std::vector<OptionInfo> compare_options(CompareOptions& options) {
    return {number_option("--samples", "N", options.samples, from_one(0x1p32),
                          "Samples on each model (default 200000)"),
            number_option("--seed", "N", options.seed, {}, "Seed of the samples (default 1)"),
            number_option("--tolerance", "T", options.tolerance, {.max = 1e9},
                          "Relative gap of a maximum and its bound (default 0.01)"),
            number_option("--threads", "N", options.threads, {.max = 1024},
                          "Maximum number of threads; 0: all (default)")};
}

OptionInfo rare(OptionInfo option) {
    option.group.clear();
    return option;
}

}  // namespace faqem::cli
