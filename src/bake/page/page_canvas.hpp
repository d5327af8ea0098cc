#pragma once
/// \file
/// The images of a page while its texels are written.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "bake/atlas/per_triangle.hpp"
#include "bake/page/page_request.hpp"
#include "bake/page/texel_values.hpp"

namespace faqem::detail {

/// By texel of a page: nonzero if its centre is in a triangle, or if the centre of a triangle is in it. The
/// gutter is not among them: it is read at the edges of triangles only, with small weights.
/// Complexity: O(texels + triangles).
std::vector<std::uint8_t> shown_texels(const Atlas& atlas);

/// Encodes texels in the images of a page. Different texels can be written concurrently.
class PageCanvas {
public:
    /// \param page  must outlive this
    explicit PageCanvas(const PageRequest& page);

    /// Sets a texel to the mean of its samples.
    void write(std::uint32_t x, std::uint32_t y, const TexelSums& texel);

    /// The images, in which texels that were not written are filled by push_pull().
    PageImages finish(const RunContext& context) &&;

private:
    void write_base(std::size_t at, const TexelSums& texel, float share);
    void keep_colors_of_hidden_materials();
    void run_last_steps(const RunContext& context);
    void count_samples();

    const PageRequest& page_;
    PageImages images_;
    // By texel: number of samples with MapStep::approximate and MapStep::closest.
    std::vector<std::uint8_t> approximate_samples_, closest_samples_;
    std::vector<std::uint8_t> is_covered_;         // by texel: in a cell or chart
    std::vector<std::uint8_t> has_color_;          // by texel: its colour is its own; empty without alpha
    std::vector<Index> material_;                  // by covered texel: in the source; empty without alpha
    std::vector<std::uint8_t> has_layer_samples_;  // by texel: has samples of the page's own material
};

}  // namespace faqem::detail
