#pragma once
/// \file
/// The version number. CMake reads it from this file. The name of the inline namespace in export.hpp repeats
/// the major and minor number.

#include <string_view>

#include "faqem/export.hpp"

FAQEM_NAMESPACE_BEGIN

/// Version of these headers (https://semver.org); CHANGELOG.md states what each number promises.
inline constexpr int version_major = 0;
inline constexpr int version_minor = 1;
inline constexpr int version_patch = 0;

/// Returns "MAJOR.MINOR.PATCH" of the library in use. A shared library may be newer than the headers.
FAQEM_EXPORT std::string_view version();

FAQEM_NAMESPACE_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/base/version-inl.hpp"
#endif
