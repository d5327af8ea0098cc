"""Mesh simplification with texture baking, for numpy arrays and textured models.

    out = faqem.simplify(vertices, triangles, ratio=0.1)
    simplified = faqem.bake(faqem.load("statue.glb"), faces=20_000)
    faqem.save(simplified, "simplified.glb")

docs/python.md describes all options.
"""

from ._library import version as _version
from ._levels import History, simplify_levels
from ._model import Model, Part, bake, bake_truncated, bake_levels, load, save, save_levels
from ._simplify import Simplified, simplify
from .errors import Error, InputError, InternalError, OptionError, TimeLimitError, UnsupportedError, WriteError

__version__ = _version()

__all__ = [
    "Error",
    "History",
    "InputError",
    "InternalError",
    "Model",
    "OptionError",
    "Part",
    "Simplified",
    "TimeLimitError",
    "UnsupportedError",
    "WriteError",
    "bake",
    "bake_truncated",
    "bake_levels",
    "load",
    "save",
    "save_levels",
    "simplify",
    "simplify_levels",
]
