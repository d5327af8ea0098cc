#pragma once
/// \file
/// From attributes on corners to vertices as files want them.

#include <memory>
#include <span>
#include <vector>

#include "faqem/asset.hpp"
#include "faqem/engine/util/cancellation.hpp"
#include "faqem/simplify.hpp"
#include "faqem/surface_map.hpp"

namespace faqem::detail {

/// A part of the source with its simplified mesh.
struct BakePart {
    Index index = 0;  ///< into Asset::parts
    const Part* source = nullptr;
    const SimplifyResult* simplified = nullptr;
    std::unique_ptr<const SurfaceMap>
        map;  ///< null where the simplified mesh has no faces, or nothing is asked

    std::size_t faces() const { return simplified->mesh.triangles.size(); }
};

/// Operations of a poll that finding a place through BakePart::map counts as.
inline constexpr std::uint64_t map_query_cost = 32;

/// Corners of the simplified mesh by vertex.
struct VertexCorners {
    std::vector<std::uint64_t> begin;    ///< vertices + 1
    std::vector<std::uint64_t> corners;  ///< 3 * face + corner, ascending at each vertex

    std::span<const std::uint64_t> at(std::size_t vertex) const {
        return std::span(corners).subspan(begin[vertex], begin[vertex + 1] - begin[vertex]);
    }
};

/// O(faces + vertices)
VertexCorners vertex_corners(const TriangleMesh& mesh, engine::CancellationCheck check_cancelled = {});

/// Barycentrics of a point at a corner, moved by `inset` of the way to the middle of the opposite edge.
Vec3 barycentrics_near_corner(std::size_t corner, double inset);

/// One entry per corner of the simplified mesh in each; empty ones are not written.
struct CornerLayers {
    std::vector<Vec3f> normals;
    std::vector<std::vector<Vec2f>> uvs;
    std::vector<Vec4f> colors;
    std::vector<Vec4f> tangents = {};
};

/// The output part, and for each of its vertices a corner of the simplified mesh that it stands for.
struct WeldedPart {
    Part part;
    std::vector<std::uint64_t> corner;
};

/// Joins the corners of a simplified vertex that agree in every layer. Output vertices come in the order of their
/// first use. Name and source are those of the source part. O(corners log valence)
/// \throws what the poll throws
WeldedPart weld_corners(const BakePart& part, const CornerLayers& layers,
                        engine::CancellationCheck check_cancelled = {});

}  // namespace faqem::detail
