#include "cli/memory/memory_limit.hpp"

#include <limits>

#include "support/catch.hpp"
#include "support/cli_support.hpp"

using namespace faqem::cli;
using namespace tool_test;

TEST_CASE("machine_memory returns a plausible size") { CHECK(machine_memory() > 100'000'000); }

TEST_CASE("cgroup_memory_limit returns the minimum limit of a control group and its ancestors") {
    const Folder folder;
    const auto group = [&](const std::string& text) {
        write(folder / "membership", text);
        return cgroup_memory_limit(folder / "membership", folder / "mounts");
    };
    constexpr std::uint64_t none = std::numeric_limits<std::uint64_t>::max();
    CHECK(cgroup_memory_limit(folder / "membership", folder / "mounts") == none);
    CHECK(group("0::/a/b\n") == none);
    fs::create_directories(folder / "mounts/a/b");
    fs::create_directories(folder / "mounts/memory/c/d");
    write(folder / "mounts/a/b/memory.max", "max\n");
    CHECK(group("0::/a/b\n") == none);
    write(folder / "mounts/a/memory.max", "5000000000\n");
    CHECK(group("0::/a/b\n") == 5'000'000'000);
    write(folder / "mounts/a/b/memory.max", "4000000000\n");
    CHECK(group("0::/a/b\n") == 4'000'000'000);
    write(folder / "mounts/memory.max", "3000000000\n");  // the container's own
    CHECK(group("0::/a/b\n") == 3'000'000'000);
    CHECK(group("0::/../outside\n") == 3'000'000'000);
    write(folder / "mounts/memory/c/memory.limit_in_bytes", "2000000000\n");
    const std::string both = "7:memory_other:/c/d\n4:cpu,memory:/c/d\n0::/\n";
    CHECK(group(both) == 2'000'000'000);
    CHECK(group("no line\n4:memory\n") == none);
    CHECK(group("7:memory_other:/c/d\n") == none);
}
