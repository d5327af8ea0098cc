#pragma once
/// \file
/// Distribution of the face budget of an asset over its parts.

#include <cstdint>
#include <span>
#include <vector>

#include "faqem/asset.hpp"
#include "faqem/bake.hpp"

namespace faqem::detail {

/// Minimum face count that keeps all components of a part: 4 faces for each component, or all it has. O(faces)
std::uint64_t min_faces_for_components(const Part& part);

/// Distributes `target_faces` over the parts in proportion to their face counts (largest remainder method).
/// A part gets at least 4 faces (or all it has) for each of its connected components, at the expense of the
/// other parts. If `target_faces` is too small for that, the minimum is 4 faces per part (or all it has).
/// \return face count by part; the sum exceeds `target_faces` only if the sum of 4 faces per part does
/// Complexity: O(faces).
std::vector<std::uint64_t> budget_by_faces(const Asset& asset, std::uint64_t target_faces);

/// The number of faces below which budget_by_cost() reduces only flat parts: a share of the faces that a part would
/// have in proportion to the face counts.
inline constexpr double min_share = 0.65;

/// The faces that each part would have in proportion to the face counts, times the share of its vertices that are not
/// hidden.
/// \param visibility  VertexVisibility::weights, or empty
/// Complexity: O(vertices)
std::vector<double> proportional_shares(const Asset& asset, std::uint64_t target_faces,
                                        std::span<const std::vector<float>> visibility);

/// Warns of the parts that have less than a tenth of their proportional share, and names up to five of them.
/// \param shares      of proportional_shares()
/// \param simplified  the warning is added to its report
/// Complexity: O(parts)
void warn_of_small_shares(const Asset& source, std::span<const double> shares, SimplifiedParts& simplified);

/// Weights by part that convert costs (squared distance times area) from a part's units to those of the
/// scene: the fourth power of an instance's scale, summed over the instances of the part. 1 for parts that
/// have no size in the scene, or none that is finite.
/// \param parts      number of parts
/// \param instances  all instances of the scene, as seen_instances() lists them
std::vector<double> cost_weights(std::size_t parts, std::span<const Instance> instances);

}  // namespace faqem::detail
