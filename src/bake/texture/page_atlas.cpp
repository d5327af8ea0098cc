#include "bake/texture/page_atlas.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "bake/atlas/charts.hpp"
#include "faqem/detail/base/morton.hpp"
#include "faqem/engine/mesh/vector.hpp"

namespace faqem::detail {
namespace {

using engine::to_eigen;
using engine::Vector3;

// With fewer faces, charts have more gutter than the cells of a per-triangle atlas.
constexpr std::size_t min_mean_faces_per_chart = 3;

// Source texels per unit of length at a simplified face: root mean square over four points.
double density_at(const BakePart& part, const SourceSampler& sampler, Index face) {
    constexpr double third = 1.0 / 3, far = 2.0 / 3, near = 1.0 / 6;
    double sum = 0;
    for (const Vec3& w :
         {Vec3{third, third, third}, Vec3{far, near, near}, Vec3{near, far, near}, Vec3{near, near, far}}) {
        const double d = sampler.texel_density(part.index, part.map->map(face, w).face);
        sum += d * d;
    }
    return std::sqrt(sum / 4);
}

std::array<Vector3, 3> corners_of(const TriangleMesh& mesh, Index face) {
    const Triangle& t = mesh.triangles[face];
    return {to_eigen(mesh.positions[t[0]]), to_eigen(mesh.positions[t[1]]), to_eigen(mesh.positions[t[2]])};
}

// Clamps densities to within a factor of 4 of their area-weighted median. By part, as parts have their own
// units.
void clamp_densities(const BakeJob& job, std::span<const PageFace> faces, std::vector<double>& density) {
    for (std::size_t begin = 0, end; begin < faces.size(); begin = end) {
        struct Weighted {
            double density, area;
        };
        std::vector<Weighted> sorted;
        double total = 0;
        for (end = begin; end < faces.size() && faces[end].part == faces[begin].part; ++end) {
            const auto p = corners_of(job.parts[faces[end].part].simplified->mesh, faces[end].face);
            sorted.push_back({density[end], engine::area_vector(p[0], p[1], p[2]).norm()});
            total += sorted.back().area;
        }
        std::sort(sorted.begin(), sorted.end(), [](const Weighted& a, const Weighted& b) {
            return a.density != b.density ? a.density < b.density : a.area < b.area;
        });
        double sum = 0, median = 0;
        for (const Weighted& w : sorted) {
            median = w.density;
            if ((sum += w.area) >= total / 2) break;
        }
        for (std::size_t i = begin; i < end; ++i) density[i] = std::clamp(density[i], median / 4, median * 4);
    }
}

// Sort keys of faces: by part, and along a Morton curve over the bounding box of the part.
std::vector<std::uint64_t> morton_codes(const BakeJob& job, std::span<const PageFace> faces) {
    std::vector<std::uint64_t> result(faces.size());
    for (std::size_t begin = 0, end = 0; begin < faces.size(); begin = end) {
        const BakePart& part = job.parts[faces[begin].part];
        Vector3 low = Vector3::Constant(std::numeric_limits<double>::infinity()), high = -low;
        for (const Vec3& p : part.simplified->mesh.positions) {
            low = low.cwiseMin(to_eigen(p));
            high = high.cwiseMax(to_eigen(p));
        }
        const double size = std::max((high - low).maxCoeff(), std::numeric_limits<double>::min());
        for (end = begin; end < faces.size() && faces[end].part == faces[begin].part; ++end) {
            const auto p = corners_of(part.simplified->mesh, faces[end].face);
            const Vector3 middle = (p[0] + p[1] + p[2]) / 3;
            result[end] = (std::uint64_t{part.index & 0xffff} << 48) | morton<16>((middle - low) / size);
        }
    }
    return result;
}

std::uint8_t opposite_longest_edge(const PairTriangle& triangle) {
    const auto longest = std::max_element(triangle.edges.begin(), triangle.edges.end());
    return static_cast<std::uint8_t>(longest - triangle.edges.begin());
}

// A half-edge of a face.
struct FaceEdge {
    Index part, low, high;  // vertices
    std::uint64_t corner;   // 3 * triangle + corner opposite the edge
    bool up;                // directed from low to high

