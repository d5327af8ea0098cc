#include "cli/memory/memory_limit.hpp"

#ifndef _WIN32
#include <malloc.h>
#include <pthread.h>
#include <sys/resource.h>
#include <unistd.h>
#endif

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <limits>
#include <new>
#include <string>
#include <string_view>

#include "asset/io/temporary_file.hpp"
#include "cli/process/exit_code.hpp"
#include "faqem/detail/base/peak_memory.hpp"

namespace faqem::cli {

namespace {

std::string megabytes(std::uint64_t bytes) { return std::to_string((bytes + 999'999) / 1'000'000) + " MB"; }

}  // namespace

void require_memory(const std::filesystem::path& file, std::uint64_t needed, std::uint64_t allowed) {
    if (needed <= allowed) return;
    throw CommandError(exit_no_memory, file.string() + ": may need " + megabytes(needed) +
                                           " of memory, but only " + megabytes(allowed) +
                                           " are allowed (--max-memory)");
}

#ifdef _WIN32
std::uint64_t machine_memory() {
    MEMORYSTATUSEX status = {};
    status.dwLength = sizeof status;
    GlobalMemoryStatusEx(&status);
    return status.ullTotalPhys;
}

std::uint64_t process_memory() { return detail::peak_memory_bytes(); }
#else
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

/// Returns a size from /proc/self/status, in bytes; 0 if it is missing.
std::uint64_t status_bytes(std::string_view key) {
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;) {
        std::uint64_t kilobytes = 0;
        if (word == key) return status >> kilobytes ? 1024 * kilobytes : 0;
        status.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
    }
    return 0;
}

constexpr std::uint64_t code_share = 16;  // a sixteenth of the limit is left for program code in memory
constexpr std::uint64_t min_stack_bytes = std::uint64_t{1} << 20;

/// Returns the address space for the stacks of new threads. If they would take more than a twentieth of the
/// limit, new threads get smaller stacks: address space for stacks is available for other data, too.
std::uint64_t stack_bytes(std::uint64_t limit, std::uint64_t threads) {
    pthread_attr_t attributes;
    std::size_t each = 0;
    if (pthread_getattr_default_np(&attributes) != 0) return 0;
    pthread_attr_getstacksize(&attributes, &each);
    const std::uint64_t wanted = std::max(limit / 20 / std::max<std::uint64_t>(threads, 1), min_stack_bytes);
    if (wanted < each) {
        each = static_cast<std::size_t>(wanted / min_stack_bytes * min_stack_bytes);
        pthread_attr_setstacksize(&attributes, each);
        pthread_setattr_default_np(&attributes);
    }
    pthread_attr_destroy(&attributes);
    return threads * each;
}

/// Ends the process like a caught std::bad_alloc if one is thrown in a noexcept function or in a thread of
/// another library.
[[noreturn]] void terminate_without_memory() {
    if (const std::exception_ptr error = std::current_exception()) {
        try {
            std::rethrow_exception(error);
        } catch (const std::bad_alloc&) {
            constexpr std::string_view text = "faqem: not enough memory\n";
            static_cast<void>(!::write(STDERR_FILENO, text.data(), text.size()));
            // Another thread may be replacing files. If this one is, the next run completes or restores them.
            for (int i = 0; i < 100 && !detail::remove_temporary_files(); ++i) ::usleep(10'000);
            _exit(exit_no_memory);
        } catch (...) {
        }
    }
    std::abort();
}

}  // namespace

std::uint64_t cgroup_memory_limit(const fs::path& membership, const fs::path& mounts) {
    std::uint64_t min_limit = unlimited;
    std::ifstream in(membership);
    // Each line is NUMBER:CONTROLLERS:PATH; CONTROLLERS is empty in version 2.
    std::string number, controllers, group;
    while (std::getline(in, number, ':') && std::getline(in, controllers, ':') && std::getline(in, group)) {
        if (controllers.empty())
            min_limit = std::min(min_limit, min_limit_of_ancestors(mounts, group, "memory.max"));
        if (("," + controllers + ",").find(",memory,") != std::string::npos)
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

std::uint64_t process_memory() { return status_bytes("VmHWM:"); }

void limit_process_memory(std::uint64_t bytes, std::uint64_t threads) {
    bytes = std::max(bytes, min_process_memory);
    rlimit limit{};
    if (getrlimit(RLIMIT_DATA, &limit) != 0) return;
    static const rlim_t before = limit.rlim_cur;
    const std::uint64_t mapped = status_bytes("VmData:"), used = status_bytes("RssAnon:");
    const std::uint64_t unused = mapped > used ? mapped - used : 0;
    const std::uint64_t headroom = unused + stack_bytes(bytes, threads);
    if (bytes > std::numeric_limits<rlim_t>::max() - headroom) return;
    limit.rlim_cur = std::min<rlim_t>(before, bytes - bytes / code_share + headroom);
    setrlimit(RLIMIT_DATA, &limit);
    std::set_terminate(terminate_without_memory);
}

void return_freed_memory() {
    constexpr int block_bytes = 1 << 20;
    // Without these calls, the allocator raises both sizes to 32 MB and more as blocks are freed.
    mallopt(M_MMAP_THRESHOLD, block_bytes);
    mallopt(M_TRIM_THRESHOLD, block_bytes);
}

void reset_peak_memory() { std::ofstream("/proc/self/clear_refs") << "5"; }
#endif

}  // namespace faqem::cli
