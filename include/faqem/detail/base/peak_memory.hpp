#pragma once
/// \file
/// The peak memory of the process, which each system tells in another way. Other files include <windows.h> by this
/// header, which removes its macros.

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

FAQEM_DETAIL_BEGIN

/// Maximum resident memory of the process, bytes; 0 if the system does not tell it.
inline std::uint64_t peak_memory_bytes() {
#ifdef _WIN32
    PROCESS_MEMORY_COUNTERS counters{};
    K32GetProcessMemoryInfo(GetCurrentProcess(), &counters, sizeof counters);
    return counters.PeakWorkingSetSize;
#else
    // Linux counts in units of 1024 bytes.
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
#endif
}

FAQEM_DETAIL_END
