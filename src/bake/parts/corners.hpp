#pragma once
/// \file
/// Welds the corners of a simplified mesh with equal attributes to vertices of an output part.

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "bake/parts/point_map.hpp"
#include "faqem/asset.hpp"
#include "faqem/detail/base/buckets.hpp"
#include "faqem/simplify.hpp"

namespace faqem::detail {

/// Normals of a simplified mesh, and their clusters.
struct CornerNormals {
    std::vector<Vec3f> normals;   ///< by corner: unit length, within 90 degrees of the face normal
    std::vector<Index> clusters;  ///< by corner: corners of a vertex that share a normal have the same number
    /// By face: 1 if the winding of the source face contradicts its vertex normals, while it agrees with them
    /// on most of the part's area. Such a face is shaded by its vertex normals, as in the source.
    std::vector<std::uint8_t> has_reversed_winding;
};

/// A part of the source with its simplified mesh.
struct BakePart {
    Index index = 0;  ///< index into Asset::parts
    const Part* source = nullptr;
    const SimplifyResult* simplified = nullptr;
    /// Null if the simplified mesh has no faces, if the part is kept, or if at most normals are transferred from the source.
    std::unique_ptr<const PointMap> map;
    CornerNormals normals = {};  ///< empty without faces, if it is kept, and if no normals are needed
    /// Whether the result has the normals; otherwise only a part with a normal map has them.
    bool writes_normals = true;
    /// By corner: the UVs of new textures, in [0, 1]; empty: they get new ones.
    std::vector<Vec2f> given_uvs = {};
    /// Whether baking leaves it empty in the result, because it is added later with its own vertices or UVs.
    bool is_kept = false;

    std::size_t faces() const { return simplified->mesh.triangles.size(); }
};

/// Number of operations that a query of BakePart::map counts as in cancellation checks.
inline constexpr std::uint64_t map_query_cost = 32;

/// Corners of the simplified mesh by vertex: 3 * face + corner, ascending for every vertex.
using VertexCorners = Buckets<std::uint64_t>;

/// Sorts the corners of a mesh by vertex. Complexity: O(faces + vertices).
VertexCorners vertex_corners(const TriangleMesh& mesh);

/// Joins each corner of a mesh with the first one of its vertex that is close to it. Calls join(from, to) for them.
/// \param most      number of corners of a vertex, not joined with others, that are compared with each: it bounds the work
/// \param is_close  is_close(from, to)
template <class IsClose, class Join>
void join_corners(const TriangleMesh& mesh, std::size_t most, const IsClose& is_close, const Join& join) {
    const VertexCorners at = vertex_corners(mesh);
    std::vector<std::uint64_t> distinct;
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        distinct.clear();
        for (const std::uint64_t corner : at[v]) {
            const auto same =
                std::ranges::find_if(distinct, [&](std::uint64_t other) { return is_close(other, corner); });
            if (same != distinct.end())
                join(*same, corner);
            else if (distinct.size() < most)
                distinct.push_back(corner);
        }
    }
}

/// Barycentric coordinates of a point near a corner, at the fraction `inset` of the way from the corner to
/// the midpoint of the opposite edge.
Vec3 barycentrics_near_corner(std::size_t corner, double inset);

/// Barycentric coordinates of four points of a triangle, each of which stands for a quarter of it.
inline constexpr std::array<Vec3, 4> quarter_points = {{{1.0 / 3, 1.0 / 3, 1.0 / 3},
                                                        {2.0 / 3, 1.0 / 6, 1.0 / 6},
                                                        {1.0 / 6, 2.0 / 3, 1.0 / 6},
                                                        {1.0 / 6, 1.0 / 6, 2.0 / 3}}};

/// Attributes of the simplified mesh: a part without positions, whose vertices are the corners. Empty ones are not
/// written.
using CornerValues = Part;

/// An output part.
struct WeldedPart {
    Part part;
    std::vector<std::uint64_t> corner;  ///< by vertex of `part`: its first corner in the simplified mesh
};

/// Makes one output vertex of all corners of a simplified vertex that agree in all values. Where several closed fans of
/// faces meet at a vertex, each gets its own, so that the surface is a manifold. Output vertices are in the order of their
/// first use. Part::name and Part::source are those of the source part.
/// Complexity: O(corners log valence).
WeldedPart weld_corners(const BakePart& part, const CornerValues& values);

}  // namespace faqem::detail
