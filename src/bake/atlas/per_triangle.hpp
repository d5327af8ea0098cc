#pragma once
/// \file
/// The paper's atlas: every triangle on its own (FA-QEM, Sec. 3.2.3, per-triangle flattening).

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "faqem/engine/util/cancellation.hpp"
#include "faqem/mesh.hpp"

namespace faqem::detail {

/// What the atlas must know of a triangle. One of its angles becomes the right one.
struct AtlasTriangle {
    std::uint8_t right_angle_corner =
        0;  ///< the corner opposite the partner's edge, else the one with the largest angle
    /// Wanted lengths in texels of the edges from `right_angle_corner` to the next corner and to the one after.
    std::array<double, 2> legs = {0, 0};
    std::uint64_t order = 0;  ///< triangles with close numbers look alike and are close together
    /// The triangle across the edge opposite `right_angle_corner`, wound alike. Mutual. The two share that edge on the
    /// page.
    Index partner = no_index;
};

/// A triangle's place. Corner UVs are in texels; texel (i, j)'s centre is at (i + 0.5, j + 0.5), v down.
struct TrianglePlacement {
    std::array<std::array<double, 2>, 3> uv = {};
    std::array<std::uint32_t, 2> legs = {0, 0};  ///< as given lengths; 0, 0: all of it is one texel
};

/// A rectangle of texels that belongs to one triangle or to two.
struct AtlasCell {
    std::uint32_t x = 0, y = 0, width = 0, height = 0;
    Index first = no_index, second = no_index;  ///< triangles; second is first's turned by 180 degrees
    /// They are partners, and the hypotenuse of one is that of the other. Else there is a margin between
    /// them.
    bool has_shared_hypotenuse = false;
};

/// A page. Cells do not overlap, and every texel that a bilinear read inside a triangle touches is in its
/// cell and, but for partners, on its side of the cell.
struct Atlas {
    std::uint32_t width = 0, height = 0;        ///< powers of two
    std::vector<TrianglePlacement> placements;  ///< by triangle
    std::vector<AtlasCell> cells;               ///< by row
    double scale = 1;                           ///< of the wanted lengths
};

/// Packs rectangles of size classes, four to the octave and width and height apart, on shelves: partners
/// share one, the others go by twos. Takes the smallest page that holds the wanted lengths, and then the
/// largest scale that fits it, at most sqrt 2. Cells lie on a grid of 2^k texels and triangles begin 2^(k-1)
/// texels inside, so that mip level k reads texels of a pair's own cell only; k grows with the cell. Cells of
/// one size follow a Hilbert curve over the page, so that beyond level k they mix with cells that look alike.
/// \param max_size  largest width and height, a power of two
/// \return nothing if there are more triangles than texels
/// O(n log n)
/// \throws what the poll throws
std::optional<Atlas> pack_triangles(std::span<const AtlasTriangle> triangles, std::uint32_t max_size,
                                    engine::CancellationCheck check_cancelled = {});

/// Barycentrics of a triangle with a place, at texel coordinates.
class BarycentricFrame {
public:
    explicit BarycentricFrame(const TrianglePlacement& placement);

    /// Of (x, y); negative outside.
    Vec3 at(double x, double y) const;
    /// Of the point of the triangle that is closest to (x, y) on the page.
    Vec3 closest(double x, double y) const;

private:
    TrianglePlacement placement_;
    std::array<std::array<double, 3>, 2> gradient_ = {};  ///< of the second and third weight: x, y, constant
};

}  // namespace faqem::detail
