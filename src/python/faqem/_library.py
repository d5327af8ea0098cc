"""The functions of the C API (faqem/faqem.h, faqem_levels.h, faqem_asset.h), with errors as exceptions."""

from __future__ import annotations

import ctypes
import os
import pathlib
import weakref
from ctypes import POINTER, c_char, c_char_p, c_double, c_float, c_int, c_size_t, c_uint8, c_uint16, c_uint32, c_uint64, c_void_p

from . import errors

TYPE_CHECKING = False  # as in __init__.py
if TYPE_CHECKING:
    from typing import Any

    from typing_extensions import Self

Progress = ctypes.CFUNCTYPE(c_int, c_void_p, c_int, c_double)


class Mesh(ctypes.Structure):
    """struct faqem_mesh"""

    _fields_ = [
        ("positions", POINTER(c_float)),
        ("double_positions", POINTER(c_double)),
        ("vertex_count", c_size_t),
        ("triangles", POINTER(c_uint32)),
        ("short_triangles", POINTER(c_uint16)),
        ("face_count", c_size_t),
        ("face_groups", POINTER(c_uint32)),
        ("vertex_locks", POINTER(c_uint8)),
        ("vertex_weights", POINTER(c_float)),
        ("corner_values", POINTER(c_float)),
        ("corner_width", c_uint32),
        ("position_stride", c_size_t),
        ("position_step", c_size_t),
        ("triangle_stride", c_size_t),
        ("triangle_step", c_size_t),
    ]


class Level(ctypes.Structure):
    """struct faqem_level"""

    _fields_ = [("kind", c_int), ("value", c_double)]


class _Error(ctypes.Structure):
    _fields_ = [("status", c_int), ("message", c_char * 2044)]


_handle, _status = c_void_p, c_int
_made, _error = POINTER(_handle), POINTER(_Error)
#: Result, arguments, and the functions with these, without the prefix faqem_.
_signatures: list[tuple[Any, list[Any], str]] = [
    (c_char_p, [], "version"),
    (_handle, [], "options_create"),
    (c_size_t, [], "option_count"),
    (c_char_p, [c_size_t], "option_name option_help"),
    (_status, [_handle, c_char_p, c_char_p, _error], "options_set"),
    (_status, [_handle, Progress, c_void_p], "options_set_progress"),
    (None, [_handle], "options_destroy result_destroy history_destroy glb_destroy asset_destroy pixels_destroy"),
    (c_size_t, [_handle], "result_vertex_count result_face_count history_part_count history_level_count"),
    (c_size_t, [_handle], "asset_part_count asset_material_count asset_image_count"),
    (c_size_t, [_handle], "asset_warning_count asset_not_understood_count"),
    (c_char_p, [_handle], "result_report_json asset_report_json"),
    (c_double, [_handle], "result_level_error asset_level_error"),
    (c_uint32, [_handle], "result_corner_width pixels_width pixels_height"),
    (c_int, [_handle], "pixels_has_alpha"),
    (POINTER(c_double), [_handle], "result_positions"),
    (POINTER(c_float), [_handle], "result_corner_values"),
    (POINTER(c_uint32), [_handle], "result_triangles result_face_groups result_vertex_origin result_face_origin"),
    (POINTER(c_uint8), [_handle], "pixels_rgba"),
    (c_size_t, [_handle, c_size_t], "asset_vertex_count asset_face_count asset_uv_set_count"),
    (c_char_p, [_handle, c_size_t], "asset_part_name asset_material_name asset_image_name asset_image_mime_type"),
    (c_char_p, [_handle, c_size_t], "asset_warning asset_not_understood"),
    (POINTER(c_double), [_handle, c_size_t], "asset_positions"),
    (POINTER(c_uint32), [_handle, c_size_t], "asset_triangles asset_face_materials"),
    (POINTER(c_float), [_handle, c_size_t, c_size_t], "asset_uvs"),
    (c_uint32, [_handle, c_size_t, c_int, POINTER(c_uint32)], "asset_material_image"),
    (c_void_p, [_handle, POINTER(c_size_t)], "history_bytes glb_bytes"),
    (c_void_p, [_handle, c_size_t, POINTER(c_size_t)], "asset_image_bytes"),
    (_status, [POINTER(Mesh), _handle, _made, _error], "simplify"),
    (_status, [POINTER(Mesh), _handle, POINTER(Level), c_size_t, _made, _error], "simplify_levels"),
    (_status, [_handle, POINTER(c_uint32), POINTER(c_double), c_size_t, POINTER(c_uint32), POINTER(c_double), _error], "result_map"),
    (_status, [_made, c_size_t, _made, _error], "history_create asset_history_create"),
    (_status, [c_char_p, c_size_t, _made, _error], "history_read asset_from_glb"),
    (_status, [_handle, c_uint64, _made, _error], "history_truncate history_truncate_parts"),
    (_status, [c_char_p, _made, _error], "asset_load"),
    (_status, [POINTER(Mesh), _made, _error], "asset_create"),
    (_status, [_handle, _made, _error], "asset_to_glb"),
    (_status, [_handle, c_size_t, _made, _error], "asset_decode_image"),
    (_status, [_handle, _handle, _made, _error], "asset_simplify"),
    (_status, [_handle, _handle, c_char_p, c_char_p, _handle, _made, _error], "asset_bake_onto"),
    (_status, [_handle, _handle, POINTER(Level), c_size_t, c_int, _made, _error], "asset_simplify_levels"),
    (_status, [_handle, _handle, c_uint64, _handle, _made, _error], "asset_bake_truncated"),
    (_status, [_handle, c_char_p, c_int, _error], "asset_save"),
    (_status, [_made, c_size_t, c_double, c_char_p, c_int, _error], "asset_save_levels"),
]


