#pragma once
/// \file
/// Faces of different materials at one place.

#include <vector>

#include "faqem/asset.hpp"

namespace faqem::detail {

/// Materials of one group share a page, and the engine drops all but one of the faces of a group that have
/// the same corners and winding. Two of different materials do not show the same: such are the sides of two
/// boxes that touch, where one is wound the wrong way.
/// \param groups  of the part's faces, or empty: one for all
/// \return `groups`; a face with the corners (by place) and winding of an earlier one of its group, but
///         another material, has a group that it shares with others of its material at most. O(n log n)
std::vector<Index> set_materials_apart(const Part& part, std::vector<Index> groups);

}  // namespace faqem::detail
