"""Compares with the package fast_simplification: types, counts, and the replay of our collapses by it."""

import fast_simplification
import faqem.fast_simplification as drop_in
import numpy


def grid(n, height):
    x, y = (axis.ravel() for axis in numpy.meshgrid(numpy.arange(n), numpy.arange(n), indexing="ij"))
    first = (n * numpy.arange(n - 1)[:, None] + numpy.arange(n - 1)).ravel()[:, None]
    triangles = numpy.concatenate([first + [0, n, n + 1], first + [0, n + 1, 1]]).astype(numpy.int32)
    return numpy.stack([x, y, height(x, y)], axis=1).astype(float), triangles


def bridged_sheets():
    """Two sheets that two faces at a corner join."""
    points, triangles = grid(30, lambda x, y: 2 * numpy.sin(x / 4))
    above = points + [0, 0, 5]
    return numpy.concatenate([points, above]), numpy.concatenate(
        [triangles, triangles + 900, [[0, 900, 1], [1, 900, 901]]]).astype(numpy.int32)


def tube():
    """A closed band: no border in one direction."""
    points, triangles = grid(64, lambda x, y: 0 * x)
    angle = points[:, 0] * (2 * numpy.pi / 63)
    bent = numpy.stack([numpy.cos(angle), numpy.sin(angle), points[:, 1] / 8 + 0.1 * numpy.sin(5 * angle)], axis=1)
    return bent, numpy.where(triangles >= 63 * 64, triangles - 63 * 64, triangles)


meshes = {"waves": grid(60, lambda x, y: 3 * numpy.sin(x / 8) * numpy.cos(y / 6)), "bridged": bridged_sheets(), "tube": tube()}
for name, (points, triangles) in meshes.items():
    for reduction in (0.5, 0.9, 0.99):
        ours = drop_in.simplify(points, triangles, reduction, return_collapses=True)
        theirs = fast_simplification.simplify(points, triangles, reduction, return_collapses=True)
        assert [array.dtype for array in ours] == [array.dtype for array in theirs]
        assert [array.ndim for array in ours] == [array.ndim for array in theirs]
        assert abs(len(ours[1]) - len(theirs[1])) <= 4, (len(ours[1]), len(theirs[1]))
        replayed = fast_simplification.replay_simplification(points, triangles, ours[2])
        assert len(replayed[1]) == len(ours[1]), (name, reduction, len(replayed[1]), len(ours[1]))
        own = drop_in.replay_simplification(points, triangles, ours[2])
        assert (own[0] == ours[0]).all() and (own[1] == ours[1]).all()
        # Our replay of their collapses has their faces, too.
        assert len(drop_in.replay_simplification(points, triangles, theirs[2])[1]) == len(theirs[1])
        print(f"{name} {reduction}: {len(triangles)} to {len(ours[1])} and {len(theirs[1])} faces")
