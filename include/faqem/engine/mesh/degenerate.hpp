#pragma once
/// \file
/// Faces that are as good as a line: what is left of a surface must not be these alone.

#include <algorithm>
#include <cstddef>

#include "faqem/engine/mesh/collapse_mesh.hpp"
#include "faqem/engine/mesh/pair_table.hpp"
#include "faqem/export.hpp"

FAQEM_NAMESPACE_BEGIN
namespace engine {

/// Height over longest edge below which a face counts as degenerate.
inline constexpr double degenerate_aspect = 1e-9;

/// \param doubled_area  of a triangle
/// \param to_a, to_b    two of its sides, from one corner
inline bool is_degenerate(double doubled_area, const Vector3& to_a, const Vector3& to_b) {
    const double a = to_a.squaredNorm(), b = to_b.squaredNorm();
    // The third side squared is at most twice their sum: few triangles are worth a closer look.
    if (doubled_area > 2 * degenerate_aspect * (a + b)) return false;
    const double longest = std::max({a, b, (to_b - to_a).squaredNorm()});
    return !(doubled_area > degenerate_aspect * longest);
}

/// \pre f is alive
inline bool is_degenerate(const CollapseMesh& mesh, Index f) {
    const auto [a, b, c] = mesh.triangle(f);
    const Vector3& p = mesh.position(a);
    return is_degenerate(2 * mesh.area(f), mesh.position(b) - p, mesh.position(c) - p);
}

/// Knows how many degenerate faces there are at most. No legal collapse makes one (see Legality), so that
/// they only become fewer, and are counted anew only when the others seem to run out.
class DegenerateFaces {
public:
    DegenerateFaces() = default;
    /// O(faces)
    /// \throws what the poll throws
    explicit DegenerateFaces(const CollapseMesh& mesh, CancellationCheck check_cancelled = {})
        : max_count_(count(mesh, check_cancelled)) {}

    /// Do the faces of this pair hold all the area there is? Where nothing has an area: are they all there
    /// are? O(the smaller valence of the pair); O(faces) where nearly all are degenerate
    bool are_last_faces(const CollapseMesh& mesh, const PairTable& pairs, Index pair,
                        CancellationCheck check_cancelled = {}) {
        if (pairs.face_count(pair) + max_count_ < mesh.face_count()) return false;
        const std::size_t with_area = pairs.face_count(pair) - count_at_pair(mesh, pairs, pair);
        if (with_area == 0) return pairs.face_count(pair) >= mesh.face_count();
        if (with_area + max_count_ < mesh.face_count()) return false;
        max_count_ = count(mesh, check_cancelled);
        return with_area + max_count_ >= mesh.face_count();
    }

    /// To be told before the pair is collapsed. O(the smaller valence of the pair); O(1) if none is degenerate
    void before_collapse(const CollapseMesh& mesh, const PairTable& pairs, Index pair) {
        if (max_count_ > 0) max_count_ -= std::min(max_count_, count_at_pair(mesh, pairs, pair));
    }

private:
    static std::size_t count(const CollapseMesh& mesh, CancellationCheck check_cancelled) {
        std::size_t count = 0;
        for (Index f = 0; f < mesh.face_slots(); ++f) {
            check_cancelled();
            count += mesh.is_alive(f) && is_degenerate(mesh, f);
        }
        return count;
    }

    static std::size_t count_at_pair(const CollapseMesh& mesh, const PairTable& pairs, Index pair) {
        std::size_t count = 0;
        const auto [u, v] = mesh.lower_degree_first(pairs.first(pair), pairs.second(pair));
        mesh.for_each_face(
            u, [&, v = v](Index f, unsigned) { count += mesh.has_corner(f, v) && is_degenerate(mesh, f); });
        return count;
    }

    std::size_t max_count_ = 0;
};

}  // namespace engine
FAQEM_NAMESPACE_END
