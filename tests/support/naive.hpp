#pragma once
/// \file
/// A slow reference implementation of the simplifier, written directly from the equations of the paper.

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "faqem/engine/constraints/legality.hpp"
#include "faqem/engine/metric/accumulated.hpp"
#include "faqem/history.hpp"
#include "support/meshes.hpp"

namespace faqem::test {

using engine::AreaTerm;
using engine::BaseWeight;
using engine::Candidate;
using engine::CollapseMesh;
using engine::CompositeWeights;
using engine::Legality;
using engine::PairTable;
using engine::Rules;
using engine::to_eigen;
using engine::Vector3;

/// Algorithm 1 of the paper with 4 x 4 matrices. Each collapse creates a vertex with a new index, and all
/// adjacency is recomputed.
class Naive {
public:
    Naive(const TriangleMesh& mesh, const CompositeWeights& weights, const Rules& rules)
        : faces_(mesh.triangles), weights_(weights), rules_(rules) {
        for (const Vec3& p : mesh.positions) positions_.push_back(to_eigen(p));
        for (const Triangle& t : faces_) {
            for (const Index v : t) box_.extend(positions_[v]);
        }
        const Edges all = edges(faces_);
        for (Index v = 0; v < positions_.size(); ++v) quadrics_.push_back(first_quadric(all, v));
        for (const auto& edge : all) evaluate(edge.first.first, edge.first.second);
    }

    // The collapses until the target is reached or no pair is left.
    std::vector<Collapse> run(std::size_t target) {
        while (faces_.size() > target && !queue_.empty()) {
            const auto best =
                std::min_element(queue_.begin(), queue_.end(),
                                 [](const auto& a, const auto& b) { return a.second.cost < b.second.cost; });
            const auto [u, v] = best->first;
            const Vector3 p = best->second.point;
            queue_.erase(best);
            if (!legal(u, v, p)) continue;
            collapse(u, v, p);
        }
        return trace_;
    }

private:
    using Matrix4 = Eigen::Matrix4d;

    static Matrix4 outer(const Vector3& n, const Vector3& through) {
        const Eigen::Vector4d p(n.x(), n.y(), n.z(), -n.dot(through));
        return p * p.transpose();
    }

    Matrix4 first_quadric(const Edges& all, Index v) const {
        Matrix4 q = Matrix4::Zero();
        Vector3 sum = Vector3::Zero();
        for (const Triangle& t : faces_) {
            if (!std::count(t.begin(), t.end(), v)) continue;
            const Vector3 n2 = engine::area_vector(positions_[t[0]], positions_[t[1]], positions_[t[2]]);
            const double area = n2.norm() / 2;
            const double w = weights_.base == BaseWeight::unit   ? 1
                             : weights_.base == BaseWeight::area ? area
                                                                 : 1 / (weights_.plane_area * area);
            q += w * outer(n2.normalized(), positions_[t[0]]);
            sum += n2;
        }
        q += weights_.normal * outer(sum.normalized(), positions_[v]);
        std::vector<Index> border;
        for (const auto& [edge, count] : all) {
            if (count == 1 && (edge.first == v || edge.second == v))
                border.push_back(edge.first == v ? edge.second : edge.first);
        }
        if (border.size() != 2) return q;
        const Vector3 &v1 = positions_[v], &v2 = positions_[border[0]], &v3 = positions_[border[1]];
        const Vector3 first = v3 - v2, second = v3 - 2 * v1 + v2;
        const double kappa = first.cross(second).norm() / std::pow(first.norm(), 3);
        q += weights_.boundary * kappa * (outer((v1 - v2).cross(v3 - v1), v1) + outer(v1 - v2, v1));
        return q;
    }

    Matrix4 area_quadric(const Edges& all, Index u, Index v) const {
        Matrix4 q = Matrix4::Zero();
        for (const auto& [edge, count] : all) {
            const auto [r, s] = edge;
            if (count != 1 || (r != u && r != v && s != u && s != v)) continue;
            const Vector3 e = positions_[s] - positions_[r], t = positions_[r].cross(positions_[s]);
            Eigen::Matrix<double, 3, 4> m;
            m << 0, -e.z(), e.y(), t.x(), e.z(), 0, -e.x(), t.y(), -e.y(), e.x(), 0, t.z();
            q += 0.5 * m.transpose() * m;
        }
        return q;
    }

