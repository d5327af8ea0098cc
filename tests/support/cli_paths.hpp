#pragma once
/// \file
/// Paths for the tests of the command. Their definitions are in a generated file (tests/CMakeLists.txt), so that no other
/// file of the tests depends on a path.

namespace tool_test {

/// The faqem command.
extern const char* const tool_path;
/// The source folder.
extern const char* const source_path;
/// The library that the tests in faults load into the command.
extern const char* const injector_path;

}  // namespace tool_test
