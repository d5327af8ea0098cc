#pragma once
/// \file
/// The report as JSON. A header of its own because the header-only mode needs nlohmann-json for it.

#include <string>

#include "faqem/export.hpp"
#include "faqem/report.hpp"

FAQEM_NAMESPACE_BEGIN

/// The report as JSON, with the keys documented in docs/cli.md and the process's peak memory.
FAQEM_EXPORT std::string to_json(const Report& report);

FAQEM_NAMESPACE_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/simplify/report_json-inl.hpp"
#endif
