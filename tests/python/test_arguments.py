"""Tests of wrong arguments: the exception names the argument, and nothing is converted in silence."""

import pathlib
import tempfile
import unittest

import faqem
import faqem.fast_simplification as fast
import numpy
from test_arrays import InFolder, flat_grid
from test_compatible import bumpy_grid


class Objects(InFolder):
    """Objects of another class than the argument's. The C library cannot tell them apart."""

    def setUp(self):
        super().setUp()
        self.mesh = bumpy_grid(6)
        self.out = faqem.simplify(*self.mesh, ratio=0.5, history=True)
        self.model = faqem.Model.from_arrays(*self.mesh)
        self.history = faqem.History.of([self.out])

    def test_another_class_is_a_type_error(self):
        file = self.folder / "a.glb"
        for wrong in (self.out, self.history, None, "a.glb", self.mesh, 5):
            calls = {
                "model": [lambda: faqem.bake_truncated(wrong, self.history, 5)],
                "levels": [lambda: faqem.save_levels([self.model, wrong], file)],
            }
            if wrong is not self.history:
                calls["history"] = [lambda: faqem.bake_truncated(self.model, wrong, 5)]
            if wrong is not self.out:
                calls["levels"].append(lambda: faqem.History.of([self.out, wrong]))
            if wrong is not self.mesh:
                calls["model"].append(lambda: faqem.save(wrong, file))
            if not isinstance(wrong, (str, tuple)):
                calls["b"] = [lambda: faqem.compare(self.model, wrong)]
            for name, named in calls.items():
                for call in named:
                    with self.subTest(name=name, wrong=wrong), self.assertRaisesRegex(TypeError, f"^{name}: "):
                        call()
        for mixed in ([self.out, self.model], [self.model, self.out], [self.history]):
            with self.assertRaisesRegex(TypeError, "^levels: a list of (Model|Simplified)"):
                faqem.History.of(mixed)
        self.assertFalse(file.exists())

    def test_what_is_no_model_needs_triangles(self):
        for wrong in (self.out, self.history, None, self.mesh, 5):
            with self.assertRaisesRegex(faqem.InputError, "^triangles: missing"):
                faqem.simplify(wrong)
            with self.assertRaisesRegex(TypeError, "^levels: a list is expected"):
                faqem.simplify_levels(wrong, [0.5])
        with self.assertRaisesRegex(TypeError, "^levels: come directly after a model"):
            faqem.simplify_levels(self.model, [0.5], [0.2])
        with self.assertRaisesRegex(TypeError, "fast_simplification"):
            faqem.simplify(self.model, target_reduction=0.5)

    def test_levels_are_a_list_of_numbers_and_texts(self):
        for wrong in (None, 0.5, "0.5", self.out):
            for call in (lambda: faqem.simplify_levels(*self.mesh, wrong), lambda: faqem.simplify_levels(self.model, wrong),
                         lambda: faqem.History.of(wrong), lambda: faqem.save_levels(wrong, self.folder / "a.glb")):
                with self.subTest(wrong=wrong), self.assertRaisesRegex(TypeError, "^levels: a list is expected"):
                    call()
        for wrong in (None, [1], numpy.array([0.5, 0.1]), 10**400, "0.5"):
            with self.subTest(wrong=wrong), self.assertRaisesRegex(faqem.OptionError, "^levels: .* is not a level"):
                faqem.simplify_levels(*self.mesh, [wrong])
        expected = faqem.simplify_levels(*self.mesh, [0.5, 0.2])
        for levels in (numpy.array([0.5, 0.2]), (0.5, 0.2), iter([0.5, 0.2])):
            self.assertEqual([len(level.triangles) for level in faqem.simplify_levels(*self.mesh, levels)],
                             [len(level.triangles) for level in expected])

    def test_models_that_nothing_else_holds_are_saved(self):
        file = self.folder / "a.glb"
        faqem.save_levels((faqem.Model.from_arrays(*bumpy_grid(n)) for n in (6, 3)), file)
        self.assertIn(b"MSFT_lod", file.read_bytes())
        faqem.save(bumpy_grid(6), file, overwrite=True)
        self.assertEqual(len(faqem.load(file).parts[0].triangles), 72)

    def test_file_names_are_texts_or_paths(self):
        for call in (faqem.load, faqem.History.load, self.history.save, lambda path: faqem.save(self.model, path),
                     lambda path: faqem.save_levels([self.model], path)):
            for wrong in (None, 5, self.mesh[0]):
                with self.assertRaisesRegex(TypeError, "^path: "):
                    call(wrong)

    def test_files_of_histories_are_named(self):
        file = self.folder / "a.history"
        self.history.save(file)
        file.write_bytes(file.read_bytes()[:-5])
        with self.assertRaisesRegex(faqem.InputError, "a.history: history: "):
            faqem.History.load(file)
        for absent in (self.folder / "missing.history", self.folder):
            with self.assertRaisesRegex(OSError, absent.name):
                faqem.History.load(absent)

    def test_a_model_without_triangles_cannot_be_simplified(self):
        empty = self.folder / "empty.gltf"
        empty.write_text('{"asset": {"version": "2.0"}, "scenes": [{}]}')
        for model in (faqem.load(empty), faqem.Model.from_arrays([], [])):
            for call in (lambda: faqem.simplify(model), lambda: faqem.simplify_levels(model, [0.5]),
                         lambda: faqem.bake_truncated(model, self.history, 5)):
                with self.assertRaisesRegex(faqem.InputError, "^model: has no triangles"):
                    call()


