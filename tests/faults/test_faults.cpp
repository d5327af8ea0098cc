// A fault at every system call that opens or changes a file: afterwards a set of files is the old or the new
// one.

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>

#include <chrono>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <random>
#include <vector>

#include "asset/io/file_set.hpp"
#include "asset/io/temporary_file.hpp"
#include "faqem/error.hpp"
#include "support/catch.hpp"
#include "support/cli_support.hpp"
#include "support/format_support.hpp"
#include "support/sanitizers.hpp"

using namespace tool_test;
using faqem::testing::contains;

namespace {

using Files = std::map<std::string, std::string>;

/// A command that writes a set of files in the folder `out`.
struct Scenario {
    std::string name;
    std::vector<std::string> command;  ///< the last word is the option that takes the size of the result
    std::string model;                 ///< a file of the set that refers to others
};

std::vector<Scenario> scenarios() {
    return {{"glTF",
             {"simplify", "in.glb", "out/a.gltf", "--report", "out/a.json", "--history", "out/a.history",
              "--ratio"},
             "a.gltf"},
            {"OBJ", {"simplify", "in.glb", "out/a.obj", "--history", "out/a.history", "--ratio"}, "a.obj"},
            {"GLB", {"simplify", "in.glb", "out/a.glb", "--ratio"}, "a.glb"},
            {"lod",
             {"lod", "in.glb", "out", "--format", "gltf", "--history", "out/in.history", "--levels"},
             "in_LOD1.gltf"}};
}

/// Fault of injector.cpp. The call is counted from 1.
struct Fault {
    std::string kind;
    int call = 0;
};

/// Exit code, or minus the signal that ended the process; and what the injector logged.
struct FaultyRun {
    int code = 0;
    std::string log, errors;
    bool reached() const { return !log.starts_with("calls "); }
};

Files files_of(const fs::path& folder) {
    Files files;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        files[entry.path().lexically_relative(folder)] = entry.is_directory() ? "" : read(entry.path());
    return files;
}

/// Reports have times, which differ from run to run.
std::string without_times(const std::string& name, const std::string& text) {
    if (!name.ends_with(".json")) return text;
    nlohmann::json json = nlohmann::json::parse(text, nullptr, false);
    const auto erase = [](nlohmann::json& report) {
        if (!report.is_object()) return;
        report.erase("seconds");
        report.erase("peak_rss_bytes");
    };
    erase(json);
    if (json.is_object() && json.contains("levels"))
        for (nlohmann::json& level : json["levels"])
            if (level.contains("report")) erase(level["report"]);
    return json.dump();
}

Files comparable(const Files& files) {
    Files all;
    for (const auto& [name, text] : files) all[name] = without_times(name, text);
    return all;
}

/// Without temporary files and set folders.
Files visible(Files files) {
    std::erase_if(files, [](const auto& file) { return file.first.starts_with("."); });
    return files;
}

bool has_hidden_file(const Files& files) { return visible(files).size() != files.size(); }

/// Runs the command of a scenario with faults, and checks the files.
class FaultTest {
public:
    explicit FaultTest(const Scenario& scenario) : scenario_(scenario) {
        faqem::save(sheet(2), folder_ / "in.glb");
        old_files_ = reference("0.75");
        new_files_ = reference("0.5");
        REQUIRE(comparable(old_files_) != comparable(new_files_));
    }

    /// Returns whether the fault was reached: the command has as many calls.
    /// \param replace  whether the old set exists
    bool check(const Fault& fault, bool replace) {
        CAPTURE(scenario_.name, fault.kind, fault.call, replace);
        set_files(replace ? old_files_ : Files());
        const FaultyRun run = spawn(scenario_.command, "0.5", fault);
        if (!run.reached()) return false;
        CAPTURE(run.code, run.log, run.errors);
        const Files before = replace ? old_files_ : Files(), all = files_of(folder_ / "out"),
                    after = visible(all);
        const bool is_old = after == before, is_new = comparable(after) == comparable(new_files_);
        if (fault.kind == "kill") {
            CHECK(run.code == -SIGKILL);
            if (!is_old && !is_new) check_unreadable();
        } else {
            CHECK((is_old || is_new));
            if (run.code == 0) CHECK(is_new);
        }
        if (fault.kind == "term") {
            // At the start, when there is no handler yet, the signal ends the process.
            CHECK((run.code == 0 || run.code == 8 || run.code == -SIGTERM));
            CHECK((run.code == 0) == is_new);
            CHECK(after.size() == all.size());
        }
        check_next_write(before, after);
        return true;
    }

