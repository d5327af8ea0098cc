#pragma once
/// \file
/// The texel loop: bakes the images of one page of the atlas.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "bake/page/page_canvas.hpp"
#include "bake/page/page_request.hpp"
#include "faqem/detail/base/parallel.hpp"

namespace faqem::detail {

/// A sample of a texel.
struct SamplePlace {
    std::uint32_t column = 0, row = 0;  ///< from the left and the top
    double s = 0, t = 0;                ///< position in the texel, from 0 to 1
};

/// The order of the samples of a texel. The first ones are spread over the texel: if they are alike, the others are not
/// taken.
class SampleOrder {
public:
    /// \param samples  of a texel along each axis; at least 1
    explicit SampleOrder(std::uint32_t samples);

    /// The samples of texel (x, y). Of 2 x 2 samples the first two are on a diagonal, and in the four texels beside it on
    /// the other diagonal, so that lines along one of them are not missed.
    std::span<const SamplePlace> of(std::uint32_t x, std::uint32_t y) const { return orders_[(x + y) % 2]; }

    /// Number of samples that are always taken.
    std::size_t first_samples() const { return first_samples_; }

private:
    std::size_t first_samples_ = 1;
    std::array<std::vector<SamplePlace>, 2> orders_;
};

/// Bakes the images of a page.
/// A texel is the average of PageRequest::samples^2 samples in linear light with premultiplied alpha, and is
/// encoded once. The other texels are filled by push_pull().
/// Samples outside a triangle show the mesh neighbour across the edge, unfolded into the triangle's plane, so
/// that coarser mip levels have the averages of a continuous texture; where there is no neighbour, they show
/// the triangle's closest point. Normals are averaged in the tangent space of the simplified mesh; samples
/// outside a triangle use the tangent space of its closest point.
/// The result does not depend on the number of threads, as cells and tiles are independent of each other.
/// \param from, to  fractions of Phase::bake that are done before and after the page
/// \throws Cancelled if the progress callback cancels, and whatever the callback throws
PageImages bake_page(const PageRequest& page, double from, double to, const RunContext& context);

}  // namespace faqem::detail