class Values(unittest.TestCase):
    def test_switches_are_true_or_false(self):
        mesh = bumpy_grid(6)
        model = faqem.Model.from_arrays(*mesh)
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder, "a.glb")
            file.write_text("precious")
            for wrong in ("no", 0.5, 1, [True]):
                for name, call in (("history", lambda: faqem.simplify(*mesh, history=wrong)),
                                   ("progress", lambda: faqem.simplify(*mesh, progress=wrong)),
                                   ("overwrite", lambda: faqem.save(model, file, overwrite=wrong)),
                                   ("overwrite", lambda: faqem.save_levels([model], file, overwrite=wrong))):
                    with self.subTest(name=name, wrong=wrong), self.assertRaisesRegex(faqem.OptionError, f"^{name}: "):
                        call()
            self.assertEqual(file.read_text(), "precious")
            faqem.save(model, file, overwrite=numpy.True_)
        faqem.History.of([faqem.simplify(*mesh, history=numpy.True_)])
        self.assertEqual(faqem.simplify(*mesh, virtual_edges=numpy.True_).report["virtual_edges"],
                         faqem.simplify(*mesh, virtual_edges=True).report["virtual_edges"])

    def test_choices_and_lengths_are_named(self):
        mesh = bumpy_grid(6)
        model = faqem.Model.from_arrays(*mesh)
        out = faqem.simplify(*mesh, history=True)
        for wrong in (None, ["each"], 5):
            with self.assertRaisesRegex(faqem.OptionError, "^textures: "):
                faqem.simplify_levels(model, [0.5], textures=wrong)
        for wrong in (None, "many", [1]):
            with self.assertRaisesRegex(faqem.OptionError, "^pixel_error: "):
                faqem.save_levels([model], "a.glb", pixel_error=wrong)
        for wrong in ("text", [[1, 0], [1]], [[1, 0, "0"]], [[1j, 0, 0]], [[1, 0, None, 0]]):
            with self.assertRaisesRegex(faqem.InputError, "barycentric"):
                out.map([0], wrong)

    def test_locks_are_booleans(self):
        vertices, triangles = bumpy_grid(6)
        count = len(vertices)
        for wrong in (numpy.full(count, 0.5), numpy.full(count, numpy.nan), numpy.arange(count), ["no"] * count, [None] * count):
            with self.assertRaisesRegex(faqem.InputError, "^locks: "):
                faqem.simplify(vertices, triangles, locks=wrong)
        locks = numpy.arange(count) % 2
        out = faqem.simplify(vertices, triangles, locks=locks, ratio=0.1)
        again = faqem.simplify(vertices, triangles, locks=locks.astype(bool), ratio=0.1)
        numpy.testing.assert_array_equal(out.triangles, again.triangles)

    def test_positions_are_never_rounded(self):
        vertices, triangles = flat_grid(4)
        for wrong in (vertices.astype(numpy.int64) + 2**60, vertices.astype(numpy.longdouble), vertices.astype(str),
                      vertices + 1j, None, "points"):
            for simplify, call in ((faqem.simplify, {"ratio": 0.5}), (fast.simplify, {"target_reduction": 0.5})):
                with self.assertRaisesRegex(faqem.InputError, "^points: "):
                    simplify(wrong, triangles, **call)
        for good in (vertices.astype(numpy.float16), vertices.astype(numpy.int64), vertices.astype(object)):
            self.assertEqual(faqem.simplify(good, triangles, ratio=0.5).vertices.dtype, numpy.float64)

    def test_numbers_beyond_float32_are_named(self):
        vertices, triangles = flat_grid(4)
        with self.assertRaisesRegex(faqem.InputError, "vertex 0: weight"):
            faqem.simplify(vertices, triangles, weights=numpy.full(len(vertices), 1e300))
        with self.assertRaisesRegex(faqem.InputError, "attributes, corner 0"):
            faqem.simplify(vertices, triangles, uvs=numpy.full((len(triangles), 3, 2), -1e300))

    def test_empty_lists_are_arrays_in_every_call(self):
        for simplify, call in ((faqem.simplify, {"ratio": 0.5}), (fast.simplify, {"target_count": 0}),
                               (fast.simplify, {"target_reduction": 0.5})):
            out = simplify([], [], **call)
            points, faces = out if isinstance(out, tuple) else (out.vertices, out.triangles)
            self.assertEqual((points.shape, faces.shape), ((0, 3), (0, 3)))

    def test_positions_cut_from_a_history_keep_their_type(self):
        vertices, triangles = bumpy_grid(12)
        for kind in (numpy.float32, numpy.float64):
            levels = faqem.simplify_levels(vertices.astype(kind), triangles, [0.5, 0.2], history=True)
            history = faqem.History.of(levels)
            self.assertEqual(history.truncate(50).vertices.dtype, kind)
            self.assertEqual(history.truncate_parts(50)[0].vertices.dtype, kind)


