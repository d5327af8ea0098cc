"""Textured models: loading, simplification with baking, saving."""

from __future__ import annotations

import ctypes
import dataclasses
import json
import math
import os
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy
from numpy.typing import ArrayLike, NDArray

from ._arrays import MeshArrays, view_array
from ._levels import History, Path, Target, as_list, file_name, handle_array, level_array, made_levels
from ._library import Unchanging, call, create, destroy_with, library
from ._options import Options, checked_integer, checked_switch, enum_value, names_keywords, parse_length
from ._simplify import counts_text
from ._textures import Image, Material, materials
from .errors import InputError, OptionError, ReadError, UnsupportedError, WriteError

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._types import CommonModelOptions, ModelOptions


@dataclasses.dataclass(frozen=True)
class Part:
    """One mesh of a model, in local coordinates. Its arrays belong to the model, which they keep alive: they are not
    copied, and cannot be changed."""

    name: str
    vertices: NDArray[numpy.float64]  #: (v, 3) float64; vertices are split at seams, as in the file
    triangles: NDArray[numpy.uint32]  #: (f, 3) uint32
    uvs: list[NDArray[numpy.float32]]  #: for each UV set (v, 2) float32, v pointing down as in glTF
    materials: NDArray[numpy.uint32]  #: (f,) uint32: index into Model.materials, 2^32 - 1 for the default material


class Model(Unchanging):
    """A scene of parts, materials and images. Created by load(), simplify() or Model.from_arrays()."""

    def __init__(self, handle: ctypes.c_void_p) -> None:
        self._handle = handle
        destroy_with(self, library.faqem_asset_destroy, handle)

    def __repr__(self) -> str:
        parts = range(library.faqem_asset_part_count(self._handle))
        faces = sum(library.faqem_asset_face_count(self._handle, part) for part in parts)
        vertices = sum(library.faqem_asset_vertex_count(self._handle, part) for part in parts)
        return f"<faqem.{type(self).__name__}: {counts_text(faces, vertices, self.error)}, parts: {len(parts)}>"

    def __reduce__(self) -> Any:
        raise TypeError("a Model cannot be pickled: GLB rounds its doubles. Pass a file name, or to_glb() and from_glb()")

    @classmethod
    @names_keywords
    def from_arrays(cls, vertices: ArrayLike, triangles: ArrayLike) -> Model:
        """Creates a model of one part without materials; the arrays are copied. Raises InputError."""
        arrays = MeshArrays(vertices, triangles)
        return cls(create(library.faqem_asset_create, arrays.pointer))

    @classmethod
    @names_keywords
    def from_glb(cls, content: bytes) -> Model:
        """Reads the bytes of a .glb file without other files. Raises InputError, UnsupportedError, MemoryError."""
        if not isinstance(content, (bytes, bytearray, memoryview)):
            raise TypeError(f"content: bytes are expected, not {type(content).__name__}")
        content = bytes(content)
        return cls(create(library.faqem_asset_from_glb, content, len(content)))

    def to_glb(self) -> bytes:
        """Returns the bytes of the .glb file that save() writes. Raises WriteError, MemoryError."""
        glb, size = create(library.faqem_asset_to_glb, self._handle), ctypes.c_size_t()
        try:
            return ctypes.string_at(library.faqem_glb_bytes(glb, ctypes.byref(size)), size.value)
        finally:
            library.faqem_glb_destroy(glb)

    @property
    def parts(self) -> list[Part]:
        """List of Part, whose arrays are not copied."""
        count = library.faqem_asset_part_count(self._handle)
        return [self._part(part) for part in range(count)]

    @property
    def materials(self) -> list[Material]:
        """List of Material, with the images that they use."""
        return materials(self)

    @property
    def images(self) -> list[Image]:
        """List of Image, which are decoded by Image.pixels()."""
        return [Image(self, index) for index in range(library.faqem_asset_image_count(self._handle))]

    @property
    def warnings(self) -> list[str]:
        """List of str: what was repaired, left out, or could not be saved."""
        count = library.faqem_asset_warning_count(self._handle)
        return [library.faqem_asset_warning(self._handle, i).decode(errors="replace") for i in range(count)]

    @property
    def not_understood(self) -> list[str]:
        """List of str: kinds of statements that mean nothing for a model and were ignored, and unknown extensions."""
        count = library.faqem_asset_not_understood_count(self._handle)
        texts = (library.faqem_asset_not_understood(self._handle, i) for i in range(count))
        return [text.decode(errors="replace") for text in texts]

    @property
    def report(self) -> dict[str, Any] | None:
        """Report of simplify(), with the keys documented in docs/reference.md; None for other models."""
        text = library.faqem_asset_report_json(self._handle)
        return None if text is None else json.loads(text)

    @property
    def error(self) -> float | None:
        """Upper bound of the distance of a level from the original, in scene units; None for other models."""
        error: float = library.faqem_asset_level_error(self._handle)
        return None if math.isnan(error) else error

    def _part(self, part: int) -> Part:
        v = library.faqem_asset_vertex_count(self._handle, part)
        f = library.faqem_asset_face_count(self._handle, part)
        return Part(
            name=library.faqem_asset_part_name(self._handle, part).decode(errors="replace"),
            vertices=view_array(library.faqem_asset_positions(self._handle, part), (v, 3), self),
            triangles=view_array(library.faqem_asset_triangles(self._handle, part), (f, 3), self),
            uvs=[view_array(library.faqem_asset_uvs(self._handle, part, uv_set), (v, 2), self)
                 for uv_set in range(library.faqem_asset_uv_set_count(self._handle, part))],
            materials=view_array(library.faqem_asset_face_materials(self._handle, part), (f,), self),
        )


