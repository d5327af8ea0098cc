#pragma once
/// \file
/// Faces at one place that do not look the same.

#include <vector>

#include "faqem/asset.hpp"

namespace faqem::detail {

/// The engine drops all but one of the faces of a group that have the same corners and winding. Materials of
/// one group share a page, and normals may turn a face round: then two such faces do not show the same. They
/// are the sides of two boxes that touch, or of a sheet, where one is wound the wrong way.
/// \param groups  of the part's faces, or empty: one for all
/// \return `groups`; a face with the corners (by place) and winding of an earlier one of its group, but
///         another material, or normals on the other side, has a group that it shares with others of its kind
///         at most.
/// O(n log n)
std::vector<Index> separate_coincident_faces(const Part& part, std::vector<Index> groups);

}  // namespace faqem::detail
