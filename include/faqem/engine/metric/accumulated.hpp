#pragma once
/// \file
/// The metric with accumulated quadrics.

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "faqem/engine/constraints/feature_curves.hpp"
#include "faqem/engine/mesh/collapse_mesh.hpp"
#include "faqem/engine/mesh/pair_table.hpp"
#include "faqem/engine/metric/collapse_metric.hpp"
#include "faqem/engine/quadric/placement.hpp"
#include "faqem/engine/quadric/quadric.hpp"
#include "faqem/engine/quadric/terms.hpp"
#include "faqem/export.hpp"

FAQEM_ENGINE_BEGIN

/// How the area term is used.
enum class AreaTerm {
    after_placement,   ///< added to the cost at the position found without it (paper eq. 4)
    before_placement,  ///< included in the quadric that determines the position (Liu et al. 2024)
};

/// Weights of the paper's terms; weight 0 disables a term.
struct CompositeWeights {
    BaseWeight base = BaseWeight::unit;  ///< weight of the face planes
    double plane_area = 1;               ///< w of paper eq. 5, > 0; used with BaseWeight::inverse_area
    double boundary = 0;                 ///< boundary and curvature term (paper eq. 9)
    double normal = 0;                   ///< normal term (paper eq. 10)
    double area = 0;                     ///< area term (paper eq. 4)
    AreaTerm area_term = AreaTerm::after_placement;  ///< how the area term is used
    double seam = 1;                                 ///< factor on the initial quadric of seam vertices
    double min_area = 0;  ///< smaller face areas are clamped to this, engine units squared
};

/// The composite metric with accumulated quadrics: each vertex has the sum of the quadrics of all vertices
/// that were merged into it (paper, Algorithm 1; Garland and Heckbert 1997). Not thread-safe.
class AccumulatedMetric : public MetricDefaults {
public:
    /// \param weights      weights of the terms
    /// \param seam_vertex  empty, or one entry per vertex slot, nonzero for vertices on a UV seam; borrowed
    /// \param curves       boundaries between face groups, which are preserved by additional planes;
    ///     borrowed; null: none
    explicit AccumulatedMetric(const CompositeWeights& weights,
                               std::span<const std::uint8_t> seam_vertex = {},
                               const FeatureCurves* curves = nullptr)
        : weights_(weights), seam_vertex_(seam_vertex), curves_(curves) {}

    /// Computes the quadrics of the current mesh. O(faces)
    void initialise(const CollapseMesh& mesh, const PairTable& pairs) {
        quadrics_.assign(mesh.vertex_slots(), {});
        placement_bounds_.setEmpty();
        for (Index f = 0; f < mesh.face_slots(); ++f) {
            if (!mesh.is_alive(f)) continue;
            for (const Index v : mesh.triangle(f)) placement_bounds_.extend(mesh.position(v));
        }
        choose_origins(mesh, 1e-5 * placement_bounds_.diagonal().norm());
        for (Index f = 0; f < mesh.face_slots(); ++f) {
            if (!mesh.is_alive(f)) continue;
            const Triangle& t = mesh.triangle(f);
            const Vector3 n2 = mesh.area_vector(f);
            const auto term = [&](Index v) {
                return base_term(n2, relative(mesh.position(t[0]), v), weights_.base, weights_.plane_area,
                                 weights_.min_area);
            };
            if (origins_.empty()) {
                const Quadric q = term(t[0]);
                for (const Index v : t) quadrics_[v] += q;
            } else {
                for (const Index v : t) quadrics_[v] += term(v);
            }
        }
        for (Index v = 0; v < mesh.vertex_slots(); ++v) add_vertex_terms(mesh, pairs, v);
        placement_bounds_ = placement_bounds(placement_bounds_);
    }

    /// See CollapseMetric. O(1), or O(valence) at boundary vertices if the area term is used.
    std::optional<Candidate> evaluate(const CollapseMesh& mesh, const PairTable& pairs, Index pair,
                                      AllowedPosition allowed_position) const {
        if (allowed_position == AllowedPosition::nowhere) return std::nullopt;
        const Index u = pairs.first(pair), v = pairs.second(pair);
        Quadric q = quadrics_[u] + quadric_at(v, u);
        const bool has_area =
            weights_.area > 0 && (pairs.boundary_degree(u) > 0 || pairs.boundary_degree(v) > 0);
        Quadric area;
        if (has_area) {
            area = area_term(mesh, pairs, u, v, origin(u));
            area *= weights_.area;
            if (weights_.area_term == AreaTerm::before_placement) q += area;
        }
        const Vector3 a = relative(mesh.position(u), u), b = relative(mesh.position(v), u);
        const Eigen::AlignedBox3d bounds(relative(placement_bounds_.min(), u),
                                         relative(placement_bounds_.max(), u));
        const Vector3 p = optimal_position(q, a, b, allowed_position, &bounds);
        double cost = std::max(q(p), 0.0);
        if (has_area && weights_.area_term == AreaTerm::after_placement) cost += std::max(area(p), 0.0);
        if (!std::isfinite(cost)) return std::nullopt;
        if (origins_.empty()) return Candidate{p, cost};
        // Not rounded if it is the position of a vertex.
        if (p == a) return Candidate{mesh.position(u), cost};
        if (p == b) return Candidate{mesh.position(v), cost};
        return Candidate{p + origins_[u], cost};
    }

