#include "cli/memory/machine_memory.hpp"

#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

namespace faqem::cli {

namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t unlimited = std::numeric_limits<std::uint64_t>::max();

/// Returns the number in a file; `unlimited` if there is no such file or it contains `max`.
std::uint64_t read_limit(const fs::path& file) {
    std::ifstream in(file);
    std::uint64_t limit = 0;
    return in >> limit ? limit : unlimited;
}

/// Returns the minimum of the limits in the files called `name` of a group and of all its ancestors.
/// \param group  path of the group, begins with a slash
std::uint64_t min_limit_of_ancestors(const fs::path& mount, const fs::path& group, const char* name) {
    std::uint64_t min_limit = read_limit(mount / name);
    for (fs::path below = group.relative_path(); !below.empty(); below = below.parent_path())
        min_limit = std::min(min_limit, read_limit(mount / below / name));
    return min_limit;
}

bool has_memory_controller(const std::string& controllers) {
    return ("," + controllers + ",").find(",memory,") != std::string::npos;
}

}  // namespace

std::uint64_t cgroup_memory_limit(const fs::path& membership, const fs::path& mounts) {
    std::uint64_t min_limit = unlimited;
    std::ifstream in(membership);
    // Each line is NUMBER:CONTROLLERS:PATH; CONTROLLERS is empty in version 2.
    for (std::string line; std::getline(in, line);) {
        const std::size_t first = line.find(':');
        const std::size_t second = line.find(':', first + 1);
        if (first == std::string::npos || second == std::string::npos) continue;
        const std::string controllers = line.substr(first + 1, second - first - 1);
        const fs::path group = line.substr(second + 1);
        if (controllers.empty())
            min_limit = std::min(min_limit, min_limit_of_ancestors(mounts, group, "memory.max"));
        if (has_memory_controller(controllers))
            min_limit = std::min(min_limit,
                                 min_limit_of_ancestors(mounts / "memory", group, "memory.limit_in_bytes"));
    }
    return min_limit;
}

std::uint64_t machine_memory() {
    const std::uint64_t bytes = static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) *
                                static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
    return std::min(bytes, cgroup_memory_limit("/proc/self/cgroup", "/sys/fs/cgroup"));
}

}  // namespace faqem::cli
