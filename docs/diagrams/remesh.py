"""Makes a coarse mesh of squares around a binary STL file, as remeshers do. Usage: remesh.py IN.stl OUT.obj [CELLS]

CELLS is the number of cells along the longest side. The mesh has neither UVs nor colours.
"""
import itertools
import math
import pathlib
import struct
import sys


def samples(data, spacing):
    """Points on all triangles at most `spacing` apart."""
    for face in range(struct.unpack_from("<I", data, 80)[0]):
        values = struct.unpack_from("<9f", data, 84 + 50 * face + 12)
        a, b, c = values[:3], values[3:6], values[6:]
        n = max(1, math.ceil(max(math.dist(a, b), math.dist(b, c), math.dist(c, a)) / spacing))
        for i in range(n + 1):
            for j in range(n + 1 - i):
                yield tuple((a[k] * i + b[k] * j + c[k] * (n - i - j)) / n for k in range(3))


def main(source, out, cells=40):
    data = pathlib.Path(source).read_bytes()
    corners = list(samples(data, math.inf))
    low, high = ([pick(p[k] for p in corners) for k in range(3)] for pick in (min, max))
    side = max(h - l for l, h in zip(low, high)) / cells
    size = [math.ceil((h - l) / side) + 4 for l, h in zip(low, high)]
    inside = {}  # points by cell
    for p in samples(data, side / 5):
        inside.setdefault(tuple(int((p[k] - low[k]) / side) + 2 for k in range(3)), []).append(p)
    steps = [tuple(sign * (k == axis) for k in range(3)) for axis in range(3) for sign in (-1, 1)]
    outside, open_cells = {(0, 0, 0)}, [(0, 0, 0)]
    while open_cells:
        cell = open_cells.pop()
        for step in steps:
            to = tuple(map(sum, zip(cell, step)))
            if to not in outside and to not in inside and all(0 <= x < s for x, s in zip(to, size)):
                outside.add(to)
                open_cells.append(to)
    vertices, faces = {}, []
    for cell, axis, sign in itertools.product(sorted(inside), range(3), (0, 1)):
        if tuple(x + (2 * sign - 1) * (k == axis) for k, x in enumerate(cell)) not in outside:
            continue
        u, v = (axis + 1) % 3, (axis + 2) % 3
        square = []
        for du, dv in ((0, 0), (1, 0), (1, 1), (0, 1)):
            at = list(cell)
            at[axis], at[u], at[v] = at[axis] + sign, at[u] + du, at[v] + dv
            square.append(vertices.setdefault(tuple(at), len(vertices) + 1))
        faces.append(square if sign else square[::-1])
    places, neighbours = [[low[k] + (at[k] - 2) * side for k in range(3)] for at in vertices], [set() for _ in vertices]
    for square in faces:
        for i in range(4):
            neighbours[square[i] - 1].update((square[i - 1] - 1, square[i - 3] - 1))
    for _ in range(12):
        places = [[(p[k] + sum(places[n][k] for n in near) / len(near)) / 2 for k in range(3)]
                  for p, near in zip(places, neighbours)]
    with open(out, "w") as file:
        for p in places:
            print("v", *(f"{x:.6g}" for x in p), file=file)
        for square in faces:
            print("f", *square, file=file)


main(*sys.argv[1:3], *map(int, sys.argv[3:]))
