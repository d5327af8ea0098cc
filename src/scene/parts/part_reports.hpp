#pragma once
/// \file
/// The report of a scene as the sum over its parts, and the visible components that were removed or have shrunk.

#include <span>
#include <string>

#include "faqem/bake.hpp"

namespace faqem::detail {

/// Adds the counts of a report, other than the hidden vertices.
void add_counts(Report& sum, const Report& part);

/// Adds the report of a part.
/// \param title  of the part, for its warnings
void add_part_report(Report& sum, const Report& part, const std::string& title);

/// The report of a simplification of which some parts are those with UVs. The target and the times are not changed:
/// they are those of the whole.
/// \param which  indices into SimplifiedParts::with_uvs
Report report_with_uvs(const Asset& source, const SimplifiedParts& simplified, std::span<const Index> which);

/// Adds the components of all parts that were removed or have shrunk, and were visible in the scene, to its report,
/// with warnings. The shares refer to all instances of the scene.
/// \param source  the input of the simplification
/// \param result  of simplify_parts_to_targets()
/// Complexity: that of may_lack_components(); if so, O(vertices log vertices + faces of all instances) of the source
void report_removed_components(const Asset& source, SimplifiedParts& result);

}  // namespace faqem::detail
