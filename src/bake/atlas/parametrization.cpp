#include "bake/atlas/parametrization.hpp"

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>

#include "bake/atlas/triangle_overlap.hpp"
#include "faqem/detail/base/portable_math.hpp"
#include "faqem/detail/base/vector.hpp"
#include "faqem/engine/mesh/union_find.hpp"

namespace faqem::detail {
namespace {

// Points of the plane as complex numbers: a least squares conformal map is the solution of a linear system over
// them, and a rotation is a multiplication.
using ComplexPoint = std::complex<double>;
using RealMatrix = Eigen::SparseMatrix<double>;
using HermitianMatrix = Eigen::SparseMatrix<ComplexPoint>;

constexpr double min_height_ratio = 1e-3;
constexpr int max_iterations = 10;

// Twice the signed area of the triangle (a, b, c); positive if it is counter-clockwise.
double twice_signed_area(const ComplexPoint& a, const ComplexPoint& b, const ComplexPoint& c) {
    return (std::conj(b - a) * (c - a)).imag();
}

// The distance from 0. That of std::abs(), as a quotient of complex numbers, rounds differently with each C library.
double magnitude(const ComplexPoint& z) { return portable_length(z.real(), z.imag(), 0); }

// The corners of a triangle as points of a chart.
Triangle2 to_points(const std::array<ComplexPoint, 3>& t) {
    return {Point2{t[0].real(), t[0].imag()}, {t[1].real(), t[1].imag()}, {t[2].real(), t[2].imag()}};
}

// A face mapped isometrically to the plane: corner 0 at the origin, corner 1 on the positive x axis, corner 2
// above it.
struct LocalTriangle {
    std::array<ComplexPoint, 3> at;
    double area = 0;  // of the input face; `at` may have a larger height, see min_height_ratio

    // The edge opposite corner k.
    ComplexPoint edge(std::size_t k) const { return at[(k + 2) % 3] - at[(k + 1) % 3]; }
    double twice_area() const { return twice_signed_area(at[0], at[1], at[2]); }
    // Half the cotangent of the angle at corner k.
    double half_cotangent(std::size_t k) const {
        const ComplexPoint a = at[(k + 1) % 3] - at[k], b = at[(k + 2) % 3] - at[k];
        return (std::conj(a) * b).real() / twice_area() / 2;
    }
};

LocalTriangle local_triangle(const PageTriangle& face) {
    std::array<Vector3, 3> p;
    for (std::size_t i = 0; i < 3; ++i) p[i] = to_eigen(face.corners[i]) * face.density;
    std::size_t longest = 0;
    std::array<double, 3> length;
    for (std::size_t k = 0; k < 3; ++k) {
        length[k] = (p[(k + 2) % 3] - p[(k + 1) % 3]).norm();
        if (length[k] > length[longest]) longest = k;
    }
    LocalTriangle result;
    const double base = std::max(length[longest], 1e-9);
    const Vector3 &apex = p[longest], &from = p[(longest + 1) % 3], &to = p[(longest + 2) % 3];
    const double twice = engine::area_vector(apex, from, to).norm();
    result.area = twice / 2;
    const double along = length[longest] > 0 ? (apex - from).dot(to - from) / base : base / 2;
    result.at[(longest + 1) % 3] = {0, 0};
    result.at[(longest + 2) % 3] = {base, 0};
    result.at[longest] = {std::clamp(along, 0.0, base), std::max(twice / base, min_height_ratio * base)};
    const ComplexPoint origin = result.at[0],
                       rotation = std::conj(result.at[1] - origin) / magnitude(result.at[1] - origin);
    for (ComplexPoint& z : result.at) z = (z - origin) * rotation;
    return result;
}

// The faces of one chart as an indexed mesh. Corners are the same vertex if shared edges connect them.
class ChartMesh {
public:
    ChartMesh(std::span<const PageTriangle> all, std::vector<Index> faces)
        : all_(all), faces_(std::move(faces)) {
        engine::UnionFind joined(3 * faces_.size());
        for (Index i = 0; i < faces_.size(); ++i) {
            for (Index c = 0; c < 3; ++c) {
                const AdjacentTriangle& adjacent = all[faces_[i]].adjacent[c];
                if (adjacent.triangle == no_index || adjacent.triangle < faces_[i]) continue;
                const auto found = std::lower_bound(faces_.begin(), faces_.end(), adjacent.triangle);
                if (found == faces_.end() || *found != adjacent.triangle) continue;
                const auto j = static_cast<Index>(found - faces_.begin());
                const Index corner = adjacent.corner;
                joined.unite(3 * i + (c + 1) % 3, 3 * j + (corner + 2) % 3);
                joined.unite(3 * i + (c + 2) % 3, 3 * j + (corner + 1) % 3);
            }
        }
        corner_.resize(3 * faces_.size());
        for (Index i = 0; i < corner_.size(); ++i) {
            const Index first = joined.find(i);
            corner_[i] = first == i ? vertices_++ : corner_[first];
        }
        for (Index f : faces_) {
            locals_.push_back(local_triangle(all[f]));
            area_ += locals_.back().area;
        }
    }

