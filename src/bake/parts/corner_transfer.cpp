#include "bake/parts/corner_transfer.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <span>

#include "bake/parts/output_part.hpp"
#include "bake/source/source_normals.hpp"
#include "faqem/detail/base/portable_math.hpp"
#include "faqem/detail/base/vector.hpp"
#include "scene/material_groups.hpp"

namespace faqem::detail {
namespace {

// Attributes are read close to a corner, but on the face.
constexpr double end_inset = 1e-3;

// Largest number of different values at a vertex that are compared with a corner. It bounds the work.
constexpr std::size_t max_versions = 64;

using Uv = std::array<double, 2>;

double uv_distance(const Uv& a, const Uv& b) { return portable_length(a[0] - b[0], a[1] - b[1], 0); }

Uv uv_at(const Part& part, std::size_t set, const SurfacePoint& point) {
    return interpolated<double>(part.uvs[set], part, point);
}

// Largest ratio of an edge in UV space to the edge of a face.
double uv_stretch(const Part& part, std::size_t set, Index face) {
    double result = 0;
    const Triangle& t = part.triangles[face];
    for (std::size_t i = 0; i < 3; ++i) {
        const Index a = t[i], b = t[(i + 1) % 3];
        const double length = (to_eigen(part.positions[a]) - to_eigen(part.positions[b])).norm();
        const Vec2f &from = part.uvs[set][a], &to = part.uvs[set][b];
        if (length > 0) result = std::max(result, uv_distance({from[0], from[1]}, {to[0], to[1]}) / length);
    }
    return result;
}

// Transfers the corners of one part, face by face.
class CornerTransfer {
public:
    CornerTransfer(const BakePart& part, TransferredCorners& to)
        : source_(*part.source), mesh_(part.simplified->mesh), map_(*part.map), to_(to) {
        width_ = 2 * source_.uvs.size() + (source_.colors.empty() ? 0 : 4);
        to_.values.resize(3 * mesh_.triangles.size() * width_);
        to_.faces.resize(mesh_.triangles.size());
    }

    // Returns false if the face crosses a border.
    bool transfer(Index face) {
        const SurfacePoint centre = map_.map(face, {1.0 / 3, 1.0 / 3, 1.0 / 3});
        to_.faces[face] = centre.face;
        bool is_inside = true;
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const SurfacePoint end = map_.map(face, barycentrics_near_corner(corner, end_inset));
            float* out = &to_.values[(3 * std::size_t{face} + corner) * width_];
            for (std::size_t set = 0; set < source_.uvs.size(); ++set) {
                const Way way = {face,
                                 corner,
                                 set,
                                 centre.face,
                                 uv_at(source_, set, centre),
                                 max_growth * uv_stretch(source_, set, centre.face) * radius(face, corner)};
                Uv uv = uv_at(source_, set, end);
                if (!is_in_chart(way, end, 1)) {
                    is_inside = false;
                    uv = last_in_chart(way);
                }
                for (const double x : uv) *out++ = static_cast<float>(x);
            }
            if (!source_.colors.empty())
                std::ranges::copy(interpolated<float>(source_.colors, source_, end), out);
        }
        return is_inside;
    }

    // Gives corners of a vertex the same values where they differ only because they were read at different places.
    void merge_versions() {
        join_corners(
            mesh_, max_versions, [&](std::uint64_t a, std::uint64_t b) { return is_close(a, b); },
            [&](std::uint64_t from, std::uint64_t to) {
                std::ranges::copy(values(from), values(to).begin());
            });
    }

private:
    // The way from the centre of a face to a corner, and what is compared with its points.
    struct Way {
        Index face;
        std::size_t corner, set;
        Index centre_face;
        Uv centre;
        double limit;  // on the distance of the corner from the centre in UV space
    };

    // \param share  of the way, in (0, 1]
    bool is_in_chart(const Way& way, const SurfacePoint& point, double share) const {
        return face_material(source_, point.face) == face_material(source_, way.centre_face) &&
               uv_distance(uv_at(source_, way.set, point), way.centre) <= way.limit * share;
    }

