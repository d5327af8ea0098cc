#pragma once
/// \file
/// The faces of a page, flattened from the parts that they are in.

#include <cstdint>
#include <span>
#include <vector>

#include "bake/atlas/chart.hpp"
#include "bake/atlas/per_triangle.hpp"
#include "bake/parts/corners.hpp"
#include "bake/source/source_sampler.hpp"
#include "faqem/detail/base/parallel.hpp"

namespace faqem::detail {

/// Share of a page's texels that its charts usually cover.
inline constexpr double usual_page_fill = 0.6;

/// A face of a simplified mesh.
struct PageFace {
    Index part = 0, face = 0;
};

/// The triangles of a page as the layout and the texel loop need them. All vectors are by triangle.
struct PageMesh {
    std::vector<PageFace> faces;  ///< where the triangles are from; those of one part are consecutive
    /// Corners, neighbours across edges with exactly two faces of consistent winding, creases, and the wanted texel
    /// densities.
    std::vector<PageTriangle> triangles;
    /// Place of the triangle along a Morton curve through its part. Triangles with close values look alike.
    std::vector<std::uint64_t> order;
    std::vector<double>
        source_density;  ///< texels of the source per unit of length at the middle of the triangle
};

/// Makes the mesh of a page. Texel densities are those of the source, between a quarter and four times the median of
/// the part. As far as the page has room, they are up to four times the median of the material, and those that
/// SourceSampler::region_density() says. Small pages have up to twice as many texels, and show such regions with up to four
/// times their densities.
/// \param parts    the parts, with maps and normals
/// \param faces    the faces of the page; those of one part must be consecutive
/// \param bake     its texel_density is a factor of the texel densities, instead of those for small pages
/// Complexity: O(n log n).
PageMesh make_page_mesh(std::span<const BakePart> parts, std::vector<PageFace> faces,
                        const SourceSampler& sampler, const BakeOptions& bake, const RunContext& context);

/// Texel densities of a page divided by those of the source, root mean squares over the simplified surface.
struct PageDensity {
    double mean = 0;            ///< of the page; 0 if the source has no texels there
    double lowest = 0;          ///< of the faces of one material of the source
    Index material = no_index;  ///< the first one with the lowest density
};

/// Returns the texel densities of a page. \param atlas  of the triangles
/// Complexity: O(n log m) for n triangles of m materials.
PageDensity relative_density(std::span<const BakePart> parts, const PageMesh& mesh, const Atlas& atlas);

}  // namespace faqem::detail
