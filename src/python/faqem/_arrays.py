"""Conversion between numpy arrays and the arrays of the C API."""

from __future__ import annotations

import ctypes
import math
from typing import Any

import numpy
from numpy.typing import ArrayLike, DTypeLike, NDArray

from ._library import Mesh
from .errors import InputError

Array = NDArray[Any]

_no_index = 2**32 - 1


def check_rows(array: Array, width: int, name: str) -> Array:
    """Returns an array of the shape (n, width); an empty one of any shape has no rows. Raises InputError for others."""
    rows = array.reshape(0, width) if array.size == 0 else array
    if rows.ndim != 2 or rows.shape[1] != width:
        raise InputError(f"{name}: the shape must be (n, {width}), but is {rows.shape}")
    return rows


def triangle_rows(triangles: ArrayLike) -> Array:
    """Returns triangles as rows. pyvista's `faces`, a flat array with a 3 before each triangle, are accepted, too."""
    array = checked_array(triangles, "triangles")
    if array.ndim != 1 or array.size == 0:
        return check_rows(array, 3, "triangles")
    if array.size % 4 != 0 or (array[::4] != 3).any():
        raise InputError("triangles: a flat array must have a 3 before the three indices of each triangle")
    return array.reshape(-1, 4)[:, 1:]


def _is_readable_in_place(array: Array) -> bool:
    """Whether the C API reads the array (n, 3) in place: rows or columns follow each other without overlap."""
    stride, step = array.strides
    size = array.itemsize
    by_rows = step >= size and stride >= 2 * step + size
    return bool(by_rows or (stride >= size and step >= (len(array) - 1) * stride + size))


def _strided(array: ArrayLike, kind: DTypeLike) -> Array:
    """Returns the array as type `kind`, without a copy if its type and layout fit."""
    converted: Array = numpy.asarray(array, dtype=kind)
    fits = converted.ndim == 2 and _is_readable_in_place(converted)
    return converted if fits else numpy.ascontiguousarray(converted)


def _converted(values: ArrayLike, name: str, kind: DTypeLike | None) -> Array:
    try:
        with numpy.errstate(over="ignore"):  # the library rejects what becomes infinite, and names the element
            return numpy.asarray(values, dtype=kind)
    except (TypeError, ValueError, OverflowError) as error:
        raise InputError(f"{name}: {error}") from None


def checked_array(values: ArrayLike, name: str, kind: DTypeLike | None = None) -> Array:
    """Returns an array, of a type if given. Raises InputError with the name of the argument if it is none."""
    array = _converted(values, name, None)
    if array.dtype.kind not in "biufO":  # numpy would convert texts and complex numbers, too
        raise InputError(f"{name}: numbers are expected, but the type is {array.dtype}")
    return array if kind is None else _converted(array, name, kind)


def checked_positions(values: ArrayLike, name: str, kind: DTypeLike | None = None) -> Array:
    """Returns positions (n, 3) as float32 if they are of that type and `kind` is None, else as float64.

    Raises InputError if a value has no float64, or they are of a wider type.
    """
    array = checked_array(values, name)
    if kind is None:
        kind = numpy.float32 if array.dtype == numpy.float32 else numpy.float64
    is_integer = array.dtype.kind in "iu" and array.size > 0
    if array.dtype.kind == "f" and array.dtype.itemsize > 8:
        raise InputError(f"{name}: the type {array.dtype} has more digits than float64; convert the array")
    if is_integer and not (array.min() >= -(2**53) and array.max() <= 2**53):
        raise InputError(f"{name}: an integer is beyond 2^53, and would be rounded")
    return check_rows(checked_array(array, name, kind), 3, name)


def checked_indices(values: ArrayLike, name: str) -> Array:
    """Returns vertex, face or group indices as an array of integers.

    Raises InputError if they are not integers from 0 to 2^32 - 2. A conversion by numpy would round fractions and
    take the remainder of large numbers.
    """
    array = checked_array(values, name)
    if array.size and not numpy.issubdtype(array.dtype, numpy.integer):
        raise InputError(f"{name}: integers are expected, but the type is {array.dtype}")
    if array.size and not (array.min() >= 0 and array.max() < _no_index):
        raise InputError(f"{name}: a value is negative or exceeds 2^32 - 2")
    return array


