"""Tests of faqem.simplify_levels, histories, and the map to the original."""

import pathlib
import tempfile
import unittest

import faqem
import numpy
from numpy.testing import assert_allclose, assert_array_equal


def hill(n):
    """Returns a curved grid of (n + 1)^2 vertices and 2 n^2 triangles."""
    x, y = numpy.meshgrid(numpy.arange(n + 1.0), numpy.arange(n + 1.0), indexing="ij")
    vertices = numpy.stack([x, y, 3 * numpy.sin(x / 4) * numpy.cos(y / 5)], axis=-1).reshape(-1, 3)
    a = ((n + 1) * numpy.arange(n)[:, None] + numpy.arange(n)).reshape(-1, 1)
    return vertices, numpy.concatenate([a + [0, n + 1, n + 2], a + [0, n + 2, 1]])


def points(vertices, triangles, faces, weights):
    return numpy.einsum("nk,nki->ni", weights, vertices[triangles[faces]])


class Levels(unittest.TestCase):
    def test_levels_have_fewer_faces_and_larger_errors(self):
        levels = faqem.simplify_levels(*hill(20), ["50%", 100, "error:5%"])
        self.assertEqual(len(levels), 3)
        self.assertLessEqual(len(levels[0].triangles), 400)
        self.assertLessEqual(len(levels[1].triangles), 100)
        self.assertTrue(0 < levels[0].error <= levels[1].error <= levels[2].error)
        self.assertIsNone(faqem.simplify(*hill(20)).error)

    def test_invalid_levels_are_rejected(self):
        for wrong in [[0.1, 0.5], ["fine"], ["error:much"], [2.5], [0], [-1], [float("nan")]]:
            with self.subTest(wrong), self.assertRaises(faqem.OptionError):
                faqem.simplify_levels(*hill(6), wrong)
        with self.assertRaises(faqem.OptionError):
            faqem.simplify_levels(*hill(6), [0.5], ratio=0.5)

    def test_exceptions_of_progress_propagate(self):
        def stop(phase, fraction):
            raise KeyError(phase)

        with self.assertRaises(KeyError):
            faqem.simplify_levels(*hill(20), [0.5, 0.1], progress=stop)

    def test_a_saved_history_reproduces_every_level(self):
        levels = faqem.simplify_levels(*hill(20), [300, 50], history=True)
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "hill.history"
            faqem.History.of(levels).save(path)
            with self.assertRaises(FileExistsError):
                faqem.History.of(levels).save(path)
            history = faqem.History.load(path)
            path.write_bytes(path.read_bytes()[:-1])
            with self.assertRaises(faqem.InputError):
                faqem.History.load(path)
        self.assertEqual(len(history), 2)
        for level in levels:
            cut = history.truncate(len(level.triangles))
            assert_array_equal(cut.vertices, level.vertices)
            assert_array_equal(cut.triangles, level.triangles)
            assert_array_equal(cut.face_origin, level.face_origin)
            self.assertEqual(len(cut.vertex_origin), 0)
        self.assertLessEqual(len(history.truncate(150).triangles), 150)
        with self.assertRaises(faqem.OptionError):
            history.truncate(0)
        with self.assertRaises(faqem.OptionError):
            faqem.History.of([faqem.simplify(*hill(6))])
        with self.assertRaises(faqem.OptionError):
            faqem.History.of([])

    def test_points_are_mapped_to_nearby_points_of_the_original(self):
        vertices, triangles = hill(20)
        out = faqem.simplify(vertices, triangles, ratio=0.2, history=True)
        faces = numpy.arange(len(out.triangles))
        weights = numpy.full((len(faces), 3), 1 / 3)
        source, there = out.map(faces, weights)
        assert_allclose(there.sum(axis=1), 1)
        offset = points(vertices, triangles, source, there) - points(out.vertices, out.triangles, faces, weights)
        self.assertLess(numpy.linalg.norm(offset, axis=1).max(), 1)
        for wrong in [([len(faces)], [[1, 0, 0]]), ([0], [[2, 0, 0]]), ([0, 1], [[1, 0, 0]])]:
            with self.subTest(wrong), self.assertRaises(faqem.InputError):
                out.map(*wrong)
        with self.assertRaises(faqem.OptionError):
            faqem.simplify(vertices, triangles).map([0], [[1, 0, 0]])

    def test_indices_of_points_are_never_converted(self):
        out = faqem.simplify(*hill(6), ratio=0.5, history=True)
        for wrong in ([2**32], [2**32 - 1], [2**64], [-1], [0.7], [0.0], [float("nan")], [True], ["0"], [None],
                      numpy.array([-1], numpy.int8)):
            with self.subTest(wrong), self.assertRaisesRegex(faqem.InputError, "faces"):
                out.map(wrong, [[1, 0, 0]])
        expected, _ = out.map([1], [[1, 0, 0]])
        for kind in (numpy.int8, numpy.uint16, numpy.int64, numpy.uint64, ">u4"):
            assert_array_equal(out.map(numpy.array([1], kind), [[1, 0, 0]])[0], expected)
        source, weights = out.map([], numpy.empty((0, 3)))
        self.assertEqual((source.shape, weights.shape), ((0,), (0, 3)))

    def test_uvs_are_interpolated(self):
        vertices, triangles = hill(20)
        uvs = vertices[triangles][:, :, :2] / 20
        out = faqem.simplify(vertices, triangles, uvs=uvs, ratio=0.2)
        self.assertEqual(out.uvs.shape, (len(out.triangles), 3, 2))
        assert_allclose(out.uvs, out.vertices[out.triangles][:, :, :2] / 20, atol=0.05)
        self.assertIsNone(faqem.simplify(vertices, triangles).uvs)
        for wrong in [uvs[:-1], uvs[:, :2], uvs[:, :, :0], uvs.reshape(-1, 2)]:
            with self.assertRaises(faqem.InputError):
                faqem.simplify(vertices, triangles, uvs=wrong)
