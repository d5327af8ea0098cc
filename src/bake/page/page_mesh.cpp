#include "bake/page/page_mesh.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

#include "bake/parts/corner_normals.hpp"
#include "faqem/detail/base/morton.hpp"
#include "faqem/detail/base/vector.hpp"
#include "faqem/detail/geometry/halfedges.hpp"
#include "scene/material_groups.hpp"

namespace faqem::detail {
namespace {

// Pages with fewer texels get up to twice as many.
constexpr double small_page_texels = 1 << 18;

// By how much small pages show small regions more sharply: the mixture of two of them is a colour that the source does not
// have, and texels of plain regions need few bytes.
constexpr double small_page_sharpness = 4;

// The triangles of faces, with numbers of vertices that differ between parts.
std::vector<Triangle> numbered_triangles(std::span<const BakePart> parts, std::span<const PageFace> faces) {
    std::vector<Index> first = {0};  // by part
    for (const BakePart& part : parts)
        first.push_back(first.back() + static_cast<Index>(part.simplified->mesh.positions.size()));
    std::vector<Triangle> result;
    result.reserve(faces.size());
    for (const PageFace& face : faces) {
        const Triangle& t = parts[face.part].simplified->mesh.triangles[face.face];
        const Index begin = first[face.part];
        result.push_back({begin + t[0], begin + t[1], begin + t[2]});
    }
    return result;
}

// Sets PageTriangle::adjacent and crease.
void connect_triangles(std::span<const BakePart> parts, PageMesh& page) {
    const auto connect = [&](const Halfedge& from, const Halfedge& to) {
        const PageFace &own = page.faces[from.face], &other = page.faces[to.face];
        PageTriangle& triangle = page.triangles[from.face];
        triangle.adjacent[from.opposite()] = {to.face, to.opposite()};
        triangle.crease[from.opposite()] =
            is_crease(parts[own.part].normals, own.face, from.opposite(), other.face, to.opposite());
    };
    for_each_edge(sorted_halfedges(numbered_triangles(parts, page.faces)), [&](std::span<const Halfedge> on) {
        if (on.size() != 2 || on[0].is_ascending == on[1].is_ascending || on[0].face == on[1].face) return;
        connect(on[0], on[1]);
        connect(on[1], on[0]);
    });
}

// Source texels per unit of length at a simplified face.
struct FaceDensity {
    double mean = 0;            // root mean square over four points
    double middle = 0;          // at the middle
    double regions = 0;         // the largest that the regions at these points need
    Index material = no_index;  // at the middle
    double area = 0;            // of the simplified face
};

FaceDensity density_at(const BakePart& part, const SourceSampler& sampler, Index face) {
    FaceDensity result;
    double sum = 0;
    for (std::size_t i = 0; i < quarter_points.size(); ++i) {
        const SurfacePoint point = part.map->map(face, quarter_points[i]);
        const double density = sampler.texel_density(part.index, point.face);
        sum += density * density;
        result.regions = std::max(result.regions, sampler.region_density(part.index, point.face));
        if (i > 0) continue;
        result.middle = density;
        result.material = sampler.material(part.index, point);
    }
    result.mean = std::sqrt(sum / 4);
    return result;
}

// The median of the densities, weighted by area. Complexity: O(n log n)
double median_density(std::vector<FaceDensity> faces) {
    double total = 0, sum = 0;
    for (const FaceDensity& face : faces) total += face.area;
    std::ranges::sort(faces, {}, [](const FaceDensity& face) { return std::pair(face.mean, face.area); });
    for (const FaceDensity& face : faces)
        if ((sum += face.area) >= total / 2) return face.mean;
    return faces.empty() ? 0 : faces.back().mean;
}

// With these a face would show everything.
struct WantedDensities {
    double usual;  // those of the source, within a factor of 4 of the median of the material, and of regions
    double small;  // on a small page
};

// Sets the densities of the triangles of one part: those of the source, within a factor of 4 of the median of the part.
std::vector<WantedDensities> set_densities(std::span<const FaceDensity> faces,
                                           std::span<PageTriangle> triangles) {
    std::map<Index, std::vector<FaceDensity>> by_material;
    for (const FaceDensity& face : faces) by_material[face.material].push_back(face);
    std::map<Index, double> medians;
    for (auto& [material, own] : by_material) medians[material] = median_density(std::move(own));
    const double median =
        medians.size() == 1 ? medians.begin()->second : median_density({faces.begin(), faces.end()});
    // One density for all regions, which may be small: charts in which it jumps are distorted. It is not that of the
    // smallest ones, which are hardly seen.
    double regions = 0, area = 0;
    for (const FaceDensity& face : faces) {
        regions += face.area * face.regions;
        area += face.area;
    }
    regions = std::isfinite(regions) && area > 0 ? regions / area : 0;
    std::vector<WantedDensities> wanted;
    for (std::size_t i = 0; i < faces.size(); ++i) {
        const FaceDensity& face = faces[i];
        triangles[i].density = std::clamp(face.mean, median / 4, median * 4);
        const double of_material = std::min(face.mean, medians[face.material] * 4);
        const double usual = std::max({triangles[i].density, of_material, regions});
        wanted.push_back({usual, std::max(usual, small_page_sharpness * regions)});
    }
    return wanted;
}

// Raises the densities of triangles to the wanted ones, as far as the page has room.
void use_room(std::span<const WantedDensities> wanted, double WantedDensities::*which, double page_texels,
              std::span<PageTriangle> triangles) {
    const auto gain = [&](std::size_t i) {
        const double own = triangles[i].density, density = wanted[i].*which;
        return std::max(0.0, density * density - own * own);
    };
    double used = 0, more = 0;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const double area = area_vector(triangles[i]).norm() / 2, own = triangles[i].density;
        if (!std::isfinite(area)) continue;
        used += area * own * own;
        more += area * gain(i);
    }
    const double share = std::min(1.0, (page_texels - used) / more);
    if (!(share > 0)) return;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        double& density = triangles[i].density;
        density = std::sqrt(density * density + share * gain(i));
    }
}

