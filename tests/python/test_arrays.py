"""Tests of faqem.simplify with numpy arrays."""

import ctypes
import gc
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import faqem
import numpy
from faqem._arrays import MeshArrays
from numpy.testing import assert_array_equal


def flat_grid(n, dtype=numpy.float64):
    """Returns a grid of (n + 1)^2 vertices and 2 n^2 triangles over [0, n]^2."""
    x, y = numpy.meshgrid(numpy.arange(n + 1), numpy.arange(n + 1), indexing="ij")
    vertices = numpy.stack([x.ravel(), y.ravel(), 0 * x.ravel()], axis=1).astype(dtype)
    a = (numpy.arange(n)[:, None] * (n + 1) + numpy.arange(n)).ravel()
    b = a + n + 1
    triangles = numpy.concatenate([numpy.stack([a, b, b + 1], 1), numpy.stack([a, b + 1, a + 1], 1)])
    return vertices, triangles.astype(numpy.uint32)


def area(vertices, triangles):
    a, b, c = (vertices[triangles[:, k]] for k in range(3))
    return 0.5 * numpy.cross(b - a, c - a)[:, 2].sum()


class InFolder(unittest.TestCase):
    """Tests that write files, in a folder of their own."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)


class Arrays(unittest.TestCase):
    def test_the_installed_module_is_imported(self):
        self.assertTrue(faqem.__file__.startswith(os.environ["FAQEM_ENVIRONMENT"]))
        self.assertEqual(faqem.__version__, os.environ["FAQEM_EXPECTED_VERSION"])

    def test_a_flat_square_is_preserved_for_all_array_types(self):
        expected = None
        for kind in (numpy.float32, numpy.float64, numpy.int32):
            for index in (numpy.uint32, numpy.int64, numpy.uint16):
                vertices, triangles = flat_grid(20, kind)
                out = faqem.simplify(vertices, triangles.astype(index), ratio=0.1)
                self.assertLessEqual(len(out.triangles), 80)
                self.assertAlmostEqual(area(out.vertices, out.triangles), 400)
                self.assertEqual(out.report["stop_reason"], "reached_target")
                self.assertEqual(out.report["faces_in"], 800)
                self.assertIsNone(out.groups)
                expected = out if expected is None else expected
                assert_array_equal(out.vertices, expected.vertices)
                assert_array_equal(out.triangles, expected.triangles)

    def test_a_time_limit_is_a_stop_reason(self):
        vertices, triangles = flat_grid(20)
        out = faqem.simplify(vertices, triangles, max_seconds=1e-9)
        self.assertEqual(out.report["stop_reason"], "reached_time_limit")
        self.assertEqual(len(out.triangles), 800)
        for wrong in (0, -1, float("nan")):
            with self.assertRaisesRegex(faqem.OptionError, "max_seconds"):
                faqem.simplify(vertices, triangles, max_seconds=wrong)

    def test_views_and_lists_are_accepted(self):
        vertices, triangles = flat_grid(10)
        out = faqem.simplify(vertices, triangles, faces=40)
        for v, t in [
            (numpy.repeat(vertices, 2, axis=0)[::2], numpy.asfortranarray(triangles)),
            (numpy.concatenate([vertices, vertices + 7], axis=1)[:, :3], numpy.asfortranarray(triangles, numpy.uint32)),
            (numpy.asfortranarray(vertices, numpy.float32), numpy.repeat(triangles, 2, axis=1)[:, ::2]),
            (vertices[::-1].copy()[::-1], triangles[::-1].copy()[::-1]),
            (vertices.astype(">f8"), triangles.astype(">u4")),
            (vertices.tolist(), triangles.tolist()),
        ]:
            again = faqem.simplify(v, t, faces=40)
            assert_array_equal(again.vertices, out.vertices)
            assert_array_equal(again.triangles, out.triangles)

    def test_views_whose_elements_overlap_are_copied(self):
        # Triangle f has corners f, f + 1, f + 2.
        strip = numpy.lib.stride_tricks.sliding_window_view(numpy.arange(12, dtype=numpy.uint32), 3)
        vertices = numpy.stack([numpy.arange(12) // 2, numpy.arange(12) % 2, numpy.zeros(12)], axis=1)
        out, again = (faqem.simplify(vertices, t, ratio=1) for t in (strip, strip.copy()))
        self.assertGreater(len(out.triangles), 0)
        assert_array_equal(out.triangles, again.triangles)
        numbers = numpy.lib.stride_tricks.sliding_window_view(vertices.ravel(), 3)
        out, again = (faqem.simplify(v, triangles, ratio=1) for v in (numbers, numbers.copy())
                      for triangles in [[[0, 4, 8]]])
        assert_array_equal(out.vertices, again.vertices)
        one = numpy.broadcast_to(vertices[0], (3, 3))
        self.assertEqual(len(faqem.simplify(one, [[0, 1, 2]]).triangles), 0)

    def test_arrays_of_supported_types_are_not_copied(self):
        vertices, triangles = flat_grid(10)
        wide = numpy.concatenate([vertices, vertices], axis=1)
        corners = numpy.asfortranarray(triangles, numpy.uint32)
        mesh = MeshArrays(wide[:, 3:], corners).mesh
        self.assertEqual(ctypes.addressof(mesh.double_positions.contents), wide[:, 3:].ctypes.data)
        self.assertEqual((mesh.position_stride, mesh.position_step), (48, 8))
        self.assertEqual(ctypes.addressof(mesh.triangles.contents), corners.ctypes.data)
        self.assertEqual((mesh.triangle_stride, mesh.triangle_step), (4, 4 * len(corners)))
        self.assertFalse(mesh.short_triangles)
        short = triangles.astype(numpy.uint16)
        mesh = MeshArrays(vertices, short).mesh
        self.assertEqual(ctypes.addressof(mesh.short_triangles.contents), short.ctypes.data)
        self.assertEqual((mesh.triangle_stride, mesh.triangle_step), (6, 2))
        self.assertFalse(mesh.triangles)

    def test_results_are_not_copied_and_outlive_the_object(self):
        vertices, triangles = flat_grid(30)
        expected = faqem.simplify(vertices, triangles, ratio=0.5, history=True)
        out = faqem.simplify(vertices, triangles, ratio=0.5)
        address = ctypes.addressof(faqem._library.library.faqem_result_triangles(out._handle).contents)
        self.assertEqual(out.triangles.ctypes.data, address)
        kept, moved = out.triangles, out.vertices
        moved += 1  # the caller's own
        del out
        gc.collect()
        again = [faqem.simplify(vertices, triangles, ratio=0.5) for _ in range(20)]  # would use memory that was freed
        assert_array_equal(kept, expected.triangles)
        assert_array_equal(moved, expected.vertices + 1)
        assert_array_equal(again[-1].vertices, expected.vertices)

    def test_results_can_be_read_while_the_program_ends(self):
        code = ("import atexit\n"  # registered before the module is imported: called after what that registers
                "atexit.register(lambda: print([a.tobytes() for a in arrays] == kept))\n"
                "import faqem, test_arrays as t\n"
                "arrays = [faqem.simplify(*t.flat_grid(40), ratio=0.5).vertices,\n"
                "          faqem.Model.from_arrays(*t.flat_grid(40)).parts[0].vertices]\n"
                "kept = [a.tobytes() for a in arrays]")
        done = subprocess.run([sys.executable, "-c", code], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "True\n", ""))

    def test_changed_results_do_not_change_the_history(self):
        out = faqem.simplify(*flat_grid(12), ratio=0.5, history=True)
        before = out.map([0], [[0.2, 0.3, 0.5]])
        out.vertices += 5
        out.triangles[:] = 0
        for array, same in zip(out.map([0], [[0.2, 0.3, 0.5]]), before):
            assert_array_equal(array, same)

    def test_origins_refer_to_the_input(self):
        vertices, triangles = flat_grid(8)
        groups = numpy.arange(len(triangles)) % 2
        locks = numpy.zeros(len(vertices), dtype=bool)
        locks[40] = True  # the centre
        weights = numpy.ones(len(vertices))
        out = faqem.simplify(vertices, triangles, groups=groups, locks=locks, weights=weights, faces=60)
        assert_array_equal(out.groups, groups[out.face_origin])
        self.assertIn(40, out.vertex_origin)
        kept = out.vertices[list(out.vertex_origin).index(40)]
        assert_array_equal(kept, vertices[40])

    def test_max_error_is_a_percentage_or_a_distance(self):
        vertices, triangles = flat_grid(12)
        out = faqem.simplify(vertices, triangles, max_error="0.1%")
        self.assertTrue(out.report["max_error"]["within"])
        self.assertAlmostEqual(out.report["max_error"]["allowed"], 0.001 * numpy.sqrt(288))
        out = faqem.simplify(vertices, triangles, max_error=0.25)
        self.assertEqual(out.report["max_error"]["allowed"], 0.25)

    def test_empty_arrays_give_empty_results(self):
        for empty in (numpy.zeros((0, 3)), []):
            out = faqem.simplify(empty, empty)
            self.assertEqual(out.vertices.shape, (0, 3))
            self.assertEqual(out.triangles.shape, (0, 3))

    def test_invalid_options_are_rejected_by_name(self):
        vertices, triangles = flat_grid(4)
        for option, value in [("ratio", 0), ("ratio", float("nan")), ("faces", 0), ("faces", -1), ("faces", 2.5),
                              ("faces", numpy.array(40.5)), ("faces", numpy.float32(40)), ("threads", 1.0),
                              ("max_error", "1 percent"), ("max_error", -1), ("preset", "bestest"),
                              ("link", "maybe"), ("boundary", 1), ("threads", 2**32), ("prune", "x%")]:
            with self.subTest(option=option, value=value):
                with self.assertRaisesRegex(faqem.OptionError, option.replace("faces", "faces|face count")):
                    faqem.simplify(vertices, triangles, **{option: value})
        with self.assertRaises(faqem.OptionError):
            faqem.simplify(vertices, triangles, ratio=0.5, faces=5)
        with self.assertRaisesRegex(TypeError, "unknown option 'frobnicate'$"):
            faqem.simplify(vertices, triangles, frobnicate=1)
        with self.assertRaisesRegex(TypeError, "unknown option 'texeldensity'; did you mean 'texel_density'"):
            faqem.simplify(vertices, triangles, texeldensity=1)
        with self.assertRaisesRegex(faqem.OptionError, r"^texel_density must be in \[0.125, 8\], not 9$"):
            faqem.simplify(vertices, triangles, texel_density=9)
        with self.assertRaisesRegex(faqem.InputError, "is a file name"):
            faqem.simplify("in.glb", "out.glb")

    def test_every_option_of_the_library_is_a_keyword(self):
        vertices, triangles = flat_grid(4)
        names = faqem._options.option_names()
        self.assertIn("w_area", names)
        for name in names:
            faqem.simplify(vertices, triangles, **{name: None})
        faqem.simplify(vertices, triangles, link="as_preset", preset="fast", w_area=100, virtual_edges=True,
                       bake="automatic", weld_distance=0, max_error="5%", threads=numpy.uint8(1))
        out = faqem.simplify(*flat_grid(10), boundary="locked")
        self.assertEqual(len(out.triangles), 38)  # a triangulation of the polygon with the 40 boundary vertices

    def test_invalid_arrays_are_rejected_by_name(self):
        vertices, triangles = flat_grid(4)
        nan = vertices.copy()
        nan[3, 1] = numpy.nan
        beyond = triangles.copy()
        beyond[2, 2] = 25
        for v, t, name in [(vertices[:, :2], triangles, "points"), (nan, triangles, "vertex 3"),
                           (vertices, triangles[:, :2], "triangles"), (vertices, triangles * 1.0, "triangles"),
                           (vertices, triangles.astype(int) - 1, "triangles"), (vertices, beyond, "face 2"),
                           (vertices, triangles.astype(int) + 2**32, "triangles")]:
            with self.subTest(name=name), self.assertRaisesRegex(faqem.InputError, name):
                faqem.simplify(v, t)
        for groups in ([0.7] * 32, [2**32] * 32, [-1] * 32, [True] * 32):
            with self.subTest(groups=groups[0]), self.assertRaisesRegex(faqem.InputError, "groups"):
                faqem.simplify(vertices, triangles, groups=groups)
        for option in ("groups", "locks", "weights"):
            with self.subTest(option=option), self.assertRaisesRegex(faqem.InputError, option):
                faqem.simplify(vertices, triangles, **{option: [1, 1]})

    def test_progress_is_called_and_its_exceptions_propagate(self):
        vertices, triangles = flat_grid(20)
        calls = []
        faqem.simplify(vertices, triangles, progress=lambda phase, fraction: calls.append((phase, fraction)))
        self.assertTrue(calls)
        for phase, fraction in calls:
            self.assertIn(phase, ("weld", "simplify"))
            self.assertTrue(0 <= fraction <= 1)

        def stop(_phase, _fraction):
            raise KeyboardInterrupt

        with self.assertRaises(KeyboardInterrupt):
            faqem.simplify(vertices, triangles, progress=stop)