class SimplifiedModel(Model):
    """A result of simplify()."""

    @property
    def report(self) -> dict[str, Any]:
        """Report of simplify(), with the keys documented in docs/reference.md."""
        return dict(super().report or {})

    @property
    def warnings(self) -> list[str]:
        """List of str: those of the report, and what could not be saved."""
        return [*self.report["warnings"], *super().warnings]


class ModelLevel(SimplifiedModel):
    """A level of simplify_levels()."""

    @property
    def error(self) -> float:
        """Upper bound of the distance from the original, in scene units."""
        return float(library.faqem_asset_level_error(self._handle))


def as_model(model: Model | tuple[ArrayLike, ArrayLike], name: str) -> Model:
    """Returns a model, made of a pair of arrays if it is one. Raises TypeError with the name of the argument."""
    if isinstance(model, Model):
        return model
    if not isinstance(model, (tuple, list)) or len(model) != 2:
        raise TypeError(f"{name}: a Model or a pair of arrays is expected, not {type(model).__name__}")
    return Model.from_arrays(*model)


def _source(model: Model) -> ctypes.c_void_p:
    """Returns the C object of a model that is simplified. Raises TypeError if it is none, InputError without faces."""
    if not isinstance(model, Model):
        raise TypeError(f"model: a Model is expected, not {type(model).__name__}")
    parts = range(library.faqem_asset_part_count(model._handle))
    if not any(library.faqem_asset_face_count(model._handle, part) for part in parts):
        raise InputError("model: has no triangles")
    return model._handle


def _path(path: Path) -> bytes:
    encoded = os.fsencode(file_name(path))
    if b"\0" in encoded:
        raise InputError(f"{path!r}: the file name contains a zero byte")
    return encoded


def _write(path: Path, replace: bool, function: Any, *arguments: Any) -> None:
    """Calls a function that writes a file. The error of an existing one names the argument that replaces it."""
    encoded = _path(path)
    try:
        call(function, *arguments, encoded, int(replace))
    except WriteError as error:
        if replace or "File exists" not in str(error):
            raise
        raise WriteError(f"{error}; overwrite=True replaces it") from None


@names_keywords
def load(path: Path) -> Model:
    """Loads a .glb, .gltf, .vrm, .obj, .ply, .stl or .off file.

    Returns a Model. Raises InputError, ReadError if there is no such file or it cannot be read, UnsupportedError,
    MemoryError.
    """
    encoded = _path(path)
    try:
        return Model(create(library.faqem_asset_load, encoded))
    except UnsupportedError:
        raise
    except InputError as error:
        if os.path.isfile(encoded) and os.access(encoded, os.R_OK):
            raise
        raise ReadError(str(error)) from None


def simplify_model(model: Model, **options: Unpack[ModelOptions]) -> SimplifiedModel:
    """simplify() of a model."""
    source, chosen = _source(model), Options(**options)
    return chosen.run(lambda: SimplifiedModel(create(library.faqem_asset_simplify, source, chosen.object)))


