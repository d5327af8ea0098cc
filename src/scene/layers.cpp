#include "scene/layers.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "asset/scene/affine.hpp"
#include "asset/scene/part_arrays.hpp"
#include "faqem/detail/base/parallel.hpp"
#include "faqem/detail/geometry/bvh.hpp"
#include "faqem/detail/simplify/build_result.hpp"
#include "scene/part_components.hpp"

namespace faqem::detail {

namespace {

using engine::RunContext;

// Largest distance between layers, and largest move of a vertex in one pass, as a share of the height of a face of the
// result. Parts that only touch must not be pushed apart.
constexpr double reach_share = 0.3;
// Wanted distance, as a share of the largest one, where it was not less.
constexpr double clearance_share = 0.03;
// Between the direction from one layer to the other and its normal, and between their normals.
constexpr double least_cosine = 0.9;
constexpr int passes = 3;

// Parts of the scene as one mesh, in the coordinates of the scene. A piece is a connected component of the source.
struct Layers {
    std::vector<Vec3> positions;
    std::vector<Triangle> triangles;
    std::vector<Index> piece;  // by triangle

    Vector3 at(Index v) const { return to_eigen(positions[v]); }
    Vector3 area_vector(Index f) const {
        const auto [a, b, c] = triangles[f];
        return (at(b) - at(a)).cross(at(c) - at(a));
    }
    Vector3 normal(Index f) const { return area_vector(f).normalized(); }
    Vector3 point(Index f, const Vector3& barycentric) const {
        const auto [a, b, c] = triangles[f];
        return barycentric[0] * at(a) + barycentric[1] * at(b) + barycentric[2] * at(c);
    }
    // Farthest that the points of a face may move.
    double reach(Index f) const {
        const auto [a, b, c] = triangles[f];
        const double longest =
            std::max({(at(b) - at(a)).norm(), (at(c) - at(b)).norm(), (at(a) - at(c)).norm()});
        return longest > 0 ? reach_share * area_vector(f).norm() / longest : 0;
    }

