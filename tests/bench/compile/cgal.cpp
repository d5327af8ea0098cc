#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_ratio_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>
#include <fstream>
namespace SMS = CGAL::Surface_mesh_simplification;
using Mesh = CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>;
// Reads a model, reduces it to a tenth and writes it.
int main(int, char** argv) {
    Mesh mesh;
    std::ifstream in(argv[1]);
    in >> mesh;
    SMS::edge_collapse(mesh, SMS::Count_ratio_stop_predicate<Mesh>(0.1));
    mesh.collect_garbage();
    std::ofstream(argv[2]) << mesh;
}
