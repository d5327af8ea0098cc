#include "asset/formats/obj_smoothing.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>

#include "asset/scene/affine.hpp"
#include "asset/scene/value_numbers.hpp"

namespace faqem::detail {
namespace {

/// The vector with length 1; zero if its length is zero or not finite.
Vec3 direction(const Vec3& v) {
    const double length = std::sqrt(dot(v, v));
    if (!(length > 0) || !std::isfinite(length)) return {0, 0, 0};
    return {v[0] / length, v[1] / length, v[2] / length};
}

/// The direction of a polygon by its area vector.
Vec3 face_direction(std::span<const Vec3> positions, std::span<const CornerKey> corners) {
    Vec3 sum = {0, 0, 0};
    for (std::size_t i = 2; i < corners.size(); ++i) {
        const Vec3& origin = positions[corners[0][0]];
        add_scaled(
            sum, 1,
            cross(minus(positions[corners[i - 1][0]], origin), minus(positions[corners[i][0]], origin)));
    }
    return direction(sum);
}

/// The angle of a polygon at a corner; for a reflex one that to the other side.
double corner_angle(std::span<const Vec3> positions, std::span<const CornerKey> corners, std::size_t i) {
    const std::size_t n = corners.size();
    const Vec3& at = positions[corners[i][0]];
    const Vec3 a = minus(positions[corners[(i + n - 1) % n][0]], at);
    const Vec3 b = minus(positions[corners[(i + 1) % n][0]], at);
    const Vec3 normal = cross(a, b);
    return std::atan2(std::sqrt(dot(normal, normal)), dot(a, b));
}

}  // namespace

std::int64_t smoothing_group(std::string_view word) {
    std::int64_t number = word == "on" ? 1 : 0;
    std::from_chars(word.data(), word.data() + word.size(), number);
    return number > 0 ? number : 0;
}

void add_smoothed_normals(std::span<const Vec3> positions, std::span<const std::uint32_t> sizes,
                          std::span<const std::int64_t> groups, std::span<CornerKey> corners,
                          std::vector<Vec3f>& normals) {
    const auto for_each_face = [&](const auto& visit) {
        std::size_t first = 0;
        for (std::size_t f = 0; f < sizes.size(); first += sizes[f++])
            if (groups[f] != unknown_smoothing) visit(groups[f], corners.subspan(first, sizes[f]));
    };
    bool has_missing = false;
    for_each_face([&](std::int64_t, std::span<const CornerKey> face) {
        for (const CornerKey& corner : face) has_missing = has_missing || corner[2] == no_index;
    });
    if (!has_missing) return;

    UniqueValues<std::array<std::int64_t, 2>> shared;  // position and group
    std::vector<Vec3> sums;
    for_each_face([&](std::int64_t group, std::span<const CornerKey> face) {
        if (group == 0) return;
        const Vec3 normal = face_direction(positions, face);
        for (std::size_t i = 0; i < face.size(); ++i) {
            const Index number = shared.insert({face[i][0], group});
            if (number == sums.size()) sums.push_back({0, 0, 0});
            add_scaled(sums[number], corner_angle(positions, face, i), normal);
        }
    });

    UniqueValues<Vec3f> distinct;
    const auto first_new = static_cast<Index>(normals.size());
    for_each_face([&](std::int64_t group, std::span<CornerKey> face) {
        const Vec3 own = group == 0 ? face_direction(positions, face) : Vec3{0, 0, 0};
        for (CornerKey& corner : face) {
            if (corner[2] != no_index) continue;
            const Vec3 n = group == 0 ? own : direction(sums[shared.insert({corner[0], group})]);
            if (dot(n, n) > 0) corner[2] = first_new + distinct.insert(converted<float>(n));
        }
    });
    normals.insert(normals.end(), distinct.values().begin(), distinct.values().end());
}

}  // namespace faqem::detail
