#include "cli/shell/parser.hpp"

#include "support/catch.hpp"
#include "support/cli_support.hpp"

using namespace faqem::cli;
using tool_test::Folder;

TEST_CASE("suggestion refers to the first unknown command or option") {
    CommandTree tree;
    tree.options = {{{"--version"}}};
    tree.commands = {
        {.name = "simplify", .description = "", .options = {{{"-h", "--help"}}, {{"--ratio"}, "R"}}},
        {.name = "info", .description = "", .options = {{{"--json"}}}}};
    CHECK(suggestion(tree, {}).empty());
    CHECK(suggestion(tree, {"smplify"}) == "simplify");
    CHECK(suggestion(tree, {"--versoin"}) == "--version");
    CHECK(suggestion(tree, {"dance"}).empty());
    CHECK(suggestion(tree, {"simplify", "a", "--raito", "0.5"}) == "--ratio");
    CHECK(suggestion(tree, {"simplify", "a", "--raito=0.5", "--hlep"}) == "--ratio");
    CHECK(suggestion(tree, {"info", "--ratio", "0.5"}).empty());  // it has no such option
    CHECK(suggestion(tree, {"simplify", "--", "--raito"}).empty());
    CHECK(suggestion(tree, {"simplify", "--ratio", "-0.5"}).empty());
}

TEST_CASE("the command prints a suggestion for a misspelt option or command") {
    const Folder folder;
    for (const auto& [arguments, meant] :
         {std::pair("simplify a.glb b.glb --txture-size 512", "--texture-size"),
          std::pair("smplify", "simplify"), std::pair("render a.glb b.png --wire", "--wireframe"),
          std::pair("--verison", "--version")}) {
        const tool_test::Outcome outcome = tool_test::run(folder, arguments);
        CAPTURE(arguments, outcome.err);
        CHECK(outcome.code == 2);
        CHECK(outcome.err.find(std::string("Did you mean ") + meant + "?") != std::string::npos);
    }
    CHECK(tool_test::run(folder, "simplify a.glb b.glb --qqqqqq").err.find("Did you mean") ==
          std::string::npos);
}
