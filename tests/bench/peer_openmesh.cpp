#include <OpenMesh/Core/Mesh/DefaultTriMesh.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>

#include "faqem/detail/base/stopwatch.hpp"
#include "simplifier.hpp"

namespace faqem::bench {

namespace {

using Mesh = OpenMesh::TriMesh_ArrayKernelT<OpenMesh::DefaultTraitsDouble>;

/// Converts a mesh. Faces that would make the mesh non-manifold get their own vertices, as in OpenMesh's file
/// readers.
Mesh to_openmesh(const TriangleMesh& in) {
    Mesh mesh;
    mesh.request_vertex_status();
    mesh.request_edge_status();
    mesh.request_halfedge_status();
    mesh.request_face_status();
    std::vector<Mesh::VertexHandle> vertices;
    vertices.reserve(in.positions.size());
    for (const Vec3& p : in.positions) vertices.push_back(mesh.add_vertex({p[0], p[1], p[2]}));
    std::vector<Triangle> refused;
    for (const Triangle& t : in.triangles) {
        if (!mesh.add_face(vertices[t[0]], vertices[t[1]], vertices[t[2]]).is_valid()) refused.push_back(t);
    }
    for (const Triangle& t : refused) {
        Mesh::VertexHandle own[3];
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3& p = in.positions[t[k]];
            own[k] = mesh.add_vertex({p[0], p[1], p[2]});
        }
        mesh.add_face(own[0], own[1], own[2]);
    }
    return mesh;
}

TriangleMesh from_openmesh(const Mesh& mesh) {
    TriangleMesh out;
    for (const Mesh::VertexHandle v : mesh.vertices()) {
        const Mesh::Point& p = mesh.point(v);
        out.positions.push_back({p[0], p[1], p[2]});
    }
    for (const Mesh::FaceHandle f : mesh.faces()) {
        Triangle t = {};
        std::size_t k = 0;
        for (const Mesh::VertexHandle v : mesh.fv_range(f)) t.at(k++) = static_cast<Index>(v.idx());
        out.triangles.push_back(t);
    }
    return out;
}

}  // namespace

Outcome openmesh(const TriangleMesh& in, std::size_t target_faces) {
    Mesh mesh = to_openmesh(in);
    const detail::Stopwatch core;
    OpenMesh::Decimater::DecimaterT<Mesh> decimater(mesh);
    OpenMesh::Decimater::ModQuadricT<Mesh>::Handle quadric;
    decimater.add(quadric);
    decimater.module(quadric).unset_max_err();
    decimater.initialize();
    decimater.decimate_to_faces(0, target_faces);
    mesh.garbage_collection();
    const double seconds = core.seconds();
    return {from_openmesh(mesh), seconds, {}};
}

}  // namespace faqem::bench
