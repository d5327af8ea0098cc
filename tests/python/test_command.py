"""Tests of the command and of comparisons as functions."""

import contextlib
import io
import os
import pathlib
import tempfile
import unittest

import faqem
import numpy
from test_arrays import InFolder, flat_grid


class Command(InFolder):
    def setUp(self):
        super().setUp()
        self.file = self.folder / "a b.ply"
        faqem.save(flat_grid(6), self.file)

    def test_it_returns_the_output(self):
        self.assertEqual(faqem.command("--version").split()[-1], faqem.__version__)
        faqem.command("simplify", self.file, self.folder / "b.ply", "--faces", "20", "--bake", "none")
        self.assertLessEqual(len(faqem.load(self.folder / "b.ply").parts[0].triangles), 20)

    def test_exit_codes_become_exceptions(self):
        out = self.folder / "b.ply"
        out.write_text("precious")
        (self.folder / "a.xyz").write_text("1 2 3")
        for kind, message, arguments in (
            (faqem.OptionError, "--no-such", ("info", self.file, "--no-such")),
            (faqem.OptionError, "zero byte", ("info", "a\0b")),
            (faqem.InputError, "missing.glb", ("info", "missing.glb")),
            (faqem.UnsupportedError, "a.xyz", ("info", self.folder / "a.xyz")),
            (faqem.WriteError, "b.ply", ("simplify", self.file, out)),
            (faqem.ByteLimitError, "max_bytes", ("simplify", self.file, self.folder / "c.ply", "--max-bytes", "1")),
        ):
            with self.subTest(arguments=arguments), self.assertRaisesRegex(kind, message):
                faqem.command(*arguments)
        self.assertEqual(out.read_text(), "precious")

    def test_warnings_go_to_standard_error(self):
        with contextlib.redirect_stderr(io.StringIO()) as said:
            faqem.command("info", self.file)
        self.assertEqual(said.getvalue(), "")
        model = self.folder / "model.obj"
        model.write_text("mtllib missing.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        with contextlib.redirect_stderr(io.StringIO()) as said:
            faqem.command("report", model, model, "-o", self.folder / "a.html", "--size", "32", "--without-view")
        self.assertIn("missing.mtl", said.getvalue())


class Compare(unittest.TestCase):
    def test_the_distance_of_parallel_squares_is_found(self):
        vertices, triangles = flat_grid(4)
        above = (vertices + [0, 0, 0.5], triangles)
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "above.glb")
            faqem.save(above, file)
            for other in (above, faqem.Model.from_arrays(*above), file, pathlib.Path(file)):
                found = faqem.compare((vertices, triangles), other, samples=100, tolerance=0)
                self.assertAlmostEqual(found["hausdorff"], 0.5)
                self.assertAlmostEqual(found["hausdorff_bound_rel"], 0.5 / numpy.sqrt(32))
                self.assertEqual((found["samples"], found["tolerance"], found["colors"]), (100, 0, None))
                self.assertNotIn("a", found)

    def test_wrong_arguments_are_named(self):
        mesh = flat_grid(2)
        for name, value in (("samples", 0), ("samples", 1.5), ("tolerance", -1), ("tolerance", "much"), ("threads", -1)):
            with self.subTest(name=name, value=value), self.assertRaisesRegex(faqem.OptionError, name):
                faqem.compare(mesh, mesh, **{name: value})
        with self.assertRaisesRegex(faqem.InputError, "missing.glb"):
            faqem.compare(mesh, "missing.glb")
        with self.assertRaises(faqem.InputError):
            faqem.compare(mesh, ([], []))


if __name__ == "__main__":
    unittest.main()
