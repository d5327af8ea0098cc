"""Types of the keyword arguments, for type checkers. docs/python.md describes the options."""

from __future__ import annotations

from collections.abc import Callable
from typing import Literal, TypedDict, Union

from numpy.typing import ArrayLike

Length = Union[float, str]  # 0.01 in model units, or "0.1%" of the diagonal


class CommonOptions(TypedDict, total=False):
    """Options of all calls that simplify."""

    preset: Literal["qem", "paper", "stmw", "fast", "balanced", "best"] | None
    w_area: float | None
    w_boundary: float | None
    w_normal: float | None
    w_uv: float | None
    w_plane_area: float | None
    link: Literal["as_preset", "as-preset", "off", "by_size", "by-size", "on", "strict"] | None
    boundary: Literal["free", "locked"] | None
    group_boundaries: Literal["free", "preferred", "preserved"] | None
    welding: Literal["by_position", "by-position", "none"] | None
    weld_distance: float | None
    prune: Length | None
    virtual_edges: float | bool | None
    history: bool | None
    threads: int | None
    progress: Callable[[str, float], object] | bool | None


class _Target(TypedDict, total=False):
    ratio: float | str | None  # 0.1 or "10%"
    faces: float | None  # a whole number, as 5000 or 1e5
    max_error: Length | None
    max_seconds: float | None


class CommonModelOptions(CommonOptions, total=False):
    """Options of all calls that make models."""

    budget: Literal["scene", "mesh"] | None
    visibility: Literal["auto", "ignored", "weighted"] | None
    format: Literal["auto", "glb", "gltf", "obj", "ply", "stl"] | None
    allow_larger: bool | None
    max_bytes: int | str | None
    bake: Literal["automatic", "auto", "atlas", "per_triangle", "per-triangle", "vertex", "keep", "none"] | None
    texture_size: int | None
    texel_density: float | None
    normal_map: Literal["automatic", "auto", "on", "off"] | None
    normals: Literal["auto", "transfer", "smooth", "flat", "none"] | None
    crease_angle: float | None
    image_format: Literal["auto", "png", "jpeg", "source", "webp", "png-or-jpeg", "png_or_jpeg"] | None
    image_quality: float | None
    jpeg_quality: int | None
    untouched: Literal["auto", "kept", "baked"] | None
    samples: int | None
    compress: Literal["source", "none", "meshopt", "draco"] | None
    quantize: Literal["source", "off", "on"] | None
    position_bits: int | None
    normal_bits: int | None
    uv_bits: int | None


class CompatibleOptions(CommonOptions, total=False):
    """Options of simplify() of faqem.fast_simplification."""

    max_seconds: float | None
    groups: ArrayLike | None
    locks: ArrayLike | None
    weights: ArrayLike | None


class SimplifyOptions(CommonOptions, _Target, total=False):
    """Options of simplify()."""


class ModelOptions(CommonModelOptions, _Target, total=False):
    """Options of simplify() of a model."""
