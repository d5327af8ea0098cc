"""Mesh simplification with texture baking, for numpy arrays and textured models.

    out = faqem.simplify(vertices, triangles, ratio=0.1)
    simplified = faqem.simplify("statue.glb", faces=20_000)
    faqem.save(simplified, "simplified.glb")

docs/python.md describes all options.
"""

from __future__ import annotations

import importlib

from .errors import (
    ByteLimitError,
    Error,
    InputError,
    InternalError,
    OptionError,
    ReadError,
    TimeLimitError,
    TryAgainError,
    UnsupportedError,
    WriteError,
)

TYPE_CHECKING = False  # type checkers take it for true; the module typing would take a third of the import's time
if TYPE_CHECKING:
    from ._levels import History, simplify_levels
    from ._model import Model, ModelLevel, Part, SimplifiedModel, bake_truncated, load, save, save_levels
    from ._call import simplify
    from ._command import command, compare
    from ._simplify import Simplified, SimplifiedLevel
    from ._textures import Image, Material, Texture

    __version__: str

__all__ = [
    "ByteLimitError",
    "Error",
    "History",
    "Image",
    "InputError",
    "InternalError",
    "Material",
    "Model",
    "ModelLevel",
    "OptionError",
    "Part",
    "ReadError",
    "Simplified",
    "SimplifiedLevel",
    "SimplifiedModel",
    "Texture",
    "TimeLimitError",
    "TryAgainError",
    "UnsupportedError",
    "WriteError",
    "bake_truncated",
    "command",
    "compare",
    "load",
    "save",
    "save_levels",
    "simplify",
    "simplify_levels",
]

# The rest is imported when it is first used, so that the command and programs that only may need faqem start without
# numpy and the library.
_modules = {
    **dict.fromkeys(["History", "simplify_levels"], "_levels"),
    **dict.fromkeys(["Model", "ModelLevel", "Part", "SimplifiedModel", "bake_truncated", "load", "save", "save_levels"], "_model"),
    **dict.fromkeys(["command", "compare"], "_command"),
    **dict.fromkeys(["Image", "Material", "Texture"], "_textures"),
    **dict.fromkeys(["Simplified", "SimplifiedLevel"], "_simplify"),
    "simplify": "_call",
}


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
