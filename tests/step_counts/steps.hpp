#pragma once
/// \file
/// The work done by a test, measured in basic blocks. Unlike a duration this is reproducible.

#include <cstdint>

namespace faqem::test {

/// Number of basic blocks that this thread has executed in the instrumented files of this program.
std::uint64_t steps();

}  // namespace faqem::test
