"""Runs the Python blocks of a page one after the other, as a reader would who has the models that it names.

Usage: run_page.py PAGE [--print]     with --print, prints the blocks as one program, for type checkers

The blocks share their variables. Those that import a package which is not installed are left out, with a message; tests of
results are in CHECKS. Works in a new folder.
"""

import contextlib
import importlib.util
import io
import os
import pathlib
import re
import sys
import tempfile

import faqem
import numpy

OPTIONAL = ["trimesh", "pyvista"]

# Expressions that hold at the end, by a text that the page must have for them.
CHECKS = {
    "web.glb": 'pathlib.Path("web.glb").stat().st_size <= 100_000',
    "asset.glb": 'asset.report["faces_out"] <= 20_000 and found["colors"]["psnr"] > 30',
    "light": 'sorted(file.name for file in results.iterdir()) == ["a.glb", "b.glb"] and light.report["faces_out"] <= 4_800',
    "waves.history": "len(cut.triangles) <= 1500 and len(values) == len(cut.triangles)",
    "UVs": "colors.shape == (len(part.vertices), 3) and numpy.ptp(colors, axis=0).min() > 50",
    "before-after.png": 'pathlib.Path("before-after.png").exists() and pathlib.Path("page.html").exists()',
}


def write_models():
    """Writes models of 24,000 faces under the names that pages use: a wavy plate, whose colours become a texture."""
    n, m = 121, 101
    x, y = (axis.ravel() for axis in numpy.meshgrid(numpy.arange(n), numpy.arange(m), indexing="ij"))
    z = 6 * numpy.sin(x / 15) * numpy.cos(y / 12)
    lines = [f"v {a} {b} {c:.6f} {a / n:.4f} {b / m:.4f} {0.5 + c / 13:.4f}" for a, b, c in zip(x, y, z)]
    first = [m * a + b + 1 for a in range(n - 1) for b in range(m - 1)]
    lines += [f"f {k} {k + m} {k + m + 1}\nf {k} {k + m + 1} {k + 1}" for k in first]
    pathlib.Path("coloured.obj").write_text("\n".join(lines) + "\n")
    textured = faqem.simplify(faqem.load("coloured.obj"), ratio=1, untouched="baked", texture_size=512)
    pathlib.Path("models").mkdir()
    for name in ("statue.glb", "generated.glb", "models/a.glb", "models/b.glb"):
        faqem.save(textured, name)
    pathlib.Path("models/broken.glb").write_bytes(b"glTF")


def blocks(page):
    """Yields (number of the first line, code) of each Python block."""
    text = page.read_text(encoding="utf-8")
    for match in re.finditer(r"^```python\n(.*?)^```", text, re.DOTALL | re.MULTILINE):
        yield text[: match.start(1)].count("\n") + 1, match[1]


def missing_package(code):
    return next((name for name in OPTIONAL if re.search(rf"^import {name}\b", code, re.MULTILINE)
                 and importlib.util.find_spec(name) is None), None)


def main():
    page = pathlib.Path(sys.argv[1]).resolve()
    if sys.argv[2:] == ["--print"]:
        return print("\n".join(code for _, code in blocks(page)))
    names, count = {}, 0
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        write_models()
        for line, code in blocks(page):
            package = missing_package(code)
            if package:
                print(f"{page.name}:{line}: left out, {package} is not installed")
                continue
            with contextlib.redirect_stderr(io.StringIO()):  # the line of the progress
                exec(compile("\n" * (line - 1) + code, str(page), "exec"), names)
            count += 1
        for text, check in CHECKS.items():
            assert text in page.read_text(encoding="utf-8"), f"the page has no {text}"
            assert eval(check, names), check
        os.chdir("/")
    print(f"{page.name}: {count} blocks")


if __name__ == "__main__":
    main()
