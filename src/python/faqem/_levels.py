"""Levels of detail, and the histories that they can be cut from again."""

import ctypes
import os
import weakref

from ._arrays import MeshArrays, mesh_pointer
from ._library import Level, call, create, library
from ._options import Options, parse_length, checked_integer
from ._simplify import Simplified
from .errors import OptionError

_ratio, _faces, _distance = 0, 1, 2  # a share of the diagonal comes after the distance


def _level(level):
    if isinstance(level, str):
        if not level.startswith("error:"):
            raise OptionError(f"levels: {level!r} is none; a distance is 'error:0.01' or 'error:0.1%'")
        value, unit = parse_length(level[len("error:"):], "levels")
        return Level(_distance + unit, value)
    if 0 < level <= 1:
        return Level(_ratio, float(level))
    return Level(_faces, checked_integer(level, "levels", 53))


def level_array(levels):
    """An array of faqem_level."""
    return (Level * len(levels))(*map(_level, levels))


def simplify_levels(vertices, triangles, levels, /, *, groups=None, locks=None, weights=None, uvs=None, **options):
    """Simplifies a triangle soup to one level after the other, and measures each against the original.

    levels   from fine to coarse: 0.5 (share of the triangles), 5000 (triangles), "error:0.01" (distance in model
             units) or "error:0.1%" (of the diagonal)
    options  those of simplify(), without ratio, faces and max_error

    Returns a list of Simplified, whose `error` ascends. Raises what simplify() raises.
    """
    arrays = MeshArrays(vertices, triangles, groups, locks, weights, uvs)
    chosen = Options(**options)
    wanted = level_array(levels)
    made = (ctypes.c_void_p * len(levels))()
    chosen.run(lambda: call(library.faqem_simplify_levels, mesh_pointer(arrays), chosen.object, wanted, len(levels), made))
    return [Simplified(ctypes.c_void_p(one)) for one in made]


def handle_array(levels):
    """The objects of the C door that Simplified or Model have."""
    return (ctypes.c_void_p * len(levels))(*(level._handle.value for level in levels))


class History:
    """How the original became one level after the other. Comes from History.of() or History.load()."""

    def __init__(self, handle):
        self._handle = handle
        weakref.finalize(self, library.faqem_history_destroy, handle)

    @classmethod
    def of(cls, levels):
        """Of what simplify_levels() or bake_levels(), or a list of one simplify() or bake(), gave with history=True."""
        objects = handle_array(levels)
        of_arrays = all(isinstance(level, Simplified) for level in levels)
        make = library.faqem_history_create if of_arrays else library.faqem_asset_history_create
        return cls(create(make, objects, len(levels)))

    @classmethod
    def load(cls, path):
        """From a file of save(), or of the command. Raises InputError, OSError."""
        with open(path, "rb") as file:
            content = file.read()
        return cls(create(library.faqem_history_read, content, len(content)))

    def save(self, path, *, overwrite=False):
        """In the format of docs/history-format.md. Raises OSError."""
        size = ctypes.c_size_t()
        content = ctypes.string_at(library.faqem_history_bytes(self._handle, ctypes.byref(size)), size.value)
        with open(os.fspath(path), "wb" if overwrite else "xb") as file:
            file.write(content)

    def __len__(self):
        """Number of levels."""
        return library.faqem_history_level_count(self._handle)

    @property
    def part_count(self):
        """Meshes that it is of: 1, or the parts of a model."""
        return library.faqem_history_part_count(self._handle)

    def truncate(self, faces):
        """The mesh when no more than so many triangles were left, as a Simplified; see docs/levels.md.

        Raises OptionError, also where it is of several meshes: truncate_parts() is for them, and bake_truncated() for models.
        """
        if self.part_count > 1:
            raise OptionError(f"the history is of {self.part_count} meshes: truncate_parts() cuts them")
        return Simplified(create(library.faqem_history_truncate, self._handle, checked_integer(faces, "faces", 53)))

    def truncate_parts(self, faces):
        """The same for all meshes together: a list of Simplified, one for each part of the model."""
        made = (ctypes.c_void_p * self.part_count)()
        call(library.faqem_history_truncate_parts, self._handle, checked_integer(faces, "faces", 53), made)
        return [Simplified(ctypes.c_void_p(one)) for one in made]
