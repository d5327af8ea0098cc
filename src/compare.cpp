#include "faqem/compare.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "bvh.hpp"
#include "faqem/error.hpp"
#include "parallel.hpp"

namespace faqem {

namespace {

using detail::Bvh;
using engine::Vector3;

constexpr std::size_t block = 4096;
constexpr double degrees_per_radian = 57.295779513082320877;

/// Faces lower than this share of their longest edge have no normal worth comparing.
constexpr double least_height = 1e-12;

/// Neighbouring faces whose distances differ by less than this share of the diagonal are tied.
constexpr double tie_tolerance = 1e-9;

/// A number in [0, 1) that depends on its arguments only (the finaliser is that of SplitMix64, Steele et al.
/// 2014).
double uniform(std::uint64_t seed, std::uint64_t sample, std::uint64_t dimension) {
    const auto mix = [](std::uint64_t x) {
        x += 0x9e3779b97f4a7c15u;
        x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
        x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
        return x ^ (x >> 31);
    };
    return static_cast<double>(mix(mix(mix(seed) + dimension) + sample) >> 11) * 0x1p-53;
}

/// The faces with area of a mesh, ready to be sampled.
struct Surface {
    std::vector<Vec3> positions;
    std::vector<Triangle> triangles;  ///< with area
    std::vector<Vector3> normals;     ///< unit, per triangle
    std::vector<double> area_up_to;   ///< per triangle: area of it and all before
    std::vector<Vec3> vertices;       ///< used positions, each once
    Vector3 low = Vector3::Zero(), high = Vector3::Zero();

    double diagonal() const { return (high - low).norm(); }
    Vector3 corner(Index f, std::size_t k) const { return engine::to_eigen(positions[triangles[f][k]]); }
};

void check_indices(const Triangle& t, std::size_t f, std::size_t vertices) {
    for (const Index v : t) {
        if (v >= vertices) {
            throw InputError({}, "face " + std::to_string(f),
                             "refers to vertex " + std::to_string(v) + " of " + std::to_string(vertices));
        }
    }
}

Surface make_surface(const MeshView& mesh, const char* name) {
    Surface s;
    s.positions.resize(mesh.positions.size());
    for (std::size_t v = 0; v < s.positions.size(); ++v) s.positions[v] = mesh.positions[v];
    double area = 0;
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
        const Triangle t = mesh.triangles[f];
        check_indices(t, f, s.positions.size());
        const Vector3 a = engine::to_eigen(s.positions[t[0]]), b = engine::to_eigen(s.positions[t[1]]),
                      c = engine::to_eigen(s.positions[t[2]]);
        const Vector3 n = engine::area_vector(a, b, c);
        const double longest =
            std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
        const double twice_area = n.norm();
        if (!(twice_area > least_height * longest) || !std::isfinite(twice_area)) continue;
        area += twice_area / 2;
        s.triangles.push_back(t);
        s.normals.push_back(n / twice_area);
        s.area_up_to.push_back(area);
        for (const Index v : t) s.vertices.push_back(s.positions[v]);
    }
    if (s.triangles.empty()) throw InputError({}, name, "has no face with area");
    std::sort(s.vertices.begin(), s.vertices.end());
    s.vertices.erase(std::unique(s.vertices.begin(), s.vertices.end()), s.vertices.end());
    s.low = s.high = engine::to_eigen(s.vertices.front());
    for (const Vec3& p : s.vertices) {
        s.low = s.low.cwiseMin(engine::to_eigen(p));
        s.high = s.high.cwiseMax(engine::to_eigen(p));
    }
    return s;
}

/// Closest points for queries that come in spatial order: the answer to one bounds the next.
class CoherentQuery {
public:
    CoherentQuery(const Surface& surface, const Bvh& tree) : surface_(surface), tree_(tree) {}

