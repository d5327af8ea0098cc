"""Runs the Python blocks of the README with a model statue.glb, measures the import, and looks for the licences.

Usage: try.py README
"""

import importlib.metadata
import pathlib
import re
import subprocess
import sys
import time

import faqem
import numpy


def write_statue():
    """Writes a model of 51,200 faces: a wavy plate with vertex colours, which become a texture."""
    n = 161
    x, y = (axis.ravel() for axis in numpy.meshgrid(numpy.arange(n), numpy.arange(n), indexing="ij"))
    lines = [f"v {a} {b} {(a * b) % 7 * 0.1} {a / n} {b / n} 0.5" for a, b in zip(x, y)]
    first = [n * a + b + 1 for a in range(n - 1) for b in range(n - 1)]
    lines += [f"f {k} {k + n} {k + n + 1}\nf {k} {k + n + 1} {k + 1}" for k in first]
    pathlib.Path("statue.obj").write_text("\n".join(lines) + "\n")
    faqem.save(faqem.load("statue.obj"), "statue.glb")


def import_seconds():
    """Returns the least of several times of `import faqem`, beyond the start of the interpreter."""

    def least(code):
        seconds = []
        for _ in range(5):
            start = time.perf_counter()
            subprocess.run([sys.executable, "-c", code], check=True)
            seconds.append(time.perf_counter() - start)
        return min(seconds)

    return least("import faqem") - least("pass")


def check_licences():
    """Libraries that are bundled have their licences in the wheel, with all texts that these refer to."""
    files = {file.as_posix().partition("licenses/")[2]: file for file in importlib.metadata.files("faqem")}
    assert {"LICENSE", "draco.txt", "libstdc++.txt", "meshoptimizer.txt", "three.js.txt"} <= set(files), sorted(files)
    for name in [name for name in files if name]:
        for other in re.findall(r"/usr/share/(common-licenses/[\w.-]+\w)", files[name].read_text()):
            assert len(files[other].read_text()) > 1000, (name, other)


check_licences()
write_statue()
blocks = re.findall(r"```python\n(.*?)```", pathlib.Path(sys.argv[1]).read_text(), re.DOTALL)
names = {}
for block in blocks:
    exec(block, names)
assert 400 < len(names["out"].triangles) <= 480
assert names["simplified"].report["faces_out"] <= 20_000
assert len(blocks) == 2 and pathlib.Path("simplified.ply").exists() and pathlib.Path("simplified.glb").exists()
seconds = import_seconds()
print(f"numpy {numpy.__version__}, import {1000 * seconds:.1f} ms")
assert seconds < 0.05
