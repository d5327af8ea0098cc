"""The functions of the C API (faqem/faqem.h, faqem_levels.h, faqem_asset.h), with errors as exceptions."""

from __future__ import annotations

import ctypes
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
_signatures: dict[str, tuple[Any, list[Any]]] = {
    "faqem_version": (c_char_p, []),
    "faqem_options_create": (_handle, []),
    "faqem_options_destroy": (None, [_handle]),
    "faqem_options_set": (_status, [_handle, c_char_p, c_char_p, POINTER(_Error)]),
    "faqem_option_count": (c_size_t, []),
    "faqem_option_name": (c_char_p, [c_size_t]),
    "faqem_option_help": (c_char_p, [c_size_t]),
    "faqem_options_set_progress": (_status, [_handle, Progress, c_void_p]),
    "faqem_simplify": (c_int, [POINTER(Mesh), _handle, POINTER(_handle), POINTER(_Error)]),
    "faqem_result_destroy": (None, [_handle]),
    "faqem_result_vertex_count": (c_size_t, [_handle]),
    "faqem_result_face_count": (c_size_t, [_handle]),
    "faqem_result_positions": (POINTER(c_double), [_handle]),
    "faqem_result_triangles": (POINTER(c_uint32), [_handle]),
    "faqem_result_face_groups": (POINTER(c_uint32), [_handle]),
    "faqem_result_vertex_origin": (POINTER(c_uint32), [_handle]),
    "faqem_result_face_origin": (POINTER(c_uint32), [_handle]),
    "faqem_result_report_json": (c_char_p, [_handle]),
    "faqem_result_corner_values": (POINTER(c_float), [_handle]),
    "faqem_result_corner_width": (c_uint32, [_handle]),
    "faqem_result_level_error": (c_double, [_handle]),
    "faqem_result_map": (
        c_int,
        [_handle, POINTER(c_uint32), POINTER(c_double), c_size_t, POINTER(c_uint32), POINTER(c_double),
         POINTER(_Error)],
    ),
    "faqem_simplify_levels": (
        c_int,
        [POINTER(Mesh), _handle, POINTER(Level), c_size_t, POINTER(_handle), POINTER(_Error)],
    ),
    "faqem_history_create": (c_int, [POINTER(_handle), c_size_t, POINTER(_handle), POINTER(_Error)]),
    "faqem_history_read": (c_int, [c_char_p, c_size_t, POINTER(_handle), POINTER(_Error)]),
    "faqem_history_destroy": (None, [_handle]),
    "faqem_history_bytes": (c_void_p, [_handle, POINTER(c_size_t)]),
    "faqem_history_part_count": (c_size_t, [_handle]),
    "faqem_history_level_count": (c_size_t, [_handle]),
    "faqem_history_truncate": (c_int, [_handle, c_uint64, POINTER(_handle), POINTER(_Error)]),
    "faqem_history_truncate_parts": (c_int, [_handle, c_uint64, POINTER(_handle), POINTER(_Error)]),
    "faqem_asset_load": (c_int, [c_char_p, POINTER(_handle), POINTER(_Error)]),
    "faqem_asset_from_glb": (c_int, [c_char_p, c_size_t, POINTER(_handle), POINTER(_Error)]),
    "faqem_asset_to_glb": (c_int, [_handle, POINTER(_handle), POINTER(_Error)]),
    "faqem_glb_bytes": (c_void_p, [_handle, POINTER(c_size_t)]),
    "faqem_glb_destroy": (None, [_handle]),
    "faqem_asset_create": (c_int, [POINTER(Mesh), POINTER(_handle), POINTER(_Error)]),
    "faqem_asset_simplify": (c_int, [_handle, _handle, POINTER(_handle), POINTER(_Error)]),
    "faqem_asset_simplify_levels": (
        c_int,
        [_handle, _handle, POINTER(Level), c_size_t, c_int, POINTER(_handle), POINTER(_Error)],
    ),
    "faqem_asset_level_error": (c_double, [_handle]),
    "faqem_asset_save_levels": (
        c_int,
        [POINTER(_handle), c_size_t, c_double, c_char_p, c_int, POINTER(_Error)],
    ),
    "faqem_asset_history_create": (c_int, [POINTER(_handle), c_size_t, POINTER(_handle), POINTER(_Error)]),
    "faqem_asset_bake_truncated": (c_int, [_handle, _handle, c_uint64, _handle, POINTER(_handle), POINTER(_Error)]),
    "faqem_asset_save": (c_int, [_handle, c_char_p, c_int, POINTER(_Error)]),
    "faqem_asset_destroy": (None, [_handle]),
    "faqem_asset_part_count": (c_size_t, [_handle]),
    "faqem_asset_part_name": (c_char_p, [_handle, c_size_t]),
    "faqem_asset_vertex_count": (c_size_t, [_handle, c_size_t]),
    "faqem_asset_face_count": (c_size_t, [_handle, c_size_t]),
    "faqem_asset_positions": (POINTER(c_double), [_handle, c_size_t]),
    "faqem_asset_triangles": (POINTER(c_uint32), [_handle, c_size_t]),
    "faqem_asset_uv_set_count": (c_size_t, [_handle, c_size_t]),
    "faqem_asset_uvs": (POINTER(c_float), [_handle, c_size_t, c_size_t]),
    "faqem_asset_face_materials": (POINTER(c_uint32), [_handle, c_size_t]),
    "faqem_asset_material_count": (c_size_t, [_handle]),
    "faqem_asset_material_name": (c_char_p, [_handle, c_size_t]),
    "faqem_asset_material_image": (c_uint32, [_handle, c_size_t, c_int, POINTER(c_uint32)]),
    "faqem_asset_image_count": (c_size_t, [_handle]),
    "faqem_asset_image_name": (c_char_p, [_handle, c_size_t]),
    "faqem_asset_image_mime_type": (c_char_p, [_handle, c_size_t]),
    "faqem_asset_image_bytes": (c_void_p, [_handle, c_size_t, POINTER(c_size_t)]),
    "faqem_asset_decode_image": (c_int, [_handle, c_size_t, POINTER(_handle), POINTER(_Error)]),
    "faqem_pixels_destroy": (None, [_handle]),
    "faqem_pixels_width": (c_uint32, [_handle]),
    "faqem_pixels_height": (c_uint32, [_handle]),
    "faqem_pixels_has_alpha": (c_int, [_handle]),
    "faqem_pixels_rgba": (POINTER(c_uint8), [_handle]),
    "faqem_asset_warning_count": (c_size_t, [_handle]),
    "faqem_asset_warning": (c_char_p, [_handle, c_size_t]),
    "faqem_asset_not_understood_count": (c_size_t, [_handle]),
    "faqem_asset_not_understood": (c_char_p, [_handle, c_size_t]),
    "faqem_asset_report_json": (c_char_p, [_handle]),
}


def _open() -> ctypes.CDLL:
    # CDLL releases the interpreter lock while a function runs.
    opened = ctypes.CDLL(str(pathlib.Path(__file__).with_name("libfaqem_c.so")))
    for name, (result, arguments) in _signatures.items():
        function = getattr(opened, name)
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
