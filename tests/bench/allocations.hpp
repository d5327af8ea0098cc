#pragma once
/// \file
/// Measures memory allocated with operator new, by malloc_usable_size(). A program that links this file
/// measures its own code and that of its libraries. Direct calls of malloc() are not counted.

#include <cstdint>

namespace faqem::bench {

/// Measures the peak of allocated memory from construction on, relative to the amount at construction. Only
/// one object may exist at a time.
class PeakMemory {
public:
    PeakMemory();
    ~PeakMemory();
    PeakMemory(const PeakMemory&) = delete;
    PeakMemory& operator=(const PeakMemory&) = delete;

    /// Returns the peak so far, bytes.
    std::uint64_t bytes() const;
};

}  // namespace faqem::bench
