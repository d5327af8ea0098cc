"""Flat arrays in, flat arrays out."""

import dataclasses
import json

import numpy

from ._arrays import MeshArrays, copied, reference
from ._library import create, library
from ._options import Options


@dataclasses.dataclass(frozen=True)
class Simplified:
    """A small mesh, where it came from, and what happened."""

    vertices: numpy.ndarray  #: (v, 3) float64; what was not moved is unchanged to the last bit
    triangles: numpy.ndarray  #: (f, 3) uint32
    groups: "numpy.ndarray | None"  #: (f,) uint32, or None where the input had none
    vertex_origin: numpy.ndarray  #: (v,) uint32: an input vertex that each grew from
    face_origin: numpy.ndarray  #: (f,) uint32: the input triangle that each was
    report: dict  #: with the keys of docs/cli.md


def simplify(vertices, triangles, /, *, groups=None, locks=None, weights=None, **options):
    """Simplifies a triangle soup.

    vertices   (v, 3) numbers; float32 and float64 are used without a copy
    triangles  (f, 3) whole numbers below v; uint32 without a copy
    groups     (f,) whole numbers, for group_borders="kept"
    locks      (v,) truth values: these stay where they are
    weights    (v,) numbers in [1e-6, 1e6]: errors there count so many times
    options    ratio, faces, max_error, preset, link, border, group_borders, weld_distance, virtual_edges,
               prune, threads, progress; see docs/python.md

    Raises OptionError, InputError, MemoryError, and what `progress` raises.
    """
    arrays = MeshArrays(vertices, triangles, groups, locks, weights)
    chosen = Options(**options)
    result = chosen.run(lambda: create(library.faqem_simplify, reference(arrays), chosen.object))
    try:
        v = library.faqem_result_vertex_count(result)
        f = library.faqem_result_face_count(result)
        return Simplified(
            vertices=copied(library.faqem_result_positions(result), v, 3),
            triangles=copied(library.faqem_result_triangles(result), f, 3),
            groups=None if groups is None else copied(library.faqem_result_face_groups(result), f),
            vertex_origin=copied(library.faqem_result_vertex_origin(result), v),
            face_origin=copied(library.faqem_result_face_origin(result), f),
            report=json.loads(library.faqem_result_report_json(result)),
        )
    finally:
        library.faqem_result_destroy(result)
