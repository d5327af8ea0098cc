#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Bounded_normal_change_placement.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/GarlandHeckbert_plane_policies.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include "faqem/detail/base/stopwatch.hpp"
#include "simplifier.hpp"

namespace faqem::bench {

namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
namespace sms = CGAL::Surface_mesh_simplification;
namespace pmp = CGAL::Polygon_mesh_processing;

/// Stop predicate for a number of faces. CGAL 5.5 has predicates only for numbers of edges; later versions
/// have one.
class FaceCountStop {
public:
    FaceCountStop(const Mesh& mesh, std::size_t target_faces) : mesh_(&mesh), target_(target_faces) {}

    template <class FT, class Profile>
    bool operator()(const FT&, const Profile&, std::size_t, std::size_t) const {
        return mesh_->number_of_faces() <= target_;
    }

private:
    const Mesh* mesh_;
    std::size_t target_;
};

/// Converts a mesh. A half-edge mesh must be manifold: orienting the polygon soup splits non-manifold edges
/// into several boundary edges.
Mesh to_cgal(const TriangleMesh& in) {
    std::vector<Kernel::Point_3> points;
    points.reserve(in.positions.size());
    for (const Vec3& p : in.positions) points.emplace_back(p[0], p[1], p[2]);
    std::vector<std::vector<std::size_t>> polygons;
    polygons.reserve(in.triangles.size());
    for (const Triangle& t : in.triangles) polygons.push_back({t[0], t[1], t[2]});
    if (!pmp::is_polygon_soup_a_polygon_mesh(polygons)) pmp::orient_polygon_soup(points, polygons);
    Mesh mesh;
    pmp::polygon_soup_to_polygon_mesh(points, polygons, mesh);
    return mesh;
}

TriangleMesh from_cgal(Mesh& mesh) {
    mesh.collect_garbage();
    TriangleMesh out;
    out.positions.reserve(mesh.number_of_vertices());
    for (const Mesh::Vertex_index v : mesh.vertices()) {
        const Kernel::Point_3& p = mesh.point(v);
        out.positions.push_back({p.x(), p.y(), p.z()});
    }
    out.triangles.reserve(mesh.number_of_faces());
    for (const Mesh::Face_index f : mesh.faces()) {
        Triangle t = {};
        std::size_t k = 0;
        for (const Mesh::Vertex_index v : mesh.vertices_around_face(mesh.halfedge(f))) t.at(k++) = v;
        out.triangles.push_back(t);
    }
    return out;
}

template <class Collapse>
Outcome run(const TriangleMesh& in, std::size_t target_faces, Collapse&& collapse) {
    Mesh mesh = to_cgal(in);
    const detail::Stopwatch core;
    collapse(mesh, FaceCountStop(mesh, target_faces));
    const double seconds = core.seconds();
    return {from_cgal(mesh), seconds, {}};
}

}  // namespace

Outcome cgal_lindstrom_turk(const TriangleMesh& in, std::size_t target_faces) {
    return run(in, target_faces,
               [](Mesh& mesh, const FaceCountStop& stop) { sms::edge_collapse(mesh, stop); });
}

// As in CGAL's example: plane quadrics; placements that flip a face are rejected.
Outcome cgal_garland_heckbert(const TriangleMesh& in, std::size_t target_faces) {
    return run(in, target_faces, [](Mesh& mesh, const FaceCountStop& stop) {
        using Policies = sms::GarlandHeckbert_plane_policies<Mesh, Kernel>;
        const Policies policies(mesh);
        const sms::Bounded_normal_change_placement<Policies::Get_placement> placement(
            policies.get_placement());
        sms::edge_collapse(mesh, stop,
                           CGAL::parameters::get_cost(policies.get_cost()).get_placement(placement));
    });
}

}  // namespace faqem::bench
