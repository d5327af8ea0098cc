#include "cli/shell/deprecated_names.hpp"

#include "support/catch.hpp"

using namespace faqem::cli;

using Words = std::vector<std::string>;

TEST_CASE("deprecated names are replaced by current ones, with a warning for each") {
    Words warnings;
    CHECK(replace_deprecated_names({"cut", "a.history", "b.glb", "--faces", "10"}, warnings) ==
          Words{"truncate", "a.history", "b.glb", "--faces", "10"});
    CHECK(warnings == Words{"'cut' is deprecated: use 'truncate'"});
    CHECK(replace_deprecated_names({"simplify", "--lock-border", "--visibility", "weighs"}, warnings) ==
          Words{"simplify", "--lock-boundary", "--visibility", "weighted"});
    CHECK(replace_deprecated_names({"simplify", "--visibility=weighs"}, warnings) ==
          Words{"simplify", "--visibility=weighted"});
    CHECK(warnings.size() == 4);
}

TEST_CASE("words that only look like deprecated names are not changed") {
    Words warnings;
    const Words words = {"simplify", "cut", "weighs", "--", "--lock-border"};
    CHECK(replace_deprecated_names(words, warnings) == words);
    CHECK(replace_deprecated_names({}, warnings).empty());
    CHECK(warnings.empty());
    CHECK(current_option_name("--lock-border") == "--lock-boundary");
    CHECK(current_option_name("--ratio") == "--ratio");
}
