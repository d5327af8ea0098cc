"""Tests of faqem.fast_simplification. tests/wheel/peers.py compares with the package."""

import contextlib
import io
import unittest

import faqem
import faqem.fast_simplification as fast
import numpy
from numpy.testing import assert_array_equal
from test_arrays import area, flat_grid


def bumpy_grid(n):
    vertices, triangles = flat_grid(n)
    vertices[:, 2] = numpy.cos(vertices[:, 0]) * vertices[:, 1] / 4
    return vertices, triangles


class Call(unittest.TestCase):
    def test_the_results_are_arrays_of_the_types_of_the_package(self):
        vertices, triangles = bumpy_grid(20)
        for points in (vertices, vertices.astype(numpy.float32), vertices.tolist()):
            for faces in (triangles, triangles.astype(numpy.int64), triangles.tolist()):
                for call in ({"target_reduction": 0.9}, {"target_count": 80}):
                    out, left = fast.simplify(points, faces, **call)
                    self.assertEqual((out.dtype, left.dtype), (numpy.float64, numpy.int32))
                    self.assertTrue(70 < len(left) <= 80)
                    self.assertEqual(left.max() + 1, len(out))
        assert_array_equal(fast.simplify(vertices, triangles, 0.9)[1], fast.simplify(vertices, triangles, 0.9, None, 3)[1])

    def test_faces_may_be_padded(self):
        vertices, triangles = bumpy_grid(10)
        padded = numpy.hstack([numpy.full((len(triangles), 1), 3), triangles]).ravel()
        assert_array_equal(fast.simplify(vertices, padded, 0.5)[1], fast.simplify(vertices, triangles, 0.5)[1])
        self.assertEqual(len(faqem.simplify(vertices, padded, faces=100).triangles), 100)
        for wrong in (padded[1:], numpy.where(padded == 3, 4, padded)):
            with self.assertRaisesRegex(faqem.InputError, "triangles"):
                fast.simplify(vertices, wrong, 0.5)

    def test_lossless_removes_only_what_is_flat(self):
        out, left = fast.simplify(*flat_grid(12), lossless=True)
        self.assertLessEqual(len(left), 4)
        self.assertAlmostEqual(abs(area(out, left)), 144)
        vertices, triangles = bumpy_grid(12)
        self.assertEqual(len(fast.simplify(vertices, triangles, lossless=True)[1]), len(triangles))

    def test_preserve_border_keeps_the_border(self):
        vertices, triangles = bumpy_grid(12)
        out, _ = fast.simplify(vertices, triangles, 0.5, preserve_border=True)
        border = (vertices[:, :2] % 12 == 0).any(axis=1)
        self.assertLessEqual(set(map(tuple, vertices[border])), set(map(tuple, out)))

    def test_verbose_and_progress_show_a_bar(self):
        for simplify, options in ((fast.simplify, {"target_reduction": 0.5, "verbose": True}),
                                  (faqem.simplify, {"ratio": 0.5, "progress": True})):
            with contextlib.redirect_stderr(io.StringIO()) as shown:
                simplify(*bumpy_grid(12), **options)
            self.assertRegex(shown.getvalue(), r"^\r.*\rsimplify \[#* *\] +\d+%.*\n$")
            lengths = {len(text) for text in shown.getvalue().strip().split("\r")}
            self.assertEqual(len(lengths), 1, "each text covers the one before")
        with contextlib.redirect_stderr(io.StringIO()) as shown:
            fast.simplify(*bumpy_grid(12), 0.5, progress=False)
        self.assertEqual(shown.getvalue(), "")
        with contextlib.redirect_stderr(None):  # as in programs without a console
            fast.simplify(*bumpy_grid(12), 0.5, progress=True)

    def test_wrong_arguments_are_named(self):
        vertices, triangles = bumpy_grid(4)
        for name, options in {
            "target_reduction": {"target_reduction": 1.5},
            "target_reduction: 'much'": {"target_reduction": "much"},
            "target_reduction: nan": {"target_reduction": float("nan")},
            "target_reduction and target_count": {"target_reduction": 0.5, "target_count": 3},
            "target_count: 33": {"target_count": 33},
            "target_count: -1": {"target_count": -1},
            "target_count: 2.5": {"target_count": 2.5},
            "ratio": {"target_reduction": 0.5, "ratio": 0.5},
            "target_reduction, target_count or lossless": {"return_collapses": True},
            "return_collapses: preset best": {"target_reduction": 0.5, "return_collapses": True, "preset": "best"},
        }.items():
            with self.assertRaisesRegex(faqem.OptionError, name):
                fast.simplify(*bumpy_grid(40) if "best" in name else (vertices, triangles), **options)
        for name, points, faces in (("points", vertices[:, :2], triangles), ("points", "none", triangles),
                                    ("points", [[0, 0, 0], [1]], triangles), ("triangles", vertices, "none"),
                                    ("triangles", vertices, triangles[:, :2]), ("triangles", vertices, triangles + 0.5)):
            for run in (lambda p, f: fast.simplify(p, f, 0.5), lambda p, f: fast.replay_simplification(p, f, [])):
                with self.assertRaisesRegex(faqem.InputError, name):
                    run(points, faces)
        with self.assertRaisesRegex(TypeError, "did you mean 'locks'"):
            fast.simplify(vertices, triangles, target_reduction=0.5, lock=0.5)

    def test_positions_keep_their_type(self):
        vertices, triangles = bumpy_grid(12)
        for kind in (numpy.float32, numpy.float64):
            self.assertEqual(faqem.simplify(vertices.astype(kind), triangles, ratio=0.5).vertices.dtype, kind)
            for level in faqem.simplify_levels(vertices.astype(kind), triangles, [0.5, 0.2]):
                self.assertEqual(level.vertices.dtype, kind)


