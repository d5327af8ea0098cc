#pragma once
/// \file
/// Segmentation of a surface into regions of similar normals, from which charts are made.

#include <span>
#include <vector>

#include "bake/atlas/chart.hpp"
#include "faqem/engine/util/run_context.hpp"

namespace faqem::detail {

/// Hierarchical clustering of faces into regions that are connected over PageTriangle::adjacent.
/// Neighbouring regions are merged in ascending order of a cost: the increase of the spread of the normals
/// (face areas times squared distances from the mean normal; Ward's method, as in the face clusters of
/// Garland et al. 2001) plus a multiple of the union's squared perimeter. Two regions are not merged if the
/// mean normal of the union would be shorter than 0.88 or its densities would differ by more than a factor
/// of 2.
/// \return the faces of every region, ascending; regions sorted by smallest face
/// Complexity: O(n log n) expected.
/// \param context  checked for each merge of two regions; exceptions pass through
std::vector<std::vector<Index>> cluster_faces(std::span<const PageTriangle> faces,
                                              const engine::RunContext& context = {});

/// Connected components of `faces`.
/// \param all    all faces of the page
/// \param faces  indices into `all`, ascending
/// \return the faces of every component, ascending; components sorted by smallest face
std::vector<std::vector<Index>> connected_subsets(std::span<const PageTriangle> all,
                                                  std::span<const Index> faces);

/// Splits connected faces into two connected sets of about the same size, which are grown breadth-first from
/// two faces far apart.
/// \param all    all faces of the page
/// \param faces  indices into `all`, connected, at least two, ascending
std::array<std::vector<Index>, 2> bisect(std::span<const PageTriangle> all, std::span<const Index> faces);

}  // namespace faqem::detail
