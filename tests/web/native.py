"""Simplifies models by the native library in one thread, and writes what the test of the package compares.

Usage: native.py FOLDER MODEL...
FOLDER receives NAME.json and the arrays of each case as little-endian files: NAME.positions (float32), NAME.triangles,
NAME.values (corner values, float32), and the results.
"""
import json
import pathlib
import sys

import faqem
import numpy


def grid(n):
    """A wavy sheet of 2 n^2 faces."""
    u, v = numpy.meshgrid(numpy.linspace(0, 1, n + 1), numpy.linspace(0, 1, n + 1))
    height = 0.05 * numpy.sin(9 * u) * numpy.cos(7 * v) + 0.01 * u * v * numpy.sin(40 * u * v)
    i = (numpy.arange(n)[:, None] * (n + 1) + numpy.arange(n)).ravel()
    quads = numpy.stack([i, i + 1, i + n + 2, i + n + 1], 1)
    return numpy.stack([u, v, height], 2).reshape(-1, 3), quads[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3)


def torus(n):
    """A torus of 2 n^2 faces with seams of split vertices."""
    points, triangles = grid(n)
    a, b = 2 * numpy.pi * points[:, 0], 2 * numpy.pi * points[:, 1]
    r = 1 + 0.3 * numpy.cos(b) + points[:, 2] * 0.2
    return numpy.stack([r * numpy.cos(a), r * numpy.sin(a), 0.3 * numpy.sin(b)], 1), triangles


def soup(n):
    """Random triangles, many of which share edges of more than two faces."""
    random = numpy.random.default_rng(1)
    return random.random((n, 3)), random.integers(0, n, (3 * n, 3))


def cases(models):
    """Yields name, positions, triangles, corner values or None, options."""
    yield "grid", *grid(148), None, {"ratio": 0.1}
    for preset in ("qem", "paper", "stmw", "fast", "best"):
        yield f"torus-{preset}", *torus(40), None, {"ratio": 0.2, "preset": preset}
    yield "torus-error", *torus(40), None, {"max_error": "1%"}
    points, triangles = grid(40)
    yield "grid-uvs", points, triangles, points[:, :2][triangles].reshape(-1, 6), {"faces": 500, "virtual_edges": "on"}
    yield "soup", *soup(700), None, {"ratio": 0.5}
    for path in models:
        for number, part in enumerate(faqem.load(path).parts):
            yield f"{path.stem}-{number}", part.vertices, part.triangles, None, {"ratio": 0.3}


def main():
    folder = pathlib.Path(sys.argv[1])
    for name, positions, triangles, values, options in cases(map(pathlib.Path, sys.argv[2:])):
        positions, triangles = positions.astype(numpy.float32), triangles.astype(numpy.uint32)
        uvs = None if values is None else values.astype(numpy.float32).reshape(-1, 3, 2)
        out = faqem.simplify(positions, triangles, uvs=uvs, threads=1, **options)
        arrays = {"positions": positions, "triangles": triangles, "values": uvs, "out-positions": out.vertices,
                  "out-triangles": out.triangles, "out-vertexOrigin": out.vertex_origin, "out-faceOrigin": out.face_origin,
                  "out-cornerValues": out.uvs}
        for key, array in arrays.items():
            (folder / f"{name}.{key}").write_bytes(b"" if array is None else array.tobytes())
        (folder / f"{name}.json").write_text(json.dumps({"options": options, "seconds": out.report["seconds"]["total"]}))
    levels = faqem.simplify_levels(*grid(40), [0.5, "error:1%"], threads=1)
    (folder / "levels.txt").write_text(json.dumps([[len(level.triangles), level.error] for level in levels]))
    positions, triangles = grid(40)
    (folder / "levels.positions").write_bytes(positions.tobytes())
    (folder / "levels.triangles").write_bytes(triangles.astype(numpy.uint32).tobytes())


if __name__ == "__main__":
    main()
