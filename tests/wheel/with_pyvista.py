"""Simplifies meshes of the package pyvista, whose `faces` have a 3 before each triangle."""

import fast_simplification
import faqem
import faqem.fast_simplification as drop_in
import numpy
import pyvista

mesh = pyvista.Sphere(theta_resolution=80, phi_resolution=80)
for call in ({"target_reduction": 0.9}, {"target_count": 1000}):
    points, faces = drop_in.simplify(mesh.points, mesh.faces, **call)
    small = pyvista.make_tri_mesh(points, faces)
    assert small.is_manifold and small.n_open_edges == 0
    theirs = fast_simplification.simplify(mesh.points, mesh.regular_faces, **call)[1]
    assert abs(small.n_cells - len(theirs)) <= 4, (small.n_cells, len(theirs))
    assert abs(small.volume / mesh.volume - 1) < 0.01

out = faqem.simplify(mesh.points, mesh.faces, ratio=0.1)
assert out.vertices.dtype == mesh.points.dtype == numpy.float32
numpy.testing.assert_array_equal(out.triangles, faqem.simplify(mesh.points, mesh.regular_faces, ratio=0.1).triangles)
quads = pyvista.Plane(i_resolution=4, j_resolution=4)
try:
    faqem.simplify(quads.points, quads.faces, ratio=0.5)
    raise AssertionError("quads")
except faqem.InputError as error:
    assert "triangles: a flat array" in str(error)
print(f"pyvista {pyvista.__version__}")
