#pragma once
/// \file
/// The report of a scene as the sum over its parts.

#include <string>

#include "faqem/report.hpp"

namespace faqem::detail {

/// Adds the report of a part.
/// \param title  of the part, for its warnings
void add_part_report(Report& sum, const Report& part, const std::string& title);

/// Removes the report of a part that was added before, except for its time and its StopReason.
void remove_part_report(Report& sum, const Report& part, const std::string& title);

/// Replaces the report of a part by that of another simplification to the face count that it had. The target and the
/// times are not changed: they are those of the whole.
void replace_part_report(Report& sum, const Report& before, const Report& part, const std::string& title);

}  // namespace faqem::detail
