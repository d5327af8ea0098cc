#include "cli/report/error_surface.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "asset/image/srgb.hpp"
#include "asset/scene/repair.hpp"
#include "faqem/detail/base/parallel.hpp"
#include "faqem/detail/geometry/bvh.hpp"
#include "faqem/detail/geometry/surface.hpp"
#include "faqem/engine/mesh/vector.hpp"

namespace faqem::cli {

namespace {

using engine::Vector3;

constexpr Index max_subdivisions = 1024;              // segments along each edge of a face
constexpr std::uint64_t max_added_faces = 1'000'000;  // total over all faces

/// Returns the number of segments into which each edge of a face is divided.
Index subdivision_count(const Part& mesh, const Triangle& t, double spacing) {
    double longest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vector3 a = engine::to_eigen(mesh.positions[t[k]]),
                      b = engine::to_eigen(mesh.positions[t[(k + 1) % 3]]);
        longest = std::max(longest, (b - a).norm());
    }
    const double subdivisions = std::ceil(longest / spacing);
    if (!(subdivisions > 1)) return 1;
    return subdivisions < max_subdivisions ? static_cast<Index>(subdivisions) : max_subdivisions;
}

std::uint64_t added_face_count(const Part& mesh, double spacing) {
    std::uint64_t sum = 0;
    for (const Triangle& t : mesh.triangles) {
        const std::uint64_t subdivisions = subdivision_count(mesh, t, spacing);
        sum += subdivisions * subdivisions - 1;
    }
    return sum;
}

/// Divides each edge into `subdivisions` segments and the face into subdivisions^2 faces. Only the corners
/// are shared with adjacent faces.
void subdivide_face(Part& surface, const Triangle& t, Index subdivisions) {
    const Vec3 a = surface.positions[t[0]], b = surface.positions[t[1]], c = surface.positions[t[2]];
    std::vector<Index> above, row;
    for (Index i = 0; i <= subdivisions; ++i) {  // rows from corner a to the edge (b, c)
        row.clear();
        for (Index j = 0; j <= i; ++j) {
            const bool is_last_row = i == subdivisions;
            if (i == 0) {
                row.push_back(t[0]);
            } else if (is_last_row && (j == 0 || j == subdivisions)) {
                row.push_back(t[j == 0 ? 1 : 2]);
            } else {
                const double to_c = static_cast<double>(j) / subdivisions,
                             to_b = static_cast<double>(i - j) / subdivisions;
                Vec3 p;
                for (std::size_t k = 0; k < 3; ++k) p[k] = a[k] + to_b * (b[k] - a[k]) + to_c * (c[k] - a[k]);
                row.push_back(static_cast<Index>(surface.positions.size()));
                surface.positions.push_back(p);
            }
        }
        for (Index j = 0; j < i; ++j) {
            surface.triangles.push_back({above[j], row[j], row[j + 1]});
            if (j + 1 < i) surface.triangles.push_back({above[j], row[j + 1], above[j + 1]});
        }
        above.swap(row);
    }
}

}  // namespace

ErrorSurface error_surface(const Part& mesh, const Part& to, double spacing, std::uint32_t threads) {
    while (added_face_count(mesh, spacing) > max_added_faces) spacing *= 1.25;
    detail::check_index_count(mesh.positions.size() + 3 * max_added_faces, "",
                              "vertices of the error surface");
    Part part;
    part.name = "error";
    part.positions = mesh.positions;
    for (const Triangle& t : mesh.triangles) subdivide_face(part, t, subdivision_count(mesh, t, spacing));
    part.face_material.assign(part.triangles.size(), no_index);
    const detail::Surface surface =
        detail::extract_nonempty_surface({to.positions, to.triangles}, "the other mesh");
    const detail::Bvh tree(surface.positions, surface.triangles);
    std::vector<double> distances(part.positions.size());
    detail::parallel_blocks(distances.size(), 4096, threads, [&](std::size_t begin, std::size_t end) {
        detail::CoherentQuery closest(surface, tree);
        for (std::size_t v = begin; v < end; ++v)
            distances[v] = std::sqrt(closest(part.positions[v]).distance_squared);
    });
    return {std::move(part), std::move(distances)};
}

double distance_quantile(const ErrorSurface& a, const ErrorSurface& b, double share) {
    std::vector<double> all = a.distances;
    all.insert(all.end(), b.distances.begin(), b.distances.end());
    if (all.empty()) return 0;
    const double rank = std::ceil(share * static_cast<double>(all.size())) - 1;
    const auto nth = all.begin() + static_cast<std::ptrdiff_t>(std::max(rank, 0.0));
    std::nth_element(all.begin(), nth, all.end());
    return *nth;
}

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
