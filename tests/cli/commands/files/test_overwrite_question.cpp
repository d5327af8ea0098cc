// Existing outputs: a question at a terminal, exit code 7 elsewhere.

#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>

#include "support/catch.hpp"
#include "support/cli_support.hpp"

using namespace tool_test;

namespace {

/// What a terminal showed, and the exit code.
struct Session {
    int code = -1;
    std::string shown;

    bool asked() const { return shown.find("[y/N]") != std::string::npos; }
};

/// Runs `faqem ARGUMENTS` in the folder at a pseudo-terminal. \param keys  typed when it asks
Session run_at_terminal(const Folder& folder, const std::string& arguments, const std::string& keys) {
    int terminal = -1;
    const std::string command =
        "cd '" + folder.path().string() + "' && exec '" + tool_path + "' " + arguments;
    const pid_t child = forkpty(&terminal, nullptr, nullptr, nullptr);
    if (child == 0) {
        execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
        _exit(127);
    }
    REQUIRE(child > 0);
    Session session;
    bool is_typed = false;
    std::array<char, 1000> bytes;
    for (ssize_t count; (count = ::read(terminal, bytes.data(), bytes.size())) > 0;) {
        session.shown.append(bytes.data(), static_cast<std::size_t>(count));
        if (is_typed || !session.asked()) continue;
        is_typed = ::write(terminal, keys.data(), keys.size()) == static_cast<ssize_t>(keys.size());
    }
    int status = 0;
    waitpid(child, &status, 0);
    close(terminal);
    if (WIFEXITED(status)) session.code = WEXITSTATUS(status);
    return session;
}

}  // namespace

TEST_CASE("at a terminal an existing output is replaced only after a yes") {
    const ModelFolder folder("in.glb", sheet(4));
    const std::string command = "in.glb out.glb --bake none --report r.json";
    for (const auto& [keys, code] :
         {std::pair("y\r", 0), {"yes\r", 0}, {"n\r", 7}, {"\r", 7}, {"\x04", 7}, {"\x03", 8}}) {
        CAPTURE(keys);
        write(folder / "out.glb", "mine");
        fs::remove(folder / "r.json");
        const Session session = run_at_terminal(folder, command, keys);
        CAPTURE(session.shown);
        CHECK(session.code == code);
        CHECK(session.shown.find("faqem: out.glb exists (4 bytes, 20") != std::string::npos);
        CHECK(session.shown.find("); overwrite? [y/N] ") != std::string::npos);
        CHECK((read(folder / "out.glb") == "mine") == (code != 0));
        CHECK(fs::exists(folder / "r.json") == (code == 0));
        CHECK((session.shown.find("\nfaqem: cancelled") != std::string::npos) == (code == 8));
    }
    write(folder / "r.json", "mine");
    const Session both = run_at_terminal(folder, command, "n\r");
    CHECK(both.code == 7);
    CHECK(both.shown.find(") and 1 more; overwrite?") != std::string::npos);
}

TEST_CASE("nobody is asked with --force, for new files, for inputs, in a batch, and in a pipe") {
    const ModelFolder folder("in.glb", sheet(4));
    write(folder / "out.glb", "mine");
    for (const auto& [arguments, code] : {std::pair("in.glb new.glb --bake none", 0),
                                          {"in.glb in.glb", 2},
                                          {"in.glb out.glb --bake none -f", 0},
                                          {"batch . batched --bake none", 0},
                                          {"batch . batched --bake none", 9}}) {
        CAPTURE(arguments);
        const Session session = run_at_terminal(folder, arguments, "y\r");
        CAPTURE(session.shown);
        CHECK(session.code == code);
        CHECK_FALSE(session.asked());
    }
    write(folder / "out.glb", "mine");
    const Outcome piped = run(folder, "in.glb out.glb < in.glb");
    CHECK(piped.code == 7);
    CHECK(piped.err == "faqem: out.glb: the file exists; use --force to overwrite it\n");
    CHECK(run_at_terminal(folder, "in.glb out.glb < /dev/null", "y\r").code == 7);
    CHECK(read(folder / "out.glb") == "mine");
}

TEST_CASE("each command that writes asks once") {
    const ModelFolder folder("in.glb", sheet(8));
    for (const char* arguments : {"lod in.glb levels --levels 0.5 --bake none --history h.bin",
                                  "lod in.glb levels.glb --levels 0.5 --bake none",
                                  "truncate h.bin cut.glb --faces 70", "render in.glb a.png --size 32",
                                  "report in.glb in.glb a.html --size 32 --views 1 --without-view"}) {
        CAPTURE(arguments);
        CHECK_FALSE(run_at_terminal(folder, arguments, "y\r").asked());
        const Session again = run_at_terminal(folder, arguments, "y\r");
        CHECK(again.code == 0);
        CHECK(again.shown.find("[y/N]") == again.shown.rfind("[y/N]"));
        CHECK(again.asked());
    }
}
