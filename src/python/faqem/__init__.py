"""Mesh simplification with texture baking, for numpy arrays and textured models.

    out = faqem.simplify(vertices, triangles, ratio=0.1)
    simplified = faqem.simplify("statue.glb", faces=20_000)
    faqem.save(simplified, "simplified.glb")

docs/python.md describes all options.
"""

from __future__ import annotations

import importlib

from . import errors
from .errors import *

# Everything else is imported when it is first used, so that the command and programs that only may need faqem start
# without numpy and the library.
_modules = {
    **dict.fromkeys(["History", "simplify_levels"], "_levels"),
    **dict.fromkeys(["Model", "ModelLevel", "Part", "SimplifiedModel", "bake_onto", "bake_truncated", "load", "save", "save_levels"], "_model"),
    **dict.fromkeys(["command", "compare"], "_command"),
    **dict.fromkeys(["Image", "Material", "Texture"], "_textures"),
    **dict.fromkeys(["Simplified", "SimplifiedLevel"], "_simplify"),
    "simplify": "_call",
}
__all__ = sorted([*(name for name in vars(errors) if name.endswith("Error")), *_modules])

TYPE_CHECKING = False  # type checkers take it for true; the module typing would take a third of the import's time
if TYPE_CHECKING:
    from ._call import simplify as simplify
    from ._command import command as command, compare as compare
    from ._levels import History as History, simplify_levels as simplify_levels
    from ._model import Model as Model, ModelLevel as ModelLevel, Part as Part, SimplifiedModel as SimplifiedModel
    from ._model import bake_onto as bake_onto, bake_truncated as bake_truncated
    from ._model import load as load, save as save, save_levels as save_levels
    from ._simplify import Simplified as Simplified, SimplifiedLevel as SimplifiedLevel
    from ._textures import Image as Image, Material as Material, Texture as Texture

    __version__: str


def __getattr__(name: str) -> object:
    if name == "__version__":
        value = importlib.import_module("._library", __name__).version()
    elif name == "batch":
        value = importlib.import_module(".batch", __name__)
    elif name in _modules:
        value = getattr(importlib.import_module("." + _modules[name], __name__), name)
    else:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted([*globals(), *_modules, "__version__", "batch"])
