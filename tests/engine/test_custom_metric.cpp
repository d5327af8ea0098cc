#include "faqem/engine/custom_metric.hpp"
#include "faqem/engine/metric/accumulated.hpp"

#include <limits>

#include "faqem/engine/simplify_with.hpp"
#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace faqem;
using namespace faqem::engine;
using namespace faqem::test;

namespace {

// Simplifies with accumulated quadrics and an adjustment.
template <class Adjust>
CustomResult adjusted(const TriangleMesh& mesh, std::size_t faces, Adjust adjust) {
    return simplify_with(mesh.view(), CustomMetric(AccumulatedMetric({}), adjust),
                         {.target_faces = faces, .ladder = Ladder::off});
}

const auto unchanged = [](const AccumulatedMetric&, const CollapseMesh&, Index, Index, AllowedPosition,
                          const Candidate& found) { return std::optional(found); };

}  // namespace

TEST_CASE("custom metric: an adjustment that returns its argument does not change the result") {
    const TriangleMesh mesh = shaken(torus(24, 12), 0.02, 1);
    const CustomResult with = adjusted(mesh, 100, unchanged);
    const CustomResult without =
        simplify_with(mesh.view(), AccumulatedMetric({}), {.target_faces = 100, .ladder = Ladder::off});
    CHECK(with.mesh.triangles.size() == 100);
    CHECK(with.mesh.positions == without.mesh.positions);
    CHECK(with.mesh.triangles == without.mesh.triangles);
}

TEST_CASE("custom metric: vetoed collapses are not done") {
    const TriangleMesh mesh = icosphere(3);
    const auto is_upper = [](const Vector3& p) { return p.z() > 0; };
    const CustomResult out = adjusted(mesh, 4,
                                      [&](const AccumulatedMetric&, const CollapseMesh& c, Index u, Index v,
                                          AllowedPosition, const Candidate& found) {
                                          const bool same =
                                              is_upper(c.position(u)) == is_upper(c.position(v)) &&
                                              is_upper(c.position(u)) == is_upper(found.point);
                                          return same ? std::optional(found) : std::nullopt;
                                      });
    for (std::size_t v = 0; v < out.mesh.positions.size(); ++v) {
        const Vec3& grew_from = mesh.positions[out.vertex_origin[v]];
        CHECK((out.mesh.positions[v][2] > 0) == (grew_from[2] > 0));
    }
}

TEST_CASE("custom metric: new vertices have the positions that the adjustment returned") {
    const TriangleMesh mesh = shaken(torus(24, 12), 0.02, 1);
    const CustomResult out = adjusted(mesh, 200,
                                      [](const AccumulatedMetric& m, const CollapseMesh&, Index u, Index v,
                                         AllowedPosition, Candidate found) {
                                          for (double& x : found.point) x = std::round(8 * x) / 8;
                                          found.cost =
                                              std::max((m.quadric(u) + m.quadric(v))(found.point), 0.0);
                                          return std::optional(found);
                                      });
    std::size_t moved = 0;
    for (std::size_t v = 0; v < out.mesh.positions.size(); ++v) {
        const Vec3& p = out.mesh.positions[v];
        if (p == mesh.positions[out.vertex_origin[v]]) continue;
        for (const double x : p) CHECK(8 * x == std::round(8 * x));
        ++moved;
    }
    CHECK(moved > 50);
}

TEST_CASE("custom metric: more faces are kept where an additional term increases the cost") {
    const TriangleMesh mesh = shaken(icosphere(4), 0.002, 5);
    const CustomResult out = adjusted(mesh, 1000,
                                      [](const AccumulatedMetric&, const CollapseMesh& c, Index u, Index,
                                         AllowedPosition, Candidate found) {
                                          if (c.position(u).x() > 0) found.cost *= 100;
                                          return std::optional(found);
                                      });
    std::size_t right = 0;
    for (const Vec3& p : out.mesh.positions) right += p[0] > 0;
    CHECK(right > 2 * (out.mesh.positions.size() - right));
}

TEST_CASE("custom metric: a NaN cost is a veto") {
    const TriangleMesh mesh = icosphere(1);
    const CustomResult out = adjusted(
        mesh, 4,
        [](const AccumulatedMetric&, const CollapseMesh&, Index, Index, AllowedPosition, Candidate found) {
            found.cost = std::numeric_limits<double>::quiet_NaN();
            return std::optional(found);
        });
    CHECK(out.mesh.triangles == mesh.triangles);
    CHECK(out.loop.stop == StopReason::no_legal_collapse);
}
