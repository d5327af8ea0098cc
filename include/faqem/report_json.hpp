#pragma once
/// \file
/// Reports as JSON. This is a separate header because it needs nlohmann-json in header-only mode.

#include <string>

#include "faqem/export.hpp"
#include "faqem/report.hpp"

FAQEM_NAMESPACE_BEGIN

/// Returns a report as JSON, with the keys documented in docs/reference.md, and the peak resident memory of the
/// process. Bytes of strings that are not valid UTF-8 are replaced by U+FFFD.
FAQEM_EXPORT std::string to_json(const Report& report);

FAQEM_NAMESPACE_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/simplify/report_json-inl.hpp"
#endif
