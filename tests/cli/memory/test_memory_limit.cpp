#include "cli/memory/memory_limit.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <new>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "cli/process/exit_code.hpp"
#include "support/catch.hpp"
#include "support/cli_support.hpp"
#include "support/sanitizers.hpp"

using namespace faqem::cli;
using namespace tool_test;

// Sanitizers need address space of their own, and end the process if an allocation fails.
#ifndef FAQEM_SANITIZED

namespace {

constexpr std::uint64_t megabyte = 1'000'000;

/// Runs a function in a child process. \return its exit code, -1 if it was ended by a signal
template <class Work>
int exit_code_in_child(Work&& work) {
    const pid_t child = fork();
    if (child == 0) {
        static_cast<void>(!std::freopen("/dev/null", "w", stderr));
        _exit(work());
    }
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// Whether memory can be allocated and written.
bool can_use(std::uint64_t bytes) {
    try {
        const auto memory = std::make_unique_for_overwrite<char[]>(bytes);
        std::memset(memory.get(), 1, bytes);
        // Without a read of the memory, compilers remove the allocation.
        const volatile char* const last = memory.get() + bytes - 1;
        return *last == 1;
    } catch (const std::bad_alloc&) {
        return false;
    }
}

void exhaust_memory() noexcept {
    static std::vector<char> memory;
    memory.reserve(std::size_t{1} << 46);
}

/// Writes a sheet that `count` nodes refer to.
/// \param file  .gltf
void write_repeated_sheet(const fs::path& file, faqem::Index quads, std::size_t count) {
    faqem::save(sheet(quads), file);
    auto document = nlohmann::json::parse(read(file));
    const nlohmann::json node = document["nodes"][0];
    document["nodes"] = std::vector<nlohmann::json>(count, node);
    document["scenes"][0]["nodes"].clear();
    for (std::size_t i = 0; i < count; ++i) document["scenes"][0]["nodes"].push_back(i);
    write(file, document.dump());
}

}  // namespace

TEST_CASE("limit_process_memory makes allocations above the limit fail") {
    CHECK(exit_code_in_child([] {
              limit_process_memory(500 * megabyte, 4);
              return can_use(200 * megabyte) && !can_use(1200 * megabyte) ? 0 : 1;
          }) == 0);
    // A lower limit of the shell is kept.
    CHECK(exit_code_in_child([] {
              rlimit limit{};
              getrlimit(RLIMIT_DATA, &limit);
              limit.rlim_cur = 1500 * megabyte;
              setrlimit(RLIMIT_DATA, &limit);
              limit_process_memory(2000 * megabyte, 4);
              getrlimit(RLIMIT_DATA, &limit);
              return limit.rlim_cur == 1500 * megabyte ? 0 : 1;
          }) == 0);
    // Stacks of threads are additional, but on a machine of many threads they do not multiply the limit.
    CHECK(exit_code_in_child([] {
              limit_process_memory(500 * megabyte, 100);
              rlimit limit{};
              getrlimit(RLIMIT_DATA, &limit);
              return limit.rlim_cur < 1000 * megabyte ? 0 : 1;
          }) == 0);
}

TEST_CASE("the process ends with exit code 11 if memory is exhausted where no exception can be thrown") {
    CHECK(exit_code_in_child([] {
              limit_process_memory(2000 * megabyte, 4);
              exhaust_memory();
              return 0;
          }) == exit_no_memory);
}

TEST_CASE("simplify stays within --max-memory where no estimate tells the memory in advance") {
    const Folder folder;
    write_repeated_sheet(folder / "in.gltf", 70, 8000);
    // The scene is flattened when it is saved: 39 million faces.
    const Outcome outcome =
        run(folder, "simplify in.gltf out.ply --bake none --ratio 0.5 --max-memory 500MB");
    CHECK(outcome.code == exit_no_memory);
    CHECK(outcome.err == "faqem: not enough memory\n");
    CHECK_FALSE(fs::exists(folder / "out.ply"));
    CHECK(run(folder, "simplify in.gltf out.glb --bake none --ratio 0.5 --max-memory 500MB").code == 0);
}

TEST_CASE("batch limits the memory of all models and runs those that fail for memory again alone") {
    const Folder folder;
    fs::create_directories(folder / "in");
    // The first four need hundreds of megabytes each, but less than the limit, and the last more than that.
    for (const std::string name : {"a", "b", "c", "d"})
        write_repeated_sheet(folder / ("in/" + name + ".gltf"), 50, 1600);
    write_repeated_sheet(folder / "in/large.gltf", 50, 20000);
    const Outcome outcome =
        run(folder, "batch in out --format ply --bake none --ratio 0.5 --jobs 4 --max-memory 500MB");
    CHECK(outcome.code == exit_batch_incomplete);
    std::istringstream lines(outcome.out);
    std::size_t count = 0;
    for (std::string line; std::getline(lines, line); ++count) {
        const auto json = nlohmann::json::parse(line);
        CAPTURE(line);
        CHECK(json["code"].get<int>() == (json["path"] == "large.gltf" ? exit_no_memory : exit_ok));
    }
    CHECK(count == 5);
}

TEST_CASE("memory that models of a batch have freed is available for the next ones") {
    const Folder folder;
    fs::create_directories(folder / "in");
    for (char name = 'a'; name <= 'j'; ++name)
        write_repeated_sheet(folder / ("in/" + std::string(1, name) + ".gltf"), 50, 1600);
    // All models start before the first has allocated, and most of them fail; each is run again alone.
    const Outcome outcome =
        run(folder, "batch in out --format ply --bake none --ratio 0.5 --jobs 10 --max-memory 500MB");
    CHECK(outcome.code == exit_ok);
    CHECK(std::count(outcome.out.begin(), outcome.out.end(), '\n') == 10);
}

#endif

TEST_CASE("require_memory reports the file, the estimate and the limit") {
    CHECK_NOTHROW(require_memory("a.glb", 100, 100));
    CHECK_THROWS_WITH(require_memory("a.glb", 3'000'001, 2'000'000),
                      "a.glb: may need 4 MB of memory, but only 2 MB are allowed (--max-memory)");
    CHECK_THROWS_AS(require_memory("a.glb", 101, 100), CommandError);
    CHECK(exit_code_of(CommandError(exit_no_memory, "")) == exit_no_memory);
    CHECK(exit_code_of(std::bad_alloc()) == exit_no_memory);
}
