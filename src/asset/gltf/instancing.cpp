#include "asset/gltf/instancing.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "asset/gltf/accessor.hpp"
#include "asset/gltf/json.hpp"
#include "faqem/error.hpp"

namespace faqem::detail {
namespace {

const Json& instancing_attributes(const Json& node) {
    return member(node, "extensions", instancing_name, "attributes");
}

/// The values of an attribute; `neutral` if the node does not have it.
template <class T, std::size_t N>
std::vector<std::array<T, N>> attribute_values(const SourceDocument& source, const Json& attributes,
                                               const char* name, std::size_t count,
                                               const std::array<T, N>& neutral) {
    const Index accessor = index_member(attributes, name);
    if (accessor == no_index) return std::vector<std::array<T, N>>(count, neutral);
    return read_vectors<T, N>(source, accessor);
}

template <class T, std::size_t N>
void check_finite(const SourceDocument& source, Index accessor, const std::string& file,
                  const std::string& where) {
    const std::vector<std::array<T, N>> values = read_vectors<T, N>(source, accessor);
    for (std::size_t i = 0; i < values.size(); ++i)
        if (!std::all_of(values[i].begin(), values[i].end(), [](T x) { return std::isfinite(x); }))
            throw InputError(file, where, "instance " + std::to_string(i) + " is not finite");
}

}  // namespace

std::array<double, 16> transform_matrix(const std::array<double, 3>& t, const std::array<double, 4>& rotation,
                                        const std::array<double, 3>& s) {
    auto [x, y, z, w] = rotation;
    const double length = std::sqrt(x * x + y * y + z * z + w * w);
    if (length > 0) {
        x /= length;
        y /= length;
        z /= length;
        w /= length;
    }
    return {(1 - 2 * (y * y + z * z)) * s[0],
            2 * (x * y + z * w) * s[0],
            2 * (x * z - y * w) * s[0],
            0,
            2 * (x * y - z * w) * s[1],
            (1 - 2 * (x * x + z * z)) * s[1],
            2 * (y * z + x * w) * s[1],
            0,
            2 * (x * z + y * w) * s[2],
            2 * (y * z - x * w) * s[2],
            (1 - 2 * (x * x + y * y)) * s[2],
            0,
            t[0],
            t[1],
            t[2],
            1};
}

std::vector<std::array<double, 16>> instance_matrices(const SourceDocument& source, const Json& node) {
    std::vector<std::array<double, 16>> matrices;
    const Json& attributes = instancing_attributes(node);
    if (attributes.empty()) return matrices;
    const Index any = attributes.begin()->get<Index>();
    const auto count =
        static_cast<std::size_t>(unsigned_member(member(source.document, "accessors")[any], "count", 0));
    const auto translation = attribute_values<double, 3>(source, attributes, "TRANSLATION", count, {0, 0, 0});
    const auto rotation = attribute_values<float, 4>(source, attributes, "ROTATION", count, {0, 0, 0, 1});
    const auto scale = attribute_values<double, 3>(source, attributes, "SCALE", count, {1, 1, 1});
    matrices.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const Vec4f& r = rotation[i];
        matrices.push_back(transform_matrix(translation[i], {r[0], r[1], r[2], r[3]}, scale[i]));
    }
    return matrices;
}

void check_instances(const SourceDocument& source, const std::string& file) {
    const Json& nodes = member(source.document, "nodes");
    for (std::uint64_t i = 0; i < nodes.size(); ++i) {
        const Json& attributes = instancing_attributes(nodes[i]);
        const std::string where = child_path("/nodes", i) + "/extensions/" + instancing_name + "/attributes/";
        for (const char* name : {"TRANSLATION", "ROTATION", "SCALE"}) {
            const Index accessor = index_member(attributes, name);
            if (accessor != no_index) check_finite<float, 4>(source, accessor, file, where + name);
        }
    }
}

}  // namespace faqem::detail
