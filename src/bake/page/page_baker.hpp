#pragma once
/// \file
/// The texel loop: bakes the images of one page of the atlas.

#include "bake/page/page_canvas.hpp"
#include "bake/page/page_request.hpp"
#include "faqem/detail/base/parallel.hpp"

namespace faqem::detail {

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
