#pragma once
/// \file
/// Normals of OBJ files from smoothing groups.

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "asset/scene/corner_vertices.hpp"
#include "faqem/mesh.hpp"

namespace faqem::detail {

/// Smoothing group of a face before the first `s`: nothing is said about its normals.
inline constexpr std::int64_t unknown_smoothing = -1;

/// Returns the smoothing group that a statement `s` names: 0, of faceted faces, for a word without a number, such as
/// `off`, except `on`, which is group 1.
/// \param word  what follows the `s`; may be empty
std::int64_t smoothing_group(std::string_view word);

/// Gives the corners without a normal in faces with a smoothing group a new one. In group 0 it is that of the face, in
/// others the mean over the faces of the group at the position, weighted by their angles there. Corners of faces
/// without an area, or beyond the range of doubles, stay without a normal.
/// \param positions  by index
/// \param sizes      number of corners of each face
/// \param groups     smoothing group of each face
/// \param corners    of all faces; their last index is that of the normal
/// \param normals    receives the new ones, each once
/// Complexity: O(corners).
void add_smoothed_normals(std::span<const Vec3> positions, std::span<const std::uint32_t> sizes,
                          std::span<const std::int64_t> groups, std::span<CornerKey> corners,
                          std::vector<Vec3f>& normals);

}  // namespace faqem::detail
