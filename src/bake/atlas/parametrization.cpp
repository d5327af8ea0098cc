#include "bake/atlas/parametrization.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "bake/atlas/boundary_clearance.hpp"
#include "bake/atlas/triangle_overlap.hpp"
#include "faqem/engine/mesh/vector.hpp"

namespace faqem::detail {
namespace {

using engine::to_eigen;
using engine::Vector3;
using Complex = ChartPoint;
using Real = Eigen::SparseMatrix<double>;
using Hermitian = Eigen::SparseMatrix<Complex>;

constexpr double least_height = 1e-3;
constexpr int rounds = 10;

// A face by itself in the plane: corner 0 at the origin, corner 1 to the right, corner 2 above.
struct Local {
    std::array<Complex, 3> at;
    double area = 0;  // the true one, not that of `at`

    Complex edge(std::size_t k) const { return at[(k + 2) % 3] - at[(k + 1) % 3]; }  // opposite k
    double twice() const { return turn(at[0], at[1], at[2]); }
    // Half the cotangent of the angle at k.
    double weight(std::size_t k) const {
        const Complex a = at[(k + 1) % 3] - at[k], b = at[(k + 2) % 3] - at[k];
        return (std::conj(a) * b).real() / twice() / 2;
    }
};

Local local_of(const ChartFace& face) {
    std::array<Vector3, 3> p;
    for (std::size_t i = 0; i < 3; ++i) p[i] = to_eigen(face.corners[i]) * face.density;
    std::size_t longest = 0;
    std::array<double, 3> length;
    for (std::size_t k = 0; k < 3; ++k) {
        length[k] = (p[(k + 2) % 3] - p[(k + 1) % 3]).norm();
        if (length[k] > length[longest]) longest = k;
    }
    Local result;
    const double base = std::max(length[longest], 1e-9);
    const Vector3 &apex = p[longest], &from = p[(longest + 1) % 3], &to = p[(longest + 2) % 3];
    const double twice = engine::area_vector(apex, from, to).norm();
    result.area = twice / 2;
    const double along = length[longest] > 0 ? (apex - from).dot(to - from) / base : base / 2;
    result.at[(longest + 1) % 3] = {0, 0};
    result.at[(longest + 2) % 3] = {base, 0};
    result.at[longest] = {std::clamp(along, 0.0, base), std::max(twice / base, least_height * base)};
    const Complex origin = result.at[0],
                  turned = std::conj(result.at[1] - origin) / std::abs(result.at[1] - origin);
    for (Complex& z : result.at) z = (z - origin) * turned;
    return result;
}

// The faces as a mesh of their own: corners are one vertex if they meet over shared edges.
class Patch {
public:
    Patch(std::span<const ChartFace> all, std::vector<Index> faces) : all_(all), faces_(std::move(faces)) {
        std::vector<std::size_t> parent(3 * faces_.size());
        std::iota(parent.begin(), parent.end(), std::size_t{0});
        const auto root = [&](std::size_t i) {
            while (parent[i] != i) i = parent[i] = parent[parent[i]];
            return i;
        };
        const auto join = [&](std::size_t a, std::size_t b) {
            a = root(a);
            b = root(b);
            parent[std::max(a, b)] = std::min(a, b);
        };
        for (std::size_t i = 0; i < faces_.size(); ++i) {
            for (std::size_t c = 0; c < 3; ++c) {
                const Across& across = all[faces_[i]].across[c];
                if (across.triangle == no_index || across.triangle < faces_[i]) continue;
                const auto found = std::lower_bound(faces_.begin(), faces_.end(), across.triangle);
                if (found == faces_.end() || *found != across.triangle) continue;
                const auto j = static_cast<std::size_t>(found - faces_.begin());
                join(3 * i + (c + 1) % 3, 3 * j + (across.corner + 2) % 3);
                join(3 * i + (c + 2) % 3, 3 * j + (across.corner + 1) % 3);
            }
        }
        corner_.resize(parent.size());
        std::vector<Index> number(parent.size());
        for (std::size_t i = 0; i < parent.size(); ++i) {
            if (parent[i] == i) number[i] = vertices_++;
            corner_[i] = number[root(i)];
        }
        for (Index f : faces_) {
            locals_.push_back(local_of(all[f]));
            area_ += locals_.back().area;
        }
    }

