#include "soak/check.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace faqem::soak {

namespace {

// Limit of outside_box(). Optimal vertices of coarse meshes are outside the original surface.
constexpr double most_outside = 1;

template <class T>
bool strictly_ascending(const std::vector<T>& values) {
    return std::adjacent_find(values.begin(), values.end(), std::greater_equal<>()) == values.end();
}

// Checks positions, indices and attributes.
std::string fault_of_arrays(const TriangleMesh& mesh) {
    std::vector<bool> used(mesh.positions.size());
    for (const Vec3& p : mesh.positions)
        if (!std::all_of(p.begin(), p.end(), [](double x) { return std::isfinite(x); }))
            return "a position is not finite";
    for (const Triangle& t : mesh.triangles) {
        for (const Index v : t) {
            if (!(v < used.size())) return "a vertex index is out of range";
            used[v] = true;
        }
        if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) return "a face has two equal corners";
    }
    if (!std::all_of(used.begin(), used.end(), [](bool is_used) { return is_used; }))
        return "a vertex is not referenced";
    for (const float x : mesh.attributes.values)
        if (!std::isfinite(x)) return "an attribute is not finite";
    return {};
}

// Ratio of the height of a face to its longest edge; 0 if all corners coincide.
double flatness(const TriangleMesh& mesh, const Triangle& t) {
    Vec3 edge[3];
    double longest = 0;
    for (unsigned k = 0; k < 3; ++k) {
        for (unsigned i = 0; i < 3; ++i)
            edge[k][i] = mesh.positions[t[(k + 1) % 3]][i] - mesh.positions[t[k]][i];
        longest = std::max(longest, std::hypot(edge[k][0], edge[k][1], edge[k][2]));
    }
    if (longest == 0) return 0;
    for (Vec3& e : edge)
        for (double& x : e) x /= longest;
    const auto [ax, ay, az] = edge[0];
    const auto [bx, by, bz] = edge[1];
    return std::hypot(ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx);
}

bool is_line(const TriangleMesh& mesh) {
    return std::all_of(mesh.triangles.begin(), mesh.triangles.end(),
                       [&](const Triangle& t) { return flatness(mesh, t) <= 1e-8; });
}

std::string fault_of_report(const TriangleMesh& mesh, double share, const SimplifyResult& result) {
    const Report& report = result.report;
    const std::size_t faces = mesh.triangles.size();
    const auto total = [](const auto& counts) {
        return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
    };
    const auto wanted =
        static_cast<std::uint64_t>(std::floor(static_cast<double>(faces) * share * (1 + 1e-15)));
    if (report.faces_in != faces || report.vertices_in != mesh.positions.size())
        return "the report has wrong input counts";
    if (report.faces_out != result.mesh.triangles.size()) return "the report has a wrong face count";
    if (report.vertices_out != result.mesh.positions.size()) return "the report has a wrong vertex count";
    if (report.target_faces != std::max<std::uint64_t>(4, wanted)) return "the report has a wrong target";
    if ((report.faces_out <= report.target_faces) != (report.stop == StopReason::reached_target))
        return "the stop reason does not fit the face count";
    if (report.stop == StopReason::no_legal_collapse && total(report.refusals) == 0)
        return "no collapse was legal, but no refusal is counted";
    if (report.faces_dropped > faces || report.collapses > mesh.positions.size())
        return "the report counts too many removed faces or collapses";
    if ((report.faces_dropped > 0 || report.components_deleted > 0) && report.warnings.empty())
        return "faces or components were removed without a warning";
    return {};
}

}  // namespace

std::string fault(const TriangleMesh& mesh, double share, const SimplifyResult& result) {
    const TriangleMesh& simplified = result.mesh;
    if (std::string found = fault_of_arrays(simplified); !found.empty()) return found;
    // simplify() removes faces with a ratio of at most 1e-12; the factor 0.99 allows for rounding.
    if (!std::all_of(simplified.triangles.begin(), simplified.triangles.end(),
                     [&](const Triangle& t) { return flatness(simplified, t) > 0.99e-12; }))
        return "a face is degenerate";
    // If all faces are nearly degenerate, the few remaining ones may all be degenerate.
    if (simplified.triangles.empty() && result.report.faces_dropped < mesh.triangles.size() && !is_line(mesh))
        return "the result is empty";
    if (!(outside_box(mesh, simplified) <= most_outside)) return "a vertex is far outside the bounding box";
    if (simplified.face_groups.size() != (mesh.face_groups.empty() ? 0 : simplified.triangles.size()))
        return "the number of face groups is wrong";
    if (simplified.attributes.values.size() != 3 * simplified.triangles.size() * mesh.attributes.width)
        return "the number of attribute values is wrong";
    if (result.face_origin.size() != simplified.triangles.size() || !strictly_ascending(result.face_origin) ||
        (!simplified.triangles.empty() && !(result.face_origin.back() < mesh.triangles.size())))
        return "face_origin is wrong";
    if (result.vertex_origin.size() != simplified.positions.size() ||
        !strictly_ascending(result.vertex_origin) ||
        (!simplified.positions.empty() && !(result.vertex_origin.back() < mesh.positions.size())))
        return "vertex_origin is wrong";
    return fault_of_report(mesh, share, result);
}

double outside_box(const TriangleMesh& mesh, const TriangleMesh& result) {
    if (result.positions.empty()) return 0;
    Vec3 low = mesh.positions[mesh.triangles[0][0]], high = low;
    for (const Triangle& t : mesh.triangles)
        for (const Index v : t)
            for (unsigned i = 0; i < 3; ++i) {
                low[i] = std::min(low[i], mesh.positions[v][i]);
                high[i] = std::max(high[i], mesh.positions[v][i]);
            }
    double farthest = 0;
    for (const Vec3& p : result.positions) {
        Vec3 gap;
        for (unsigned i = 0; i < 3; ++i) gap[i] = std::max({low[i] - p[i], p[i] - high[i], 0.0});
        farthest = std::max(farthest, std::hypot(gap[0], gap[1], gap[2]));
    }
    return farthest / std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
}

}  // namespace faqem::soak