def _open() -> ctypes.CDLL:
    # CDLL releases the interpreter lock while a function runs.
    name = "libfaqem_c.dll" if os.name == "nt" else "libfaqem_c.so"
    opened = ctypes.CDLL(str(pathlib.Path(__file__).with_name(name)))
    for result, arguments, names in _signatures:
        for name in names.split():
            function = getattr(opened, "faqem_" + name)
            function.restype, function.argtypes = result, arguments
    return opened


library = _open()

exceptions: dict[int, type[Exception]] = {
    1: errors.InternalError,
    2: errors.OptionError,
    3: errors.InputError,
    4: errors.UnsupportedError,
    7: errors.WriteError,
    8: errors.Error,  # cancelled by an exception in the progress callback, which Options.run() raises instead
    10: errors.ByteLimitError,
    11: MemoryError,
    12: errors.TimeLimitError,
    75: errors.TryAgainError,
}


def version() -> str:
    """Returns the version of the library, "MAJOR.MINOR.PATCH"."""
    text: bytes = library.faqem_version()
    return text.decode()


def call(function: Any, *arguments: Any) -> None:
    """Calls a function whose last argument is a faqem_error. Raises the corresponding exception."""
    error = _Error()
    status = function(*arguments, ctypes.byref(error))
    if status != 0:
        raise exceptions.get(status, errors.InternalError)(error.message.decode(errors="replace"))


def destroy_with(owner: object, function: Any, handle: c_void_p) -> None:
    """Destroys an object of the library together with its owner in Python.

    Not at the end of the program, because functions that run then may still have arrays that are its memory.
    """
    weakref.finalize(owner, function, handle).atexit = False


class Owner:
    """Owner of an object of the library."""

    def __init__(self, handle: c_void_p, destroy: Any) -> None:
        self.handle = handle
        destroy_with(self, destroy, handle)


class Unchanging:
    """An object that cannot change: its copy is itself."""

    def __copy__(self) -> Self:
        return self

    def __deepcopy__(self, _memo: object) -> Self:
        return self


def create(function: Any, *arguments: Any) -> c_void_p:
    """Calls a function whose last arguments are the created object and a faqem_error. Returns the object."""
    handle = c_void_p()
    call(function, *arguments, ctypes.byref(handle))
    return handle
