#include <fstream>
#include <nlohmann/json.hpp>

#include "support/catch.hpp"
#include "support/cli_support.hpp"
#include "support/sanitizers.hpp"

using namespace tool_test;

namespace {

using Json = nlohmann::json;

/// Makes each command of the test do what FAQEM_FAULT_KIND says when it opens the file bad.ply: see
/// faults/injector.cpp.
class BadFile {
public:
    explicit BadFile(const char* kind) {
        setenv("LD_PRELOAD", injector_path, 1);
        setenv("FAQEM_FAULT_KIND", kind, 1);
        setenv("FAQEM_FAULT_FILE", "bad.ply", 1);
    }
    ~BadFile() {
        for (const char* name : {"LD_PRELOAD", "FAQEM_FAULT_KIND", "FAQEM_FAULT_FILE"}) unsetenv(name);
    }
};

/// Writes a.ply to e.ply and bad.ply in the folder `in`; bad.ply is the largest, so that it is begun first.
void make_models_with_bad(const Folder& folder) {
    fs::create_directory(folder / "in");
    for (const char* name : {"a", "b", "c", "d", "e"})
        faqem::save(sheet(6), folder / "in" / (std::string(name) + ".ply"));
    faqem::save(sheet(8), folder / "in/bad.ply");
}

/// The first child of a process; 0 if it has none.
pid_t child_of(pid_t process) {
    const std::string number = std::to_string(process);
    std::ifstream children("/proc/" + number + "/task/" + number + "/children");
    pid_t child = 0;
    children >> child;
    return child;
}

bool is_running(pid_t process) {
    std::ifstream status("/proc/" + std::to_string(process) + "/stat");
    std::string id, name, state;
    return (status >> id >> name >> state) && state != "Z";
}

const std::string batch_words = "batch in out --bake none --threads 1 ";

}  // namespace

// The preloaded library would come before that of the sanitizer.
#ifndef FAQEM_SANITIZED

TEST_CASE("a model whose process crashes, is killed or hangs costs only itself") {
    const Folder folder;
    make_models_with_bad(folder);
    struct Case {
        const char *kind, *message;
    };
    for (const Case& fault : {Case{"segv", "signal 11"}, Case{"kill", "signal 9"},
                              Case{"hang", "did not end within 1 seconds"}}) {
        CAPTURE(fault.kind);
        const BadFile bad(fault.kind);
        const Outcome outcome = run(folder, batch_words + "--force --end-after 1 --jobs 2");
        CHECK(outcome.code == 9);
        const auto lines = lines_by_path(outcome);
        REQUIRE(lines.size() == 6);
        for (const auto& [name, line] : lines)
            CHECK(line["status"] == (name == "bad.ply" ? "failed" : "done"));
        CHECK(lines.at("bad.ply")["code"] == 1);
        CHECK(lines.at("bad.ply")["message"].get<std::string>().find(fault.message) != std::string::npos);
    }
    CHECK(run(folder, batch_words + "--resume").code == 0);
}

TEST_CASE("a model of a list that crashes is tried once more alone, and then given up") {
    const Folder folder;
    make_models_with_bad(folder);
    REQUIRE(run(folder, "list in -o models.jsonl").code == 0);
    const std::string shard = "batch --list models.jsonl out --bake none --threads 1 ";
    {
        const BadFile bad("segv");
        const Outcome outcome = run(folder, shard);
        CHECK(outcome.code == 0);
        const auto lines = lines_by_path(outcome);
        REQUIRE(lines.size() == 6);
        for (const auto& [name, line] : lines)
            CHECK(line["status"] == (name == "bad.ply" ? "poisoned" : "done"));
    }
    // It stays given up, also where it would be right.
    CHECK(lines_by_path(run(folder, shard)).at("bad.ply")["status"] == "poisoned");
    CHECK(lines_by_path(run(folder, shard + "--force")).at("bad.ply")["status"] == "done");
}

TEST_CASE("the processes of a batch that is killed end with it, in the middle of a model too") {
    const Folder folder;
    make_models_with_bad(folder);
    const BadFile bad("hang");
    const pid_t process = start(folder, "batch", "in", "out", "--jobs", "1");
    pid_t worker = 0;
    while (worker == 0 && waitpid(process, nullptr, WNOHANG) == 0) worker = child_of(process);
    REQUIRE(worker != 0);
    kill(process, SIGKILL);
    waitpid(process, nullptr, 0);
    for (int i = 0; i < 1000 && is_running(worker); ++i) usleep(10'000);
    CHECK(!is_running(worker));
}

#endif