class Replay(unittest.TestCase):
    def setUp(self):
        self.points, self.triangles = bumpy_grid(24)
        self.out, self.left, self.collapses = fast.simplify(self.points, self.triangles, 0.8, return_collapses=True)

    def test_the_collapses_give_the_same_mesh(self):
        self.assertEqual((self.collapses.dtype, self.collapses.shape[1]), (numpy.int32, 2))
        points, triangles, mapping = fast.replay_simplification(self.points, self.triangles, self.collapses)
        assert_array_equal(points, self.out)
        assert_array_equal(triangles, self.left)
        self.assertEqual(mapping.shape, (len(self.points),))
        corners = mapping[self.triangles]
        kept = (corners != numpy.roll(corners, 1, axis=1)).all(axis=1)
        assert_array_equal(corners[kept], self.left)

    def test_other_points_give_the_same_triangles_and_means(self):
        moved = self.points + [1, 2, 3]
        points, triangles, mapping = fast.replay_simplification(moved, self.triangles, self.collapses)
        same = fast.replay_simplification(moved, self.triangles, numpy.array(self.collapses))
        numpy.testing.assert_allclose(points, same[0])
        self.assertEqual(len(triangles), len(self.left))
        for vertex in range(len(points)):
            numpy.testing.assert_allclose(points[vertex], moved[mapping == vertex].mean(axis=0))

    def test_wrong_collapses_are_rejected(self):
        for wrong in ([[0, 1], [2, 1]], [[0, 1], [1, 2]], [[0, 1], [1, 0]], [[3, 3]], [[0, 625]], [[0, -1]], [[0.5, 1]]):
            with self.assertRaisesRegex(faqem.InputError, "collapses"):
                fast.replay_simplification(self.points, self.triangles, wrong)
        with self.assertRaisesRegex(faqem.InputError, "triangles"):
            fast.replay_simplification(self.points[:5], self.triangles, [])


if __name__ == "__main__":
    unittest.main()
