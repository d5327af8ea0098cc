"""Levels of detail, and collapse histories from which further levels can be restored."""

from __future__ import annotations

import ctypes
import os
from collections.abc import Callable, Iterable, Sequence
from typing import TYPE_CHECKING, Any, TypeVar, Union, overload

import numpy
from numpy.typing import ArrayLike, DTypeLike

from ._library import Level, Unchanging, call, create, destroy_with, library
from ._options import Options, checked_integer, checked_switch, names_keywords, parse_length
from ._simplify import Simplified, SimplifiedLevel, array_keywords, mesh_arrays
from .errors import InputError, OptionError

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._model import Model, ModelLevel
    from ._types import CommonModelOptions, CommonOptions

Target = Union[float, str]  # of a level
Path = Union[str, "os.PathLike[str]"]
Made = TypeVar("Made")

_ratio, _faces, _distance = 0, 1, 2  # faqem_level_kind; 3 is a distance as a share of the diagonal
_expected = "(expected: 0.5, '50%', 5000, 'error:0.01', 'error:0.1%')"


def file_name(path: Path) -> str:
    """Returns a file name as text. Raises TypeError with the name of the argument if it is none."""
    try:
        return os.fsdecode(path)
    except TypeError as error:
        raise TypeError(f"path: {error}") from None


def _level(level: Target) -> Level:
    if isinstance(level, str):
        is_share = level.endswith("%") and not level.startswith("error:")
        if not (is_share or level.startswith("error:")):
            raise OptionError(f"levels: {level!r} is not a level {_expected}")
        value, unit = parse_length(level.removeprefix("error:"), "levels")
        return Level(_ratio if is_share else _distance + unit, value)
    try:
        ratio = float(level)
    except (TypeError, ValueError, OverflowError):
        raise OptionError(f"levels: {level!r} is not a level {_expected}") from None
    if 0 < ratio <= 1:
        return Level(_ratio, ratio)
    return Level(_faces, checked_integer(int(ratio) if ratio.is_integer() else level, "levels", 53))


def level_array(levels: Sequence[Target]) -> Any:
    """Converts levels to an array of faqem_level. Raises TypeError if they are no list."""
    targets = as_list(levels)
    return (Level * len(targets))(*map(_level, targets))


def as_list(levels: Any) -> list[Any]:
    """Returns the elements of the argument `levels`. Raises TypeError if it is a single one."""
    if isinstance(levels, str) or not isinstance(levels, Iterable):
        raise TypeError(f"levels: a list is expected, not {type(levels).__name__}")
    return list(levels)


@overload
def simplify_levels(
    points: Model | Path, levels: Sequence[Target], /, *, textures: str = ..., **options: Unpack[CommonModelOptions]
) -> list[ModelLevel]: ...


@overload
def simplify_levels(
    points: ArrayLike,
    triangles: ArrayLike,
    levels: Sequence[Target],
    /,
    *,
    groups: ArrayLike | None = ...,
    locks: ArrayLike | None = ...,
    weights: ArrayLike | None = ...,
    uvs: ArrayLike | None = ...,
    **options: Unpack[CommonOptions],
) -> list[SimplifiedLevel]: ...


def simplify_levels(points: Any, triangles: Any, levels: Any = None, /, **options: Any) -> Any:
    """Simplifies a triangle soup or a model to several levels of detail, and measures each against the original.

    points, triangles, groups, locks, weights, uvs
              as for simplify(); or a Model or a file name instead of the first two
    levels    from fine to coarse: 0.5 (share of the triangles), 5000 (number of triangles), "error:0.01" (distance in
              model units, for a Model in scene units) or "error:0.1%" (distance as a share of the diagonal)
    textures  of a Model: "each": every level has its own textures; "shared": all levels have those of the finest one
    options   those of simplify(), except ratio, faces and max_error

    Returns a list of SimplifiedLevel or ModelLevel, whose `error` never decreases. Raises the exceptions of simplify().
    """
    from ._model import Model, load, simplify_model_levels

    if isinstance(points, (str, os.PathLike)):
        points = load(points)
    if isinstance(points, Model):
        if levels is not None:
            raise TypeError("levels: come directly after a model")
        return simplify_model_levels(points, triangles, **options)
    if levels is None:
        raise TypeError("levels: a list is expected after the triangles, or after a Model")
    arrays = mesh_arrays(points, triangles, options, "vertices")
    chosen = Options(array_keywords, **options)
    has_history = bool(options.get("history"))
    return made_levels(
        lambda one: SimplifiedLevel(one, arrays.kind, has_history=has_history),
        chosen, library.faqem_simplify_levels, arrays.pointer, level_array(levels))


