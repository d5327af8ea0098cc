#pragma once
/// \file
/// Corner attributes (UVs, colours) that stay on the surface while it is simplified.
///
/// Corners at one vertex with equal values share a wedge. A vertex with several wedges lies on a seam. A
/// collapse joins the wedges that meet in a face it removes; it must not join two wedges of one vertex, or
/// the charts on both sides of the seam would run into each other.

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "faqem/engine/mesh/collapse_mesh.hpp"
#include "faqem/engine/quadric/placement.hpp"
#include "faqem/export.hpp"

FAQEM_NAMESPACE_BEGIN
namespace engine {

/// The wedges of a complex and their values. Empty (no memory, no rule) without attributes.
class Wedges {
public:
    Wedges() = default;

    /// \param attributes  one entry per corner of the complex's face slots; width >= 1
    /// \throws what the poll throws
    Wedges(const CollapseMesh& mesh, const CornerAttributes& attributes,
           CancellationCheck check_cancelled = {})
        : width_(attributes.width), wedge_of_corner_(3 * mesh.face_slots(), no_index) {
        std::vector<Index> at_vertex;
        for (Index v = 0; v < mesh.vertex_slots(); ++v) {
            check_cancelled();
            at_vertex.clear();
            mesh.for_each_face(v, [&](Index f, unsigned corner) {
                const std::size_t c = 3 * std::size_t{f} + corner;
                wedge_of_corner_[c] = find_or_add(&attributes.values[c * width_], at_vertex);
            });
        }
    }

    bool empty() const { return width_ == 0; }
    std::uint32_t width() const { return width_; }
    /// Values of a living corner; width() floats.
    const float* values(Index face, unsigned corner) const {
        return &values_[std::size_t{wedge_of_corner_[3 * std::size_t{face} + corner]} * width_];
    }

    bool is_seam(const CollapseMesh& mesh, Index v) const {
        Index first = no_index;
        return !mesh.all_of_faces(v, [&](Index f, unsigned corner) {
            const Index wedge = wedge_of_corner_[3 * std::size_t{f} + corner];
            if (first == no_index) first = wedge;
            return wedge == first;
        });
    }

    /// Where the pair (u, v) may go so that no seam is torn: a vertex with a wedge that the other one lacks
    /// stays.
    AllowedPosition allowed_position(const CollapseMesh& mesh, Index u, Index v) {
        if (empty()) return AllowedPosition::anywhere;
        if (!match(mesh, u, v)) return AllowedPosition::nowhere;
        const bool u_stays = has_unmatched(mesh, u, &Match::at_u);
        const bool v_stays = has_unmatched(mesh, v, &Match::at_v);
        if (u_stays && v_stays) return AllowedPosition::nowhere;
        return u_stays   ? AllowedPosition::at_first
               : v_stays ? AllowedPosition::at_second
                         : AllowedPosition::anywhere;
    }

    /// u and v are about to become one vertex at p: joins their wedges, with the values that the surface has
    /// at the place closest to p among the faces of each joined wedge.
    /// \pre freedom() did not say nowhere
    void before_collapse(const CollapseMesh& mesh, Index u, Index v, const Vector3& p) {
        if (empty()) return;
        match(mesh, u, v);
        // Among faces without area there is no place to interpolate at: the nearer end's values are kept.
        const bool v_is_nearer = (mesh.position(v) - p).squaredNorm() < (mesh.position(u) - p).squaredNorm();
        std::vector<float>& new_values = scratch_;
        new_values.clear();
        for (const Match& m : matches_) {
            Closest best;
            search(mesh, u, m.at_u, p, best);
            search(mesh, v, m.at_v, p, best);
            const Index nearer = v_is_nearer ? m.at_v : m.at_u;
            for (std::uint32_t k = 0; k < width_; ++k) {
                new_values.push_back(best.face != no_index ? interpolate(best, k)
                                                           : values_[std::size_t{nearer} * width_ + k]);
            }
        }
        for (std::size_t i = 0; i < matches_.size(); ++i) {
            std::copy_n(&new_values[i * width_], width_, &values_[std::size_t{matches_[i].at_u} * width_]);
            reassign(mesh, v, matches_[i].at_v, matches_[i].at_u);
        }
    }

private:
    struct Match {
        Index at_u, at_v;
    };
    struct Closest {
        double distance = std::numeric_limits<double>::infinity();
        Index face = no_index;
        Vector3 barycentric = Vector3::Zero();
    };

