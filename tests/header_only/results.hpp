#pragma once
/// \file
/// Functions that are compiled in both build modes.

/// Writes the results of every public function of the geometry half to a file. Returns whether it could be written.
bool write_results(const char* file);

#ifdef FAQEM_HEADER_ONLY
#define SIMPLIFY_SQUARE simplify_square_header_only
#else
#define SIMPLIFY_SQUARE simplify_square_compiled
#endif

/// The number of faces of a simplified square. Two shared libraries export it, one of each build mode, which are loaded
/// into one process.
extern "C" [[gnu::visibility("default")]] unsigned long SIMPLIFY_SQUARE(double ratio);