    std::size_t size() const { return faces_.size(); }
    Index vertices() const { return vertices_; }
    Index vertex(std::size_t i, std::size_t c) const { return corner_[3 * i + c]; }
    const Local& local(std::size_t i) const { return locals_[i]; }
    double area() const { return area_; }
    std::vector<Index>& faces() { return faces_; }

    std::array<Complex, 3> placed(const std::vector<Complex>& z, std::size_t i) const {
        return {z[vertex(i, 0)], z[vertex(i, 1)], z[vertex(i, 2)]};
    }

    // Along the mean normal. Faces have their own densities, so vertices take a mean.
    std::vector<Complex> projected() const {
        Vector3 normal = Vector3::Zero();
        double weight = 0, density = 0;
        for (std::size_t i = 0; i < size(); ++i) {
            const ChartFace& face = all_[faces_[i]];
            normal += engine::area_vector(to_eigen(face.corners[0]), to_eigen(face.corners[1]),
                                          to_eigen(face.corners[2]));
            weight += locals_[i].area;
            density += locals_[i].area * face.density;
        }
        std::vector<Complex> result(vertices_);
        if (!(normal.norm() > 0)) return result;
        normal.normalize();
        const Vector3 right = normal.unitOrthogonal(), up = normal.cross(right);
        const double scale = density / weight;
        const Vector3 origin = to_eigen(all_[faces_[0]].corners[0]);
        for (std::size_t i = 0; i < size(); ++i) {
            for (std::size_t c = 0; c < 3; ++c) {
                const Vector3 p = scale * (to_eigen(all_[faces_[i]].corners[c]) - origin);
                result[vertex(i, c)] = {p.dot(right), p.dot(up)};
            }
        }
        return result;
    }

private:
    std::span<const ChartFace> all_;
    std::vector<Index> faces_;
    std::vector<Index> corner_;
    std::vector<Local> locals_;
    Index vertices_ = 0;
    double area_ = 0;
};

bool upright(const std::array<Complex, 3>& t) {
    const double size = std::norm(t[1] - t[0]) + std::norm(t[2] - t[0]);
    return turn(t[0], t[1], t[2]) > 1e-10 * size && std::isfinite(size);
}

std::vector<Index> turned_faces(Patch& patch, const std::vector<Complex>& z) {
    std::vector<Index> result;
    for (std::size_t i = 0; i < patch.size(); ++i) {
        if (!upright(patch.placed(z, i))) result.push_back(patch.faces()[i]);
    }
    return result;
}

// Flat over wanted area.
double area_ratio(const Patch& patch, const std::vector<Complex>& z) {
    double twice = 0;
    for (std::size_t i = 0; i < patch.size(); ++i) {
        const auto t = patch.placed(z, i);
        twice += turn(t[0], t[1], t[2]);
    }
    return twice / 2 / patch.area();
}

double stretch_of(const Patch& patch, const std::vector<Complex>& z) {
    const double ratio = area_ratio(patch, z);
    if (!(ratio > 0)) return HUGE_VAL;
    double sum = 0;
    for (std::size_t i = 0; i < patch.size(); ++i) {
        const Local& local = patch.local(i);
        const auto t = patch.placed(z, i);
        // u = a x + b conj(x): stretches |a| + |b| and |a| - |b|.
        const Complex e = local.at[1] - local.at[0], f = local.at[2] - local.at[0];
        const Complex u = t[1] - t[0], v = t[2] - t[0], det = {0, -2 * local.twice()};
        const double a = std::abs((u * std::conj(f) - v * std::conj(e)) / det);
        const double b = std::abs((e * v - f * u) / det);
        const double s1 = (a + b) * (a + b) / ratio, s2 = (a - b) * (a - b) / ratio;
        sum += local.area * (s1 + s2 + 1 / s1 + 1 / s2) / 4;
    }
    const double result = sum / patch.area();
    return std::isfinite(result) ? result : HUGE_VAL;
}

// The two vertices that are farthest along the axis along which the faces are longest.
std::array<std::pair<Index, double>, 2> far_vertices(const Patch& patch, std::span<const ChartFace> all,
                                                     const std::vector<Index>& faces) {
    Vector3 low = to_eigen(all[faces[0]].corners[0]), high = low;
    for (Index f : faces) {
        for (const Vec3& p : all[f].corners) {
            low = low.cwiseMin(to_eigen(p));
            high = high.cwiseMax(to_eigen(p));
        }
    }
    Eigen::Index axis = 0;
    (high - low).maxCoeff(&axis);
    std::array<std::pair<Index, double>, 2> result = {{{0, HUGE_VAL}, {0, -HUGE_VAL}}};
    for (std::size_t i = 0; i < faces.size(); ++i) {
        for (std::size_t c = 0; c < 3; ++c) {
            const double x = all[faces[i]].corners[c][static_cast<std::size_t>(axis)] * all[faces[0]].density;
            if (x < result[0].second) result[0] = {patch.vertex(i, c), x};
            if (x > result[1].second) result[1] = {patch.vertex(i, c), x};
        }
    }
    return result;
}

// Least squares conformal map; empty if the system has no solution. Two vertices are held.
std::vector<Complex> conformal(const Patch& patch, std::span<const ChartFace> all,
                               const std::vector<Index>& faces) {
    const auto held = far_vertices(patch, all, faces);
    if (held[0].first == held[1].first) return {};
    std::vector<Eigen::Triplet<Complex>> entries;
    Eigen::VectorXcd right = Eigen::VectorXcd::Zero(patch.vertices());
    const auto is_held = [&](Index v) { return v == held[0].first || v == held[1].first; };
    for (std::size_t i = 0; i < patch.size(); ++i) {
        const Local& local = patch.local(i);
        for (std::size_t j = 0; j < 3; ++j) {
            const Index row = patch.vertex(i, j);
            if (is_held(row)) continue;
            for (std::size_t k = 0; k < 3; ++k) {
                const Complex value = std::conj(local.edge(j)) * local.edge(k) / local.twice();
                const Index column = patch.vertex(i, k);
                if (is_held(column)) {
                    right[row] -= value * (column == held[0].first ? held[0].second : held[1].second);
                } else {
                    entries.emplace_back(row, column, value);
                }
            }
        }
    }
    for (const auto& [vertex, x] : held) {
        entries.emplace_back(vertex, vertex, 1.0);
        right[vertex] = x;
    }
    Hermitian matrix(patch.vertices(), patch.vertices());
    matrix.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLDLT<Hermitian> solver(matrix);
    if (solver.info() != Eigen::Success) return {};
    const Eigen::VectorXcd solution = solver.solve(right);
    std::vector<Complex> result(patch.vertices());
    for (Index v = 0; v < patch.vertices(); ++v) result[v] = solution[v];
    return result;
}

// Rounds of: the best rotation of every face, then the vertices that fit them best.
class RigidRounds {
public:
    explicit RigidRounds(const Patch& patch) : patch_(patch) {
        std::vector<Eigen::Triplet<double>> entries;
        for (std::size_t i = 0; i < patch.size(); ++i) {
            for (std::size_t k = 0; k < 3; ++k) {
                const double w = patch.local(i).weight(k);
                const Index a = patch.vertex(i, (k + 1) % 3), b = patch.vertex(i, (k + 2) % 3);
                entries.emplace_back(a, a, w);
                entries.emplace_back(b, b, w);
                entries.emplace_back(a, b, -w);
                entries.emplace_back(b, a, -w);
            }
        }
        entries.emplace_back(0, 0, 1.0);  // holds it in place
        Real matrix(patch.vertices(), patch.vertices());
        matrix.setFromTriplets(entries.begin(), entries.end());
        solver_.compute(matrix);
    }

