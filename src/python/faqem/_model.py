"""Textured models: load, bake, save."""

import ctypes
import dataclasses
import json
import math
import os
import weakref

import numpy

from ._arrays import MeshArrays, copy_array, mesh_pointer
from ._levels import handle_array, level_array
from ._library import call, create, library
from ._options import Options, checked_integer
from .errors import InputError, OptionError

_level_textures = {"each": 0, "shared": 1}


@dataclasses.dataclass(frozen=True)
class Part:
    """A copy of one mesh of a model, in its own coordinates."""

    name: str
    vertices: numpy.ndarray  #: (v, 3) float64; vertices are split at seams, as in the file
    triangles: numpy.ndarray  #: (f, 3) uint32


class Model:
    """A scene of parts, materials and images. Comes from load(), bake() or Model.from_arrays()."""

    def __init__(self, handle):
        self._handle = handle
        weakref.finalize(self, library.faqem_asset_destroy, handle)

    @classmethod
    def from_arrays(cls, vertices, triangles):
        """One part without materials; the arrays are copied."""
        arrays = MeshArrays(vertices, triangles)
        return cls(create(library.faqem_asset_create, mesh_pointer(arrays)))

    @property
    def parts(self):
        """A list of Part, copied anew each time."""
        count = library.faqem_asset_part_count(self._handle)
        return [self._part(part) for part in range(count)]

    @property
    def warnings(self):
        """What was repaired, left out, or could not be saved."""
        count = library.faqem_asset_warning_count(self._handle)
        return [library.faqem_asset_warning(self._handle, i).decode(errors="replace") for i in range(count)]

    @property
    def report(self):
        """What bake() did, with the keys of docs/cli.md; None for other models."""
        text = library.faqem_asset_report_json(self._handle)
        return None if text is None else json.loads(text)

    @property
    def error(self):
        """Of a level: no point is farther from the original, in units of the scene; None of other models."""
        error = library.faqem_asset_level_error(self._handle)
        return None if math.isnan(error) else error

    def _part(self, part):
        v = library.faqem_asset_vertex_count(self._handle, part)
        f = library.faqem_asset_face_count(self._handle, part)
        return Part(
            name=library.faqem_asset_part_name(self._handle, part).decode(errors="replace"),
            vertices=copy_array(library.faqem_asset_positions(self._handle, part), v, 3),
            triangles=copy_array(library.faqem_asset_triangles(self._handle, part), f, 3),
        )


def _path(path):
    encoded = os.fsencode(path)
    if b"\0" in encoded:
        raise InputError(f"{path!r}: a zero byte in a file name")
    return encoded


def load(path):
    """Loads .glb, .gltf, .obj, .ply, .stl or .off. Raises InputError, UnsupportedError, MemoryError."""
    return Model(create(library.faqem_asset_load, _path(path)))


def bake(model, /, **options):
    """Simplifies a model and bakes its look anew; the model is left as it is.

    options  those of simplify(), and bake, texture_size, texel_density, normal_map, normals, image_format; see
             docs/python.md

    Raises OptionError, InputError, UnsupportedError, MemoryError, and what `progress` raises.
    """
    chosen = Options(**options)
    return Model(chosen.run(lambda: create(library.faqem_asset_simplify, model._handle, chosen.object)))


def bake_levels(model, levels, /, *, textures="each", **options):
    """Simplifies a model to one level after the other, each with a new look; the model is left as it is.

    levels    as of simplify_levels(); distances are in units of the scene
    textures  "each": every level its own; "shared": all those that were baked for the finest level
    options   those of bake(), without ratio, faces and max_error

    Returns a list of Model, whose `error` ascends. Raises what bake() raises.
    """
    if textures not in _level_textures:
        raise OptionError(f"textures: {textures!r} is neither 'each' nor 'shared'")
    chosen = Options(**options)
    wanted = level_array(levels)
    made = (ctypes.c_void_p * len(levels))()
    chosen.run(lambda: call(library.faqem_asset_simplify_levels, model._handle, chosen.object, wanted, len(levels),
                            _level_textures[textures], made))
    return [Model(ctypes.c_void_p(one)) for one in made]


def bake_truncated(model, history, faces, /, **options):
    """The model when no more than so many triangles were left, with a look baked anew, without another run.

    model    the one that was simplified
    history  History.of() of its levels, or from a file
    faces    for all meshes together; as many as a level has give that level
    options  those of the look that the run had; see docs/python.md

    Returns a Model. Raises what bake() raises, and InputError where the history is of another model.
    """
    chosen = Options(**options)
    count = checked_integer(faces, "faces", 53)
    return Model(chosen.run(lambda: create(library.faqem_asset_bake_truncated, model._handle, history._handle, count,
                                           chosen.object)))


def save_levels(levels, path, /, *, pixel_error=1, screen_height=1080, overwrite=False):
    """Saves levels in one .glb or .gltf with the extension MSFT_lod; see docs/levels.md.

    levels         Models from fine to coarse, of one source; the first one may be the source itself
    pixel_error    pixels that a level may be off where it is shown,
    screen_height  on a screen with so many

    What the format cannot hold is added to the warnings of the first level. Raises what save() raises.
    """
    if not (pixel_error > 0 and screen_height > 0):
        raise OptionError("pixel_error and screen_height: must be above 0")
    share = float(pixel_error) / float(screen_height)
    call(library.faqem_asset_save_levels, handle_array(levels), len(levels), share, _path(path), 1 if overwrite else 0)


def save(model, path, *, overwrite=False):
    """Saves as .glb, .gltf, .obj, .ply or .stl, by name; the file is complete or not there at all.

    model  a Model, or a pair of arrays (vertices, triangles)

    What the format cannot hold is added to model.warnings. Raises WriteError, UnsupportedError, InputError.
    """
    if not isinstance(model, Model):
        model = Model.from_arrays(*model)
    call(library.faqem_asset_save, model._handle, _path(path), 1 if overwrite else 0)