    void evaluate(Index u, Index v) {
        const Edges all = edges(faces_);
        const auto error = [](const Matrix4& q, const Vector3& p) {
            const Eigen::Vector4d h = p.homogeneous();
            return h.dot(q * h);
        };
        Matrix4 q = quadrics_[u] + quadrics_[v];
        const Matrix4 area = weights_.area * area_quadric(all, u, v);
        if (weights_.area_term == AreaTerm::before_placement) q += area;
        const Eigen::Matrix3d a = q.topLeftCorner<3, 3>();
        const Vector3 b = q.topRightCorner<3, 1>();
        Vector3 p = a.fullPivLu().solve(-b);
        // Not in the paper: a minimum outside the bounding box by more than a tenth of its diagonal is
        // rejected.
        const double outside = std::max((box_.min() - p).maxCoeff(), (p - box_.max()).maxCoeff());
        const bool is_near = outside <= 0.1 * box_.diagonal().norm();
        if (!(a.determinant() > 1e-9 * std::pow(a.trace(), 3)) || !is_near) {
            p = positions_[u];
            for (const Vector3& other : {positions_[v], Vector3((positions_[u] + positions_[v]) / 2)}) {
                if (error(q, other) < error(q, p)) p = other;
            }
        }
        double cost = error(q, p);
        if (weights_.area_term == AreaTerm::after_placement) cost += error(area, p);
        queue_[std::minmax(u, v)] = {p, cost};
    }

    bool legal(Index u, Index v, const Vector3& p) const {
        const CollapseMesh collapse_mesh(positions_, faces_);
        const PairTable pairs(collapse_mesh, {});
        for (Index pair = 0; pair < pairs.size(); ++pair) {
            if (std::minmax(pairs.first(pair), pairs.second(pair)) == std::minmax(u, v))
                return !Legality(collapse_mesh).check(collapse_mesh, pairs, u, v, pair, p, rules_);
        }
        return false;
    }

    void collapse(Index u, Index v, const Vector3& p) {
        const Edges before = edges(faces_);
        const auto made = static_cast<Index>(positions_.size());
        trace_.push_back({std::min(u, v), std::max(u, v), engine::to_array(p)});
        positions_.push_back(p);
        quadrics_.push_back(quadrics_[u] + quadrics_[v]);
        std::vector<Triangle> left;
        for (Triangle t : faces_) {
            for (Index& corner : t) corner = corner == u || corner == v ? made : corner;
            if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) left.push_back(t);
        }
        faces_ = left;
        for (auto at = queue_.begin(); at != queue_.end();) {
            const auto [a, b] = at->first;
            at = a == u || a == v || b == u || b == v ? queue_.erase(at) : std::next(at);
        }
        const Edges after = edges(faces_);
        for (auto at = queue_.begin(); at != queue_.end();) {
            at = after.count(at->first) ? std::next(at) : queue_.erase(at);
        }
        const auto open = [](const Edges& all, std::pair<Index, Index> e) {
            const auto at = all.find(e);
            return at != all.end() && at->second == 1;
        };
        for (const auto& [edge, count] : after) {
            if (edge.second == made) evaluate(edge.first, made);  // the new vertex has the largest index
        }
        if (weights_.area == 0) return;
        for (Index n = 0; n < made; ++n) {
            if (!open(before, std::minmax(n, u)) && !open(before, std::minmax(n, v)) &&
                !open(after, std::minmax(n, made)))
                continue;
            for (const auto& [edge, count] : after) {
                if (edge.first == n || edge.second == n) evaluate(edge.first, edge.second);
            }
        }
    }

    std::vector<Vector3> positions_;
    std::vector<Triangle> faces_;
    Eigen::AlignedBox3d box_;
    std::vector<Matrix4> quadrics_;
    std::map<std::pair<Index, Index>, Candidate> queue_;
    std::vector<Collapse> trace_;
    CompositeWeights weights_;
    Rules rules_;
};

}  // namespace faqem::test
