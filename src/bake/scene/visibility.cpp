#include "bake/scene/visibility.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "asset/motion.hpp"
#include "faqem/detail/geometry/bvh.hpp"
#include "faqem/detail/geometry/vertex_faces.hpp"
#include "faqem/error.hpp"
#include "faqem/detail/geometry/surface.hpp"

namespace faqem::detail {

namespace {

using engine::to_array;
using engine::to_eigen;
using engine::Vector3;

constexpr std::size_t direction_count = 32;
constexpr std::uint64_t polls_of_look = 4 * direction_count;  // a ray takes a few microseconds
constexpr double lift_of_diagonal = 1.0 / 5000;               // above the surface rays begin
constexpr double reach_of_diagonal = 1.0 / 400;               // of a patch, from its first face
constexpr double same_way = 0.8;                              // cosine between the normals of a patch
constexpr double enough = 0.5;                                // seen, to look from no other large face

// A part where the scene shows it.
struct Placed {
    std::vector<Vec3> positions;
    std::vector<Triangle> triangles;  // wound as their fronts are seen
};

Placed placed(const Asset& scene, const Instance& instance, Poll poll) {
    const Part& part = scene.parts[instance.part];
    const Eigen::Map<const Eigen::Matrix4d> transform(instance.transform.data());
    Placed result;
    result.positions.reserve(part.positions.size());
    for (const Vec3& p : part.positions) {
        poll();
        result.positions.push_back(to_array((transform * to_eigen(p).homogeneous()).head<3>()));
    }
    result.triangles = part.triangles;
    if (transform.topLeftCorner<3, 3>().determinant() < 0) {
        for (Triangle& t : result.triangles) std::swap(t[1], t[2]);
    }
    return result;
}

// What a face of a material hides.
enum class Hides { nothing, behind_front, behind_both };

Hides hides(const Asset& scene, Index material) {
    if (material == no_index) return Hides::behind_front;
    const Material& m = scene.materials[material];
    const auto& all = m.extensions;
    if (m.alpha_mode != AlphaMode::opaque ||
        std::find(all.begin(), all.end(), "KHR_materials_transmission") != all.end()) {
        return Hides::nothing;
    }
    return m.double_sided ? Hides::behind_both : Hides::behind_front;
}

// All that stands between the surface and who looks at it.
class Blockers {
public:
    Blockers(const Asset& scene, const std::vector<Instance>& all, Poll poll) {
        std::vector<Vec3> positions;
        std::vector<Triangle> triangles;
        check_size(scene, all);
        for (const Instance& instance : all) {
            const Part& part = scene.parts[instance.part];
            const Placed own = placed(scene, instance, poll);
            const auto first = static_cast<Index>(positions.size());
            positions.insert(positions.end(), own.positions.begin(), own.positions.end());
            for (std::size_t f = 0; f < own.triangles.size(); ++f) {
                poll();
                const Hides kind =
                    hides(scene, part.face_material.empty() ? no_index : part.face_material[f]);
                if (kind == Hides::nothing) continue;
                const Triangle& t = own.triangles[f];
                triangles.push_back({first + t[0], first + t[1], first + t[2]});
                hides_behind_both_.push_back(kind == Hides::behind_both);
            }
        }
        tree_ = Bvh(positions, triangles, poll);
    }

    // Whether who looks from far in that direction does not see the point.
    bool hide(const Vector3& point, const Vector3& direction) const {
        // A ray that leaves through a face's back is a look at its front.
        return tree_.meets(to_array(point), to_array(direction), [&](Index face, Bvh::Side side) {
            return side == Bvh::Side::back || hides_behind_both_[face];
        });
    }

private:
    static void check_size(const Asset& scene, const std::vector<Instance>& all) {
        std::uint64_t faces = 0, vertices = 0;
        for (const Instance& instance : all) {
            faces += scene.parts[instance.part].triangles.size();
            vertices += scene.parts[instance.part].positions.size();
        }
        if (faces >= 1ull << 31 || vertices >= no_index)
            throw InputError({}, "scene", "is too large for visibility: " + std::to_string(faces) + " faces");
    }

    Bvh tree_;
    std::vector<bool> hides_behind_both_;
};

// Spread evenly over the sphere, on a spiral; none along an axis.
std::vector<Vector3> directions() {
    std::vector<Vector3> result;
    const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
    for (std::size_t i = 0; i < direction_count; ++i) {
        const double z = 1 - (2 * static_cast<double>(i) + 1) / direction_count;
        const double radius = std::sqrt(1 - z * z), angle = golden * static_cast<double>(i);
        result.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
    }
    return result;
}

// One instance's surface, looked from.
class Lookout {
public:
    Lookout(const Surface& surface, const Blockers& blockers, const Workers& workers)
        : surface_(surface),
          blockers_(blockers),
          around_(faces_around(surface.positions.size(), surface.triangles, workers.poll)),
          diagonal_(surface.diagonal()) {
        look_from_patches(workers);
    }

