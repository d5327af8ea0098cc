#pragma once
/// \file
/// Warm starts for the projection of samples: results of recent samples nearby.

#include <cstdint>

#include "faqem/surface_map.hpp"

namespace faqem::detail {

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

}  // namespace faqem::detail
