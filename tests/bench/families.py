#!/usr/bin/python3
"""CPU time of the command per face on unusual meshes of 20,000 faces, relative to a rough plane.

Usage: families.py COMMAND [FAMILY ...]
"""
import itertools
import subprocess
import sys
import tempfile

import numpy as np
from results import run

rng = np.random.default_rng(1)


def plane(n):
    side = int((n / 2) ** 0.5)
    x, y = np.meshgrid(np.arange(side + 1.0), np.arange(side + 1.0), indexing="ij")
    i = (np.arange(side)[:, None] * (side + 1) + np.arange(side)).ravel()
    points = np.stack([x, y, rng.normal(0, 0.3, x.shape)], -1).reshape(-1, 3)
    return points, np.concatenate([np.stack([i, i + side + 1, i + 1], 1), np.stack([i + 1, i + side + 1, i + side + 2], 1)])


def ring(n, noise):
    angle = np.arange(n) * 2 * np.pi / n
    return np.stack([np.cos(angle), np.sin(angle), noise * rng.normal(size=n)], 1)


def fan(n, noise=0.0):
    i = np.arange(n)
    return np.concatenate([[[0, 0, 0]], ring(n, noise)]), np.stack([0 * i, i + 1, (i + 1) % n + 1], 1)


def rough_fan(n):
    return fan(n, 0.1)


def two_fans(n):
    points, faces = fan(n // 2, 0.1)
    points[0, 2] = -1
    other = faces[:, [0, 2, 1]]
    other[:, 0] = len(points)
    return np.concatenate([points, [[0, 0, 1]]]), np.concatenate([faces, other])


def around_an_edge(n):
    i = np.arange(n)
    return np.concatenate([[[0, 0, 0], [0, 0, 1]], ring(n, 0.3)]), np.stack([0 * i, 0 * i + 1, i + 2], 1)


def around_a_vertex(n):
    i = np.arange(n)
    points = rng.normal(size=(n, 1, 3)) + 0.05 * rng.normal(size=(n, 2, 3))
    return np.concatenate([[[0, 0, 0]], points.reshape(-1, 3)]), np.stack([0 * i, 2 * i + 1, 2 * i + 2], 1)


def slivers(n):
    x, i = np.arange(n // 2 + 1) * 1e-4, np.arange(n // 2)
    points = np.concatenate([np.stack([x, 0 * x, 0 * x], 1), np.stack([x, 0 * x + 1, 1e-5 * rng.normal(size=len(x))], 1)])
    return points, np.concatenate([np.stack([i, i + 1, i + len(x)], 1), np.stack([i + 1, i + len(x) + 1, i + len(x)], 1)])


def complete(n):
    count = next(k for k in itertools.count(3) if (k + 1) * k * (k - 1) // 6 > n)
    return rng.normal(size=(count, 3)), np.array(list(itertools.combinations(range(count), 3)))


def separate(n):
    points = rng.random((n, 1, 3)) * n ** (1 / 3) + 0.3 * rng.normal(size=(n, 3, 3))
    return points.reshape(-1, 3), np.arange(3 * n).reshape(-1, 3)


def opposite_copies(n):
    points, faces = plane(n // 2)
    return points, np.concatenate([faces, faces[:, ::-1]])


def random_corners(n):
    return rng.random((n // 4, 3)), rng.integers(0, n // 4, (n, 3))


def write(path, points, faces):
    record = np.zeros(len(faces), [("size", "u1"), ("corners", "<i4", 3)])
    record["size"], record["corners"] = 3, faces
    header = (f"ply\nformat binary_little_endian 1.0\nelement vertex {len(points)}\nproperty float x\nproperty float y\n"
              f"property float z\nelement face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n")
    with open(path, "wb") as file:
        file.write(header.encode() + points.astype("<f4").tobytes() + record.tobytes())


def seconds(command, preset, folder):
    try:
        return run(command, "simplify", f"{folder}/in.ply", f"{folder}/out.ply", "--ratio", "0.1", "--preset", preset,
                   "--threads", "1", "--force", "--quiet", check=True, timeout=300)[1]
    except subprocess.TimeoutExpired:
        return float("inf")


def main(command, *names):
    families = (plane, fan, rough_fan, two_fans, around_an_edge, around_a_vertex, slivers, complete, separate,
                opposite_copies, random_corners)
    plain = {}
    with tempfile.TemporaryDirectory() as folder:
        for family in families:
            if names and family.__name__ not in names and family is not plane:
                continue
            points, faces = family(20000)
            write(f"{folder}/in.ply", points, faces)
            row = []
            for preset in ("fast", "balanced", "best"):
                per_face = seconds(command, preset, folder) / len(faces)
                row.append(per_face / plain.setdefault(preset, per_face))
            print(f"{family.__name__:16}" + "".join(f"{x:9.1f}" for x in row), flush=True)


main(*sys.argv[1:])
