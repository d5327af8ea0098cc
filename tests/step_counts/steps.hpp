#pragma once
/// \file
/// What a test has done so far, counted by the compiler: no time, and the same each time.

#include <cstdint>

namespace faqem::test {

/// Basic blocks that this thread has run, of all that is compiled into this executable.
std::uint64_t steps();

}  // namespace faqem::test
