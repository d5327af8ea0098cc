#pragma once
/// \file
/// The version, and the only place that has the number: CMake reads it here.

#include <string_view>

#include "faqem/export.hpp"

FAQEM_NAMESPACE_BEGIN

/// The version of these headers, as https://semver.org counts. What each number promises is in CHANGELOG.md.
inline constexpr int version_major = 0;
inline constexpr int version_minor = 1;
inline constexpr int version_patch = 0;

/// "MAJOR.MINOR.PATCH" of the library that runs: with a shared one it may be newer than the headers.
FAQEM_EXPORT std::string_view version();

FAQEM_NAMESPACE_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/base/version-inl.hpp"
#endif
