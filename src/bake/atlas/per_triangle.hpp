#pragma once
/// \file
/// Per-triangle atlas of the paper: every triangle is flattened by itself (FA-QEM, Sec. 3.2.3).

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "bake/atlas/point2.hpp"
#include "faqem/engine/util/run_context.hpp"
#include "faqem/mesh.hpp"

namespace faqem::detail {

/// Largest size in texels of the blocks to which triangles and charts are aligned on a page. Mip levels coarser
/// than such a block mix texels of neighbours.
inline constexpr std::uint32_t max_block_size = 16;

/// Input triangle of the per-triangle atlas. It becomes a right triangle on the page.
struct AtlasTriangle {
    /// The corner that gets the right angle: opposite the edge to the partner, else with the largest angle.
    std::uint8_t right_angle_corner = 0;
    /// Wanted lengths in texels of the edges from `right_angle_corner` to the next corner and to the one
    /// after it.
    std::array<double, 2> legs = {0, 0};
    /// Sort key. Triangles with close values look alike, and are placed close to each other.
    std::uint64_t order = 0;
    /// The triangle across the edge opposite `right_angle_corner`, with consistent winding; `no_index`: none.
    /// Symmetric: partners name each other. They share this edge on the page.
    Index partner = no_index;
};

/// A rectangle of texels that belongs to one or two triangles.
struct AtlasCell {
    std::uint32_t x = 0, y = 0, width = 0, height = 0;
    Index first = no_index, second = no_index;  ///< triangles; the second is rotated by 180 degrees
    /// The triangles are partners and share their hypotenuse. Otherwise there is a margin between them.
    bool has_shared_hypotenuse = false;
};

/// A page. Cells do not overlap. Every texel that a bilinear read inside a triangle touches is in the
/// triangle's cell and, unless the cell is shared by partners, on the triangle's side of the cell.
struct Atlas {
    std::uint32_t width = 0, height = 0;  ///< powers of two
    /// By triangle: its corners, in texels; the centre of texel (i, j) is at (i + 0.5, j + 0.5), and v points down. All
    /// are equal if the whole triangle is one texel.
    std::vector<Triangle2> placements;
    std::vector<AtlasCell> cells;  ///< in descending order of block size and height
    double scale = 1;              ///< lengths on the page divided by the wanted lengths
};

/// Packs triangles into rectangular cells, and the cells on shelves.
/// The width and the height of a cell are quantized to four size classes per octave. Partners share a cell;
/// other triangles are put into cells in pairs of equal shape. Takes the smallest page on which the wanted
/// lengths fit, and then the largest scale that fits on this page, at most sqrt(2). If the largest page is
/// too small, the scale is below 1.
/// Cells are aligned to a grid of 2^k texels and triangles begin 2^(k-1) texels inside their cell, so that
/// mip level k reads texels of the triangle's own cell only; k grows with the cell. Cells of one size are in the order of
/// AtlasTriangle::order, so that levels beyond k mix texels of cells that look alike.
/// \param triangles  all triangles of the page
/// \param max_size   largest width and height in texels, a power of two
/// \return nothing if there are more triangles than texels
/// Complexity: O(n log n).
/// \param context    checked for each attempt; exceptions pass through
std::optional<Atlas> pack_triangles(std::span<const AtlasTriangle> triangles, std::uint32_t max_size,
                                    const engine::RunContext& context = {});

/// Barycentric coordinates of a placed triangle as a function of texel coordinates.
class BarycentricFrame {
public:
    explicit BarycentricFrame(const Triangle2& triangle);

    /// Barycentric coordinates of (x, y); outside the triangle some are negative.
    Vec3 at(double x, double y) const;
    /// Barycentric coordinates of the point of the triangle that is closest to (x, y) on the page.
    Vec3 closest(double x, double y) const;

private:
    Triangle2 triangle_;
    /// Second and third coordinate as affine functions: factor of x, factor of y, constant.
    std::array<std::array<double, 3>, 2> gradient_ = {};
};

}  // namespace faqem::detail
