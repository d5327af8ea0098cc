"""simplify(), with the arguments of this module or those of fast_simplification."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal, Protocol, TypeVar, overload

from numpy.typing import ArrayLike

from ._compatible import Collapses, Faces, Points, simplify_compatibly, triangle_rows
from ._model import Model, simplify_model
from ._options import option_names, unknown_keyword
from ._simplify import Simplified, simplify_arrays, simplify_keywords
from ._trimesh import is_trimesh, simplify_trimesh
from .errors import InputError, OptionError

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._types import CompatibleOptions, ModelOptions, SimplifyOptions


class _Exportable(Protocol):
    """Trimesh and Scene of trimesh."""

    metadata: Any

    def export(self, *arguments: Any, **options: Any) -> Any: ...


Exportable = TypeVar("Exportable", bound=_Exportable)


@overload
def simplify(points: Model, **options: Unpack[ModelOptions]) -> Model: ...


@overload
def simplify(points: Exportable, **options: Unpack[ModelOptions]) -> Exportable: ...


@overload
def simplify(
    points: ArrayLike,
    triangles: ArrayLike,
    target_reduction: float,
    *,
    return_collapses: Literal[False] = ...,
    **options: Unpack[CompatibleOptions],
) -> tuple[Points, Faces]: ...


@overload
def simplify(
    points: ArrayLike,
    triangles: ArrayLike,
    target_reduction: float,
    *,
    return_collapses: Literal[True],
    **options: Unpack[CompatibleOptions],
) -> tuple[Points, Faces, Collapses]: ...


@overload
def simplify(
    points: ArrayLike,
    triangles: ArrayLike,
    *,
    target_count: int,
    return_collapses: Literal[False] = ...,
    **options: Unpack[CompatibleOptions],
) -> tuple[Points, Faces]: ...


@overload
def simplify(
    points: ArrayLike,
    triangles: ArrayLike,
    *,
    target_count: int,
    return_collapses: Literal[True],
    **options: Unpack[CompatibleOptions],
) -> tuple[Points, Faces, Collapses]: ...


@overload
def simplify(
    points: ArrayLike,
    triangles: ArrayLike,
    *,
    lossless: Literal[True],
    return_collapses: Literal[False] = ...,
    **options: Unpack[CompatibleOptions],
) -> tuple[Points, Faces]: ...


@overload
def simplify(
    points: ArrayLike,
    triangles: ArrayLike,
    *,
    lossless: Literal[True],
    return_collapses: Literal[True],
    **options: Unpack[CompatibleOptions],
) -> tuple[Points, Faces, Collapses]: ...


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


def simplify(
    points: Any,
    triangles: ArrayLike | None = None,
    target_reduction: float | None = None,
    target_count: int | None = None,
    agg: float | None = None,
    verbose: bool = False,
    return_collapses: bool = False,
    lossless: bool = False,
    preserve_border: bool = False,
    **options: Any,
) -> Any:
    """Simplifies a triangle soup, a model, or a mesh or scene of trimesh.

    points     (v, 3) positions; float32 and float64 are used without a copy
    triangles  (f, 3) vertex indices; uint32 and uint16 are used without a copy. Or the array `faces` of pyvista
    groups     (f,) integers, for group_boundaries="preserved"
    locks      (v,) booleans: true for vertices that must not move
    weights    (v,) factors on the costs, in [1e-6, 1e6]
    uvs        (f, 3, n) attributes of the corners, which are preserved
    options    ratio, faces, max_error, preset, history, progress and others; see docs/python.md

    Returns a Simplified. Raises OptionError, InputError, MemoryError, and the exceptions of `progress`.

    With one of the following three it is called like fast_simplification.simplify(), and returns as that does the points
    (v, 3) float64 and the triangles (f, 3) int32. Of the options of this module, all but `ratio`, `faces`, `max_error`
    and `uvs` can be added.

    target_reduction  share of the triangles to remove, in [0, 1]
    target_count      number of triangles to keep
    lossless          True: only what is flat is removed
    agg               accepted, without effect: collapses are always in the order of their costs
    verbose           True: shows the progress on standard error
    return_collapses  True: the collapses (n, 2) int32 are the third result, for replay_simplification() of either module
    preserve_border   True: boundary="locked"

    A Model alone gives another Model, with new textures. Its options are in docs/python.md, too. It is made for the format
    of the loaded file: `format` names another one, in which it will be saved. Raises also UnsupportedError,
    TimeLimitError and ByteLimitError. A Trimesh or Scene of trimesh gives another one; `metadata["faqem"]` is the report.
    """
    if triangles is None:
        if not isinstance(points, Model) and not is_trimesh(points):
            for keyword in options.keys() - {*option_names(), *simplify_keywords, "progress"}:
                raise unknown_keyword(keyword, [*option_names(), *simplify_keywords, "progress"])
            raise InputError("triangles: missing; only a Model, or a Trimesh or Scene of trimesh, can be simplified alone")
        positional = (target_reduction, target_count, agg, verbose, return_collapses, lossless, preserve_border)
        if positional != (None, None, None, False, False, False, False):
            raise OptionError("a Model, Trimesh or Scene is simplified with ratio, faces or max_error")
        return (simplify_model if isinstance(points, Model) else simplify_trimesh)(points, **options)
    if target_reduction is None and target_count is None and not lossless:
        given = {"agg": agg is not None, "verbose": verbose, "return_collapses": return_collapses,
                 "preserve_border": preserve_border}
        for name in (name for name, is_given in given.items() if is_given):
            raise OptionError(f"{name}: needs target_reduction, target_count or lossless")
        return simplify_arrays(points, triangle_rows(triangles), **options)
    for name in ("ratio", "faces", "max_error", "uvs"):
        if options.get(name) is not None:
            raise OptionError(f"{name}: cannot be combined with target_reduction, target_count or lossless")
    if verbose:
        options.setdefault("progress", True)
    if preserve_border:
        options.setdefault("boundary", "locked")
    return simplify_compatibly(points, triangles, target_reduction, target_count, return_collapses, lossless, **options)
