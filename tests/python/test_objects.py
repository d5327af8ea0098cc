"""Tests of results as objects of Python: pickled, copied, printed; and of arguments in the forms that users try."""

import concurrent.futures
import copy
import pathlib
import pickle
import pydoc
import tempfile
import unittest

import faqem
import numpy
from numpy.testing import assert_array_equal
from test_compatible import bumpy_grid


def simplified(seed):
    vertices, triangles = bumpy_grid(10)
    return faqem.simplify(vertices + seed, triangles, ratio=0.5, history=True)


class Results(unittest.TestCase):
    def setUp(self):
        self.mesh = bumpy_grid(10)
        self.out = simplified(0)

    def test_a_result_comes_back_from_another_process_without_its_history(self):
        with concurrent.futures.ProcessPoolExecutor(1) as pool:
            (other,) = pool.map(simplified, [0])
        for name in ("vertices", "triangles", "vertex_origin", "face_origin"):
            assert_array_equal(getattr(other, name), getattr(self.out, name))
        self.assertEqual(other.report["faces_out"], self.out.report["faces_out"])
        for call in (lambda: other.map([0], [[1, 0, 0]]), lambda: faqem.History.of([other])):
            with self.assertRaisesRegex(faqem.OptionError, "history: was not pickled"):
                call()

    def test_copies_of_a_result_keep_its_history_and_deep_ones_have_their_own_arrays(self):
        for make in (copy.copy, copy.deepcopy):
            other = make(self.out)
            assert_array_equal(other.map([3], [[1, 0, 0]])[0], self.out.map([3], [[1, 0, 0]])[0])
            self.assertEqual(other.vertices is self.out.vertices, make is copy.copy)
            assert_array_equal(other.vertices, self.out.vertices)

    def test_a_history_is_pickled_with_the_type_of_its_positions(self):
        for kind in (numpy.float32, numpy.float64):
            levels = faqem.simplify_levels(self.mesh[0].astype(kind), self.mesh[1], [0.5, 0.2], history=True)
            history = faqem.History.of(levels)
            other = pickle.loads(pickle.dumps(history))
            self.assertEqual(other.to_bytes(), history.to_bytes())
            self.assertEqual(other.truncate(60).vertices.dtype, kind)
            self.assertIs(copy.deepcopy(history), history)

    def test_a_model_is_copied_as_itself_and_passed_as_bytes(self):
        model = faqem.Model.from_arrays(*self.mesh)
        self.assertIs(copy.copy(model), model)
        self.assertIs(copy.deepcopy([model])[0], model)
        with self.assertRaisesRegex(TypeError, r"to_glb\(\)"):
            pickle.dumps(model)
        content = model.to_glb()
        assert_array_equal(faqem.Model.from_glb(content).parts[0].triangles, self.mesh[1])
        with self.assertRaises(faqem.InputError):
            faqem.Model.from_glb(content[:100])
        with self.assertRaisesRegex(TypeError, "content: bytes"):
            faqem.Model.from_glb("a.glb")

    def test_objects_print_their_counts(self):
        count = len(self.out.vertices)
        self.assertEqual(repr(self.out), f"<faqem.Simplified: {len(self.out.triangles)} faces, {count} vertices>")
        model = faqem.Model.from_arrays(*self.mesh)
        self.assertEqual(repr(model), "<faqem.Model: 200 faces, 121 vertices, parts: 1>")
        levels = faqem.simplify_levels(*self.mesh, [0.5, 0.1], history=True)
        self.assertRegex(repr(levels[1]), r"^<faqem.SimplifiedLevel: \d+ faces, \d+ vertices, error [0-9.]+>$")
        self.assertEqual(repr(faqem.History.of(levels)), "<faqem.History: levels: 2, meshes: 1>")
        self.assertIsInstance(faqem.simplify_levels(model, [0.5])[0].error, float)
        self.assertRegex(repr(faqem.simplify(model, faces=50)), r"^<faqem.SimplifiedModel: \d+ faces, \d+ vertices, parts: 1>$")


class Arguments(unittest.TestCase):
    def test_counts_and_shares_have_the_forms_of_numbers_and_texts(self):
        mesh = bumpy_grid(10)
        expected = faqem.simplify(*mesh, faces=100).triangles
        for call in ({"faces": 1e2}, {"faces": numpy.float64(100)}, {"ratio": "50%"}, {"ratio": 0.5}):
            assert_array_equal(faqem.simplify(*mesh, **call).triangles, expected)
        self.assertEqual(len(faqem.simplify_levels(*mesh, [1e2])[0].triangles), len(expected))
        with self.assertRaisesRegex(faqem.OptionError, "whole number"):
            faqem.simplify(*mesh, faces=99.5)

    def test_a_file_name_is_loaded(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder, "a.glb")
            faqem.save(bumpy_grid(10), file)
            for name in (file, str(file)):
                self.assertLessEqual(faqem.simplify(name, faces=50).report["faces_out"], 50)
                self.assertEqual(len(faqem.simplify_levels(name, [0.5])), 1)
            with self.assertRaises(faqem.ReadError):
                faqem.simplify(file.with_name("missing.glb"))

    def test_an_existing_file_names_the_argument_that_replaces_it(self):
        mesh = bumpy_grid(6)
        model, history = faqem.Model.from_arrays(*mesh), faqem.History.of([faqem.simplify(*mesh, history=True)])
        with tempfile.TemporaryDirectory() as folder:
            for name, save in (("a.glb", lambda path: faqem.save(model, path)), ("a.history", history.save),
                               ("b.glb", lambda path: faqem.save_levels([model], path))):
                file = pathlib.Path(folder, name)
                save(file)
                with self.assertRaisesRegex(OSError, f"{name}.*overwrite=True"):
                    save(file)

    def test_names_of_the_command_say_what_stands_for_them(self):
        mesh = bumpy_grid(6)
        for wrong, hint in (("lock_boundary", "use boundary='locked'"), ("keep_groups", "use group_boundaries='preserved'"),
                            ("weld", "use weld_distance"), ("profile", "only the command has it"),
                            ("target_reduction", "faqem.fast_simplification"), ("rato", "did you mean 'ratio'")):
            for points in (mesh, (mesh[0],)):
                with self.assertRaisesRegex(TypeError, f"{wrong}.*{hint}"):
                    faqem.simplify(*points, **{wrong: 1})

    def test_help_lists_the_options(self):
        text = pydoc.render_doc(faqem.simplify, renderer=pydoc.plaintext)
        for name in ("ratio", "max_error", "texture_size", "position_bits", "progress"):
            self.assertRegex(text, rf"\n +{name} +[A-Z]")


if __name__ == "__main__":
    unittest.main()
