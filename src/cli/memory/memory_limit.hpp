#pragma once
/// \file
/// The memory that is available to this process, and its limits: for the estimates of result/memory_estimate.hpp and, as the last safeguard, for the writable memory of
/// the process. Only the command has them: a library must not change the limits of its host.

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

/// Checks an estimate against the limit.
/// \param file             file name for the message
/// \param needed, allowed  bytes
/// \throws CommandError  exit_no_memory: `needed` exceeds `allowed`; the message has the file name and both numbers
void require_memory(const std::filesystem::path& file, std::uint64_t needed, std::uint64_t allowed);

/// Peak resident memory of the process so far, bytes. Memory that was returned to the heap is assumed to be reused.
std::uint64_t process_memory();

/// Smallest limit of the process, bytes. Lower values of --max-memory are compared with estimates only: the
/// process with its image libraries already needs a good part of this.
inline constexpr std::uint64_t min_process_memory = 500'000'000;

/// Not on Windows. Limits the writable private memory of the process (RLIMIT_DATA), so that an allocation above the limit
/// fails with std::bad_alloc. A sixteenth is left for program code, which is not writable. Memory that is
/// mapped but not in use, and the stacks of threads, are added to the limit, because they need no physical
/// memory. A lower limit that the process had before the first call is kept. If memory is exhausted where no exception
/// can be thrown, the process ends with exit_no_memory.
/// \param bytes    memory that the process may use; less than min_process_memory counts as that
/// \param threads  number of threads that will be started
void limit_process_memory(std::uint64_t bytes, std::uint64_t threads);

/// Makes the allocator return large blocks to the system when they are freed. Otherwise those that the threads
/// of one model have freed stay reserved for these threads, count against limit_process_memory(), and are
/// missing for later models. Costs about 3% of the time of a model, for new pages.
void return_freed_memory();

/// Begins to measure process_memory() anew, if the system can do this.
void reset_peak_memory();

}  // namespace faqem::cli
