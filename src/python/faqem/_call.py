"""simplify() of arrays, models, files, and meshes of trimesh."""

from __future__ import annotations

import os
import textwrap
from typing import TYPE_CHECKING, Any, overload

from numpy.typing import ArrayLike

from ._arrays import triangle_rows
from ._levels import Path
from ._model import Model, SimplifiedModel, load, simplify_model
from ._options import Options, option_helps
from ._simplify import Simplified, array_keywords, simplify_arrays
from ._trimesh import is_trimesh, simplify_trimesh
from .errors import InputError

if TYPE_CHECKING:
    from typing import Protocol, Union

    from typing_extensions import TypeVar, Unpack

    from ._types import ModelOptions, SimplifyOptions

    class _Exportable(Protocol):
        """Trimesh and Scene of trimesh."""

        metadata: Any

        def export(self, *arguments: Any, **options: Any) -> Any: ...

    # With a default, models and files need no overload of their own: type checkers list all options for each.
    Result = TypeVar("Result", bound=Union[_Exportable, SimplifiedModel], default=SimplifiedModel)


@overload
def simplify(points: Model | Path | Result, **options: Unpack[ModelOptions]) -> Result: ...


@overload
def simplify(
    points: ArrayLike,
    triangles: ArrayLike,
    *,
    groups: ArrayLike | None = ...,
    locks: ArrayLike | None = ...,
    weights: ArrayLike | None = ...,
    uvs: ArrayLike | None = ...,
    **options: Unpack[SimplifyOptions],
) -> Simplified: ...


def simplify(points: Any, triangles: ArrayLike | None = None, **options: Any) -> Any:
    """Simplifies a triangle soup, a model, a file, or a mesh or scene of trimesh.

    points     (v, 3) positions; float32 and float64 are used without a copy
    triangles  (f, 3) vertex indices; uint32 and uint16 are used without a copy. Or the array `faces` of pyvista
    groups     (f,) integers, for group_boundaries="preserved"
    locks      (v,) booleans: true for vertices that must not move
    weights    (v,) factors on the costs, in [1e-6, 1e6]
    uvs        (f, 3, n) attributes of the corners, such as UVs or colours, which are preserved
    options    below

    Returns a Simplified. Raises OptionError, InputError, MemoryError, and the exceptions of `progress`.

    A Model or a file name alone gives a Model, with new textures. It is made for the format of the loaded file: `format`
    names another one, in which it will be saved. Raises also ReadError, UnsupportedError, TimeLimitError and
    ByteLimitError. A Trimesh or Scene of trimesh gives another one; `metadata["faqem"]` is the report.
    """
    if isinstance(triangles, (str, os.PathLike)):
        raise InputError("triangles: is a file name; faqem.save(faqem.simplify(path), out) writes a result")
    if triangles is not None:
        return simplify_arrays(points, triangle_rows(triangles), **options)
    if isinstance(points, (str, os.PathLike)):
        points = load(points)
    if isinstance(points, Model):
        return simplify_model(points, **options)
    if is_trimesh(points):
        return simplify_trimesh(points, **options)
    Options(["triangles", *array_keywords], **{name: None for name in options if name not in array_keywords})
    raise InputError("triangles: missing; only a Model, a file, or a Trimesh or Scene of trimesh, can be simplified alone")


def _list_options() -> str:
    """The options, for the docstring: name and help text."""
    lines = ["", "", "    Options, of which those about appearance are for models only:"]
    helps = {**option_helps(), "progress": "Called with phase and fraction; True: a bar on standard error"}
    for name, text in helps.items():
        words = textwrap.wrap(text, 96)
        lines += [f"    {name:<18}{words[0]}", *(" " * 22 + more for more in words[1:])]
    return "\n".join(lines) + "\n    "


if simplify.__doc__:  # None with python -OO
    simplify.__doc__ += _list_options().lstrip(" ")
