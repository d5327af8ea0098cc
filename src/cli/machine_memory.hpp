#pragma once
/// \file
/// How much memory there is for this process.

#include <cstdint>
#include <filesystem>

namespace faqem::cli {

/// Memory of the machine, or the least limit of the control groups the process is in if that is less, bytes.
std::uint64_t machine_memory();

/// The least memory limit of the control groups (version 1 or 2) that a process is in, bytes; the largest
/// number where there is none. A group is looked for under its path and all folders above it: inside a
/// container the mounted tree begins at the container's own group, and the path may tell of groups outside.
/// \param membership  as /proc/self/cgroup
/// \param mounts  as /sys/fs/cgroup
std::uint64_t cgroup_memory_limit(const std::filesystem::path& membership,
                                  const std::filesystem::path& mounts);

}  // namespace faqem::cli