class Keywords(unittest.TestCase):
    def test_a_misspelt_keyword_names_the_right_one(self):
        vertices, triangles = bumpy_grid(6)
        out = faqem.simplify(vertices, triangles, history=True)
        model = faqem.Model.from_arrays(vertices, triangles)
        for wrong, right, call in (
            ("triangels", "triangles", lambda **keyword: faqem.simplify(vertices, ratio=0.5, **keyword)),
            ("triangels", "triangles", lambda **keyword: faqem.simplify(vertices, triangles, **keyword)),
            ("rato", "ratio", lambda **keyword: faqem.simplify(vertices, **keyword)),
            ("weight", "weights", lambda **keyword: faqem.simplify_levels(vertices, triangles, [0.5], **keyword)),
            ("progres", "progress", lambda **keyword: faqem.simplify(model, **keyword)),
            ("texture", "textures", lambda **keyword: faqem.simplify_levels(model, [0.5], **keyword)),
            ("overwrit", "overwrite", lambda **keyword: faqem.save(model, "a.glb", **keyword)),
            ("pixel_eror", "pixel_error", lambda **keyword: faqem.save_levels([model], "a.glb", **keyword)),
            ("sample", "samples", lambda **keyword: faqem.compare(model, model, **keyword)),
            ("triangels", "triangles", lambda **keyword: faqem.Model.from_arrays(vertices, **keyword)),
            ("colapses", "collapses", lambda **keyword: fast.replay_simplification(vertices, triangles, **keyword)),
            ("barycentrics", "barycentric", lambda **keyword: out.map([0], **keyword)),
            ("overwrit", "overwrite", lambda **keyword: faqem.History.of([out]).save("a.history", **keyword)),
            ("paht", "path", lambda **keyword: faqem.load(**keyword)),
        ):
            with self.subTest(wrong=wrong), self.assertRaisesRegex(TypeError, f"'{wrong}'; did you mean '{right}'"):
                call(**{wrong: 1})


if __name__ == "__main__":
    unittest.main()
