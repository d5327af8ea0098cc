#pragma once
/// \file
/// Corner attributes (UVs, colours) that are preserved during simplification.
///
/// The corners of a vertex with equal values form a wedge. A vertex with several wedges is on a seam. A
/// collapse merges the wedges that meet in a face it removes. It must not merge two wedges of one vertex,
/// because this would connect the UV charts on both sides of the seam.

#include <algorithm>
#include <limits>
#include <vector>

#include "faqem/engine/mesh/collapse_mesh.hpp"
#include "faqem/engine/quadric/placement.hpp"
#include "faqem/export.hpp"

FAQEM_ENGINE_BEGIN

/// The wedges of a mesh and their values. Empty, without memory or constraints, if there are no attributes.
/// Not thread-safe.
class Wedges {
public:
    Wedges() = default;

    /// Finds the wedges. O(corners) for a bounded number of wedges per vertex
    /// \param mesh             the initial mesh
    /// \param attributes       values for each corner of each face slot of `mesh`; width >= 1; copied
    Wedges(const CollapseMesh& mesh, const CornerAttributes& attributes)
        : width_(attributes.width), wedge_of_corner_(3 * mesh.face_slots(), no_index) {
        std::vector<Index> at_vertex;
        for (Index v = 0; v < mesh.vertex_slots(); ++v) {
            at_vertex.clear();
            mesh.for_each_face(v, [&](Index f, unsigned corner) {
                const std::size_t c = 3 * std::size_t{f} + corner;
                wedge_of_corner_[c] = find_or_add(&attributes.values[c * width_], at_vertex);
            });
        }
    }

    bool empty() const { return width_ == 0; }
    /// Number of floats per corner.
    std::uint32_t width() const { return width_; }
    /// Values of a corner of a face that is alive: width() floats. Valid until the next before_collapse().
    const float* values(Index face, unsigned corner) const {
        return &values_[std::size_t{wedge_of_corner_[3 * std::size_t{face} + corner]} * width_];
    }

    /// Whether the corners of v have different wedges. O(valence)
    bool is_seam(const CollapseMesh& mesh, Index v) const {
        Index first = no_index;
        return !mesh.all_of_faces(v, [&](Index f, unsigned corner) {
            const Index wedge = wedge_of_corner_[3 * std::size_t{f} + corner];
            if (first == no_index) first = wedge;
            return wedge == first;
        });
    }

    /// Positions that the pair (u, v) may be collapsed to without tearing a seam: a vertex with a wedge
    /// that has no counterpart at the other vertex must not move. O(valence)
    AllowedPosition allowed_position(const CollapseMesh& mesh, Index u, Index v) {
        if (empty()) return AllowedPosition::anywhere;
        if (!match(mesh, u, v)) return AllowedPosition::nowhere;
        return allowed_by_fixed(has_unmatched(mesh, u, &Match::at_u), has_unmatched(mesh, v, &Match::at_v));
    }

    /// Must be called before u and v are merged. Merges their wedges; each merged wedge gets the values
    /// interpolated at the point of its faces closest to p. O(valence)
    /// \param u, v  vertices of the pair
    /// \param p     position of the new vertex
    /// \pre allowed_position() is not `nowhere`
    void before_collapse(const CollapseMesh& mesh, Index u, Index v, const Vector3& p) {
        if (empty()) return;
        match(mesh, u, v);
        // If all faces of a wedge are without area, there is nothing to interpolate in, and the values of
        // the nearer vertex are used.
        const bool v_is_nearer = (mesh.position(v) - p).squaredNorm() < (mesh.position(u) - p).squaredNorm();
        std::vector<float>& new_values = scratch_;
        new_values.clear();
        for (const Match& m : matches_) {
            Closest best;
            search(mesh, u, m.at_u, p, best);
            search(mesh, v, m.at_v, p, best);
            const Index nearer = v_is_nearer ? m.at_v : m.at_u;
            for (std::uint32_t k = 0; k < width_; ++k)
                new_values.push_back(best.face != no_index ? interpolate(best, k)
                                                           : values_[std::size_t{nearer} * width_ + k]);
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
        for (const Index w : at_vertex)
            if (std::equal(value, value + width_, &values_[std::size_t{w} * width_])) return w;
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

    // Sets matches_ from the faces shared by u and v. Returns false if a wedge would be merged with two.
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
            return std::any_of(matches_.begin(), matches_.end(), [&](Match m) { return m.*side == wedge; });
        });
    }

    void search(const CollapseMesh& mesh, Index v, Index wedge, const Vector3& p, Closest& best) const {
        mesh.for_each_face(v, [&](Index f, unsigned corner) {
            if (wedge_of_corner_[3 * std::size_t{f} + corner] != wedge) return;
            const Triangle& t = mesh.triangle(f);
            update_closest(p, f, mesh.position(t[0]), mesh.position(t[1]), mesh.position(t[2]), best);
        });
    }

    // Projects p onto the plane of abc and clamps the barycentric coordinates. Exact inside the triangle,
    // approximate outside.
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
    std::vector<Match> matches_;  // wedges to merge at the current pair
    std::vector<float> scratch_;
};

FAQEM_ENGINE_END
