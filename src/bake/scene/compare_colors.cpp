#include "faqem/compare_colors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "asset/image/srgb.hpp"
#include "asset/scene/flatten.hpp"
#include "asset/scene/part_arrays.hpp"
#include "bake/source/source_sampler.hpp"
#include "bake/texture/picture_difference.hpp"
#include "faqem/detail/base/parallel.hpp"
#include "faqem/detail/geometry/random_sampling.hpp"
#include "scene/vector_conversion.hpp"

namespace faqem {
namespace {

using detail::Bvh;
using engine::Vector3;

constexpr std::size_t block = 4096;
constexpr double outlier_threshold = 0.25;

/// A scene, prepared for closest-point queries and colour lookup.
struct Model {
    Asset asset;
    detail::Surface surface;
    std::vector<Vector3> face_normals;  ///< by triangle of the surface: oriented by the vertex normals
    Bvh tree;
    detail::SourceSampler colors;

    Model(const Asset& source, const char* name)
        : asset(detail::flatten_scene(source)),
          surface(detail::extract_nonempty_surface({part().positions, part().triangles}, name)),
          face_normals(surface.normals),
          tree(surface.positions, surface.triangles),
          colors(asset, {detail::CoreTexture::base_color}) {
        if (part().normals.empty()) return;
        for (std::size_t i = 0; i < face_normals.size(); ++i) {
            Vector3 sum = Vector3::Zero();
            for (const Index v : part().triangles[surface.faces[i]])
                sum += detail::to_vector(part().normals[v]);
            if (sum.dot(face_normals[i]) < 0) face_normals[i] = -face_normals[i];
        }
    }
    Model(const Model&) = delete;
    Model& operator=(const Model&) = delete;

    const Part& part() const { return asset.parts[0]; }

    detail::LinearColor color(Index triangle, const Vec3& barycentric) const {
        return colors.sample(0, {.face = surface.faces[triangle], .barycentric = barycentric}, 0).base;
    }

    bool masked_out(Index triangle, float alpha) const {
        const Material& m =
            detail::material_or_default(asset, detail::face_material(part(), surface.faces[triangle]));
        return m.alpha_mode == AlphaMode::mask && alpha < m.alpha_cutoff;
    }
};

/// Converts a colour to sRGB without alpha; transparent colours give black.
std::array<double, 3> srgb(const detail::LinearColor& premultiplied) {
    std::array<double, 3> c = {};
    if (!(premultiplied[3] > 0)) return c;
    for (std::size_t k = 0; k < 3; ++k) {
        const double linear = static_cast<double>(premultiplied[k]) / premultiplied[3];
        c[k] = detail::srgb_from_linear(std::clamp(linear, 0.0, 1.0));
    }
    return c;
}

struct ColorErrorSums {
    double squared = 0;
    std::uint64_t seen = 0, outliers = 0, unmatched = 0;
};

void add_sample(ColorErrorSums& sums, const Model& from, const Model& to, const detail::RandomSample& s) {
    const detail::LinearColor here = from.color(s.face, s.barycentric);
    if (from.masked_out(s.face, here[3])) return;
    const Vector3& normal = from.face_normals[s.face];
    const auto faces_here = [&](const Bvh::Corners& t) { return to.face_normals[t.face].dot(normal) > 0; };
    Bvh::Hit hit = to.tree.closest_if(s.point, faces_here);
    if (hit.face == no_index) {
        hit = to.tree.closest(s.point);
        ++sums.unmatched;
    }
    const std::array<double, 3> a = srgb(here), b = srgb(to.color(hit.face, hit.barycentric));
    double squared = 0;
    for (std::size_t k = 0; k < 3; ++k) squared += (a[k] - b[k]) * (a[k] - b[k]);
    ++sums.seen;
    sums.squared += squared / 3;
    sums.outliers += squared > outlier_threshold * outlier_threshold;
}

OneSidedColors one_sided(const Model& from, const Model& to, const CompareOptions& options,
                         std::uint64_t seed) {
    std::vector<ColorErrorSums> sums((options.samples + block - 1) / block);
    detail::parallel_each(options.samples, block, options.threads, [&](std::size_t i) {
        add_sample(sums[i / block], from, to, sample(from.surface, i, options.samples, seed));
    });
    ColorErrorSums total;
    for (const ColorErrorSums& s : sums) {
        total.squared += s.squared;
        total.seen += s.seen;
        total.outliers += s.outliers;
        total.unmatched += s.unmatched;
    }
    const auto share = [](double part, std::uint64_t of) {
        return part / static_cast<double>(std::max<std::uint64_t>(of, 1));
    };
    const double mean_squared = share(total.squared, total.seen);
    return {.mean_squared = mean_squared,
            .rmse = std::sqrt(mean_squared),
            .outliers = share(static_cast<double>(total.outliers), total.seen),
            .unmatched = share(static_cast<double>(total.unmatched), total.seen),
            .hidden = share(static_cast<double>(options.samples - total.seen), options.samples)};
}

}  // namespace

bool has_colors(const Asset& asset) {
    return !asset.materials.empty() || detail::some_part_has(asset, &Part::colors);
}

ColorComparison compare_colors(const Asset& a, const Asset& b, const CompareOptions& options) {
    const Model model_a(a, "first model"), model_b(b, "second model");
    const OneSidedColors a_to_b = one_sided(model_a, model_b, options, 2 * options.seed),
                         b_to_a = one_sided(model_b, model_a, options, 2 * options.seed + 1);
    const double mean_squared = (a_to_b.mean_squared + b_to_a.mean_squared) / 2;
    return {a_to_b, b_to_a, std::sqrt(mean_squared), detail::psnr(mean_squared)};
}

}  // namespace faqem
