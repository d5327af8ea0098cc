// An OpenMesh mesh, simplified in place: properties of its own stay with the vertices and faces that are
// left, and say what may change.

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Utils/PropertyManager.hh>
#include <algorithm>
#include <exception>
#include <iostream>

#include "faqem/openmesh.hpp"

using Mesh = OpenMesh::TriMesh_ArrayKernelT<>;

int main(int argc, char** argv) try {
    Mesh mesh;
    if (argc != 3 || !OpenMesh::IO::read_mesh(mesh, argv[1])) {
        std::cerr << "usage: openmesh_in_place IN OUT, files that OpenMesh reads and writes\n";
        return 2;
    }

    // The caller's own: where each vertex was, and which face of the file each face is.
    OpenMesh::VProp<Mesh::Point> first_place(mesh);
    OpenMesh::FProp<int> number(mesh);
    for (const auto v : mesh.vertices()) first_place[v] = mesh.point(v);
    for (const auto f : mesh.faces()) number[f] = f.idx();

    // The upper half counts ten times.
    Mesh::Point low = mesh.point(mesh.vertex_handle(0)), high = low;
    for (const auto v : mesh.vertices()) low.minimize(mesh.point(v)), high.maximize(mesh.point(v));
    faqem::Properties properties;
    mesh.add_property(properties.weight);
    for (const auto v : mesh.vertices())
        mesh.property(properties.weight, v) = mesh.point(v)[1] > (low[1] + high[1]) / 2 ? 10.0f : 1.0f;

    const faqem::Report report =
        faqem::simplify(mesh, {.target = faqem::ratio(0.5)}, faqem::Region::all, properties);
    mesh.remove_property(properties.weight);
    mesh.garbage_collection();

    float farthest = 0;
    int last = -1;
    for (const auto v : mesh.vertices())
        farthest = std::max(farthest, (mesh.point(v) - first_place[v]).norm());
    for (const auto f : mesh.faces()) last = std::max(last, number[f]);
    std::cout << report.faces_in << " faces, now " << mesh.n_faces() << ", the last one was number " << last
              << "; vertices moved by up to " << farthest << "\n";
    if (!OpenMesh::IO::write_mesh(mesh, argv[2]))
        throw std::runtime_error(std::string("cannot write ") + argv[2]);
    return mesh.n_faces() == report.faces_out ? 0 : 1;
} catch (const std::exception& error) {
    std::cerr << "openmesh_in_place: " << error.what() << "\n";
    return 1;
}