def simplify_model_levels(
    model: Model, levels: Sequence[Target], textures: str = "each", **options: Unpack[CommonModelOptions]
) -> list[ModelLevel]:
    """simplify_levels() of a model."""
    source, chosen = _source(model), Options(["textures"], **options)
    shared = enum_value(["each", "shared"], textures, "textures")  # faqem_level_textures
    return made_levels(
        ModelLevel, chosen, library.faqem_asset_simplify_levels, source, level_array(levels), shared)


def bake_onto(
    source: Model, target: Model, /, *, uvs: str = "auto", max_distance: float | str = "5%",
    **options: Unpack[CommonModelOptions],
) -> SimplifiedModel:
    """Bakes the appearance of one model onto the mesh of another one, which need not be made from it.

    source        the appearance
    target        the mesh, at the same place
    uvs           "keep": those of the target; "new": new ones; "auto": "keep" if they are in [0, 1] and do not overlap
    max_distance  texels farther from the source show the texels around them: scene units, or "2%" of its diagonal
    options       those about baking; see docs/python.md

    Returns a Model with a report. Raises the exceptions of simplify().
    """
    texts = [str(text).encode() for text in (uvs, max_distance)]
    appearance, mesh, chosen = _source(source), _source(target), Options(["uvs", "max_distance"], **options)
    return chosen.run(
        lambda: SimplifiedModel(create(library.faqem_asset_bake_onto, appearance, mesh, *texts, chosen.object)))


def bake_truncated(
    model: Model, history: History, faces: int, /, **options: Unpack[CommonModelOptions]
) -> SimplifiedModel:
    """Restores a model from a history at a number of triangles and bakes its appearance, without another run.

    model    the model that was simplified
    history  History.of() its levels, or History.load()
    faces    maximum number of triangles over all meshes; the number of a level gives that level
    options  baking options of the run; see docs/python.md

    Returns a Model. Raises the exceptions of simplify(), and InputError if the history is of another model.
    """
    source, chosen = _source(model), Options(**options)
    count = checked_integer(faces, "faces", 53)
    if not isinstance(history, History):
        raise TypeError(f"history: a History is expected, not {type(history).__name__}")
    return chosen.run(lambda: SimplifiedModel(
        create(library.faqem_asset_bake_truncated, source, history._handle, count, chosen.object)))


@names_keywords
def save_levels(
    levels: Sequence[Model],
    path: Path,
    /,
    *,
    pixel_error: float = 1,
    screen_height: float = 1080,
    overwrite: bool = False,
) -> None:
    """Saves levels of detail as one .glb or .gltf file with the extension MSFT_lod; see docs/levels.md.

    levels         list of Model from fine to coarse, of one source; the first one may be the source itself
    path           file name ending in .glb or .gltf
    pixel_error    maximum error of a level on screen, in pixels, > 0
    screen_height  height of the screen in pixels, > 0
    overwrite      whether existing files may be replaced

    What the format cannot store is added to the warnings of the first level. Raises OptionError, and the
    exceptions of save().
    """
    listed, replace = as_list(levels), checked_switch(overwrite, "overwrite")
    lengths = [parse_length(pixel_error, "pixel_error"), parse_length(screen_height, "screen_height")]
    if not all(value > 0 and unit == 0 for value, unit in lengths):
        raise OptionError("pixel_error and screen_height must be > 0")
    share = lengths[0][0] / lengths[1][0]
    handles = handle_array(listed, Model)
    _write(path, replace, library.faqem_asset_save_levels, handles, len(handles), share)


@names_keywords
def save(model: Model | tuple[ArrayLike, ArrayLike], path: Path, *, overwrite: bool = False) -> None:
    """Saves a model as .glb, .gltf, .vrm, .obj, .ply or .stl, by file extension. Each file is complete or absent.

    model      a Model, or a pair of arrays (vertices, triangles)
    path       file name
    overwrite  whether existing files may be replaced

    What the format cannot store is added to model.warnings. Raises WriteError, UnsupportedError, InputError.
    """
    source, replace = as_model(model, "model"), checked_switch(overwrite, "overwrite")
    _write(path, replace, library.faqem_asset_save, source._handle)
