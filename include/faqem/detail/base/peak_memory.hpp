#pragma once
/// \file
/// The peak memory of the process, which each system tells in another way.

#include <cstdint>

#include "faqem/export.hpp"

#ifdef _WIN32
#ifndef NOMINMAX
#define NOMINMAX
#endif
#include <windows.h>

#include <psapi.h>
// Macros of nothing in <windows.h>; faqem has variables of these names.
#undef near
#undef far
#else
#include <sys/resource.h>
#endif

FAQEM_NAMESPACE_BEGIN
namespace detail {

/// Maximum resident memory of the process, bytes; 0 if the system does not tell it.
inline std::uint64_t peak_memory_bytes() {
#ifdef _WIN32
    PROCESS_MEMORY_COUNTERS counters{};
    K32GetProcessMemoryInfo(GetCurrentProcess(), &counters, sizeof counters);
    return counters.PeakWorkingSetSize;
#else
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
#endif
}

}  // namespace detail
FAQEM_NAMESPACE_END
