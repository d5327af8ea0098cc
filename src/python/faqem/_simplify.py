"""Simplification of meshes given as arrays."""

from __future__ import annotations

import copy
import ctypes
import json
from typing import TYPE_CHECKING, Any

import numpy
from numpy.typing import ArrayLike, DTypeLike, NDArray

from ._arrays import MeshArrays, checked_array, checked_indices, view_array
from ._library import Owner, call, create, library
from ._options import Options, names_keywords
from .errors import InputError, OptionError

if TYPE_CHECKING:
    from typing_extensions import Self

#: Keywords of simplify() and simplify_levels() that are arrays.
array_keywords = ("groups", "locks", "weights", "uvs")


def counts_text(faces: int, vertices: int, error: float | None) -> str:
    """Counts of a mesh, for repr()."""
    return f"{faces} faces, {vertices} vertices" + ("" if error is None else f", error {error:.4g}")


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
    _handle: ctypes.c_void_p | None  # None for a copy from another process, which has no history
    _result: Owner | None

    def __init__(
        self, handle: ctypes.c_void_p, kind: DTypeLike = numpy.float64, *, has_history: bool = False
    ) -> None:
        result = Owner(handle, library.faqem_result_destroy)

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

    def __repr__(self) -> str:
        return f"<faqem.{type(self).__name__}: {counts_text(len(self.triangles), len(self.vertices), self.error)}>"

    def __getstate__(self) -> dict[str, Any]:
        """Pickles the arrays and the report, without the history."""
        return {**self.__dict__, "_handle": None, "_result": None}

    def __copy__(self) -> Self:
        other = type(self).__new__(type(self))
        other.__dict__.update(self.__dict__)
        return other

    def __deepcopy__(self, memo: dict[int, Any]) -> Self:
        other = self.__copy__()  # the history cannot change
        for name in self.__dict__.keys() - {"_handle", "_result"}:
            other.__dict__[name] = copy.deepcopy(self.__dict__[name], memo)
        return other

    def history_handle(self) -> ctypes.c_void_p:
        """Returns the result in the library. Raises OptionError for one that was pickled."""
        if self._handle is None:
            raise OptionError("history: was not pickled with the result; pickle History.of() instead")
        return self._handle

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

        call(library.faqem_result_map, self.history_handle(), pointer(indices, ctypes.c_uint32),
             pointer(weights, ctypes.c_double), len(indices), pointer(source_faces, ctypes.c_uint32),
             pointer(source_weights, ctypes.c_double))
        return source_faces, source_weights


class SimplifiedLevel(Simplified):
    """A level of simplify_levels()."""

    error: float  #: upper bound of the distance from the original, model units


def mesh_arrays(points: ArrayLike, triangles: ArrayLike, options: dict[str, Any], name: str) -> MeshArrays:
    """Returns the mesh of a call, with the arrays that are taken from its keywords. `name` is that of the points."""
    return MeshArrays(points, triangles, **{key: options.pop(key, None) for key in array_keywords}, name=name)


def simplify_arrays(points: ArrayLike, triangles: ArrayLike, **options: Any) -> Simplified:
    """See simplify()."""
    arrays = mesh_arrays(points, triangles, options, "points")
    chosen = Options(["triangles", *array_keywords], **options)
    has_history = bool(options.get("history"))
    return chosen.run(lambda: Simplified(
        create(library.faqem_simplify, arrays.pointer, chosen.object), arrays.kind, has_history=has_history))