// The factor by which the lengths of a page are larger than the densities say.
double small_page_factor(std::span<const PageTriangle> triangles) {
    double texels = 0;
    for (const PageTriangle& t : triangles)
        if (std::isfinite(area_vector(t).norm())) texels += wanted_texels(t);
    return std::clamp(std::sqrt(small_page_texels / texels), 1.0, std::numbers::sqrt2);
}

// Sets the places of the triangles of one part, along a curve over the bounding box of the part.
void set_order(const BakePart& part, std::span<const PageTriangle> triangles,
               std::span<std::uint64_t> order) {
    Eigen::AlignedBox3d box;
    for (const Vec3& p : part.simplified->mesh.positions) box.extend(to_eigen(p));
    const double size = std::max(box.sizes().maxCoeff(), std::numeric_limits<double>::min());
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const auto& p = triangles[i].corners;
        const Vector3 middle = (to_eigen(p[0]) + to_eigen(p[1]) + to_eigen(p[2])) / 3;
        order[i] = (std::uint64_t{part.index & 0xffff} << 48) | morton<16>((middle - box.min()) / size);
    }
}

}  // namespace

PageMesh make_page_mesh(std::span<const BakePart> parts, std::vector<PageFace> faces,
                        const SourceSampler& sampler, const BakeOptions& bake, const RunContext& context) {
    const std::size_t count = faces.size();
    PageMesh page{std::move(faces), std::vector<PageTriangle>(count), std::vector<std::uint64_t>(count),
                  std::vector<double>(count)};
    std::vector<FaceDensity> densities(count);
    parallel_each(count, 256, context, [&](std::size_t i) {
        const PageFace& at = page.faces[i];
        const TriangleMesh& mesh = parts[at.part].simplified->mesh;
        for (std::size_t c = 0; c < 3; ++c)
            page.triangles[i].corners[c] = mesh.positions[mesh.triangles[at.face][c]];
        densities[i] = density_at(parts[at.part], sampler, at.face);
        densities[i].area = area_vector(page.triangles[i]).norm() / 2;
        page.source_density[i] = densities[i].middle;
    });
    connect_triangles(parts, page);
    std::vector<WantedDensities> wanted;
    for (std::size_t begin = 0, end = 0; begin < count; begin = end) {
        const Index part = page.faces[begin].part;
        while (end < count && page.faces[end].part == part) ++end;
        const auto of_part = std::span(page.triangles).subspan(begin, end - begin);
        const std::vector<WantedDensities> of_faces =
            set_densities(std::span(densities).subspan(begin, end - begin), of_part);
        wanted.insert(wanted.end(), of_faces.begin(), of_faces.end());
        set_order(parts[part], of_part, std::span(page.order).subspan(begin, end - begin));
    }
    const double side = bake.texture_size, room = usual_page_fill * side * side;
    use_room(wanted, &WantedDensities::usual, room, page.triangles);
    if (!bake.texel_density)
        use_room(wanted, &WantedDensities::small, std::min(room, small_page_texels), page.triangles);
    const double factor = bake.texel_density ? *bake.texel_density : small_page_factor(page.triangles);
    for (PageTriangle& t : page.triangles) t.density *= factor;
    return page;
}

PageDensity relative_density(std::span<const BakePart> parts, const PageMesh& mesh, const Atlas& atlas) {
    struct Texels {
        double own = 0, wanted = 0;

        double density() const { return wanted > 0 ? std::sqrt(own / wanted) : 0; }
    };
    std::map<Index, Texels> by_material;
    Texels all;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const double density = mesh.source_density[i];
        const double wanted = area_vector(mesh.triangles[i]).norm() / 2 * density * density;
        if (!std::isfinite(wanted)) continue;
        const Triangle2& uv = atlas.placements[i];
        const double own = std::abs(twice_signed_area(uv[0], uv[1], uv[2])) / 2;
        const BakePart& part = parts[mesh.faces[i].part];
        const Index source_face = part.simplified->history.remaining_faces[mesh.faces[i].face];
        for (Texels* const to : {&all, &by_material[face_material(*part.source, source_face)]}) {
            to->own += own;
            to->wanted += wanted;
        }
    }
    PageDensity result{all.density(), all.density(), no_index};
    for (const auto& [material, texels] : by_material) {
        if (texels.wanted > 0 && (result.material == no_index || texels.density() < result.lowest)) {
            result.lowest = texels.density();
            result.material = material;
        }
    }
    return result;
}

}  // namespace faqem::detail
