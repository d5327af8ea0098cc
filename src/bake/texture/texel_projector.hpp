#pragma once
/// \file
/// From the texels of a triangle to points of the simplified mesh.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "bake/texture/bake_job.hpp"
#include "bake/texture/page_atlas.hpp"
#include "bake/texture/warm_start_cache.hpp"
#include "bake/transfer/source_normals.hpp"
#include "faqem/engine/mesh/vector.hpp"

namespace faqem::detail {

/// A point on a face of the simplified mesh.
struct TexelSample {
    Index face = 0;
    Vec3 weights = {};
    std::size_t cache_index = 0;  ///< of the painter
    double x = 0, y = 0;          ///< on the page
};

/// What painters find their triangles in.
struct ProjectorInput {
    const Atlas& atlas;
    std::span<const std::array<AdjacentTriangle, 3>> adjacent;  ///< by triangle of the atlas
    std::span<const PageFace> faces;                            ///< by triangle of the atlas
    /// By part and corner, as they are written; empty parts where no normals are painted.
    std::span<const std::vector<Vec4f>> tangents;
};

/// A triangle of the atlas, its neighbours, and where its last samples were.
class TexelProjector {
public:
    /// \param triangle  of the atlas
    /// \param samples   per texel and axis
    /// \pre all that is referred to outlives this
    TexelProjector(const BakeJob& job, const ProjectorInput& page, Index triangle, std::uint32_t samples);

    /// The point for place (s, t) of texel (x, y): on the triangle, or across an edge on its neighbour, unfolded
    /// into the triangle's plane.
    TexelSample point(std::uint32_t x, std::uint32_t y, double s, double t) const;

    /// The original's point there. The trail is followed and prolonged.
    SurfacePoint project_to_source(const TexelSample& at, std::uint32_t x, std::uint32_t y);

    /// Which way the simplified face at a point looks.
    engine::Vector3 face_normal(const TexelSample& at) const {
        return oriented_face_normal(part_, normals_, at.face);
    }

    /// A normal of the original in the simplified mesh's tangent space. One that lies across an edge is turned with
    /// its face into this triangle's plane: at a crease it would lean over by the whole fold.
    engine::Vector3 to_tangent_space(const TexelSample& at, const engine::Vector3& normal) const;

    /// Weight of the right corner at a place of the page: tells which of a pair's triangles is nearer.
    double right_angle_weight(double x, double y) const { return frame_.at(x, y)[right_angle_corner_]; }

    Index part() const { return face_.part; }
    /// Distance between samples on the simplified surface.
    double spacing() const { return spacing_; }

private:
    // How weights of this face become weights of the neighbour across an edge, unfolded into one plane.
    struct UnfoldedNeighbour {
        Index face = no_index;
        std::size_t corner = 0;           // of the neighbour, opposite the edge
        double height_ratio = 0;          // this face's over the neighbour's, above the edge
        double foot = 0, other_foot = 0;  // of the corners opposite, along the edge, 0 to 1
    };

    bool is_single_texel() const { return placement_.uv[0] == placement_.uv[1]; }
    engine::Vector3 corner(Index face, std::size_t i) const;
    double texel_length() const;
    UnfoldedNeighbour unfold(std::size_t c, Index neighbour, std::size_t other) const;
    Vec3 own_weights(const TexelSample& at) const;

    const PageFace face_;
    const TrianglePlacement& placement_;
    const BarycentricFrame frame_;
    const std::size_t right_angle_corner_;
    const BakePart& part_;
    const CornerNormals& normals_;
    const TriangleMesh& mesh_;
    const double spacing_;
    std::array<UnfoldedNeighbour, 3> unfolded_;  // by corner opposite
    std::array<FrameCorner, 3> frames_;          // for normals
    std::array<WarmStartCache, 4> warm_starts_;  // the triangle's own, then those across
};

}  // namespace faqem::detail