    Index find_or_add(const float* value, std::vector<Index>& at_vertex) {
        for (const Index w : at_vertex) {
            if (std::equal(value, value + width_, &values_[std::size_t{w} * width_])) return w;
        }
        const auto wedge = static_cast<Index>(values_.size() / width_);
        values_.insert(values_.end(), value, value + width_);
        at_vertex.push_back(wedge);
        return wedge;
    }

    Index wedge_at(const CollapseMesh& mesh, Index f, Index v) const {
        const Triangle& t = mesh.triangle(f);
        const std::size_t corner = t[0] == v ? 0 : t[1] == v ? 1 : 2;
        return wedge_of_corner_[3 * std::size_t{f} + corner];
    }

    // Fills matches_ from the faces shared by u and v; false if one wedge would meet two.
    bool match(const CollapseMesh& mesh, Index u, Index v) {
        matches_.clear();
        bool good = true;
        mesh.for_each_face(u, [&](Index f, unsigned corner) {
            if (!mesh.has_corner(f, v)) return;
            const Match m{wedge_of_corner_[3 * std::size_t{f} + corner], wedge_at(mesh, f, v)};
            for (const Match& old : matches_) {
                if (old.at_u == m.at_u && old.at_v == m.at_v) return;
                if (old.at_u == m.at_u || old.at_v == m.at_v) good = false;
            }
            matches_.push_back(m);
        });
        return good;
    }

    bool has_unmatched(const CollapseMesh& mesh, Index v, Index Match::*side) const {
        return !mesh.all_of_faces(v, [&](Index f, unsigned corner) {
            const Index wedge = wedge_of_corner_[3 * std::size_t{f} + corner];
            return std::any_of(matches_.begin(), matches_.end(),
                               [&](const Match& m) { return m.*side == wedge; });
        });
    }

    void search(const CollapseMesh& mesh, Index v, Index wedge, const Vector3& p, Closest& best) const {
        mesh.for_each_face(v, [&](Index f, unsigned corner) {
            if (wedge_of_corner_[3 * std::size_t{f} + corner] != wedge) return;
            const Triangle& t = mesh.triangle(f);
            update_closest(p, f, mesh.position(t[0]), mesh.position(t[1]), mesh.position(t[2]), best);
        });
    }

    // Projects p into the plane of abc and clamps the barycentrics: exact inside, close enough at the rim.
    static void update_closest(const Vector3& p, Index f, const Vector3& a, const Vector3& b,
                               const Vector3& c, Closest& best) {
        const Vector3 n = area_vector(a, b, c);
        const double n2 = n.squaredNorm();
        if (!(n2 > 0)) return;
        Vector3 w(area_vector(p, b, c).dot(n) / n2, area_vector(a, p, c).dot(n) / n2, 0);
        w.z() = 1 - w.x() - w.y();
        w = w.cwiseMax(0);
        w /= w.sum();
        const double distance = (w.x() * a + w.y() * b + w.z() * c - p).squaredNorm();
        if (distance < best.distance) best = {distance, f, w};
    }

    float interpolate(const Closest& at, std::uint32_t k) const {
        double sum = 0;
        for (unsigned corner = 0; corner < 3; ++corner)
            sum += at.barycentric[corner] * values(at.face, corner)[k];
        return static_cast<float>(sum);
    }

    void reassign(const CollapseMesh& mesh, Index v, Index from, Index to) {
        mesh.for_each_face(v, [&](Index f, unsigned corner) {
            Index& wedge = wedge_of_corner_[3 * std::size_t{f} + corner];
            if (wedge == from) wedge = to;
        });
    }

    std::uint32_t width_ = 0;
    std::vector<Index> wedge_of_corner_;
    std::vector<float> values_;
    std::vector<Match> matches_;  // of the pair in hand
    std::vector<float> scratch_;
};

}  // namespace engine
FAQEM_NAMESPACE_END
