#pragma once
/// \file
/// Coincident faces of different appearance.

#include <vector>

#include "faqem/asset.hpp"

namespace faqem::detail {

/// Moves coincident faces of different appearance to different groups.
/// The engine keeps only one of the faces of a group that have the same corners and winding. Such faces can
/// look different, since the materials of a group share a page and vertex normals can contradict the winding.
/// An example are touching faces of two boxes, one of which has the wrong winding.
/// \param part    the faces
/// \param groups  group of every face, or empty if there is only one group
/// \return `groups`, in which a face with the corners (by position) and winding of an earlier face of its
///         group, but with another material or the opposite orientation of its normals, has a new group.
///         Faces of a new group agree in material and orientation.
/// Complexity: O(n log n).
std::vector<Index> separate_coincident_faces(const Part& part, std::vector<Index> groups);

}  // namespace faqem::detail