    std::size_t size() const { return faces_.size(); }
    Index vertices() const { return vertices_; }
    Index vertex(std::size_t i, std::size_t c) const { return corner_[3 * i + c]; }
    const PageTriangle& face(std::size_t i) const { return all_[faces_[i]]; }
    const LocalTriangle& local(std::size_t i) const { return locals_[i]; }
    double area() const { return area_; }
    std::vector<Index>& faces() { return faces_; }

    std::array<ComplexPoint, 3> triangle(const std::vector<ComplexPoint>& z, std::size_t i) const {
        return {z[vertex(i, 0)], z[vertex(i, 1)], z[vertex(i, 2)]};
    }

    // Projection along the mean normal. Densities differ by face, so all vertices are scaled by their mean.
    std::vector<ComplexPoint> planar_projection() const {
        Vector3 normal = Vector3::Zero();
        double weight = 0, density = 0;
        for (std::size_t i = 0; i < size(); ++i) {
            normal += area_vector(face(i));
            weight += locals_[i].area;
            density += locals_[i].area * face(i).density;
        }
        std::vector<ComplexPoint> result(vertices_);
        if (!(normal.norm() > 0)) return result;
        normal.normalize();
        const Vector3 right = normal.unitOrthogonal(), up = normal.cross(right);
        const double scale = density / weight;
        const Vector3 origin = to_eigen(face(0).corners[0]);
        for (std::size_t i = 0; i < size(); ++i) {
            for (std::size_t c = 0; c < 3; ++c) {
                const Vector3 p = scale * (to_eigen(face(i).corners[c]) - origin);
                result[vertex(i, c)] = {p.dot(right), p.dot(up)};
            }
        }
        return result;
    }

private:
    std::span<const PageTriangle> all_;
    std::vector<Index> faces_;
    std::vector<Index> corner_;
    std::vector<LocalTriangle> locals_;
    Index vertices_ = 0;
    double area_ = 0;
};

bool is_positively_oriented(const std::array<ComplexPoint, 3>& t) {
    const double size = std::norm(t[1] - t[0]) + std::norm(t[2] - t[0]);
    return twice_signed_area(t[0], t[1], t[2]) > 1e-10 * size && std::isfinite(size);
}

std::vector<Index> flipped_faces_of(ChartMesh& chart_mesh, const std::vector<ComplexPoint>& z) {
    std::vector<Index> result;
    for (std::size_t i = 0; i < chart_mesh.size(); ++i)
        if (!is_positively_oriented(chart_mesh.triangle(z, i))) result.push_back(chart_mesh.faces()[i]);
    return result;
}

// Area of the flattened faces divided by the wanted area.
double area_ratio(const ChartMesh& chart_mesh, const std::vector<ComplexPoint>& z) {
    double twice = 0;
    for (std::size_t i = 0; i < chart_mesh.size(); ++i) {
        const auto t = chart_mesh.triangle(z, i);
        twice += twice_signed_area(t[0], t[1], t[2]);
    }
    return twice / 2 / chart_mesh.area();
}

double stretch_of(const ChartMesh& chart_mesh, const std::vector<ComplexPoint>& z) {
    const double ratio = area_ratio(chart_mesh, z);
    if (!(ratio > 0)) return HUGE_VAL;
    double sum = 0;
    for (std::size_t i = 0; i < chart_mesh.size(); ++i) {
        const LocalTriangle& local = chart_mesh.local(i);
        const auto t = chart_mesh.triangle(z, i);
        // The face's map is u = a x + b conj(x), with the singular values |a| + |b| and |a| - |b|.
        const ComplexPoint e = local.at[1] - local.at[0], f = local.at[2] - local.at[0];
        const ComplexPoint u = t[1] - t[0], v = t[2] - t[0];
        const double a = magnitude(u * std::conj(f) - v * std::conj(e)) / (2 * local.twice_area());
        const double b = magnitude(e * v - f * u) / (2 * local.twice_area());
        const double s1 = (a + b) * (a + b) / ratio, s2 = (a - b) * (a - b) / ratio;
        sum += local.area * (s1 + s2 + 1 / s1 + 1 / s2) / 4;
    }
    const double result = sum / chart_mesh.area();
    return std::isfinite(result) ? result : HUGE_VAL;
}

// The two vertices with the smallest and the largest coordinate along the longest axis of the bounding box,
// each with this coordinate in texels.
std::array<std::pair<Index, double>, 2> pinned_vertices(const ChartMesh& chart_mesh) {
    Eigen::AlignedBox3d box;
    for (std::size_t i = 0; i < chart_mesh.size(); ++i)
        for (const Vec3& p : chart_mesh.face(i).corners) box.extend(to_eigen(p));
    Eigen::Index axis = 0;
    box.sizes().maxCoeff(&axis);
    std::array<std::pair<Index, double>, 2> result = {{{0, HUGE_VAL}, {0, -HUGE_VAL}}};
    for (std::size_t i = 0; i < chart_mesh.size(); ++i) {
        for (std::size_t c = 0; c < 3; ++c) {
            const double x =
                chart_mesh.face(i).corners[c][static_cast<std::size_t>(axis)] * chart_mesh.face(0).density;
            if (x < result[0].second) result[0] = {chart_mesh.vertex(i, c), x};
            if (x > result[1].second) result[1] = {chart_mesh.vertex(i, c), x};
        }
    }
    return result;
}

// Least squares conformal map with two pinned vertices; empty if the linear system cannot be solved.
std::vector<ComplexPoint> least_squares_conformal_map(const ChartMesh& chart_mesh) {
    const auto pinned = pinned_vertices(chart_mesh);
    if (pinned[0].first == pinned[1].first) return {};
    std::vector<Eigen::Triplet<ComplexPoint>> entries;
    Eigen::VectorXcd right = Eigen::VectorXcd::Zero(chart_mesh.vertices());
    const auto is_pinned = [&](Index v) { return v == pinned[0].first || v == pinned[1].first; };
    for (std::size_t i = 0; i < chart_mesh.size(); ++i) {
        const LocalTriangle& local = chart_mesh.local(i);
        for (std::size_t j = 0; j < 3; ++j) {
            const Index row = chart_mesh.vertex(i, j);
            if (is_pinned(row)) continue;
            for (std::size_t k = 0; k < 3; ++k) {
                const ComplexPoint value = std::conj(local.edge(j)) * local.edge(k) / local.twice_area();
                const Index column = chart_mesh.vertex(i, k);
                if (is_pinned(column))
                    right[row] -= value * (column == pinned[0].first ? pinned[0].second : pinned[1].second);
                else
                    entries.emplace_back(row, column, value);
            }
        }
    }
    for (const auto& [vertex, x] : pinned) {
        entries.emplace_back(vertex, vertex, 1.0);
        right[vertex] = x;
    }
    HermitianMatrix matrix(chart_mesh.vertices(), chart_mesh.vertices());
    matrix.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLDLT<HermitianMatrix> solver(matrix);
    if (solver.info() != Eigen::Success) return {};
    const Eigen::VectorXcd solution = solver.solve(right);
    return {solution.data(), solution.data() + solution.size()};
}

// As-rigid-as-possible parametrization. An iteration finds the best rotation of every face (local step), then
// the vertex positions that fit these rotations best (global step).
class ArapSolver {
public:
    explicit ArapSolver(const ChartMesh& chart_mesh) : chart_mesh_(chart_mesh) {
        std::vector<Eigen::Triplet<double>> entries;
        for (std::size_t i = 0; i < chart_mesh.size(); ++i) {
            for (std::size_t k = 0; k < 3; ++k) {
                const double w = chart_mesh.local(i).half_cotangent(k);
                const Index a = chart_mesh.vertex(i, (k + 1) % 3), b = chart_mesh.vertex(i, (k + 2) % 3);
                entries.emplace_back(a, a, w);
                entries.emplace_back(b, b, w);
                entries.emplace_back(a, b, -w);
                entries.emplace_back(b, a, -w);
            }
        }
        entries.emplace_back(0, 0, 1.0);  // pins vertex 0: the solution is unique up to a translation only
        RealMatrix matrix(chart_mesh.vertices(), chart_mesh.vertices());
        matrix.setFromTriplets(entries.begin(), entries.end());
        solver_.compute(matrix);
    }

