#include "cli/shell/completion.hpp"

#include <set>
#include <sstream>

#include "support/catch.hpp"
#include "support/cli_support.hpp"

using namespace tool_test;

namespace {

/// Runs a script and returns the lines that it prints.
/// \param shell  command with options that disable the user's startup files
std::set<std::string> lines_of(const std::string& shell, const Folder& folder, const std::string& script) {
    write(folder / "script", script);
    const std::string command = "cd '" + folder.path().string() + "' && " + shell + " script >lines 2>errors";
    CHECK(std::system(command.c_str()) == 0);
    CHECK(read(folder / "errors").empty());
    std::set<std::string> lines;
    std::istringstream in(read(folder / "lines"));
    for (std::string line; std::getline(in, line);) lines.insert(line);
    return lines;
}

/// Returns the completions that bash offers for `faqem WORDS`. \param last  index of the word to complete
std::set<std::string> in_bash(const std::string& words, int last) {
    const Folder folder;
    write(folder / "faqem.bash", run(folder, "completion").out);
    auto lines =
        lines_of("bash --norc", folder,
                 "source ./faqem.bash\nCOMP_WORDS=(faqem " + words + ")\nCOMP_CWORD=" + std::to_string(last) +
                     "\n_faqem\nprintf '%s\\n' \"${COMPREPLY[@]}\"\n");
    lines.erase("");
    return lines;
}

using WordSet = std::set<std::string>;

}  // namespace

TEST_CASE("bash completes commands, options and values") {
    CHECK(in_bash("''", 1) == WordSet{"simplify", "lod", "truncate", "bake", "batch", "list", "info",
                                      "compare", "render", "report", "profiles", "completion"});
    CHECK(in_bash("co", 1) == WordSet{"compare", "completion"});
    CHECK(in_bash("--v", 1) == WordSet{"--version"});
    CHECK(in_bash("simplify a.glb --textu", 3) == WordSet{"--texture-size"});
    CHECK(in_bash("info --", 2) == WordSet{"--help", "--help-all", "--json"});
    CHECK(in_bash("simplify --preset ''", 3) == WordSet{"qem", "paper", "stmw", "fast", "balanced", "best"});
    CHECK(in_bash("batch models simplified --format g", 5) == WordSet{"glb", "gltf"});
}

TEST_CASE("bash completion offers no words for file names") {
    CHECK(in_bash("simplify ''", 2).empty());
    CHECK(in_bash("simplify mod", 2).empty());
    CHECK(in_bash("simplify a.glb b.glb --report ''", 5).empty());
}
