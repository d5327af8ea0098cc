"""Simplification of meshes and scenes of the package trimesh, which passes them as glTF files."""

from __future__ import annotations

import os
import sys
import tempfile
from typing import Any

from ._model import load, save, simplify_model
from .errors import InputError


def is_trimesh(mesh: object) -> bool:
    """Whether an object is a Trimesh or a Scene of trimesh, which is imported if there are such objects."""
    package = sys.modules.get("trimesh")
    return package is not None and isinstance(mesh, (package.Trimesh, package.Scene))


def simplify_trimesh(mesh: Any, **options: Any) -> Any:
    """See simplify()."""
    package = sys.modules["trimesh"]
    is_scene = isinstance(mesh, package.Scene)
    if mesh.is_empty:
        raise InputError(f"mesh: the {'scene' if is_scene else 'mesh'} has no faces")
    with tempfile.TemporaryDirectory() as folder:
        source, result = os.path.join(folder, "source.glb"), os.path.join(folder, "result.glb")
        mesh.export(source)
        model = simplify_model(load(source), **options)
        save(model, result)
        with open(result, "rb") as file:
            loaded = package.load(file, file_type="glb", process=False, **({} if is_scene else {"force": "mesh"}))
    loaded.metadata = {**mesh.metadata, "faqem": model.report}
    return loaded
