#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>
using Mesh = OpenMesh::TriMesh_ArrayKernelT<>;
// Reads a model, reduces it to a tenth and writes it.
int main(int, char** argv) {
    Mesh mesh;
    if (!OpenMesh::IO::read_mesh(mesh, argv[1])) return 1;
    OpenMesh::Decimater::DecimaterT<Mesh> decimater(mesh);
    OpenMesh::Decimater::ModQuadricT<Mesh>::Handle quadric;
    decimater.add(quadric);
    decimater.module(quadric).unset_max_err();
    if (!decimater.initialize()) return 1;
    decimater.decimate_to_faces(0, mesh.n_faces() / 10);
    mesh.garbage_collection();
    return !OpenMesh::IO::write_mesh(mesh, argv[2]);
}
