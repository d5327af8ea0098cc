"""Flat arrays in, flat arrays out."""

import ctypes
import json
import weakref

import numpy

from ._arrays import MeshArrays, copy_array, mesh_pointer
from ._library import call, create, library
from ._options import Options, enum_value
from .errors import InputError

_mappings = ["projection", "lineage", "closest"]


class Simplified:
    """A small mesh, where it came from, and what happened. The arrays are its own."""

    vertices: numpy.ndarray  #: (v, 3) float64; what was not moved is unchanged to the last bit
    triangles: numpy.ndarray  #: (f, 3) uint32
    groups: "numpy.ndarray | None"  #: (f,) uint32, or None where the input had none
    uvs: "numpy.ndarray | None"  #: (f, 3, n) float32, or None where the input had none
    vertex_origin: numpy.ndarray  #: (v,) uint32: an input vertex that each grew from; empty after History.truncate()
    face_origin: numpy.ndarray  #: (f,) uint32: the input triangle that each was
    report: dict  #: with the keys of docs/cli.md
    error: "float | None"  #: of a level: no point is farther from the original; None of other results

    def __init__(self, handle):
        self._handle = handle  # its history is asked for later
        weakref.finalize(self, library.faqem_result_destroy, handle)
        v = library.faqem_result_vertex_count(handle)
        f = library.faqem_result_face_count(handle)
        groups = library.faqem_result_face_groups(handle)
        width = library.faqem_result_corner_width(handle)
        self.vertices = copy_array(library.faqem_result_positions(handle), v, 3)
        self.triangles = copy_array(library.faqem_result_triangles(handle), f, 3)
        self.groups = copy_array(groups, f) if groups else None
        self.uvs = copy_array(library.faqem_result_corner_values(handle), f, 3, width) if width else None
        self.vertex_origin = copy_array(library.faqem_result_vertex_origin(handle), v)
        self.face_origin = copy_array(library.faqem_result_face_origin(handle), f)
        self.report = json.loads(library.faqem_result_report_json(handle))
        error = library.faqem_result_level_error(handle)
        self.error = None if numpy.isnan(error) else error

    def map(self, faces, barycentric, mapping="projection"):
        """Where points lie on the original. Needs history=True.

        faces        (n,) triangles of the small mesh
        barycentric  (n, 3) weights of their corners, >= 0, of sum 1
        mapping      "projection", "lineage" or "closest"; see docs/baking.md

        Returns the input triangles (n,) and the weights of their corners (n, 3).
        """
        faces = numpy.ascontiguousarray(faces, dtype=numpy.uint32)
        weights = numpy.ascontiguousarray(barycentric, dtype=numpy.float64)
        if faces.ndim != 1 or weights.shape != (len(faces), 3):
            raise InputError(f"map: the shapes are {faces.shape} and {weights.shape}, not (n,) and (n, 3)")
        source_faces, source_weights = numpy.empty_like(faces), numpy.empty_like(weights)

        def pointer(array, kind):
            return array.ctypes.data_as(ctypes.POINTER(kind))

        call(library.faqem_result_map, self._handle, enum_value(_mappings, mapping, "mapping"),
             pointer(faces, ctypes.c_uint32), pointer(weights, ctypes.c_double), len(faces),
             pointer(source_faces, ctypes.c_uint32), pointer(source_weights, ctypes.c_double))
        return source_faces, source_weights


def simplify(vertices, triangles, /, *, groups=None, locks=None, weights=None, uvs=None, **options):
    """Simplifies a triangle soup.

    vertices   (v, 3) numbers; float32 and float64 are used without a copy
    triangles  (f, 3) whole numbers below v; uint32 and uint16 without a copy
    groups     (f,) whole numbers, for group_boundaries="kept"
    locks      (v,) truth values: these stay where they are
    weights    (v,) numbers in [1e-6, 1e6]: errors there count so many times
    uvs        (f, 3, n) numbers at the corners, which are carried along
    options    ratio, faces, max_error, preset, link, boundary, group_boundaries, weld_distance, virtual_edges,
               prune, history, threads, progress; see docs/python.md

    Raises OptionError, InputError, MemoryError, and what `progress` raises.
    """
    arrays = MeshArrays(vertices, triangles, groups, locks, weights, uvs)
    chosen = Options(**options)
    return Simplified(chosen.run(lambda: create(library.faqem_simplify, mesh_pointer(arrays), chosen.object)))
