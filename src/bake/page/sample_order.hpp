#pragma once
/// \file
/// The samples of a texel, in the order in which they are taken.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

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

}  // namespace faqem::detail