    void add(const Matrix4& transform, std::span<const Vec3> points, std::span<const Triangle> faces,
             std::span<const Index> pieces) {
        const auto first = static_cast<Index>(positions.size());
        for (const Vec3& p : points) positions.push_back(transformed_point(transform, p));
        for (const auto& [a, b, c] : faces) triangles.push_back({first + a, first + b, first + c});
        piece.insert(piece.end(), pieces.begin(), pieces.end());
    }
};

// A point of a face of the results that has to be on one side of another piece.
struct Constraint {
    Index face;
    Vector3 barycentric;
    double reach, wanted;  // distances: see above
    Index piece;           // the other one
    double side;           // of it: 1 or -1
    Vector3 normal;        // of it
    Vector3 home;          // the point of the source, beyond which the point is not moved
};

// The constraints of a face; none unless all of it is near the same side of one other piece, and parallel to it.
std::vector<Constraint> constraints(const Layers& source, const Bvh& tree, const Layers& results,
                                    Index face) {
    static const std::array<Vector3, 7> samples = {{{1, 0, 0},
                                                    {0, 1, 0},
                                                    {0, 0, 1},
                                                    {0.5, 0.5, 0},
                                                    {0, 0.5, 0.5},
                                                    {0.5, 0, 0.5},
                                                    Vector3::Constant(1.0 / 3)}};
    const double reach = results.reach(face);
    const auto closest = [&](const Vector3& p, bool is_own) {
        const auto accepts = [&](const Bvh::Corners& f) {
            return (source.piece[f.face] == results.piece[face]) == is_own;
        };
        return tree.closest_if(to_array(p), accepts, reach * reach);
    };
    std::vector<Constraint> found;
    for (const Vector3& sample : samples) {
        const Bvh::Hit own = closest(results.point(face, sample), true);
        if (own.face == no_index) return {};
        const Vector3 home = to_eigen(own.point);
        const Bvh::Hit other = closest(home, false);
        if (other.face == no_index) return {};
        const Vector3 apart = home - to_eigen(other.point), normal = source.normal(other.face);
        const double height = apart.dot(normal);
        if (!(std::abs(height) > least_cosine * apart.norm()) ||
            !(std::abs(normal.dot(source.normal(own.face))) > least_cosine))
            return {};
        found.push_back({face, sample, reach, std::min(std::abs(height), clearance_share * reach),
                         source.piece[other.face], std::copysign(1.0, height), normal, home});
        if (found.front().piece != found.back().piece || found.front().side != found.back().side) return {};
    }
    return found;
}

// How a point has to move.
Vector3 required_move(const Constraint& c, const Layers& results, const Bvh& tree) {
    const Vector3 x = results.point(c.face, c.barycentric);
    const auto is_other = [&](const Bvh::Corners& f) {
        return results.piece[f.face] == c.piece && results.normal(f.face).dot(c.normal) > 0.5;
    };
    const Bvh::Hit other = tree.closest_if(to_array(x), is_other, c.reach * c.reach);
    if (other.face == no_index) return Vector3::Zero();
    const Vector3 normal = c.side * results.normal(other.face);
    const double lacking =
        c.wanted + std::min((to_eigen(other.point) - x).dot(normal), (c.home - x).dot(normal));
    return std::max(lacking, 0.0) * normal;
}

// Separates the layers of the results.
void separate(const Layers& source, Layers& results, const RunContext& context) {
    std::vector<std::vector<Constraint>> of_face(results.triangles.size());
    const Bvh source_tree(source.positions, source.triangles, context);
    parallel_each(of_face.size(), 64, context, [&](std::size_t f) {
        of_face[f] = constraints(source, source_tree, results, static_cast<Index>(f));
    });
    std::vector<Constraint> all;
    for (const auto& some : of_face) all.insert(all.end(), some.begin(), some.end());
    std::vector<double> reach(results.positions.size(), std::numeric_limits<double>::infinity());
    for (Index f = 0; f < results.triangles.size(); ++f)
        for (const Index v : results.triangles[f]) reach[v] = std::min(reach[v], results.reach(f));
    for (int pass = 0; pass < passes && !all.empty(); ++pass) {
        const Bvh tree(results.positions, results.triangles, context);
        std::vector<Vector3> required(all.size()), moves(results.positions.size(), Vector3::Zero());
        parallel_each(all.size(), 64, context,
                      [&](std::size_t i) { required[i] = required_move(all[i], results, tree); });
        for (std::size_t i = 0; i < all.size(); ++i) {
            // The shortest moves of the corners by which the point moves this far.
            const Vector3 shares = all[i].barycentric / all[i].barycentric.squaredNorm();
            for (unsigned k = 0; k < 3; ++k) {
                Vector3& move = moves[results.triangles[all[i].face][k]];
                const Vector3 own = shares[k] * required[i];
                if (own.squaredNorm() > move.squaredNorm()) move = own;
            }
        }
        for (Index v = 0; v < moves.size(); ++v) {
            const double most = std::min(1.0, reach[v] / moves[v].norm());
            if (most > 0) results.positions[v] = to_array(Vector3(results.at(v) + most * moves[v]));
        }
    }
}

}  // namespace

bool separates_layers(const Asset& source, const Options& options) {
    return (options.preset == Preset::balanced || options.preset == Preset::best) && !options.max_error &&
           face_count(source) <= 1'000'000;
}

void separate_layers(const Asset& source, std::span<SimplifyResult> results, const RunContext& context) {
    std::vector<Instance> placed = instances(source);
    std::vector<std::uint8_t> is_placed(source.parts.size(), 0);
    std::erase_if(
        placed, [&](const Instance& at) { return std::exchange(is_placed[at.part], std::uint8_t{1}) != 0; });
    Layers before, after;
    const PartComponents pieces = part_components(source);
    if (pieces.count < 2) return;
    for (const auto& [p, transform] : placed) {
        const Part& part = source.parts[p];
        before.add(transform, part.positions, part.triangles, pieces.of_face[p]);
        after.add(transform, results[p].mesh.positions, results[p].mesh.triangles,
                  gather(pieces.of_face[p], results[p].face_origin));
    }
    const std::vector<Vec3> unmoved = after.positions;
    separate(before, after, context);
    Index next = 0;  // position of the scene
    for (const auto& [p, transform] : placed) {
        const Eigen::Map<const Eigen::Matrix4d> matrix(transform.data());
        const Eigen::Matrix3d inverse = matrix.topLeftCorner<3, 3>().inverse();
        SimplifyResult& result = results[p];
        std::vector<Vec3> moved = result.mesh.positions;
        for (Vec3& position : moved) {
            const Vector3 by = inverse * (after.at(next) - to_eigen(unmoved[next]));
            ++next;
            if (by.allFinite() && !by.isZero(0)) position = to_array(Vector3(to_eigen(position) + by));
        }
        if (!revert_degenerate_faces(result.mesh.positions, result.mesh.triangles, moved)) continue;
        for (std::size_t v = 0; v < moved.size(); ++v)
            result.report.vertices_fitted += moved[v] != result.mesh.positions[v];
        if (moved == result.mesh.positions) continue;
        result.mesh.positions = std::move(moved);
        result.history.final_positions = result.mesh.positions;
    }
}

}  // namespace faqem::detail
