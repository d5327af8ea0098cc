#include <open3d/geometry/TriangleMesh.h>

#include <limits>

#include "faqem/detail/base/stopwatch.hpp"
#include "simplifier.hpp"

namespace faqem::bench {

Outcome open3d(const TriangleMesh& in, std::size_t target_faces) {
    ::open3d::geometry::TriangleMesh mesh;
    mesh.vertices_.reserve(in.positions.size());
    for (const Vec3& p : in.positions) mesh.vertices_.emplace_back(p[0], p[1], p[2]);
    mesh.triangles_.reserve(in.triangles.size());
    for (const Triangle& t : in.triangles) {
        mesh.triangles_.emplace_back(static_cast<int>(t[0]), static_cast<int>(t[1]), static_cast<int>(t[2]));
    }

    // Unlimited error and boundary weight 1 are the defaults of Open3D's Python interface.
    const detail::Stopwatch core;
    const auto result = mesh.SimplifyQuadricDecimation(static_cast<int>(target_faces),
                                                       std::numeric_limits<double>::infinity(), 1.0);
    const double seconds = core.seconds();

    TriangleMesh out;
    out.positions.reserve(result->vertices_.size());
    for (const auto& p : result->vertices_) out.positions.push_back({p[0], p[1], p[2]});
    out.triangles.reserve(result->triangles_.size());
    for (const auto& t : result->triangles_) {
        out.triangles.push_back(
            {static_cast<Index>(t[0]), static_cast<Index>(t[1]), static_cast<Index>(t[2])});
    }
    return {std::move(out), seconds, {}};
}

}  // namespace faqem::bench
