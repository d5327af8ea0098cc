// Simplifies an OpenMesh mesh in place.
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <faqem/openmesh.hpp>

int main() {
    OpenMesh::TriMesh_ArrayKernelT<> mesh;
    std::vector<OpenMesh::VertexHandle> v;
    for (int i = 0; i <= 10; ++i) {
        for (int j = 0; j <= 10; ++j)
            v.push_back(mesh.add_vertex({float(i), float(j), 0.1f * float(i * j % 3)}));
    }
    for (std::size_t i = 0; i < 10; ++i) {
        for (std::size_t j = 0; j < 10; ++j) {
            const std::size_t a = i * 11 + j;
            mesh.add_face(v[a], v[a + 11], v[a + 12]);
            mesh.add_face(v[a], v[a + 12], v[a + 1]);
        }
    }
    const auto report = faqem::simplify(mesh, {.target = faqem::ratio(0.25)});
    mesh.garbage_collection();
    return mesh.n_faces() == report.faces_out && mesh.n_faces() <= 50 ? 0 : 1;
}
