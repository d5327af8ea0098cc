#pragma once
/// \file
/// Maps samples of texels to points of the simplified mesh and of the source.

#include <array>
#include <cstdint>
#include <vector>

#include "bake/atlas/chart.hpp"
#include "bake/atlas/per_triangle.hpp"
#include "bake/atlas/point2.hpp"
#include "bake/page/page_request.hpp"
#include "bake/parts/corner_normals.hpp"
#include "bake/source/source_normals.hpp"
#include "faqem/detail/base/vector.hpp"
#include "faqem/detail/mapping/local_map.hpp"
#include "faqem/surface_map.hpp"

namespace faqem::detail {

/// A sample of a texel as a point on a face of the simplified mesh.
struct TexelSample {
    Index face = 0;
    Vec3 weights = {};             ///< barycentric coordinates
    bool on_own_triangle = false;  ///< on the projector's triangle on the page, not in the gutter
    std::size_t cache_index = 0;   ///< 0 on the projector's triangle, c + 1 across its edge opposite corner c
    double x = 0, y = 0;           ///< position on the page, in texels
    Point2 on_triangle;  ///< (x, y) or, with cache_index 0, the closest point of the triangle on the page
};

/// Remembers the last sample on a face and the first sample of its row of texels. The search for a sample
/// close to one of them can start there. Samples must be added row by row from the top, each row from the
/// left.
class WarmStartCache {
public:
    /// Starting point for a sample in texel (x, y), or null if no remembered sample is close. Valid until
    /// add().
    const SurfacePoint* start_near(std::uint32_t x, std::uint32_t y) const {
        if (!started_) return nullptr;
        if (last_.y == y && x - last_.x <= 1) return &last_.point;
        return row_start_.is_near(x, y) ? &row_start_.point : nullptr;
    }

    /// Adds the result of a sample in texel (x, y).
    void add(const SurfacePoint& point, std::uint32_t x, std::uint32_t y) {
        last_ = {point, x, y};
        if (!started_ || row_start_.y != y) row_start_ = last_;
        started_ = true;
    }

private:
    struct CachedSample {
        SurfacePoint point;
        std::uint32_t x = 0, y = 0;

        bool is_near(std::uint32_t sample_x, std::uint32_t sample_y) const {
            constexpr std::uint32_t steps = 4;  // largest offset in texels between the starts of two rows
            // Unsigned differences wrap around: above, or too far to the left, they are large.
            return sample_y - y <= 1 && sample_x + steps - x <= 2 * steps;
        }
    };

    CachedSample last_, row_start_;
    bool started_ = false;
};

/// Projects samples of one triangle of the atlas to the source. Not thread-safe, since it keeps warm starts and the
/// source's faces near the last samples.
class TexelProjector {
public:
    /// \param page      must outlive this
    /// \param triangle  index into the mesh of the page
    TexelProjector(const PageRequest& page, Index triangle);

    /// The sample at position (s, t), from 0 to 1, in texel (x, y): on the triangle, or across an edge (the
    /// gutter) on its neighbour, unfolded into the triangle's plane.
    TexelSample point(std::uint32_t x, std::uint32_t y, double s, double t) const;

    /// PointMap::find() for a sample in texel (x, y). Samples must be passed row by row from
    /// the top, each row from the left.
    SurfacePoint project_to_source(const TexelSample& at, std::uint32_t x, std::uint32_t y);

    /// Normal of the simplified face at a sample, see oriented_face_normal().
    Vector3 face_normal(const TexelSample& at) const { return oriented_face_normal(part_, at.face); }

    /// Transforms a normal of the source to the tangent space of the simplified mesh. For a sample on a
    /// neighbour the normal is rotated with the neighbour into this triangle's plane; otherwise it would be
    /// off by the dihedral angle.
    Vector3 to_tangent_space(const TexelSample& at, const Vector3& normal) const;

