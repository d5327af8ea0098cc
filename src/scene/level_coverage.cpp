#include "scene/level_coverage.hpp"

#include <cmath>
#include <limits>

#include "asset/scene/affine.hpp"
#include "faqem/error.hpp"

namespace faqem::detail {

namespace {

double diagonal_of(const std::vector<Vec3>& points) {
    PointBounds bounds;
    for (const Vec3& p : points) bounds.add(p);
    const Vec3 extent = minus(bounds.high, bounds.low);
    return points.empty() ? 0 : std::sqrt(dot(extent, extent));
}

}  // namespace

std::vector<double> level_coverage(const Asset& source, const SceneSize& size, double error,
                                   double error_share) {
    std::vector<double> result;
    for (std::size_t p = 0; p < source.parts.size(); ++p) {
        const double diagonal = size.scales[p].largest * diagonal_of(source.parts[p].positions);
        result.push_back(error > 0 ? diagonal / error * error_share
                                   : std::numeric_limits<double>::infinity());
    }
    return result;
}

void set_coverage(std::vector<SavedLevel>& levels, const std::vector<double>& errors, double screen_error) {
    if (!(screen_error > 0 && std::isfinite(screen_error)))
        throw OptionError("screen_error must be finite and > 0");
    if (levels.empty()) return;
    const Asset& first = levels[0].asset;
    const SceneSize size = scene_size(first);
    for (std::size_t i = 0; i < levels.size(); ++i)
        levels[i].coverage = level_coverage(first, size, std::isnan(errors[i]) ? 0 : errors[i], screen_error);
}

}  // namespace faqem::detail