    Bvh::Hit operator()(const Vec3& p) {
        const detail::ClosestPoint near_last =
            detail::closest_point_on_triangle(engine::to_eigen(p), surface_.corner(last_, 0),
                                              surface_.corner(last_, 1), surface_.corner(last_, 2));
        Bvh::Hit hit = tree_.closest(p, near_last.distance_squared);
        if (hit.face == no_index) {  // rounding: the box may seem a last digit farther than what is in it
            hit = {last_, engine::to_array(near_last.barycentric), engine::to_array(near_last.point),
                   near_last.distance_squared};
        }
        last_ = hit.face;
        return hit;
    }

private:
    const Surface& surface_;
    const Bvh& tree_;
    Index last_ = 0;
};

/// Largest cosine between `normal` and the normals of the faces as near to p as `hit`: at an edge or corner
/// of the other mesh several faces are, and which of them comes first is chance.
double best_cosine(const Surface& to, const Bvh& tree, const Vec3& p, const Bvh::Hit& hit,
                   const Vector3& normal, double tolerance) {
    double best = normal.dot(to.normals[hit.face]);
    const double reach = std::sqrt(hit.distance_squared) + tolerance;
    tree.visit_within(p, reach * reach, [&](Index face, const detail::ClosestPoint&) {
        best = std::max(best, normal.dot(to.normals[face]));
    });
    return std::min(best, 1.0);
}

struct Sums {
    double max_squared = 0, distance = 0, squared = 0, degrees = 0;
};

/// Sample i of n: the i-th stratum of the area, a uniform point of the face it falls into.
struct Sample {
    Index face;
    Vec3 point;
};

Sample sample(const Surface& s, std::uint64_t i, std::uint64_t n, std::uint64_t seed) {
    const double place =
        (static_cast<double>(i) + uniform(seed, i, 0)) / static_cast<double>(n) * s.area_up_to.back();
    const auto found = std::lower_bound(s.area_up_to.begin(), s.area_up_to.end(), place);
    const auto face = static_cast<Index>(
        std::min<std::ptrdiff_t>(found - s.area_up_to.begin(), std::ssize(s.area_up_to) - 1));
    const double r = std::sqrt(uniform(seed, i, 1)), t = uniform(seed, i, 2);
    const Vector3 p =
        (1 - r) * s.corner(face, 0) + r * (1 - t) * s.corner(face, 1) + r * t * s.corner(face, 2);
    return {face, engine::to_array(p)};
}

/// Calls work(sums, begin, end) for blocks of [0, size) and returns the blocks' sums in order.
template <class Work>
std::vector<Sums> sum_blocks(std::uint64_t size, std::uint32_t threads, Work&& work) {
    std::vector<Sums> sums((size + block - 1) / block);
    detail::parallel_blocks(size, block, threads, [&](std::size_t begin, std::size_t end) {
        work(sums[begin / block], begin, end);
    });
    return sums;
}

OneSided one_sided(const Surface& from, const Surface& to, const Bvh& tree, const CompareOptions& options,
                   std::uint64_t seed, double tolerance) {
    std::vector<Sums> sums =
        sum_blocks(options.samples, options.threads, [&](Sums& sum, std::size_t begin, std::size_t end) {
            CoherentQuery query(to, tree);
            for (std::size_t i = begin; i < end; ++i) {
                const Sample s = sample(from, i, options.samples, seed);
                const Bvh::Hit hit = query(s.point);
                const double cosine = best_cosine(to, tree, s.point, hit, from.normals[s.face], tolerance);
                sum.max_squared = std::max(sum.max_squared, hit.distance_squared);
                sum.distance += std::sqrt(hit.distance_squared);
                sum.squared += hit.distance_squared;
                sum.degrees += std::acos(std::max(cosine, -1.0)) * degrees_per_radian;
            }
        });
    const std::vector<Sums> at_vertices =
        sum_blocks(from.vertices.size(), options.threads, [&](Sums& sum, std::size_t begin, std::size_t end) {
            CoherentQuery query(to, tree);
            for (std::size_t i = begin; i < end; ++i) {
                sum.max_squared = std::max(sum.max_squared, query(from.vertices[i]).distance_squared);
            }
        });
    Sums total;
    for (const Sums& s : sums) {
        total.max_squared = std::max(total.max_squared, s.max_squared);
        total.distance += s.distance;
        total.squared += s.squared;
        total.degrees += s.degrees;
    }
    for (const Sums& s : at_vertices) total.max_squared = std::max(total.max_squared, s.max_squared);
    const double n = static_cast<double>(std::max<std::uint64_t>(options.samples, 1));
    return {std::sqrt(total.max_squared), total.distance / n, total.squared / n, total.degrees / n};
}

}  // namespace

Comparison compare(const MeshView& a, const MeshView& b, const CompareOptions& options) {
    const Surface sa = make_surface(a, "first mesh"), sb = make_surface(b, "second mesh");
    const Bvh ta(sa.positions, sa.triangles), tb(sb.positions, sb.triangles);
    Comparison result;
    result.diagonal = sa.diagonal();
    const double tolerance = tie_tolerance * result.diagonal;
    result.a_to_b = one_sided(sa, sb, tb, options, 2 * options.seed, tolerance);
    result.b_to_a = one_sided(sb, sa, ta, options, 2 * options.seed + 1, tolerance);
    result.hausdorff = std::max(result.a_to_b.max, result.b_to_a.max);
    result.chamfer = result.a_to_b.mean_squared + result.b_to_a.mean_squared;
    result.mean_normal_degrees = (result.a_to_b.mean_normal_degrees + result.b_to_a.mean_normal_degrees) / 2;
    return result;
}

}  // namespace faqem