    /// Moves the old set, half replaced by a run that was killed, to `half`.
    void make_half_replaced_set() {
        for (int call = 1;; ++call) {
            set_files(old_files_);
            REQUIRE(spawn(scenario_.command, "0.5", {"kill", call}).code == -SIGKILL);
            const Files after = visible(files_of(folder_ / "out"));
            if (after == old_files_ || comparable(after) == comparable(new_files_)) continue;
            return fs::rename(folder_ / "out", folder_ / "half");
        }
    }

    /// Lets a run that finds a half replaced set and writes another file fail or end at a call: the set is
    /// old or new, or it is still not readable and the next run completes it. Returns whether the call was
    /// reached.
    bool check_recovery(const Fault& fault) {
        CAPTURE(scenario_.name, fault.kind, fault.call);
        fs::remove_all(folder_ / "out");
        // With the times and links of the files.
        const std::string copy = "cp -a " + (folder_ / "half").string() + " " + (folder_ / "out").string();
        REQUIRE(std::system(copy.c_str()) == 0);
        const FaultyRun run = spawn({"simplify", "in.glb", "out/other.glb", "--ratio"}, "0.5", fault);
        if (!run.reached()) return false;
        fs::remove(folder_ / "out/other.glb");
        CAPTURE(run.code, run.log, run.errors);
        const Files after = visible(files_of(folder_ / "out"));
        if (after != old_files_ && comparable(after) != comparable(new_files_)) {
            CHECK(run.code != 0);
            check_unreadable();
        }
        check_next_write(old_files_, after);
        return true;
    }

    /// Number of calls of a run that replaces the old set.
    int calls() {
        set_files(old_files_);
        const std::string log = spawn(scenario_.command, "0.5", {}).log;
        return std::atoi(log.c_str() + std::string("calls ").size());
    }

private:
    void set_files(const Files& files) {
        fs::remove_all(folder_ / "out");
        fs::create_directory(folder_ / "out");
        for (const auto& [name, text] : files) write(folder_ / "out" / name, text);
    }

    static std::vector<std::string> words(const std::vector<std::string>& command, const std::string& size) {
        std::vector<std::string> all = {tool_path};
        all.insert(all.end(), command.begin(), command.end());
        all.insert(all.end(), {size, "--bake", "keep", "--threads", "1", "--force", "--quiet"});
        return all;
    }

    /// The files of a run without a fault.
    Files reference(const std::string& size) {
        set_files({});
        const FaultyRun run = spawn(scenario_.command, size, {});
        CAPTURE(run.errors);
        REQUIRE(run.code == 0);
        const Files files = files_of(folder_ / "out");
        REQUIRE(!has_hidden_file(files));
        return files;
    }

    /// Runs the command in the folder. \param size  of the result
    FaultyRun spawn(const std::vector<std::string>& command, const std::string& size,
                    const Fault& fault) const {
        const fs::path log = folder_ / "log", errors = folder_ / "errors";
        fs::remove(log);
        std::vector<std::string> strings = words(command, size), variables;
        for (char** variable = environ; *variable; ++variable) variables.emplace_back(*variable);
        variables.push_back(std::string("LD_PRELOAD=") + injector_path);
        variables.push_back("FAQEM_FAULT_CALL=" + std::to_string(fault.call));
        variables.push_back("FAQEM_FAULT_KIND=" + fault.kind);
        variables.push_back("FAQEM_FAULT_LOG=" + log.string());
        std::vector<char*> arguments, environment;
        for (std::string& word : strings) arguments.push_back(word.data());
        for (std::string& variable : variables) environment.push_back(variable.data());
        arguments.push_back(nullptr);
        environment.push_back(nullptr);
        posix_spawn_file_actions_t actions;
        posix_spawn_file_actions_init(&actions);
        posix_spawn_file_actions_addchdir_np(&actions, folder_.path().c_str());
        posix_spawn_file_actions_addopen(&actions, 2, errors.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
        pid_t process = 0;
        REQUIRE(posix_spawn(&process, tool_path, &actions, nullptr, arguments.data(), environment.data()) ==
                0);
        posix_spawn_file_actions_destroy(&actions);
        int status = 0;
        REQUIRE(waitpid(process, &status, 0) == process);
        return {WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status), read(log), read(errors)};
    }

    void check_unreadable() {
        ++mixed_;
        const std::string message = faqem::testing::message_of<faqem::ReadError>(
            [&] { faqem::load(folder_ / "out" / scenario_.model); });
        CHECK(contains(message, "that writes to the folder"));
    }

