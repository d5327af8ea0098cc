#pragma once
/// \file
/// Corners of faces that differ by the rounding of a file, such as those of an STL file after a conversion.

#include <cstdint>
#include <string>
#include <vector>

#include "faqem/asset.hpp"
#include "faqem/export.hpp"
#include "faqem/mesh.hpp"

namespace faqem::detail {

/// What find_rounding_weld() found.
struct RoundingWeld {
    /// By vertex: the vertex whose position it gets, itself for most. Empty if no position changes.
    std::vector<Index> representative;
    std::uint64_t welded = 0;  ///< number of different positions that become equal to another one
    /// Number of boundary edges that have a partner nearby, but are not welded.
    std::uint64_t near_edges = 0;
    std::vector<std::string> messages;  ///< what was found, in sentences for a report

    /// Moves the vertices that are welded. Positions that are equal to the new ones keep the sign of their zeros.
    /// \param positions  those that were passed to find_rounding_weld()
    void apply(std::vector<Vec3>& positions) const {
        for (std::size_t v = 0; v < representative.size(); ++v)
            if (positions[v] != positions[representative[v]]) positions[v] = positions[representative[v]];
    }
};

/// Finds vertices on the boundary whose positions differ by rounding. An edge is a boundary edge if all its faces have
/// the same third vertex, after welding of equal positions: a face and its back side do not close each other.
///
/// Two vertices are welded if no coordinate differs by more than the smaller one of their tolerances:
/// * CoordinateRounding::tolerance() of the largest coordinate of the vertex or, if this is larger, of the largest one
///   of the mesh, but for the latter at most 1/64 of the length of the edges at the vertex;
/// * at most 1/4 of that length: the second longest edge of a face, and the shortest of these around the vertex.
///
/// In the order of their indices, vertices are welded to the nearest of the vertices that stay, the first one if
/// several are nearest; never two corners of one face. An edge has a partner if another edge has both its ends within
/// ten times these tolerances, or within the rounding of floats relative to the size of the mesh, and within 1/4 of the
/// length.
///
/// \param positions  finite
/// \param triangles  indices in range
/// \param stored     Asset::precision
/// Complexity: O(n) expected
FAQEM_EXPORT RoundingWeld find_rounding_weld(const std::vector<Vec3>& positions,
                                             const std::vector<Triangle>& triangles,
                                             const StoredPrecision& stored = {});

/// Moves the vertices of all parts to those that find_rounding_weld() finds.
/// \param asset  its parts must have valid indices and finite positions
/// \return RoundingWeld::messages of all parts, each with the name of the part
/// Complexity: O(n) expected
FAQEM_EXPORT std::vector<std::string> weld_rounded_positions(Asset& asset);

}  // namespace faqem::detail