def _indices(values: ArrayLike, name: str) -> Array:
    """Returns checked indices as uint32, or as uint16 if they are of that type."""
    array = checked_indices(values, name)
    return _strided(array, numpy.uint16 if array.dtype == numpy.uint16 else numpy.uint32)


def _locks(values: ArrayLike, count: int) -> Array:
    array = checked_array(values, "locks")
    is_flag = array.dtype.kind == "b" or (array.dtype.kind in "iu" and ((array == 0) | (array == 1)).all())
    if array.size and not is_flag:
        raise InputError(f"locks: booleans (or 0 and 1) are expected, but the type is {array.dtype}")
    return _per_element(array, count, numpy.uint8, "locks")


def _per_element(values: ArrayLike, count: int, kind: DTypeLike, name: str) -> Array:
    array: Array = numpy.ascontiguousarray(checked_array(values, name, kind))
    if array.shape != (count,):
        raise InputError(f"{name}: the shape must be ({count},), but is {array.shape}")
    return array


class MeshArrays:
    """A mesh for the C API. `pointer`, for parameters of type `const faqem_mesh*`, is valid as long as this object exists;
    `kind` is the type of the positions.

    Arrays of the right type are not copied. `name` is what messages call the positions.
    """

    def __init__(
        self,
        vertices: ArrayLike,
        triangles: ArrayLike,
        groups: ArrayLike | None = None,
        locks: ArrayLike | None = None,
        weights: ArrayLike | None = None,
        uvs: ArrayLike | None = None,
        name: str = "vertices",
    ) -> None:
        positions = checked_positions(vertices, name)
        positions = _strided(positions, positions.dtype)
        corners = _indices(triangles, "triangles")
        corners = check_rows(corners, 3, "triangles")
        self.kind = positions.dtype
        self.mesh = Mesh(vertex_count=len(positions), face_count=len(corners))
        self._arrays: list[Array] = []
        self._set_array("positions" if positions.dtype == numpy.float32 else "double_positions", positions)
        self._set_array("short_triangles" if corners.dtype == numpy.uint16 else "triangles", corners)
        self.mesh.position_stride, self.mesh.position_step = positions.strides
        self.mesh.triangle_stride, self.mesh.triangle_step = corners.strides
        if groups is not None:
            of_faces = _per_element(_indices(groups, "groups"), len(corners), numpy.uint32, "groups")
            self._set_array("face_groups", of_faces)
        if locks is not None:
            self._set_array("vertex_locks", _locks(locks, len(positions)))
        if weights is not None:
            self._set_array("vertex_weights", _per_element(weights, len(positions), numpy.float32, "weights"))
        if uvs is not None:
            corner_values = numpy.ascontiguousarray(checked_array(uvs, "uvs", numpy.float32))
            if corner_values.ndim != 3 or corner_values.shape[:2] != (len(corners), 3) or corner_values.shape[2] < 1:
                raise InputError(f"uvs: the shape must be ({len(corners)}, 3, n), but is {corner_values.shape}")
            self._set_array("corner_values", corner_values)
            self.mesh.corner_width = corner_values.shape[2]
        self.pointer = ctypes.byref(self.mesh)

    def _set_array(self, field: str, array: Array) -> None:
        self._arrays.append(array)
        pointers: dict[str, Any] = {name: kind for name, kind, *_ in Mesh._fields_}
        setattr(self.mesh, field, array.ctypes.data_as(pointers[field]))


def view_array(pointer: Any, shape: tuple[int, ...], owner: object, *, writable: bool = False) -> Array:
    """Returns the array that a getter of the C API returns, without a copy; null gives an empty array.

    owner  a Python object as long as which the memory exists; the array keeps it alive
    """
    if not pointer:
        return numpy.empty((0, *shape[1:]), dtype=numpy.dtype(pointer._type_))
    memory: Any = (pointer._type_ * math.prod(shape)).from_address(ctypes.addressof(pointer.contents))
    memory.owner = owner
    view = memoryview(memory)
    array: Array = numpy.frombuffer(view if writable else view.toreadonly(), pointer._type_).reshape(shape)
    return array