    bool is_factorized() const { return solver_.info() == Eigen::Success; }

    std::vector<ComplexPoint> iterate(const std::vector<ComplexPoint>& z) const {
        Eigen::MatrixX2d right = Eigen::MatrixX2d::Zero(chart_mesh_.vertices(), 2);
        for (std::size_t i = 0; i < chart_mesh_.size(); ++i) {
            const LocalTriangle& local = chart_mesh_.local(i);
            ComplexPoint rotation = 0;
            for (std::size_t k = 0; k < 3; ++k) {
                const ComplexPoint u =
                    z[chart_mesh_.vertex(i, (k + 2) % 3)] - z[chart_mesh_.vertex(i, (k + 1) % 3)];
                rotation += local.half_cotangent(k) * u * std::conj(local.edge(k));
            }
            const double size = magnitude(rotation);
            rotation = size > 0 ? rotation / size : ComplexPoint(1);
            for (std::size_t k = 0; k < 3; ++k) {
                const ComplexPoint edge = local.half_cotangent(k) * rotation * local.edge(k);
                const Index a = chart_mesh_.vertex(i, (k + 1) % 3), b = chart_mesh_.vertex(i, (k + 2) % 3);
                right.row(b) += Eigen::RowVector2d(edge.real(), edge.imag());
                right.row(a) -= Eigen::RowVector2d(edge.real(), edge.imag());
            }
        }
        const Eigen::MatrixX2d solution = solver_.solve(right);
        std::vector<ComplexPoint> result(chart_mesh_.vertices());
        for (Index v = 0; v < chart_mesh_.vertices(); ++v) result[v] = {solution(v, 0), solution(v, 1)};
        return result;
    }

private:
    const ChartMesh& chart_mesh_;
    Eigen::SimplicialLDLT<RealMatrix> solver_;
};

// Makes a chart of the wanted area from the map `z`.
Chart make_chart(ChartMesh& chart_mesh, const std::vector<ComplexPoint>& z, double stretch) {
    Chart chart;
    const double ratio = area_ratio(chart_mesh, z);
    const double scale = chart_mesh.area() > 0 && ratio > 0 ? 1 / std::sqrt(ratio) : 1;
    for (std::size_t i = 0; i < chart_mesh.size(); ++i) {
        auto t = chart_mesh.triangle(z, i);
        for (ComplexPoint& corner : t) corner *= scale;
        chart.points.push_back(to_points(t));
    }
    chart.faces = std::move(chart_mesh.faces());
    chart.stretch = stretch;
    chart.texels = chart_mesh.area();
    return chart;
}

}  // namespace

Parametrization parametrize(std::span<const PageTriangle> all, std::vector<Index> faces,
                            std::uint64_t& work) {
    Parametrization result;
    if (faces.size() > max_faces_per_chart) return result;
    ChartMesh chart_mesh(all, std::move(faces));
    if (chart_mesh.size() == 1) {
        const LocalTriangle& local = chart_mesh.local(0);
        result.chart = {chart_mesh.faces(), {to_points(local.at)}, 1, local.area};
        result.outcome = Parametrization::Outcome::valid;
        return result;
    }
    const std::uint64_t cost = parametrization_work_per_face * chart_mesh.size();
    if (work < cost) {
        work = 0;
        return result;
    }
    work -= cost;
    std::vector<ComplexPoint> z = chart_mesh.planar_projection(), best;
    if (!flipped_faces_of(chart_mesh, z).empty()) {
        z = least_squares_conformal_map(chart_mesh);
        if (z.empty()) return result;
    }
    double least = HUGE_VAL;
    const ArapSolver arap(chart_mesh);
    for (int round = 0;; ++round) {
        const std::vector<Index> flipped = flipped_faces_of(chart_mesh, z);
        if (flipped.empty()) {
            const double stretch = stretch_of(chart_mesh, z);
            const bool settled = !(stretch < least * (1 - 1e-4));
            if (stretch < least) {
                least = stretch;
                best = z;
            }
            if (settled) break;
        }
        if (best.empty() && (result.flipped_faces.empty() || flipped.size() < result.flipped_faces.size()))
            result.flipped_faces = flipped;
        if (round == max_iterations || !arap.is_factorized()) break;
        z = arap.iterate(z);
    }
    if (best.empty()) {
        result.outcome = Parametrization::Outcome::flipped;
        return result;
    }
    result.flipped_faces.clear();
    Chart chart = make_chart(chart_mesh, best, least);
    if (!have_disjoint_interiors(chart.points, work) || !has_boundary_clearance(all, chart, work))
        return result;
    result.chart = std::move(chart);
    result.outcome = Parametrization::Outcome::valid;
    return result;
}

}  // namespace faqem::detail
