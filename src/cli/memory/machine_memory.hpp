#pragma once
/// \file
/// Amount of memory that is available to this process.

#include <cstdint>
#include <filesystem>

namespace faqem::cli {

/// Returns the physical memory of the machine or the limit of the process's control groups, whichever is
/// less, in bytes.
std::uint64_t machine_memory();

/// Returns the minimum memory limit, in bytes, of the control groups (version 1 or 2) of a process; the
/// largest std::uint64_t if there is no limit. Limits are read from the group's directory and all its
/// ancestors: inside a container the mounted tree begins at the container's own group, and the path may refer
/// to groups outside.
/// \param membership  path of a file in the format of /proc/self/cgroup
/// \param mounts      path of a directory with the layout of /sys/fs/cgroup
std::uint64_t cgroup_memory_limit(const std::filesystem::path& membership,
                                  const std::filesystem::path& mounts);

}  // namespace faqem::cli
