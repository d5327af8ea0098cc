"""Conversion between numpy arrays and the arrays of the C API."""

import ctypes

import numpy

from ._library import Mesh
from .errors import InputError

_no_index = 2**32 - 1


def _check_shape(array, width, name):
    if array.ndim != 2 or array.shape[1] != width:
        raise InputError(f"{name}: the shape must be (n, {width}), but is {array.shape}")
    return array


def _is_readable_in_place(array):
    """Whether the C API reads the array (n, 3) in place: rows or columns follow each other without overlap."""
    stride, step = array.strides
    size = array.itemsize
    by_rows = step >= size and stride >= 2 * step + size
    return by_rows or (stride >= size and step >= (len(array) - 1) * stride + size)


def _strided(array, kind):
    """Returns the array as type `kind`, without a copy if its type and layout fit."""
    array = numpy.asarray(array, dtype=kind)
    return array if array.ndim == 2 and _is_readable_in_place(array) else numpy.ascontiguousarray(array)


def _positions(vertices):
    array = numpy.asarray(vertices)
    kind = numpy.float32 if array.dtype == numpy.float32 else numpy.float64
    if array.size == 0:
        array = array.reshape(0, 3)
    return _check_shape(_strided(array, kind), 3, "vertices")


def checked_indices(values, name):
    """Returns vertex, face or group indices as an array of integers.

    Raises InputError if they are not integers from 0 to 2^32 - 2. A conversion by numpy would round fractions and
    take the remainder of large numbers.
    """
    array = numpy.asarray(values)
    if array.size and not numpy.issubdtype(array.dtype, numpy.integer):
        raise InputError(f"{name}: integers are expected, but the type is {array.dtype}")
    if array.size and not (array.min() >= 0 and array.max() < _no_index):
        raise InputError(f"{name}: a value is negative or exceeds 2^32 - 2")
    return array


def _indices(values, name):
    """Returns checked indices as uint32, or as uint16 if they are of that type."""
    array = checked_indices(values, name)
    return _strided(array, numpy.uint16 if array.dtype == numpy.uint16 else numpy.uint32)


def _per_element(values, count, kind, name):
    array = numpy.ascontiguousarray(values, dtype=kind)
    if array.shape != (count,):
        raise InputError(f"{name}: the shape must be ({count},), but is {array.shape}")
    return array


class MeshArrays:
    """A mesh for the C API. `mesh` is valid as long as this object exists.

    Arrays of the right type are not copied.
    """

    def __init__(self, vertices, triangles, groups=None, locks=None, weights=None, uvs=None):
        positions = _positions(vertices)
        corners = _indices(triangles, "triangles")
        corners = _check_shape(corners.reshape(0, 3) if corners.size == 0 else corners, 3, "triangles")
        self.mesh = Mesh(vertex_count=len(positions), face_count=len(corners))
        self._arrays = []
        name = "positions" if positions.dtype == numpy.float32 else "double_positions"
        self._set_array(name, positions)
        self._set_array("short_triangles" if corners.dtype == numpy.uint16 else "triangles", corners)
        self.mesh.position_stride, self.mesh.position_step = positions.strides
        self.mesh.triangle_stride, self.mesh.triangle_step = corners.strides
        if groups is not None:
            groups = _per_element(_indices(groups, "groups"), len(corners), numpy.uint32, "groups")
            self._set_array("face_groups", groups)
        if locks is not None:
            locks = _per_element(numpy.asarray(locks, dtype=bool), len(positions), numpy.uint8, "locks")
            self._set_array("vertex_locks", locks)
        if weights is not None:
            self._set_array("vertex_weights", _per_element(weights, len(positions), numpy.float32, "weights"))
        if uvs is not None:
            corner_values = numpy.ascontiguousarray(uvs, dtype=numpy.float32)
            if corner_values.ndim != 3 or corner_values.shape[:2] != (len(corners), 3) or corner_values.shape[2] < 1:
                raise InputError(f"uvs: the shape must be ({len(corners)}, 3, n), but is {corner_values.shape}")
            self._set_array("corner_values", corner_values)
            self.mesh.corner_width = corner_values.shape[2]

    def _set_array(self, field, array):
        self._arrays.append(array)
        pointer = dict(Mesh._fields_)[field]
        setattr(self.mesh, field, array.ctypes.data_as(pointer))


def copy_array(pointer, *shape):
    """Copies the array that a getter of the C API returns; null gives an empty array."""
    if not pointer:
        kind = numpy.dtype(pointer._type_)
        return numpy.empty((0, *shape[1:]), dtype=kind)
    return numpy.ctypeslib.as_array(pointer, shape=shape).copy()


def mesh_pointer(mesh_arrays):
    """Returns the argument for a parameter of type `const faqem_mesh*`."""
    return ctypes.byref(mesh_arrays.mesh)