def made_levels(
    make: Callable[[ctypes.c_void_p], Made], chosen: Options, function: Any, source: Any, wanted: Any, *more: Any
) -> list[Made]:
    """Calls a function of the library that makes levels of a source. `make` wraps each."""
    made = (ctypes.c_void_p * len(wanted))()

    def run() -> list[Made]:
        call(function, source, chosen.object, wanted, len(wanted), *more, made)
        return [make(ctypes.c_void_p(one)) for one in made]

    return chosen.run(run)


def handle_array(levels: list[Any], kind: type) -> Any:
    """Returns the C objects of a list as an array, which does not keep them alive.

    Raises TypeError if an element is not of the type `kind`: Simplified or Model.
    """
    for level in levels:
        if not isinstance(level, kind):
            raise TypeError(f"levels: a list of {kind.__name__} is expected, but one is {type(level).__name__}")
    handles = (level.history_handle() if isinstance(level, Simplified) else level._handle for level in levels)
    return (ctypes.c_void_p * len(levels))(*(handle.value for handle in handles))


class History(Unchanging):
    """Collapse history of a chain of levels. Created by History.of() or History.load()."""

    def __init__(self, handle: ctypes.c_void_p, kind: DTypeLike = numpy.float64) -> None:
        self._handle, self._kind = handle, kind  # the type of positions
        destroy_with(self, library.faqem_history_destroy, handle)

    def __repr__(self) -> str:
        return f"<faqem.History: levels: {len(self)}, meshes: {self.part_count}>"

    def __reduce__(self) -> tuple[Any, ...]:
        return _restored_history, (self.to_bytes(), numpy.dtype(self._kind).str)

    @classmethod
    def of(cls, levels: Sequence[Simplified] | Sequence[Model]) -> History:
        """Creates the history of a run with history=True.

        levels  the result of simplify_levels(), or a list with one result of simplify()

        Raises OptionError if a level has no history, and InputError if the levels are not of one run.
        """
        from ._model import Model

        listed = as_list(levels)
        if any(isinstance(level, Model) for level in listed):
            return cls(create(library.faqem_asset_history_create, handle_array(listed, Model), len(listed)))
        objects = handle_array(listed, Simplified)
        kind = numpy.result_type(*(level.vertices.dtype for level in listed)) if listed else numpy.float64
        return cls(create(library.faqem_history_create, objects, len(listed)), kind)

    @classmethod
    def load(cls, path: Path) -> History:
        """Reads a history file of save() or of the command; positions are float64. Raises InputError, OSError."""
        name = file_name(path)
        with open(name, "rb") as file:
            content = file.read()
        try:
            return cls(create(library.faqem_history_read, content, len(content)))
        except InputError as error:
            raise type(error)(f"{name}: {error}") from None

    @names_keywords
    def save(self, path: Path, *, overwrite: bool = False) -> None:
        """Writes the history in the format of docs/history-format.md. Raises OSError."""
        name, replace = file_name(path), checked_switch(overwrite, "overwrite")
        if not replace and os.path.exists(name):
            raise FileExistsError(f"{name}: file exists; overwrite=True replaces it")
        with open(name, "wb" if replace else "xb") as file:
            file.write(self.to_bytes())

    def to_bytes(self) -> bytes:
        """Returns the content of the file that save() writes."""
        size = ctypes.c_size_t()
        content = library.faqem_history_bytes(self._handle, ctypes.byref(size))
        return ctypes.string_at(content, size.value)

    def __len__(self) -> int:
        """Number of levels."""
        return int(library.faqem_history_level_count(self._handle))

    @property
    def part_count(self) -> int:
        """Number of meshes: 1, or the number of parts of a model."""
        return int(library.faqem_history_part_count(self._handle))

    def truncate(self, faces: int) -> Simplified:
        """Restores the mesh at the first time when at most `faces` triangles were left; see docs/levels.md.

        Returns a Simplified. Raises OptionError, also if the history has several meshes: use truncate_parts(),
        or bake_truncated() for a model.
        """
        if self.part_count > 1:
            raise OptionError(f"the history has {self.part_count} meshes: use truncate_parts()")
        count = checked_integer(faces, "faces", 53)
        return Simplified(create(library.faqem_history_truncate, self._handle, count), self._kind)

    def truncate_parts(self, faces: int) -> list[Simplified]:
        """Restores all meshes at a total number of triangles. Returns a list of Simplified, one per part."""
        made = (ctypes.c_void_p * self.part_count)()
        call(library.faqem_history_truncate_parts, self._handle, checked_integer(faces, "faces", 53), made)
        return [Simplified(ctypes.c_void_p(one), self._kind) for one in made]


def _restored_history(content: bytes, kind: str) -> History:
    """A history from its bytes, for pickle."""
    return History(create(library.faqem_history_read, content, len(content)), kind)
