#pragma once
/// \file
/// Counts what operator new hands out, as malloc_usable_size() has it. A program that links this counts all
/// of its own and of the libraries' code; what calls malloc() itself is not counted.

#include <cstdint>

namespace faqem::bench {

/// The largest amount of memory held at once since this was made, above what was held then.
class PeakMemory {
public:
    PeakMemory();
    ~PeakMemory();
    PeakMemory(const PeakMemory&) = delete;
    PeakMemory& operator=(const PeakMemory&) = delete;

    std::uint64_t bytes() const;
};

}  // namespace faqem::bench