    void before_collapse(const CollapseMesh&, const PairTable&, Index survivor, Index removed,
                         const Vector3&) {
        quadrics_[survivor] += quadric_at(removed, survivor);
    }

    /// The costs of the neighbours' other pairs change only through the area term, which depends on the
    /// boundary edges at both vertices.
    Reevaluation reevaluation(const PairTable::Change& change) const {
        return weights_.area > 0 && change.boundary_changed ? Reevaluation::immediate : Reevaluation::none;
    }

    /// The accumulated quadric of vertex v, relative to origin(v).
    const Quadric& quadric(Index v) const { return quadrics_[v]; }

    /// Origin of the coordinates of the quadric of v: zero, or the initial position of v if its faces are tiny
    /// compared with the bounding box. There the rounding errors of a quadric about a common origin would exceed
    /// the distances to be measured.
    Vector3 origin(Index v) const { return origins_.empty() ? Vector3(Vector3::Zero()) : origins_[v]; }

private:
    // Sets origins_: the vertices whose edges are all shorter than `length` have their own one.
    void choose_origins(const CollapseMesh& mesh, double length) {
        origins_.clear();
        const auto is_tiny = [&](Index f) {
            const Triangle& t = mesh.triangle(f);
            double longest = 0;
            for (unsigned k = 0; k < 3; ++k) {
                const Vector3 edge = mesh.position(t[(k + 1) % 3]) - mesh.position(t[k]);
                longest = std::max(longest, edge.squaredNorm());
            }
            return longest < length * length;
        };
        for (Index v = 0; v < mesh.vertex_slots(); ++v) {
            if (mesh.degree(v) == 0 || !mesh.all_of_faces(v, [&](Index f, unsigned) { return is_tiny(f); }))
                continue;
            if (origins_.empty()) origins_.assign(mesh.vertex_slots(), Vector3::Zero());
            origins_[v] = mesh.position(v);
        }
    }

    // p in the coordinates of the quadric of v.
    Vector3 relative(const Vector3& p, Index v) const {
        return origins_.empty() ? p : Vector3(p - origins_[v]);
    }

    // The quadric of v in the coordinates of that of u.
    Quadric quadric_at(Index v, Index u) const {
        return origins_.empty() ? quadrics_[v] : quadrics_[v].relative_to(origins_[u] - origins_[v]);
    }

    void add_vertex_terms(const CollapseMesh& mesh, const PairTable& pairs, Index v) {
        Quadric& q = quadrics_[v];
        if (weights_.boundary > 0) {
            if (const auto ends = boundary_neighbours(pairs, v)) {
                Quadric term =
                    boundary_term(relative(mesh.position(v), v), relative(mesh.position((*ends)[0]), v),
                                  relative(mesh.position((*ends)[1]), v));
                term *= weights_.boundary;
                q += term;
            }
        }
        if (weights_.normal > 0) {
            Quadric normal = normal_term(mesh, v, origin(v));
            normal *= weights_.normal;
            q += normal;
        }
        if (curves_ && curves_->has_vertex(v)) add_curve_planes(mesh, v);
        if (!seam_vertex_.empty() && seam_vertex_[v]) q *= weights_.seam;
    }

    // On each edge between two groups, adds for each face a square perpendicular to it, with the edge as
    // its side (after Garland and Heckbert 1997).
    void add_curve_planes(const CollapseMesh& mesh, Index v) {
        curves_->for_each_curve_edge(mesh, v, [&](Index f, Index neighbour) {
            const Vector3 edge = mesh.position(neighbour) - mesh.position(v);
            const Vector3 across = edge.cross(mesh.area_vector(f).normalized());
            const double length = across.norm();
            if (!(length > 0)) return;
            quadrics_[v] += base_term(2 * edge.squaredNorm() / length * across, relative(mesh.position(v), v),
                                      weights_.base, weights_.plane_area, weights_.min_area);
        });
    }

    CompositeWeights weights_;
    std::span<const std::uint8_t> seam_vertex_;
    const FeatureCurves* curves_;
    std::vector<Quadric> quadrics_;
    std::vector<Vector3> origins_;          // see origin(); empty: all zero
    Eigen::AlignedBox3d placement_bounds_;  // bounds for new vertices: see placement_bounds()
};

static_assert(CollapseMetric<AccumulatedMetric>);

FAQEM_ENGINE_END
