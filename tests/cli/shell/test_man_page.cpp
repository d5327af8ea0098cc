#include "cli/shell/man_page.hpp"

#include "faqem/version.hpp"
#include "support/catch.hpp"
#include "support/cli_support.hpp"

TEST_CASE("man_page escapes the special characters of troff") {
    faqem::cli::CommandTree tree;
    tree.description = ".first\n'second\na\\b-c";
    const std::string page = faqem::cli::man_page(tree, "1.2.3");
    CHECK(page.find("\n\\&.first\n\\&'second\na\\eb\\-c\n") != std::string::npos);
    CHECK(page.find(".TH FAQEM 1 \"\" \"faqem 1.2.3\"") == 0);
}

TEST_CASE("the manual page lists commands, options, exit codes and examples") {
    const tool_test::Folder folder;
    const tool_test::Outcome outcome = tool_test::run(folder, "man");
    CHECK(outcome.code == 0);
    for (const char* text :
         {".SS \\fBfaqem simplify\\fR \\fIIN\\fR \\fIOUT\\fR\n", "\\fB\\-\\-max\\-error\\fR \\fILENGTH\\fR\n",
          "\\fB\\-\\-normal\\-map\\fR auto|on|off\n", "\\fB\\-h\\fR, \\fB\\-\\-help\\fR\n",
          ".SH EXIT STATUS\n", "8 cancelled", "faqem truncate statue.history"}) {
        CAPTURE(text);
        CHECK(outcome.out.find(text) != std::string::npos);
    }
    CHECK(outcome.out.find("faqem " + std::string(faqem::version())) != std::string::npos);
}
