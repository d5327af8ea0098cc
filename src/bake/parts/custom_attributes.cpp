#include "bake/parts/custom_attributes.hpp"

#include <algorithm>
#include <cmath>

#include "asset/scene/part_arrays.hpp"

namespace faqem::detail {
namespace {

constexpr std::uint32_t float_components = 5126;
constexpr double equal_share = 1e-4;  // of the range of an attribute

using Value = std::array<double, 4>;

double largest_value(const CustomAttribute& attribute) {
    double most = 0;
    for (const Value& value : attribute.values)
        for (const double x : value) most = std::max(most, std::abs(x));
    return most;
}

Value interpolated(const std::vector<Value>& values, const Triangle& t, const Vec3& w) {
    Value result{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 4; ++k) result[k] += w[i] * values[t[i]][k];
    return result;
}

bool is_close(const Value& a, const Value& b, double distance) {
    for (std::size_t k = 0; k < 4; ++k)
        if (!(std::abs(a[k] - b[k]) <= distance)) return false;
    return true;
}

// Gives corners of a vertex whose values are close to each other the value of the first of them.
void join_close_values(const TriangleMesh& mesh, double distance, std::vector<Value>& values) {
    const VertexCorners at = vertex_corners(mesh);
    std::vector<Value> distinct;
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        distinct.clear();
        for (const std::uint64_t c : at[v]) {
            const auto found = std::find_if(distinct.begin(), distinct.end(), [&](const Value& value) {
                return is_close(value, values[c], distance);
            });
            if (found == distinct.end())
                distinct.push_back(values[c]);
            else
                values[c] = *found;
        }
    }
}

}  // namespace

bool is_copied(const CustomAttribute& attribute) {
    return attribute.component_type != float_components || attribute.name == "_BATCHID" ||
           attribute.name.compare(0, 12, "_FEATURE_ID_") == 0;
}

std::vector<CustomAttribute> corner_custom_attributes(const BakePart& part,
                                                      const engine::RunContext& context) {
    const std::vector<CustomAttribute>& from = part.source->custom_attributes;
    if (from.empty() || !part.map) return {};
    std::vector<CustomAttribute> result = without_values(from);
    const TriangleMesh& mesh = part.simplified->mesh;
    for (std::size_t c = 0; c < 3 * mesh.triangles.size(); ++c) {
        context.count(2 * map_query_cost);
        const auto face = static_cast<Index>(c / 3);
        const SurfacePoint exact = part.map->map(face, barycentrics_near_corner(c % 3, 0));
        // A little inside of the face, where it is clear which side of a border the corner belongs to.
        const SurfacePoint inside = part.map->map(face, barycentrics_near_corner(c % 3, 0.02));
        const Triangle& source = part.source->triangles[inside.face];
        const auto nearest =
            static_cast<std::size_t>(std::max_element(inside.barycentric.begin(), inside.barycentric.end()) -
                                     inside.barycentric.begin());
        for (std::size_t a = 0; a < from.size(); ++a)
            result[a].values.push_back(
                is_copied(from[a])
                    ? from[a].values[source[nearest]]
                    : interpolated(from[a].values, part.source->triangles[exact.face], exact.barycentric));
    }
    for (std::size_t a = 0; a < from.size(); ++a)
        if (!is_copied(from[a]))
            join_close_values(mesh, equal_share * largest_value(from[a]), result[a].values);
    return result;
}

}  // namespace faqem::detail
