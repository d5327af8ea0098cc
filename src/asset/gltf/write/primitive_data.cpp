// Vertex attributes of an output primitive, made valid: unit normals, tangents with the sign 1 or -1, weights that sum to
// 1. Valid values are kept bit for bit.

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "asset/gltf/write/writer.hpp"
#include "asset/scene/affine.hpp"
#include "asset/scene/part_arrays.hpp"
#include "asset/scene/repair.hpp"
#include "faqem/error.hpp"

#ifdef FAQEM_WITH_MESHOPT
#include <meshoptimizer.h>
#endif

namespace faqem::detail {
namespace {

constexpr double unit_tolerance = 5e-4;    // vectors whose length is within this of 1 are kept
constexpr double weight_tolerance = 2e-7;  // required by glTF 2.0, section 3.7.3.3, for one joint

/// Normalises the first three components. Returns false if their length is zero or not finite.
template <std::size_t N>
bool make_unit(std::array<float, N>& v) {
    const Vec3 d = {v[0], v[1], v[2]};
    const double length = std::sqrt(dot(d, d));
    if (!(length > 0) || !std::isfinite(length)) return false;
    if (!(std::abs(length - 1) <= unit_tolerance))
        for (std::size_t i = 0; i < 3; ++i) v[i] = static_cast<float>(d[i] / length);
    return true;
}

/// Sorts triangles so that those that share vertices follow each other, for the small cache of graphics hardware, then
/// vertices in the order of their first use. Without meshoptimizer nothing is changed.
///
/// Of the orders of meshoptimizer, meshopt_optimizeVertexCache has the fewest cache misses with a FIFO of 12 to 32 entries.
/// Its scores are sums of constants, so the result does not depend on the machine.
/// \param vertices  any values, each used by a corner; permuted
/// \param corners   indices into `vertices`, three per triangle; the order within a triangle stays
void order_for_gpu([[maybe_unused]] std::vector<Index>& vertices,
                   [[maybe_unused]] std::vector<Index>& corners) {
#ifdef FAQEM_WITH_MESHOPT
    const std::size_t count = vertices.size();
    meshopt_optimizeVertexCache(corners.data(), corners.data(), corners.size(), count);
    std::vector<Index> moved(count), ordered(count);
    meshopt_optimizeVertexFetchRemap(moved.data(), corners.data(), corners.size(), count);
    for (Index& corner : corners) corner = moved[corner];
    for (std::size_t i = 0; i < count; ++i) ordered[moved[i]] = vertices[i];
    vertices = std::move(ordered);
#endif
}

void gather_positions(const Part& part, const Vec3& origin, PrimitiveData& data) {
    data.positions.reserve(data.vertices.size());
    for (const Index v : data.vertices) {
        const Vec3f q = converted<float>(minus(part.positions[v], origin));
        if (!is_finite(q))
            throw WriteError("part '" + part.name + "', vertex " + std::to_string(v) +
                             ": the position is too large for glTF, which stores floats");
        data.positions.push_back(q);
    }
}

/// For each vertex, the area-weighted sum of the normals of the adjacent faces.
std::vector<Vec3> face_normal_sums(const PrimitiveData& data) {
    std::vector<Vec3> sums(data.vertices.size(), Vec3{});
    for (std::size_t c = 0; c + 2 < data.corners.size(); c += 3) {
        std::array<Vec3, 3> p;
        for (std::size_t k = 0; k < 3; ++k) p[k] = converted<double>(data.positions[data.corners[c + k]]);
        const Vec3 n = cross(minus(p[1], p[0]), minus(p[2], p[0]));
        for (std::size_t k = 0; k < 3; ++k)
            for (std::size_t i = 0; i < 3; ++i) sums[data.corners[c + k]][i] += n[i];
    }
    return sums;
}

void gather_normals(const Part& part, PrimitiveData& data) {
    if (part.normals.empty()) return;
    data.normals = gather(part.normals, data.vertices);
    std::vector<std::size_t> zero;
    for (std::size_t i = 0; i < data.normals.size(); ++i)
        if (!make_unit(data.normals[i])) zero.push_back(i);
    if (zero.size() == data.normals.size()) data.normals.clear();
    if (zero.empty() || data.normals.empty()) return;
    const std::vector<Vec3> sums = face_normal_sums(data);
    for (const std::size_t i : zero) {
        const double length = std::sqrt(dot(sums[i], sums[i]));
        data.normals[i] = {0, 0, 1};
        if (length > 0 && std::isfinite(length))
            for (std::size_t k = 0; k < 3; ++k) data.normals[i][k] = static_cast<float>(sums[i][k] / length);
    }
}

/// Gathers the tangents. If one of them is invalid, all are left out, and readers compute them (MikkTSpace).
void gather_tangents(const Part& part, PrimitiveData& data) {
    if (part.tangents.empty() || data.normals.empty()) return;
    data.tangents = gather(part.tangents, data.vertices);
    for (Vec4f& tangent : data.tangents) {
        if (!make_unit(tangent) || !std::isfinite(tangent[3])) return data.tangents.clear();
        tangent[3] = tangent[3] < 0 ? -1.0f : 1.0f;
    }
}

/// Makes the influences of a vertex valid: weights of duplicate joints are added to the first one, joints
/// with zero weight are set to 0, and the weights are normalised to the sum 1.
void clean_influences(std::array<std::uint16_t, 4>& joints, Vec4f& weights) {
    for (std::size_t i = 0; i < 4; ++i) {
        if (!(weights[i] > 0) || !std::isfinite(weights[i])) weights[i] = 0;
        for (std::size_t k = 0; k < i && weights[i] > 0; ++k)
            if (joints[k] == joints[i] && weights[k] > 0) {
                weights[k] += weights[i];
                weights[i] = 0;
            }
        if (weights[i] == 0) joints[i] = 0;
    }
    const double sum = double{weights[0]} + weights[1] + weights[2] + weights[3];
    if (!(sum > 0)) weights = {1, 0, 0, 0};
    if (sum > 0 && !(std::abs(sum - 1) <= weight_tolerance))
        for (float& weight : weights) weight = static_cast<float>(weight / sum);
}

void gather_influences(const Part& part, PrimitiveData& data) {
    if (part.joints.empty() || part.weights.empty()) return;
    data.joints = gather(part.joints, data.vertices);
    data.weights = gather(part.weights, data.vertices);
    if (std::ranges::all_of(data.weights, [](const Vec4f& w) { return w == Vec4f{}; })) {
        data.joints.clear();
        data.weights.clear();
    }
    for (std::size_t i = 0; i < data.joints.size(); ++i) clean_influences(data.joints[i], data.weights[i]);
}

}  // namespace

Vec3 local_origin(const std::vector<Part>& parts) {
    constexpr double max_offset_ratio = 8;  // in half extents; costs 3 of the 24 significant bits of a float
    Vec3 origin = {};
    PointBounds bounds;
    for (const Part& part : parts)
        for (const Vec3& p : part.positions) bounds.add(p);
    const auto& [low, high] = bounds;
    double half_extent = 0;
    for (std::size_t i = 0; i < 3; ++i) half_extent = std::max(half_extent, high[i] / 2 - low[i] / 2);
    if (!(half_extent > 0)) return origin;
    const double unit = std::exp2(std::floor(std::log2(half_extent)));
    for (std::size_t i = 0; i < 3; ++i) {
        const double centre = low[i] / 2 + high[i] / 2;
        // A centre outside the range of float is not moved: the position is reported as an error later.
        if (!(std::abs(centre) > max_offset_ratio * half_extent) ||
            !(std::abs(centre) <= std::numeric_limits<float>::max()))
            continue;
        const double steps = centre / unit;
        origin[i] = std::abs(steps) < 0x1p52 ? std::round(steps) * unit : centre;
    }
    return origin;
}

PrimitiveData gather_primitive(const Part& part, const std::vector<Index>& faces, const Vec3& origin,
                               std::vector<Index>& scratch) {
    PrimitiveData data;
    number_corners(part, faces, scratch, data.vertices, data.corners);
    if (part.file_order == FileOrder::for_gpu) order_for_gpu(data.vertices, data.corners);

    gather_positions(part, origin, data);
    gather_normals(part, data);
    gather_tangents(part, data);
    gather_influences(part, data);
    if (!part.colors.empty()) {
        data.colors = gather(part.colors, data.vertices);
        // A primitive without colours is white.
        if (std::ranges::all_of(data.colors, [](const Vec4f& c) { return c == Vec4f{1, 1, 1, 1}; }))
            data.colors.clear();
    }
    return data;
}

}  // namespace faqem::detail
