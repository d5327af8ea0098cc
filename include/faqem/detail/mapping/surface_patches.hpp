#pragma once
/// \file
/// Surface patches of a triangle soup, and the faces whose orientation disagrees with their patch.

#include <cstdint>
#include <span>
#include <vector>

#include "faqem/detail/base/buckets.hpp"
#include "faqem/export.hpp"
#include "faqem/mesh.hpp"

FAQEM_DETAIL_BEGIN

/// Surface patches: sets of faces that are connected across edges. Two faces at an edge are connected if
/// * the edge has exactly two faces, or
/// * before welding they were the only two faces at the edge, so that a box remains one patch if it touches
///   another box along a whole side, or
/// * one continues the other (their angle differs from 180 degrees by at most 30) and no third face is within
///   60 degrees of that continuation, so that a surface is not divided where a fin is attached to it, and two
///   surfaces that cross remain two patches.
/// All other non-manifold edges separate patches, so that the two sides of a thin wall that meet in a fin are
/// different patches.
struct SurfacePatches {
    std::vector<Index> surface_patch;  ///< per face: number of its patch; no_index for removed faces
    /// Per face: -1 if its orientation is opposite to that of most of its patch (by area), else 1.
    std::vector<std::int8_t> sign;
    Buckets<Index> faces;  ///< by patch, in ascending order
};

/// Finds the surface patches of a triangle soup.
/// \param positions  one per vertex
/// \param triangles  faces with no_index as first corner belong to no patch
/// \param unwelded   empty, or the same faces with their vertex indices before welding
/// O(n log n) time, 48 bytes per face of temporary memory
SurfacePatches find_surface_patches(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                                    std::span<const Triangle> unwelded = {});

FAQEM_DETAIL_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/mapping/surface_patches-inl.hpp"
#endif
