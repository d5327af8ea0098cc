"""Simplification of meshes given as arrays."""

from __future__ import annotations

import ctypes
import json
from typing import Any

import numpy
from numpy.typing import ArrayLike, DTypeLike, NDArray

from ._arrays import MeshArrays, checked_array, checked_indices, mesh_pointer, view_array
from ._library import call, create, destroy_with, library
from ._options import Options, names_keywords
from .errors import InputError

#: Keywords of simplify() and simplify_levels() that are arrays.
array_keywords = ("groups", "locks", "weights", "uvs")
#: Keywords of simplify() besides the options: its arrays, and the arguments of fast_simplification.
simplify_keywords = (
    "points", "triangles", *array_keywords,
    "target_reduction", "target_count", "agg", "verbose", "return_collapses", "lossless", "preserve_border",
)


class _Result:
    """Owner of a result in the library."""

    def __init__(self, handle: ctypes.c_void_p) -> None:
        self.handle = handle
        destroy_with(self, library.faqem_result_destroy, handle)


class Simplified:
    """A simplified mesh, the origin of its elements, and the report. Owns its arrays, which may be changed."""

    vertices: NDArray[numpy.floating[Any]]  #: (v, 3) float32 if the input is, else float64; vertices that were not moved are unchanged bit by bit
    triangles: NDArray[numpy.uint32]  #: (f, 3) uint32
    groups: NDArray[numpy.uint32] | None  #: (f,) uint32, or None if the input has no groups
    uvs: NDArray[numpy.float32] | None  #: (f, 3, n) float32, or None if the input has no uvs
    vertex_origin: NDArray[numpy.uint32]  #: (v,) uint32: source vertex of each vertex; empty after History.truncate()
    face_origin: NDArray[numpy.uint32]  #: (f,) uint32: input triangle of each triangle
    report: dict[str, Any]  #: with the keys documented in docs/reference.md
    error: float | None  #: upper bound of the distance of a level from the original; None for other results

    def __init__(
        self, handle: ctypes.c_void_p, kind: DTypeLike = numpy.float64, *, has_history: bool = False
    ) -> None:
        result = _Result(handle)

        def array(getter: Any, *shape: int) -> NDArray[Any]:
            # map() and History.of() read the arrays of the library, which must not change. Without a history they cannot
            # be called, and the memory belongs to the caller.
            values = view_array(getter(handle), shape, result, writable=True)
            return values.copy() if has_history else values

        self._handle, self._result = handle, result
        v = library.faqem_result_vertex_count(handle)
        f = library.faqem_result_face_count(handle)
        width = library.faqem_result_corner_width(handle)
        self.vertices = array(library.faqem_result_positions, v, 3).astype(kind, copy=False)
        self.triangles = array(library.faqem_result_triangles, f, 3)
        has_groups = bool(library.faqem_result_face_groups(handle))
        self.groups = array(library.faqem_result_face_groups, f) if has_groups else None
        self.uvs = array(library.faqem_result_corner_values, f, 3, width) if width else None
        self.vertex_origin = array(library.faqem_result_vertex_origin, v)
        self.face_origin = array(library.faqem_result_face_origin, f)
        self.report = json.loads(library.faqem_result_report_json(handle))
        error = library.faqem_result_level_error(handle)
        self.error = None if numpy.isnan(error) else error

    @names_keywords
    def map(self, faces: ArrayLike, barycentric: ArrayLike) -> tuple[NDArray[numpy.uint32], NDArray[numpy.float64]]:
        """Maps points of the simplified mesh to the original. Needs history=True.

        faces        (n,) indices of triangles of the simplified mesh, of an integer type
        barycentric  (n, 3) weights of their corners, >= 0, sum 1

        Returns the input triangles (n,) and the weights of their corners (n, 3). Raises InputError, also for
        indices that are no integers or out of range, and OptionError if there is no history.
        """
        indices: NDArray[numpy.uint32] = numpy.ascontiguousarray(checked_indices(faces, "faces"), dtype=numpy.uint32)
        weights: NDArray[numpy.float64] = numpy.ascontiguousarray(
            checked_array(barycentric, "barycentric", numpy.float64))
        if indices.ndim != 1 or weights.shape != (len(indices), 3):
            raise InputError(f"faces and barycentric: the shapes must be (n,) and (n, 3), but are {indices.shape} and "
                             f"{weights.shape}")
        source_faces, source_weights = numpy.empty_like(indices), numpy.empty_like(weights)

        def pointer(array: NDArray[Any], kind: Any) -> Any:
            return array.ctypes.data_as(ctypes.POINTER(kind))

        call(library.faqem_result_map, self._handle, pointer(indices, ctypes.c_uint32),
             pointer(weights, ctypes.c_double), len(indices), pointer(source_faces, ctypes.c_uint32),
             pointer(source_weights, ctypes.c_double))
        return source_faces, source_weights


def simplify_arrays(
    points: ArrayLike,
    triangles: ArrayLike,
    groups: ArrayLike | None = None,
    locks: ArrayLike | None = None,
    weights: ArrayLike | None = None,
    uvs: ArrayLike | None = None,
    **options: Any,
) -> Simplified:
    """See simplify()."""
    arrays = MeshArrays(points, triangles, groups, locks, weights, uvs, "points")
    chosen = Options(simplify_keywords, **options)

    def run() -> Simplified:
        made = create(library.faqem_simplify, mesh_pointer(arrays), chosen.object)
        return Simplified(made, arrays.kind, has_history=bool(options.get("history")))

    return chosen.run(run)
