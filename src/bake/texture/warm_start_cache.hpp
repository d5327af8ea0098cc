#pragma once
/// \file
/// Where the last samples on a face were found.

#include <cstdint>

#include "faqem/surface_map.hpp"

namespace faqem::detail {

/// The last sample on a face and the first one of its row, by texel: the next one may start from there if it is
/// close by. Rows come from the top, each from the left.
class WarmStartCache {
public:
    /// The answer that a sample in texel (x, y) may start from. Null where there is none.
    const SurfacePoint* start_near(std::uint32_t x, std::uint32_t y) const {
        if (!started_) return nullptr;
        if (last_.y == y && x - last_.x <= 1) return &last_.point;
        return row_.is_near(x, y) ? &row_.point : nullptr;
    }

    void add(const SurfacePoint& point, std::uint32_t x, std::uint32_t y) {
        last_ = {point, x, y};
        if (!started_ || row_.y != y) row_ = last_;
        started_ = true;
    }

private:
    struct CachedSample {
        SurfacePoint point;
        std::uint32_t x = 0, y = 0;

        bool is_near(std::uint32_t to_x, std::uint32_t to_y) const {
            constexpr std::uint32_t steps = 4;  // a row may begin far from where the one above did
            return to_y - y <= 1 && to_x + steps - x <= 2 * steps;
        }
    };

    CachedSample last_, row_;
    bool started_ = false;
};

}  // namespace faqem::detail
