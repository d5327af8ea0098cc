#include "cli/shell/command_tree.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <sstream>

#include "cli/commands/command_line.hpp"
#include "cli/options/simplify_options.hpp"
#include "cli/shell/help.hpp"
#include "cli/shell/parser.hpp"
#include "faqem/error.hpp"
#include "support/catch.hpp"
#include "support/cli_support.hpp"

using namespace faqem::cli;

namespace {

/// Parses a command line without running it. \return whether it is valid
bool parses(const std::string& line) {
    CLI::App app;
    Action action;
    const CommandTree tree = command_tree();
    add_to_parser(app, tree, action);
    try {
        app.parse(line, true);
    } catch (const CLI::ParseError&) {
        return false;
    }
    return action != nullptr;
}

}  // namespace

TEST_CASE("every command and option has a description and every value a placeholder") {
    const CommandTree tree = command_tree();
    CHECK(tree.commands.size() == 12);
    CHECK(tree.exit_codes.find("11 not enough memory") != std::string::npos);
    for (const CommandInfo& command : tree.commands) {
        CAPTURE(command.name);
        CHECK(!command.description.empty());
        for (const OptionInfo& option : command.options) {
            CAPTURE(option.names);
            CHECK(!option.description.empty());
            for (const char* type : {"TEXT", "FLOAT", "UINT", "INT"}) CHECK(option.value_name != type);
        }
    }
}

TEST_CASE("every command has examples that can be parsed") {
    const CommandTree tree = command_tree();
    for (const CommandInfo& command : tree.commands) {
        CAPTURE(command.name);
        CHECK(!command.examples.empty());
        for (const std::string& example : command.examples) {
            const std::size_t begin = example.find("faqem " + command.name);
            CAPTURE(example);
            REQUIRE(begin != std::string::npos);
            const std::string line = example.substr(begin, example.find_first_of(")|>", begin) - begin);
            CHECK(parses(line));
            CHECK(!parses(line + " --frobnicate"));
        }
    }
}

TEST_CASE("enumerated options accept exactly the values of their placeholder") {
    GivenOptions given;
    CommandTree tree{.commands = {{.name = "simplify",
                                   .description = "",
                                   .options = table_options(faqem::detail::in_simplify, given),
                                   .run = [&given]() -> int { return make_options(given), 0; }}}};
    const auto accepts = [&](const std::string& line) {
        CLI::App app;
        Action action;
        add_to_parser(app, tree, action);
        given.clear();
        app.parse("simplify " + line);
        try {
            action();
        } catch (const faqem::OptionError&) {
            return false;
        }
        return true;
    };
    std::size_t choices = 0;
    for (const OptionInfo& option : tree.commands.front().options) {  // of simplify
        CAPTURE(option.names);
        const std::string name = option.names.back() + " ";
        for (const std::string& choice : choices_of(option)) {
            CAPTURE(choice);
            CHECK(accepts(name + choice));
        }
        if (!choices_of(option).empty()) CHECK(!accepts(name + "nothing"));
        choices += choices_of(option).size();
    }
    CHECK(choices == 38);
}

TEST_CASE("help has at most 40 lines of 80 columns, and --help-all has each option") {
    const CommandTree tree = command_tree();
    std::vector<std::string> usual = {tree_help(tree)}, all;
    for (const CommandInfo& command : tree.commands) {
        usual.push_back(command_help(command, false));
        all.push_back(command_help(command, true));
        for (const OptionInfo& option : command.options) {
            CAPTURE(option.names);
            CHECK(all.back().find(option.names.back()) != std::string::npos);
            // Each option has one line in the short help.
            if (!option.group.empty())
                CHECK(usual.back().find(summary_of(option) + "\n") != std::string::npos);
        }
    }
    for (const std::string& help : usual) CHECK(std::count(help.begin(), help.end(), '\n') <= 40);
    usual.insert(usual.end(), all.begin(), all.end());
    for (const std::string& help : usual) {
        std::istringstream lines(help);
        for (std::string line; std::getline(lines, line);) {
            CAPTURE(line);
            CHECK(line.size() <= 80);
        }
    }
}

TEST_CASE("help shows examples and the possible values of options") {
    const tool_test::Folder folder;
    const std::string help = tool_test::run(folder, "simplify --help").out;
    CHECK(help.find("Examples:\n  faqem simplify model.glb") != std::string::npos);
    CHECK(help.find("\nTarget:\n  ") != std::string::npos);
    CHECK(help.find("--preset") == std::string::npos);
    CHECK(tool_test::run(folder, "simplify --help-all")
              .out.find("--preset qem|paper|stmw|fast|balanced|best") != std::string::npos);
    CHECK(tool_test::run(folder, "--help").out.find("Exit codes: 0 success") != std::string::npos);
}