    bool usable() const { return solver_.info() == Eigen::Success; }

    std::vector<Complex> next(const std::vector<Complex>& z) const {
        Eigen::MatrixX2d right = Eigen::MatrixX2d::Zero(patch_.vertices(), 2);
        for (std::size_t i = 0; i < patch_.size(); ++i) {
            const Local& local = patch_.local(i);
            Complex rotation = 0;
            for (std::size_t k = 0; k < 3; ++k) {
                const Complex u = z[patch_.vertex(i, (k + 2) % 3)] - z[patch_.vertex(i, (k + 1) % 3)];
                rotation += local.weight(k) * u * std::conj(local.edge(k));
            }
            const double size = std::abs(rotation);
            rotation = size > 0 ? rotation / size : Complex(1);
            for (std::size_t k = 0; k < 3; ++k) {
                const Complex pull = local.weight(k) * rotation * local.edge(k);
                const Index a = patch_.vertex(i, (k + 1) % 3), b = patch_.vertex(i, (k + 2) % 3);
                right.row(b) += Eigen::RowVector2d(pull.real(), pull.imag());
                right.row(a) -= Eigen::RowVector2d(pull.real(), pull.imag());
            }
        }
        const Eigen::MatrixX2d solution = solver_.solve(right);
        std::vector<Complex> result(patch_.vertices());
        for (Index v = 0; v < patch_.vertices(); ++v) result[v] = {solution(v, 0), solution(v, 1)};
        return result;
    }

private:
    const Patch& patch_;
    Eigen::SimplicialLDLT<Real> solver_;
};

// The area that is wanted; one face alone keeps its shape.
Chart chart_of(Patch& patch, const std::vector<Complex>& z, double stretch) {
    Chart chart;
    const double ratio = area_ratio(patch, z);
    const double scale = patch.area() > 0 && ratio > 0 ? 1 / std::sqrt(ratio) : 1;
    for (std::size_t i = 0; i < patch.size(); ++i) {
        auto t = patch.placed(z, i);
        for (Complex& corner : t) corner *= scale;
        chart.places.push_back(t);
    }
    chart.faces = std::move(patch.faces());
    chart.stretch = stretch;
    chart.texels = patch.area();
    return chart;
}

}  // namespace

Flattening flatten(std::span<const ChartFace> all, std::vector<Index> faces, std::uint64_t& work,
                   engine::Poll poll) {
    Flattening result;
    if (faces.size() > most_faces_per_chart) return result;
    poll(faces.size());
    Patch patch(all, std::move(faces));
    if (patch.size() == 1) {
        const Local& local = patch.local(0);
        result.chart = {patch.faces(), {local.at}, 1, local.area};
        result.outcome = Flattening::Outcome::flat;
        return result;
    }
    const std::uint64_t cost = flatten_work * patch.size();
    if (work < cost) {
        work = 0;
        return result;
    }
    work -= cost;
    std::vector<Complex> z = patch.projected(), best;
    if (!turned_faces(patch, z).empty()) {
        z = conformal(patch, all, patch.faces());
        if (z.empty()) return result;
    }
    double least = HUGE_VAL;
    poll(patch.size());
    const RigidRounds rigid(patch);
    for (int round = 0;; ++round) {
        poll(patch.size());
        const std::vector<Index> turned = turned_faces(patch, z);
        if (turned.empty()) {
            const double stretch = stretch_of(patch, z);
            const bool settled = !(stretch < least * (1 - 1e-4));
            if (stretch < least) {
                least = stretch;
                best = z;
            }
            if (settled) break;
        }
        if (best.empty() && (result.turned.empty() || turned.size() < result.turned.size())) {
            result.turned = turned;
        }
        if (round == rounds || !rigid.usable()) break;
        z = rigid.next(z);
    }
    if (best.empty()) {
        result.outcome = Flattening::Outcome::turned;
        return result;
    }
    result.turned.clear();
    Chart chart = chart_of(patch, best, least);
    if (!apart(chart.places, work, poll) || !outline_is_clear(all, chart, work, poll)) return result;
    result.chart = std::move(chart);
    result.outcome = Flattening::Outcome::flat;
    return result;
}

}  // namespace faqem::detail