    // The UV where the way leaves the chart, by bisection.
    Uv last_in_chart(const Way& way) const {
        Uv uv = way.centre;
        double inside = 0;
        for (double step = 0.5; step > 0.01; step /= 2) {
            const double share = inside + step;
            const SurfacePoint point =
                map_.map(way.face, barycentrics_near_corner(way.corner, (1 - share) * 2 / 3));
            if (!is_in_chart(way, point, share)) continue;
            inside = share;
            uv = uv_at(source_, way.set, point);
        }
        return uv;
    }

    // A point at most this many times farther away in UV space than the face at the centre suggests is in the same
    // chart.
    static constexpr double max_growth = 2;
    static constexpr double max_difference = 0.01;  // of UVs at a vertex, relative to an edge of the face

    double radius(Index face, std::size_t corner) const {
        const std::array<Vector3, 3> t = corners_of(mesh_.positions, mesh_.triangles[face]);
        return (t[corner] - (t[0] + t[1] + t[2]) / 3).norm();
    }

    std::span<float> values(std::uint64_t corner) { return {&to_.values[corner * width_], width_}; }

    Uv uv(std::uint64_t corner, std::size_t set) const {
        const float* at = &to_.values[corner * width_ + 2 * set];
        return {at[0], at[1]};
    }

    bool is_close(std::uint64_t a, std::uint64_t b) const {
        const auto next = [](std::uint64_t corner) { return corner - corner % 3 + (corner + 1) % 3; };
        for (std::size_t set = 0; set < source_.uvs.size(); ++set) {
            const double edge = std::max(uv_distance(uv(a, set), uv(next(a), set)),
                                         uv_distance(uv(b, set), uv(next(b), set)));
            if (!(uv_distance(uv(a, set), uv(b, set)) <= max_difference * edge)) return false;
        }
        for (std::size_t k = 2 * source_.uvs.size(); k < width_; ++k) {
            const double difference = to_.values[a * width_ + k] - to_.values[b * width_ + k];
            if (!(std::abs(difference) <= max_difference)) return false;
        }
        return true;
    }

    const Part& source_;
    const TriangleMesh& mesh_;
    const PointMap& map_;
    TransferredCorners& to_;
    std::size_t width_ = 0;
};

}  // namespace

TransferredCorners transfer_corners(const BakePart& part, const RunContext& context) {
    TransferredCorners result;
    CornerTransfer transfer(part, result);
    std::atomic<std::uint64_t> crossing{0};
    parallel_each(part.faces(), 256, context,
                  [&](std::size_t f) { crossing += !transfer.transfer(static_cast<Index>(f)); });
    result.crossing_faces = crossing;
    if (!result.values.empty()) transfer.merge_versions();
    return result;
}

bool has_corner_attributes(const BakePart& part) {
    const std::size_t width = 2 * part.source->uvs.size() + (part.source->colors.empty() ? 0 : 4);
    return part.simplified->mesh.attributes.values.size() == 3 * part.faces() * width;
}

void warn_of_crossing_faces(std::uint64_t count, std::vector<std::string>& warnings) {
    if (count > 0)
        warnings.push_back(std::to_string(count) +
                           " faces cross borders of the source's UV charts: the image is stretched there");
}

KeptCorners kept_corners(const BakePart& part, const RunContext& context) {
    const bool has_own = has_corner_attributes(part);
    const TransferredCorners transferred = has_own ? TransferredCorners{} : transfer_corners(part, context);
    const std::vector<float>& attributes =
        has_own ? part.simplified->mesh.attributes.values : transferred.values;
    KeptCorners result;
    result.materials =
        has_own ? remaining_materials(part) : materials_of_faces(*part.source, transferred.faces);
    result.crossing_faces = transferred.crossing_faces;
    const std::size_t sets = part.source->uvs.size();
    result.values.uvs.resize(sets);
    for (auto at = attributes.begin(); at != attributes.end();) {
        for (std::size_t s = 0; s < sets; ++s, at += 2) result.values.uvs[s].push_back({at[0], at[1]});
        if (part.source->colors.empty()) continue;
        result.values.colors.push_back({at[0], at[1], at[2], at[3]});
        at += 4;
    }
    return result;
}

}  // namespace faqem::detail
