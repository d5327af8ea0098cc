#include "bake/parts_within_error.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <limits>
#include <vector>

#include "within_error.hpp"

namespace faqem::detail {

namespace {

// By how much the scene shrinks and stretches a part at least and at most, over all its instances.
struct Scale {
    double least = 0, most = 0;
};

struct Scene {
    std::vector<Original> originals;  // by part
    std::vector<Scale> scales;        // by part
    double diagonal = 0;              // of the box of all instances' faces with area
};

// The singular values of the linear part: no distance grows by more than the largest.
Scale scale_of(const Eigen::Matrix4d& transform) {
    const Eigen::Vector3d values =
        Eigen::JacobiSVD<Eigen::Matrix3d>(transform.topLeftCorner<3, 3>()).singularValues();
    return {values[2], values[0]};
}

Scene measure_scene(const Asset& source) {
    Scene scene;
    scene.originals.reserve(source.parts.size());
    for (const Part& part : source.parts) {
        scene.originals.emplace_back(MeshView{part.positions, part.triangles});
    }
    scene.scales.resize(source.parts.size());
    std::vector<bool> shown(source.parts.size(), false);
    Eigen::AlignedBox3d box;
    for (const Instance& instance : instances(source)) {
        const Eigen::Map<const Eigen::Matrix4d> transform(instance.transform.data());
        const Scale scale = scale_of(transform);
        Scale& all = scene.scales[instance.part];
        all = {std::max(all.least, scale.least), std::max(all.most, scale.most)};
        shown[instance.part] = true;
        for (const Vec3& p : scene.originals[instance.part].surface().positions) {
            box.extend((transform * engine::to_eigen(p).homogeneous()).head<3>());
        }
    }
    for (std::size_t p = 0; p < shown.size(); ++p) {
        if (!shown[p]) scene.scales[p] = {1, 1};
    }
    scene.diagonal = box.isEmpty() ? 0 : box.diagonal().norm();
    return scene;
}

// In the units of the scene, the largest of all parts.
Distance distance(const Scene& scene, const SmallParts& small, double allowed, Look look,
                  const Options& options) {
    Distance most;
    for (std::size_t p = 0; p < scene.originals.size(); ++p) {
        const Scale& scale = scene.scales[p];
        if (scene.originals[p].surface().triangles.empty() || !(scale.most > 0)) continue;
        const Distance own =
            detail::distance(scene.originals[p], small.parts[p], allowed / scale.most, look, options);
        most.value = std::max(most.value, own.value > 0 ? own.value * scale.least : 0);
        most.bound = std::max(most.bound, own.bound > 0 ? own.bound * scale.most : 0);
        most.unsettled += own.unsettled;
    }
    return most;
}

}  // namespace

SmallParts simplify_parts_within(const Asset& source, const Options& options) {
    const Scene scene = measure_scene(source);
    const MaxError& error = *options.max_error;
    const double allowed = error.unit == MaxError::Unit::model ? error.value : error.value * scene.diagonal;
    std::uint64_t faces = 0;
    for (const Part& part : source.parts) faces += part.triangles.size();
    return run_within<SmallParts>(
        options, faces, allowed, [&](const Options& own) { return simplify_parts(source, own); },
        [&](const SmallParts& small, Look look) { return distance(scene, small, allowed, look, options); });
}

}  // namespace faqem::detail