    /// Barycentric coordinate of the right-angle corner at a point of the page. The partner with the larger
    /// value is closer to the point.
    double right_angle_weight(double x, double y) const { return frame_.at(x, y)[right_angle_corner_]; }

    /// Index of the part that the triangle belongs to.
    Index part() const { return face_.part; }
    /// Distance between samples on the simplified surface, in the part's units.
    double spacing() const { return spacing_; }

private:
    // Conversion of barycentric coordinates of this face to those of the neighbour across an edge, which is
    // unfolded into this face's plane.
    struct UnfoldedNeighbour {
        Index face = no_index;            // of the simplified mesh
        std::size_t corner = 0;           // corner of the neighbour opposite the edge
        double height_ratio = 0;          // height above the edge: of this face divided by the neighbour's
        double foot = 0, other_foot = 0;  // projections of the opposite corners to the edge, 0 to 1 along it
    };

    // The samples of one face in a square block of texels.
    struct Block {
        std::int32_t column = 0, row = 0;
        std::uint32_t samples = 0;  // number of samples so far
        LocalMap map;               // prepared when there are enough samples

        // Makes this the block at another place.
        void move_to(std::int32_t to_column, std::int32_t to_row) {
            if (column == to_column && row == to_row) return;
            column = to_column, row = to_row, samples = 0;
        }
    };
    // A ball around the samples of a block.
    struct Ball {
        Vec3 centre = {};   // barycentric coordinates
        double radius = 0;  // in the part's units
    };

    // Squares of one size. Of each column of blocks the last ones in an even and an odd row are kept.
    class BlockGrid {
    public:
        BlockGrid() = default;
        // \param size  texels along each axis of a block
        // \param box   of the triangle on the page, in texels; it begins with the first column
        BlockGrid(std::uint32_t size, const Box2& box);

        // The block around a point of the page.
        Block& at(const Point2& p);
        // Bounding box of a block, in texels.
        Box2 box_of(const Block& block) const;
        // Whether the triangle is in a single block.
        bool is_single() const { return columns_ == 1 && rows_ == 1; }

    private:
        double size_ = 1, blocks_per_texel_ = 1;
        Point2 origin_;                        // of column and row 0
        std::int32_t columns_ = 1, rows_ = 1;  // of the triangle
        std::vector<Block> blocks_;
    };

    // The map of the last sample.
    struct LastMap {
        LocalMap* map = nullptr;      // of a block; null: the whole map
        std::size_t cache_index = 0;  // of the sample
    };

    bool is_single_texel() const { return placement_[0] == placement_[1]; }
    double texel_length() const;
    Vec3 weights_beyond(std::size_t c, const Vec3& w) const;
    SurfacePoint map_near(const TexelSample& at, const SurfacePoint& near);
    LocalMap* large_map(const TexelSample& at, const SurfacePoint& near);
    Ball ball_around(const Box2& box, const TexelSample& at) const;
    void prepare(LocalMap& map, const Box2& box, const TexelSample& at, const SurfacePoint& near,
                 const LocalMap* larger) const;
    UnfoldedNeighbour unfold(std::size_t c, const PageMesh& mesh) const;
    Vec3 own_weights(const TexelSample& at) const;

    const PageFace face_;
    const Triangle2& placement_;
    const BarycentricFrame frame_;
    const std::size_t right_angle_corner_;
    const BakePart& part_;
    const SurfaceMap* const history_;  // null if the map of the part is another one
    const PageTriangle& triangle_;
    const double texel_length_;
    const double spacing_;
    std::array<UnfoldedNeighbour, 3> unfolded_;  // by corner opposite the edge
    std::array<FrameCorner, 3> frames_;          // set if the page has a normal map
    std::array<WarmStartCache, 4> warm_starts_;  // by TexelSample::cache_index
    std::array<BlockGrid, 4> blocks_;            // by TexelSample::cache_index
    LastMap last_;
    BlockGrid large_blocks_;  // of samples on the triangle
};

}  // namespace faqem::detail