    bool same_edge(const FaceEdge& o) const { return part == o.part && low == o.low && high == o.high; }
};

}  // namespace

std::vector<std::array<AdjacentTriangle, 3>> face_adjacency(const BakeJob& job,
                                                            std::span<const PageFace> faces) {
    std::vector<FaceEdge> edges;
    edges.reserve(3 * faces.size());
    for (std::size_t i = 0; i < faces.size(); ++i) {
        const Triangle& t = job.parts[faces[i].part].simplified->mesh.triangles[faces[i].face];
        for (std::size_t c = 0; c < 3; ++c) {
            const Index a = t[(c + 1) % 3], b = t[(c + 2) % 3];
            edges.push_back({faces[i].part, std::min(a, b), std::max(a, b), 3 * i + c, a < b});
        }
    }
    std::sort(edges.begin(), edges.end(), [](const FaceEdge& a, const FaceEdge& b) {
        if (a.part != b.part) return a.part < b.part;
        if (a.low != b.low) return a.low < b.low;
        return a.high != b.high ? a.high < b.high : a.corner < b.corner;
    });
    std::vector<std::array<AdjacentTriangle, 3>> result(faces.size());
    const auto set = [&](std::uint64_t at, std::uint64_t other) {
        result[at / 3][at % 3] = {static_cast<Index>(other / 3), static_cast<std::uint8_t>(other % 3)};
    };
    for (std::size_t begin = 0, end; begin < edges.size(); begin = end) {
        for (end = begin + 1; end < edges.size() && edges[end].same_edge(edges[begin]);) ++end;
        const FaceEdge &a = edges[begin], &b = edges[end - 1];
        if (end - begin != 2 || a.up == b.up || a.corner / 3 == b.corner / 3) continue;
        set(a.corner, b.corner);
        set(b.corner, a.corner);
    }
    return result;
}

namespace {

double total_wanted_texels(const BakeJob& job, std::span<const PageFace> faces,
                           const std::vector<double>& density) {
    double sum = 0;
    for (std::size_t i = 0; i < faces.size(); ++i) {
        const auto p = corners_of(job.parts[faces[i].part].simplified->mesh, faces[i].face);
        const double area = engine::area_vector(p[0], p[1], p[2]).norm() / 2;
        if (std::isfinite(area)) sum += area * density[i] * density[i];
    }
    return sum;
}

// Pages with fewer texels get up to twice as many.
constexpr double small_page_texels = 1 << 18;

double small_page_factor(double texels) {
    return std::clamp(std::sqrt(small_page_texels / texels), 1.0, std::numbers::sqrt2);
}

// Wanted texels per unit of length, by face.
std::vector<double> wanted_densities(const BakeJob& job, const SourceSampler& sampler,
                                     std::span<const PageFace> faces) {
    std::vector<double> density(faces.size());
    parallel_blocks(faces.size(), 256, job.workers(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            density[i] = density_at(job.parts[faces[i].part], sampler, faces[i].face);
        }
    });
    clamp_densities(job, faces, density);
    const double factor = job.options.bake.texel_density
                              ? *job.options.bake.texel_density
                              : small_page_factor(total_wanted_texels(job, faces, density));
    for (double& d : density) d *= factor;
    return density;
}

bool layout_triangles(const BakeJob& job, std::span<const PageFace> faces, const std::vector<double>& density,
                      PageAtlas& result) {
    std::vector<PairTriangle> shapes(faces.size());
    for (std::size_t i = 0; i < faces.size(); ++i) {
        const auto p = corners_of(job.parts[faces[i].part].simplified->mesh, faces[i].face);
        for (std::size_t c = 0; c < 3; ++c) {
            shapes[i].edges[c] = density[i] * (p[(c + 1) % 3] - p[(c + 2) % 3]).norm();
        }
        shapes[i].adjacent = result.adjacent[i];
    }
    const std::vector<std::uint8_t> corner = pair_triangles(shapes);
    const std::vector<std::uint64_t> orders = morton_codes(job, faces);
    std::vector<AtlasTriangle> triangles(faces.size());
    for (std::size_t i = 0; i < faces.size(); ++i) {
        AtlasTriangle& t = triangles[i];
        t.right_angle_corner = corner[i] < 3 ? corner[i] : opposite_longest_edge(shapes[i]);
        t.legs = {shapes[i].edges[(t.right_angle_corner + 2) % 3],
                  shapes[i].edges[(t.right_angle_corner + 1) % 3]};
        t.order = orders[i];
        if (corner[i] < 3) t.partner = shapes[i].adjacent[corner[i]].triangle;
    }
    std::optional<Atlas> atlas =
        pack_triangles(triangles, job.options.bake.texture_size, job.cancellation_check());
    if (!atlas) return false;
    result.atlas = *std::move(atlas);
    result.summary.kind = Bake::per_triangle;
    result.summary.charts = result.atlas.cells.size();
    return true;
}

bool layout_charts(const BakeJob& job, std::span<const PageFace> faces, const std::vector<double>& density,
                   PageAtlas& result) {
    std::vector<ChartFace> shapes(faces.size());
    for (std::size_t i = 0; i < faces.size(); ++i) {
        const TriangleMesh& mesh = job.parts[faces[i].part].simplified->mesh;
        for (std::size_t c = 0; c < 3; ++c) {
            shapes[i].corners[c] = mesh.positions[mesh.triangles[faces[i].face][c]];
            const AdjacentTriangle& adjacent = result.adjacent[i][c];
            shapes[i].crease[c] =
                adjacent.triangle != no_index && is_crease(job.normals[faces[i].part], faces[i].face, c,
                                                           faces[adjacent.triangle].face, adjacent.corner);
        }
        shapes[i].density = density[i];
        shapes[i].adjacent = result.adjacent[i];
    }
    Charts charts = make_charts(shapes, job.workers());
    if (job.options.bake.kind == Bake::automatic &&
        min_mean_faces_per_chart * charts.charts.size() > faces.size()) {
        return layout_triangles(job, faces, density, result);
    }
    std::optional<ChartPage> page =
        pack_charts(charts.charts, faces.size(), job.options.bake.texture_size, job.workers());
    if (!page) return false;
    result.atlas = std::move(page->atlas);
    result.charts = std::move(page->charts);
    result.tiles = split_into_tiles(result.charts);
    BakedPage& summary = result.summary;
    summary.kind = Bake::atlas;
    summary.charts = charts.charts.size();
    summary.faces_outside_charts = charts.faces_over_work_limit;
    double stretch = 0, texels = 0;
    for (const Chart& chart : charts.charts) {
        stretch += chart.stretch * chart.texels;
        texels += chart.texels;
    }
    if (texels > 0) summary.stretch = stretch / texels;
    return true;
}

}  // namespace

std::optional<PageAtlas> make_page_atlas(const BakeJob& job, const SourceSampler& sampler,
                                         std::span<const PageFace> faces) {
    const std::vector<double> density = wanted_densities(job, sampler, faces);
    PageAtlas result{{}, {}, {}, face_adjacency(job, faces), {}};
    const bool fits = job.options.bake.kind == Bake::per_triangle
                          ? layout_triangles(job, faces, density, result)
                          : layout_charts(job, faces, density, result);
    if (!fits) return std::nullopt;
    BakedPage& summary = result.summary;
    summary.width = result.atlas.width;
    summary.height = result.atlas.height;
    summary.faces = faces.size();
    return result;
}

}  // namespace faqem::detail
