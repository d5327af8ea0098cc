"""The functions of the package fast_simplification, with its arguments and results: change one import.

    from faqem.fast_simplification import simplify, replay_simplification
"""

from __future__ import annotations

import hashlib
from typing import TYPE_CHECKING, Any, Literal, overload

import numpy
from numpy.typing import ArrayLike, NDArray

from ._arrays import check_rows, checked_indices, checked_positions, triangle_rows
from ._levels import History
from ._options import checked_integer, names_keywords
from ._simplify import Simplified, simplify_arrays
from .errors import InputError, OptionError

Points = NDArray[numpy.float64]
Faces = NDArray[numpy.int32]

# "Lossless": the rounding of positions, as a share of the diagonal. Nothing that is not flat is removed.
_lossless_error = "1e-7%"

__all__ = ["Collapses", "replay_simplification", "simplify"]

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._types import CompatibleOptions

    _IntArray = NDArray[numpy.int32]
else:
    _IntArray = numpy.ndarray


class Collapses(_IntArray):
    """The collapses of simplify(), (n, 2) int32: in each, the second vertex of the input was merged into the first.

    An array that also knows where the remaining vertices were placed, for replay_simplification().
    """

    points: Points | None  #: (v, 3) the simplified points; None for arrays made from this one
    remaining: NDArray[numpy.int64] | None  #: (v,) the vertex of the input that stands for each
    source: bytes  #: digest of the points of the input

    def __array_finalize__(self, _other: object) -> None:
        self.points, self.remaining, self.source = None, None, b""


def _target(target_reduction: float | None, target_count: int | None, faces: int) -> int:
    if target_reduction is not None and target_count is not None:
        raise OptionError("target_reduction and target_count: only one of them can be set")
    if target_count is not None:
        count = checked_integer(target_count, "target_count", 53)
        if count > faces:
            raise OptionError(f"target_count: {count} is more than the {faces} triangles of the mesh")
        return max(count, 1)
    try:
        removed = float(target_reduction) if target_reduction is not None else -1.0
    except (TypeError, ValueError):
        removed = -1.0
    if not 0 <= removed <= 1:
        raise OptionError(f"target_reduction: {target_reduction!r} is not in [0, 1]")
    return max(int((1 - removed) * faces), 1)


@overload
def simplify(
    points: ArrayLike, triangles: ArrayLike, target_reduction: float | None = ..., target_count: int | None = ...,
    agg: float | None = ..., verbose: bool = ..., return_collapses: Literal[False] = ..., lossless: bool = ...,
    preserve_border: bool = ..., **options: Unpack[CompatibleOptions],
) -> tuple[Points, Faces]: ...


@overload
def simplify(
    points: ArrayLike, triangles: ArrayLike, target_reduction: float | None = ..., target_count: int | None = ...,
    agg: float | None = ..., verbose: bool = ..., *, return_collapses: Literal[True], lossless: bool = ...,
    preserve_border: bool = ..., **options: Unpack[CompatibleOptions],
) -> tuple[Points, Faces, Collapses]: ...


def simplify(
    points: ArrayLike, triangles: ArrayLike, target_reduction: float | None = None, target_count: int | None = None,
    agg: float | None = None, verbose: bool = False, return_collapses: bool = False, lossless: bool = False,
    preserve_border: bool = False, **options: Any,
) -> Any:
    """As simplify() of fast_simplification: one of `target_reduction`, `target_count` and `lossless` must be given.

    points            (v, 3) positions
    triangles         (f, 3) vertex indices, or the array `faces` of pyvista
    target_reduction  share of the triangles to remove, in [0, 1]
    target_count      number of triangles to keep
    lossless          True: only what is flat is removed
    agg               accepted, without effect: collapses are always in the order of their costs
    verbose           True: shows the progress on standard error
    return_collapses  True: the collapses (n, 2) int32 are the third result, for replay_simplification() of either module
    preserve_border   True: boundary="locked"
    options           those of faqem.simplify() but `ratio`, `faces`, `max_error` and `uvs`

    Returns the points (v, 3) float64 and the triangles (f, 3) int32. Raises the exceptions of faqem.simplify().
    """
    if target_reduction is None and target_count is None and not lossless:
        raise OptionError("target_reduction, target_count or lossless must be given")
    for name in ("ratio", "faces", "max_error", "uvs"):
        if options.get(name) is not None:
            raise OptionError(f"{name}: cannot be combined with target_reduction, target_count or lossless")
    if verbose:
        options.setdefault("progress", True)
    if preserve_border:
        options.setdefault("boundary", "locked")
    positions = checked_positions(points, "points", numpy.float64)
    rows = triangle_rows(triangles)
    if lossless:
        options["max_error"] = _lossless_error
    else:
        options["faces"] = _target(target_reduction, target_count, len(rows))
    # Vertices at one position are not merged, as there: the collapses are of the vertices that were given.
    out = simplify_arrays(positions, rows, history=bool(return_collapses), **{"welding": "none", **options})
    result = out.vertices.astype(numpy.float64, copy=False), out.triangles.astype(numpy.int32)
    return (*result, _collapses(out, positions)) if return_collapses else result