    // The share that is seen, per position of the surface: the largest of the faces around it.
    std::vector<float> seen(const Workers& workers) const {
        std::vector<float> result(surface_.positions.size());
        parallel_blocks(result.size(), 64, workers, [&](std::size_t begin, std::size_t end, Poll poll) {
            for (std::size_t v = begin; v < end; ++v)
                result[v] = static_cast<float>(seen_at(static_cast<Index>(v), poll));
        });
        return result;
    }

private:
    double reach() const { return reach_of_diagonal * diagonal_; }
    Vector3 middle(Index face) const {
        return (surface_.corner(face, 0) + surface_.corner(face, 1) + surface_.corner(face, 2)) / 3;
    }
    bool is_small(Index face) const {
        double longest = 0;
        for (std::size_t k = 0; k < 3; ++k)
            longest =
                std::max(longest, (surface_.corner(face, (k + 1) % 3) - surface_.corner(face, k)).norm());
        return longest <= reach();
    }

    // Small faces that lie together and look the same way are seen as the first of them is.
    void look_from_patches(const Workers& workers) {
        patch_.assign(surface_.triangles.size(), no_index);
        std::vector<Index> first, todo;
        for (Index f = 0; f < patch_.size(); ++f) {
            workers.poll();
            if (patch_[f] != no_index || !is_small(f)) continue;
            patch_[f] = static_cast<Index>(first.size());
            first.push_back(f);
            todo.assign(1, f);
            while (!todo.empty()) {
                const Index from = todo.back();
                todo.pop_back();
                for (const Index v : surface_.triangles[from]) add_around(v, f, todo, workers.poll);
            }
        }
        seen_from_patch_.resize(first.size());
        parallel_blocks(first.size(), 64, workers, [&](std::size_t begin, std::size_t end, Poll poll) {
            for (std::size_t i = begin; i < end; ++i) {
                poll(polls_of_look);
                seen_from_patch_[i] = seen_from(first[i], middle(first[i]));
            }
        });
    }

    // To the patch of a face what belongs to it around a vertex.
    void add_around(Index v, Index first, std::vector<Index>& todo, Poll poll) {
        for (const Index g : around_[v]) {
            poll();
            if (patch_[g] != no_index || !is_small(g)) continue;
            if (!((middle(g) - middle(first)).norm() <= reach())) continue;
            if (!(surface_.normals[g].dot(surface_.normals[first]) >= same_way)) continue;
            patch_[g] = patch_[first];
            todo.push_back(g);
        }
    }

    double seen_at(Index position, Poll poll) const {
        double most = 0;
        for (const Index f : around_[position]) {
            if (patch_[f] != no_index) {
                most = std::max(most, seen_from_patch_[patch_[f]]);
                continue;
            }
            if (most >= enough) continue;
            poll(polls_of_look);
            most = std::max(most,
                            seen_from(f, 0.55 * to_eigen(surface_.positions[position]) + 0.45 * middle(f)));
        }
        return most;
    }

    // From a point of a face, to both of its sides.
    double seen_from(Index face, const Vector3& point) const {
        const Vector3& normal = surface_.normals[face];
        std::array<double, 2> seen = {}, all = {};  // by side
        for (const Vector3& direction : directions_) {
            const double cosine = normal.dot(direction);
            const bool up = cosine > 0;
            all[up] += std::abs(cosine);
            const Vector3 from = point + (up ? 1 : -1) * lift_of_diagonal * diagonal_ * normal;
            if (!blockers_.hide(from, direction)) seen[up] += std::abs(cosine);
        }
        return std::min(1.0, seen[0] / all[0] + seen[1] / all[1]);
    }

    const Surface& surface_;
    const Blockers& blockers_;
    FacesAround around_;
    double diagonal_;
    std::vector<Vector3> directions_ = directions();
    std::vector<Index> patch_;  // by face; no_index: of none, the face is large
    std::vector<double> seen_from_patch_;
};

}  // namespace

SeenShares seen_shares(const Asset& scene, const Workers& workers) {
    const std::vector<Instance> all = instances(scene);
    const Blockers blockers(scene, all, workers.poll);
    std::vector<std::vector<std::optional<float>>> seen(scene.parts.size());
    for (std::size_t p = 0; p < seen.size(); ++p) seen[p].resize(scene.parts[p].positions.size());
    for (const Instance& instance : all) {
        const Placed own = placed(scene, instance, workers.poll);
        const Surface surface = surface_of({own.positions, own.triangles}, workers.poll);
        const std::vector<float> at = Lookout(surface, blockers, workers).seen(workers);
        for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
            for (std::size_t k = 0; k < 3; ++k) {
                std::optional<float>& most = seen[instance.part][own.triangles[surface.faces[t]][k]];
                most = std::max(most.value_or(0), at[surface.triangles[t][k]]);
            }
        }
    }
    SeenShares result;
    for (const auto& part : seen) {
        std::vector<float>& weights = result.weights.emplace_back();
        for (const std::optional<float>& share : part) {
            weights.push_back(std::max(least_visibility, share.value_or(1)));
            result.hidden += share == 0.0f;
        }
    }
    return result;
}

std::string visibility_warning(const Asset& scene) {
    return moves(scene) ? "visibility: the scene moves, and was looked at as it stands: what only a movement "
                          "shows counts as hidden"
                        : "";
}

}  // namespace faqem::detail
