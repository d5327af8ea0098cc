// The interfaces and documents follow from the table of options: docs/reference.md agrees with it, and a row that is
// added to the table appears in all of them.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <sstream>

#include "cli/commands/command_line.hpp"
#include "cli/options/profile.hpp"
#include "cli/options/simplify_options.hpp"
#include "cli/shell/completion.hpp"
#include "cli/shell/parser.hpp"
#include "faqem/error.hpp"
#include "support/catch.hpp"
#include "support/cli_support.hpp"

using namespace faqem::cli;
using namespace tool_test;
using faqem::detail::OptionKind;
using faqem::detail::OptionRow;
using faqem::detail::OptionTable;

namespace {

/// The cells of the line of a Markdown table whose first cell contains a text; empty if there is none.
std::vector<std::string> table_line(const std::string& page, const std::string& text) {
    std::istringstream lines(page);
    for (std::string line; std::getline(lines, line);) {
        if (!line.starts_with("| `-")) continue;
        std::vector<std::string> cells;
        std::istringstream columns(line.substr(2));
        for (std::string cell; std::getline(columns, cell, '|');)
            cells.push_back(cell.size() < 2
                                ? ""
                                : cell.substr(cells.empty() ? 0 : 1, cell.size() - (cells.empty() ? 1 : 2)));
        if (cells.size() >= 4 && cells[0].find(text) != std::string::npos) return cells;
    }
    return {};
}

/// Range of an option in docs/reference.md.
std::string range_cell(const OptionRow& row) {
    if (row.kind == OptionKind::choice && row.flag_value.empty()) {
        std::string words;
        for (const std::string& word : faqem::detail::split_choices(row.choices))
            words += (words.empty() ? "`" : ", `") + word + "`";
        return words;
    }
    const std::string range = range_text(row.kind, row.range, row.unit);
    return range.starts_with("in ") ? range.substr(3) : range;
}

/// How the table of `faqem simplify` in docs/reference.md differs from the table of options.
std::vector<std::string> documentation_problems(OptionTable table) {
    const std::string page = read(fs::path(source_path) / "docs/reference.md");
    std::vector<std::string> problems;
    for (const OptionRow& row : table) {
        if (!(row.entry_points & faqem::detail::in_simplify)) continue;
        const std::string name = command_spelling(row);
        const std::vector<std::string> cells = table_line(page, "`" + name);
        if (cells.empty()) {
            problems.push_back(name + ": is missing");
            continue;
        }
        if (row.flag_value.empty() && !row.value_name.empty() &&
            cells[0].find(name + " ") == std::string::npos)
            problems.push_back(name + ": has no value");
        std::string by_default = cells[2];
        std::erase(by_default, '`');
        if (!by_default.starts_with(default_text(row).empty() ? "-" : default_text(row)))
            problems.push_back(name + ": the default is " + default_text(row));
        if (cells[3] != range_cell(row) && row.suffix_choice.empty())
            problems.push_back(name + ": the range is " + range_cell(row));
    }
    return problems;
}

/// The table of options with one more row, and a command line made from it.
struct ExtendedTable {
    std::vector<OptionRow> rows{faqem::detail::option_table().begin(), faqem::detail::option_table().end()};
    GivenOptions given;
    CommandTree tree;
    faqem::Options options;  ///< after running the command

    ExtendedTable() {
        rows.push_back(faqem::detail::option_row<&faqem::Options::weights, &faqem::Weights::uv>(
            {.name = "w-novelty",
             .range = {.max = 3},
             .value_name = "W",
             .default_text = "1.5",
             .help = "Weight of the novelty term",
             .entry_points = faqem::detail::in_all_but_truncate}));
        CommandInfo command{"simplify", "Simplify"};
        command.options = table_options(faqem::detail::in_simplify, given, rows);
        command.options.push_back(profile_option());
        command.run = [this]() -> int { return options = make_options(given, rows), 0; };
        tree.commands = {command};
        complete_options(tree);
    }

    void run(const std::vector<std::string>& words) {
        CLI::App app;
        Action action;
        add_to_parser(app, tree, action);
        given.clear();
        app.parse(std::vector<std::string>(words.rbegin(), words.rend()));
        action();
    }
};

bool contains_text(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("the table of options in docs/reference.md agrees with the options") {
    CHECK(documentation_problems(faqem::detail::option_table()) == std::vector<std::string>());
}

TEST_CASE("an option that is added to the table is in the command, its messages, profiles and documents") {
    ExtendedTable extended;
    extended.run({"simplify", "--w-novelty", "2.5"});
    CHECK(extended.options.weights.uv == 2.5);
    CHECK(options_key(extended.options, extended.rows) != options_key({}, extended.rows));
    CHECK_THROWS_WITH(extended.run({"simplify", "--w-novelty=4"}), "--w-novelty must be in [0, 3], not 4");
    CHECK(suggestion(extended.tree, {"simplify", "--w-noveltee"}) == "--w-novelty");

    CHECK(contains_text(bash_completion(extended.tree), "--w-novelty"));

    const Folder folder;
    write(folder / "p.json", R"({"faqem-profile": 1, "w-novelty": 1.25})");
    extended.run({"simplify", "--config", (folder / "p.json").string()});
    CHECK(extended.options.weights.uv == 1.25);

    CHECK(documentation_problems(extended.rows) == std::vector<std::string>{"--w-novelty: is missing"});
}

TEST_CASE("an option that is added to the table can be set by its name in C and Python") {
    const ExtendedTable extended;
    const auto& row = faqem::detail::named_option("w-novelty", extended.rows);
    faqem::Options options;
    set_option(options, row, "0.5", faqem::detail::name_spelling, extended.rows);
    CHECK(options.weights.uv == 0.5);
    CHECK_THROWS_WITH(faqem::detail::named_option("w-novelti", extended.rows),
                      "unknown option 'w-novelti'; did you mean 'w-novelty'?");
}

TEST_CASE("C and Python know every option of faqem simplify, or say what stands for it") {
    const auto tree = command_tree();
    const auto& commands = tree.commands;
    const auto simplify = std::find_if(commands.begin(), commands.end(),
                                       [](const CommandInfo& command) { return command.name == "simplify"; });
    for (const OptionInfo& option : simplify->options) {
        const std::string name = option.names.back().substr(2);
        CAPTURE(name);
        try {
            faqem::detail::named_option(name);
        } catch (const faqem::OptionError& error) {
            CHECK(contains_text(error.what(), "the command"));
        }
    }
}
