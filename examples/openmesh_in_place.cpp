// Simplifies an OpenMesh mesh in place. Custom properties stay attached to the remaining vertices and faces,
// and a weight property controls where detail is preserved.

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
        std::cerr << "usage: openmesh_in_place IN OUT   (in formats that OpenMesh reads and writes)\n";
        return 2;
    }

    // Custom properties: the original position of each vertex, and the original index of each face.
    OpenMesh::VProp<Mesh::Point> original_position(mesh);
    OpenMesh::FProp<int> original_index(mesh);
    for (const auto v : mesh.vertices()) original_position[v] = mesh.point(v);
    for (const auto f : mesh.faces()) original_index[f] = f.idx();

    // Collapses in the upper half cost ten times as much.
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

    float max_displacement = 0;
    int largest_index = -1;
    for (const auto v : mesh.vertices())
        max_displacement = std::max(max_displacement, (mesh.point(v) - original_position[v]).norm());
    for (const auto f : mesh.faces()) largest_index = std::max(largest_index, original_index[f]);
    std::cout << report.faces_in << " faces, now " << mesh.n_faces() << ", largest original index "
              << largest_index << "; maximum vertex displacement " << max_displacement << "\n";
    if (!OpenMesh::IO::write_mesh(mesh, argv[2]))
        throw std::runtime_error(std::string("cannot write ") + argv[2]);
    return mesh.n_faces() == report.faces_out ? 0 : 1;
} catch (const std::exception& error) {
    std::cerr << "openmesh_in_place: " << error.what() << "\n";
    return 1;
}