def _roots(parents: NDArray[numpy.int64]) -> NDArray[numpy.int64]:
    """Follows parents up to those that are their own."""
    while True:
        above = parents[parents]
        if numpy.array_equal(above, parents):
            return parents
        parents = above


def _digest(positions: Points) -> bytes:
    return hashlib.blake2b(numpy.ascontiguousarray(positions).tobytes(), digest_size=16).digest()


def _sections(history: bytes) -> dict[str, NDArray[Any]]:
    """Returns the arrays of the first history in a file up to `remaining_versions` (docs/history-format.md)."""
    position, vector = ("<f8", 3), ("<u4", 1)
    layout = {
        "positions": position, "triangles": ("<u4", 3), "face_groups": vector, "first": vector, "second": vector,
        "created": position, "patch_begin": ("<u8", 1), "patch_faces": vector, "final_positions": position,
        "deletion_times": ("<u8", 1), "deleted_faces": vector, "remaining_versions": vector,
    }
    begin = history.index(b"FAQEMH03") + 8
    sections = {}
    for name, (kind, width) in layout.items():
        count = int(numpy.frombuffer(history, "<u8", 1, begin)[0])
        array = numpy.frombuffer(history, kind, count * width, begin + 8)
        sections[name] = array.reshape(count, width) if width > 1 else array
        begin += 8 + array.nbytes
    return sections


def _collapses(out: Simplified, positions: Points) -> Collapses:
    """Translates the versions of the history (docs/history-format.md) to vertices of the input."""
    sections = _sections(History.of([out]).to_bytes())
    if len(sections["patch_begin"]) > len(sections["first"]) + 1:
        raise OptionError("return_collapses: preset best flips edges, which collapses cannot express")
    first, second = sections["first"].astype(numpy.int64), sections["second"].astype(numpy.int64)
    count = len(sections["positions"])
    vertices = _roots(numpy.concatenate([numpy.arange(count), first]))
    array = numpy.stack([vertices[first], vertices[second]], axis=1).astype(numpy.int32).view(Collapses)
    array.points, array.source = out.vertices.astype(numpy.float64), _digest(positions)
    array.remaining = vertices[sections["remaining_versions"]]
    return array


@names_keywords
def replay_simplification(
    points: ArrayLike, triangles: ArrayLike, collapses: ArrayLike
) -> tuple[Points, Faces, NDArray[numpy.int64]]:
    """Applies the collapses of simplify() to a mesh with the same triangles.

    points     (n, 3) positions: those of the simplified mesh, or others, for example of another pose
    triangles  (f, 3) vertex indices of the mesh that was simplified
    collapses  from simplify(return_collapses=True), or of fast_simplification

    Returns the points (v, 3) float64, the triangles (g, 3) int32, and for each vertex of the input the vertex that it
    became (n,) int64, or -1 if that is part of no triangle. With the points and the collapses of a run the mesh is that
    of the run; otherwise a vertex is the mean of those that were merged into it. Faces that the run removed without a
    collapse (duplicates that stood in its way) remain. Raises InputError if an index is out of range, or a vertex is
    used after it was merged. O((n + f) log n)
    """
    positions = checked_positions(points, "points", numpy.float64)
    rows = checked_indices(triangle_rows(triangles), "triangles").astype(numpy.int64)
    pairs = checked_indices(collapses, "collapses")
    pairs = check_rows(pairs, 2, "collapses").astype(numpy.int64)
    for name, indices in (("triangles", rows), ("collapses", pairs)):
        if indices.size and indices.max() >= len(positions):
            raise InputError(f"{name}: the index {indices.max()} is not one of the {len(positions)} points")
    ends = numpy.full(len(positions), len(pairs))
    ends[pairs[::-1, 1]] = numpy.arange(len(pairs))[::-1]
    again = (ends[pairs[:, 0]] <= numpy.arange(len(pairs))) | (ends[pairs[:, 1]] < numpy.arange(len(pairs)))
    if again.any():
        raise InputError(f"collapses: entry {again.argmax()} has a vertex that was merged before")
    parents = numpy.arange(len(positions))
    parents[pairs[:, 1]] = pairs[:, 0]
    roots = _roots(parents)
    merged = roots[rows]
    merged = merged[(merged != numpy.roll(merged, 1, axis=1)).all(axis=1)]
    remaining, placed = None, None
    if isinstance(collapses, Collapses) and collapses.source == _digest(positions):
        remaining, placed = collapses.remaining, collapses.points
    if remaining is None or placed is None:
        remaining = numpy.unique(merged)
        sizes = numpy.bincount(roots, minlength=len(positions))[remaining]
        sums = [numpy.bincount(roots, positions[:, axis], minlength=len(positions))[remaining] for axis in range(3)]
        placed = numpy.stack(sums, axis=1) / sizes[:, None]
    numbers = numpy.full(len(positions), -1)
    numbers[remaining] = numpy.arange(len(remaining))
    return placed.copy(), numbers[merged].astype(numpy.int32), numbers[roots]
