"""The command as a function, and what it measures of two models."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
from typing import Any, Union

from numpy.typing import ArrayLike

from .__main__ import program
from ._levels import Path
from ._library import exceptions
from ._model import Model, as_model, save
from ._options import checked_integer, names_keywords, parse_length
from .errors import Error, InternalError, OptionError

Comparable = Union[Model, "tuple[ArrayLike, ArrayLike]", Path]


def raise_unless_ok(code: int, said: str) -> None:
    """Raises the exception that belongs to an exit code, with what the command said to standard error."""
    if code < 0:
        raise InternalError(f"the command was ended by signal {-code}: {said.strip()}")
    if code > 0:
        raise exceptions.get(code, Error)(said.strip() or f"exit code {code}")


def command(*arguments: str | os.PathLike[str]) -> str:
    """Runs the command faqem, for example command("render", "statue.glb", "statue.png").

    arguments  as in a shell, one by one; docs/cli.md describes them

    Returns the standard output. Warnings of the command go to standard error. Raises the exception that belongs to the
    exit code, with the message of the command; Error for codes that the functions of the module do not have.
    """
    words = [os.fspath(argument) for argument in arguments]
    if any("\0" in word for word in words):
        raise OptionError("an argument of the command contains a zero byte")
    done = subprocess.run([program(), *words], stdin=subprocess.DEVNULL, capture_output=True, check=False)
    said = done.stderr.decode(errors="replace")
    raise_unless_ok(done.returncode, said)
    sys.stderr.write(said)
    return done.stdout.decode(errors="replace")


def _file(model: Comparable, folder: str, name: str) -> str:
    """Returns the name of a file of the model, which is written to the folder if it is none."""
    if isinstance(model, (str, os.PathLike)):
        return os.fspath(model)
    file = os.path.join(folder, name + (".glb" if isinstance(model, Model) else ".ply"))
    save(as_model(model, name), file)
    return file


@names_keywords
def compare(
    a: Comparable, b: Comparable, /, *, samples: int = 200_000, seed: int = 1, tolerance: float = 0.01, threads: int = 0
) -> dict[str, Any]:
    """Measures the distances between two surfaces in both directions, and how their colours differ.

    a, b       models, files, or pairs of arrays (vertices, triangles); relative values refer to the diagonal of `a`
    samples    samples on each surface, for the means, >= 1
    seed       seed of the samples
    tolerance  largest relative difference between the maximum distance and its bound, >= 0
    threads    maximum; 0: all

    Returns a dict with the keys of `faqem compare` (docs/reference.md) but the names of the files: `hausdorff_bound_rel`,
    `chamfer_rel`, `mean_normal_degrees`, `colors` (None if a model has no colours) and others. Raises InputError,
    OptionError.
    """
    length, unit = parse_length(tolerance, "tolerance")
    if unit != 0:
        raise OptionError(f"tolerance: {tolerance!r} is not a number")
    numbers = {"samples": str(checked_integer(samples, "samples", 53)), "seed": str(checked_integer(seed, "seed", 53)),
               "tolerance": repr(length), "threads": str(checked_integer(threads, "threads", 32))}
    with tempfile.TemporaryDirectory() as folder:
        files = [_file(model, folder, name) for model, name in ((a, "a"), (b, "b"))]
        words = [word for name, number in numbers.items() for word in ("--" + name, number)]
        found: dict[str, Any] = json.loads(command("compare", "--json", *words, "--", *files))
    return {key: value for key, value in found.items() if key not in ("a", "b")}
