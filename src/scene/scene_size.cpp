#include "scene/scene_size.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "asset/scene/affine.hpp"
#include "asset/scene/measured_instances.hpp"
#include "faqem/detail/base/vector.hpp"
#include "faqem/detail/geometry/surface.hpp"
#include "faqem/error.hpp"
#include "faqem/options.hpp"

namespace faqem::detail {

namespace {

// Smallest and largest singular value of the linear part: bounds of the factor by which distances change.
PartScale scale_of(const Eigen::Matrix4d& transform) {
    const Eigen::Vector3d values =
        Eigen::JacobiSVD<Eigen::Matrix3d>(transform.topLeftCorner<3, 3>()).singularValues();
    return {values[2], values[0]};
}

std::vector<Vec3> box_corners(const std::vector<Vec3>& points) {
    Eigen::AlignedBox3d box;
    for (const Vec3& p : points) box.extend(to_eigen(p));
    std::vector<Vec3> corners;
    for (int i = 0; i < 8 && !box.isEmpty(); ++i)
        corners.push_back(to_array(box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i))));
    return corners;
}

double diagonal_of(const std::vector<Vec3>& points) {
    PointBounds bounds;
    for (const Vec3& p : points) bounds.add(p);
    const Vec3 extent = minus(bounds.high, bounds.low);
    return points.empty() ? 0 : std::sqrt(dot(extent, extent));
}

}  // namespace

SceneSize scene_size(const Asset& source) {
    SceneSize size;
    size.scales.resize(source.parts.size(), {0, 0});
    std::vector<std::vector<Vec3>> positions(source.parts.size());
    for (std::size_t p = 0; p < positions.size(); ++p) {
        const Part& part = source.parts[p];
        positions[p] = extract_surface({part.positions, part.triangles}).positions;
    }
    const std::vector<Instance> placed = instances(source);
    // The corners of the box of a part bound the part, which is enough in a scene of very many instances.
    if (has_excessive_instances(source, placed))
        for (std::vector<Vec3>& of_part : positions) of_part = box_corners(of_part);
    std::vector<bool> shown(source.parts.size(), false);
    Eigen::AlignedBox3d box;
    for (const Instance& instance : placed) {
        const Eigen::Map<const Eigen::Matrix4d> transform(instance.transform.data());
        const PartScale scale = scale_of(transform);
        PartScale& all = size.scales[instance.part];
        all = {std::max(all.smallest, scale.smallest), std::max(all.largest, scale.largest)};
        shown[instance.part] = true;
        for (const Vec3& p : positions[instance.part])
            box.extend((transform * to_eigen(p).homogeneous()).head<3>());
    }
    for (std::size_t p = 0; p < shown.size(); ++p)
        if (!shown[p]) size.scales[p] = {};
    size.diagonal = box.isEmpty() ? 0 : box.diagonal().norm();
    return size;
}

Options part_options(const Options& options, const SceneSize& size, const PartScale& scale) {
    Options own = options;
    if (!options.topology.prune) return own;
    // If the scale is 0, the length cannot be converted.
    own.topology.prune.reset();
    if (!(scale.largest > 0)) return own;
    using Limits = std::numeric_limits<double>;
    own.topology.prune =
        model_units(std::clamp(size(*options.topology.prune) / scale.largest, Limits::min(), Limits::max()));
    return own;
}

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