    /// After the next write to the folder the set is the old or the new one. If it was already, it is the
    /// same.
    void check_next_write(const Files& before, const Files& after) {
        const fs::path out = folder_ / "out";
        faqem::detail::write_file(out / "other", {}, faqem::Overwrite::no);
        fs::remove(out / "other");
        faqem::detail::remove_leftovers(out);
        const Files recovered = files_of(out);
        const bool is_old = recovered == before, is_new = comparable(recovered) == comparable(new_files_);
        CHECK((is_old || is_new));
        if (comparable(after) == comparable(new_files_)) CHECK(is_new);
    }

    Scenario scenario_;
    Folder folder_;
    Files old_files_, new_files_;

public:
    int mixed_ = 0;  ///< killed runs after which the set was neither the old nor the new one
};

#ifdef FAQEM_SANITIZED
constexpr bool can_inject = false;  // the run-time library of a sanitizer must be loaded first
#else
constexpr bool can_inject = true;
#endif

const std::string kinds[] = {"error", "full", "term"};

}  // namespace

TEST_CASE("a killed process leaves either the complete old set or the complete new set") {
    if (!can_inject) return;
    for (const Scenario& scenario : scenarios()) {
        FaultTest test(scenario);
        int call = 1;
        while (test.check({"kill", call}, true)) ++call;
        CHECK(call > 10);
        CHECK((test.mixed_ > 0) == (scenario.name != "GLB"));  // a single file is replaced by one call
    }
}

TEST_CASE("an error or SIGTERM at any call leaves either the old set or the new set") {
    if (!can_inject) return;
    int first_kind = 0;
    for (const Scenario& scenario : scenarios()) {
        FaultTest test(scenario);
        int call = 1;
        while (test.check({kinds[(call + first_kind) % 3], call}, true)) ++call;
        ++first_kind;
        CHECK(call > 10);
    }
}

TEST_CASE("readers of a half replaced set exit with 3, and the next run in its folder completes it") {
    if (!can_inject) return;
    const ModelFolder folder("in.glb", sheet(2));
    fs::create_directory(folder / "out");
    // The set of a process that died after it had renamed the image.
    REQUIRE(run(folder, "simplify in.glb out/a.gltf --bake keep --quiet --history out/a.history").code == 0);
    const std::string gltf = read(folder / "out/a.gltf");
    const fs::path set = folder / "out/.faqem-set";
    fs::create_directories(set / "new");
    fs::create_directories(set / "old/a.history");
    fs::rename(folder / "out/a.gltf", set / "new/a.gltf");
    write(folder / "out/a.gltf", "old");
    fs::last_write_time(folder / "out/a.gltf", fs::file_time_type::clock::now() - std::chrono::hours(1));
    fs::create_hard_link(folder / "out/a.gltf", set / "old/a.gltf");
    for (const char* command : {"info out/a.gltf", "compare out/a.gltf in.glb", "render out/a.gltf a.png",
                                "report in.glb out/a.gltf -o a.html", "simplify out/a.gltf b.glb",
                                "lod out/a.gltf levels", "truncate out/a.history b.glb --faces 4"}) {
        CAPTURE(command);
        const Outcome outcome = run(folder, command);
        CAPTURE(outcome.err);
        CHECK(outcome.code == 3);
        CHECK(contains(outcome.err, "replaced only in part; any faqem command that writes to the folder"));
    }
    CHECK(run(folder, "simplify in.glb out/b.glb --bake keep --quiet").code == 0);
    CHECK(read(folder / "out/a.gltf") == gltf);
    CHECK(run(folder, "info out/a.gltf").code == 0);
    CHECK(!has_hidden_file(files_of(folder / "out")));
}

TEST_CASE("a run that recovers a half replaced set may fail or be killed, too") {
    if (!can_inject) return;
    for (const std::size_t i : {0u, 3u}) {
        FaultTest test(scenarios()[i]);
        test.make_half_replaced_set();
        for (const char* kind : {"kill", "error"}) {
            int call = 1;
            while (test.check_recovery({kind, call})) ++call;
            CHECK(call > 10);
        }
    }
}

TEST_CASE("a thousand faults", "[.long]") {
    if (!can_inject) return;
    const std::vector<Scenario> all = scenarios();
    std::vector<std::unique_ptr<FaultTest>> tests;
    std::vector<unsigned> calls;
    for (const Scenario& scenario : all) {
        tests.push_back(std::make_unique<FaultTest>(scenario));
        calls.push_back(static_cast<unsigned>(tests.back()->calls()));
    }
    std::mt19937 random(1);
    for (unsigned faults = 0, tries = 0; faults < 1000; ++tries) {
        const std::size_t i = tries % all.size();
        const std::string kind = random() % 2 ? "kill" : kinds[random() % 3];
        const int call = 1 + static_cast<int>(random() % calls[i]);
        faults += tests[i]->check({kind, call}, random() % 4 != 0);  // fewer calls without an old set
    }
}
