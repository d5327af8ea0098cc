#include "cli/report/heat_ramp.hpp"

#include <algorithm>

#include "asset/image/srgb.hpp"

namespace faqem::cli {

Vec4f heat_color(double share) {
    const double at = share > 0 ? std::min(share, 1.0) * (heat_ramp.size() - 1) : 0;
    const std::size_t before = std::min(static_cast<std::size_t>(at), heat_ramp.size() - 2);
    const double t = at - static_cast<double>(before);
    Vec4f color = {0, 0, 0, 1};
    for (std::size_t k = 0; k < 3; ++k) {
        const double srgb = (1 - t) * heat_ramp[before][k] + t * heat_ramp[before + 1][k];
        color[k] = static_cast<float>(detail::linear_from_srgb(srgb / 255));
    }
    return color;
}

}  // namespace faqem::cli
