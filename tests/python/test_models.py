"""Tests of faqem.load, bake and save with model files."""


import faqem
from numpy.testing import assert_array_equal
from test_arrays import InFolder, flat_grid


class Models(InFolder):
    def coloured(self):
        """Writes a square in four colours as OBJ with vertex colours."""
        vertices, triangles = flat_grid(12)
        lines = [f"v {x} {y} {z} {x < 6:d} {y < 6:d} 0.5" for x, y, z in vertices]
        lines += [f"f {a} {b} {c}" for a, b, c in triangles + 1]
        file = self.folder / "coloured.obj"
        file.write_text("\n".join(lines) + "\n")
        return file

    def test_saved_arrays_are_equal_after_loading(self):
        vertices, triangles = flat_grid(6)
        for name in ("a.glb", "a.ply", "ä b.obj"):
            faqem.save((vertices, triangles), self.folder / name)
            (part,) = faqem.load(str(self.folder / name)).parts
            assert_array_equal(part.vertices[part.triangles], vertices[triangles])  # OBJ changes the vertex order

    def test_bake_simplifies_a_model(self):
        source = faqem.load(self.coloured())
        self.assertIsNone(source.report)
        simplified = faqem.simplify(source, faces=50, texture_size=64, texel_density=2, bake="per_triangle",
                                normals="flat", normal_map="off", visibility="weighted", image_format="png")
        self.assertEqual(len(source.parts[0].triangles), 288)
        self.assertLessEqual(len(simplified.parts[0].triangles), 50)
        self.assertEqual(simplified.report["faces_out"], len(simplified.parts[0].triangles))
        self.assertEqual(simplified.report["pages"][0]["width"], 64)
        self.assertEqual(simplified.report["vertices_hidden"], 0)
        faqem.save(simplified, self.folder / "simplified.glb")
        self.assertEqual(len(faqem.load(self.folder / "simplified.glb").parts), 1)

    def test_results_have_the_bytes_of_the_command(self):
        source = self.folder / "source.glb"
        baked = faqem.simplify(faqem.load(self.coloured()), bake="atlas", format="glb", texture_size=64, ratio=1.0)
        faqem.save(baked, source)
        for extension in ("glb", "gltf", "obj", "ply", "stl"):
            for limit in (None, 9000):
                folders = [self.folder / f"{extension}{limit}{by}" for by in ("command", "python")]
                for folder in folders:
                    folder.mkdir()
                options = [] if limit is None else ["--max-bytes", str(limit)]
                faqem.command("simplify", source, folders[0] / f"out.{extension}", *options)
                result = faqem.simplify(faqem.load(source), format=extension, max_bytes=limit)
                faqem.save(result, folders[1] / f"out.{extension}")
                files = [{file.name: file.read_bytes() for file in folder.iterdir()} for folder in folders]
                self.assertEqual(files[0], files[1])
                self.assertEqual(result.report["bytes_in"], source.stat().st_size)
        with self.assertRaisesRegex(faqem.ByteLimitError, "max_bytes allows 100"):
            faqem.simplify(faqem.load(source), max_bytes="100B")

    def test_results_are_made_for_the_format_of_the_source(self):
        source = faqem.load(self.coloured())
        faqem.save(source, self.folder / "source.ply")
        result = faqem.simplify(faqem.load(self.folder / "source.ply"), ratio=0.5)
        self.assertEqual(result.images, [])
        faqem.save(result, self.folder / "result.obj")
        self.assertIn("was made for .ply files", result.warnings[-1])

    def test_an_option_without_effect_gives_a_warning(self):
        model = faqem.Model.from_arrays(*flat_grid(4))
        for result, count in ((faqem.simplify(model, bake="keep", texture_size=64), 1),
                              (faqem.simplify(model, bake="keep", texture_size=None), 0),
                              (faqem.simplify(*flat_grid(4), texture_size=64, bake="keep", threads=1), 2),
                              (faqem.simplify(*flat_grid(4), preset="fast"), 0),
                              (faqem.simplify_levels(*flat_grid(4), [0.5, 0.2], max_bytes=9)[0], 1)):
            idle = [warning for warning in result.report["warnings"] if "has no effect" in warning]
            self.assertEqual(len(idle), count, idle)

    def test_levels_have_separate_or_shared_textures(self):
        source = faqem.load(self.coloured())
        self.assertIsNone(source.error)
        for textures in ("each", "shared"):
            levels = faqem.simplify_levels(source, [0.5, 40], textures=textures, texture_size=64)
            self.assertEqual(len(levels), 2)
            for level, target in zip(levels, (144, 40)):
                self.assertLessEqual(len(level.parts[0].triangles), target)
                self.assertEqual(level.report["faces_in"], 288)
            self.assertGreaterEqual(levels[1].error, levels[0].error)
            self.assertEqual(bool(levels[1].report["pages"]), textures == "each")
        for wrong in ({"textures": "both"}, {"textures": "shared", "bake": "keep"}, {"ratio": 0.5}):
            with self.assertRaises(faqem.OptionError):
                faqem.simplify_levels(source, [0.5, 40], **wrong)

    def test_levels_are_saved_in_one_file_and_histories_have_several_meshes(self):
        coloured = faqem.load(self.coloured())
        chain = self.folder / "chain.glb"
        faqem.save_levels([coloured, *faqem.simplify_levels(coloured, [0.5], texture_size=64)], chain)
        self.assertIn(b"MSFT_lod", chain.read_bytes())
        with self.assertRaises(faqem.WriteError):
            faqem.save_levels([coloured], chain)
        for wrong in ({"pixel_error": 0}, {"screen_height": -1}, {"pixel_error": float("nan")}):
            with self.assertRaises(faqem.OptionError):
                faqem.save_levels([coloured], chain, overwrite=True, **wrong)

        texture = {"texture_size": 64}
        # Without the extension the meshes of the levels have nothing to do with each other.
        separate = self.folder / "separate.glb"
        separate.write_bytes(chain.read_bytes().replace(b"MSFT_lod", b"EXT_none"))
        both = faqem.load(separate)
        levels = faqem.simplify_levels(both, [200, 40], history=True, **texture)
        file = self.folder / "both.history"
        faqem.History.of(levels).save(file)
        history = faqem.History.load(file)
        self.assertEqual((history.part_count, len(history)), (2, 2))
        for level, faces in zip(levels, (200, 40)):
            cut = faqem.bake_truncated(both, history, faces, **texture)
            for a, b in zip(cut.parts, level.parts):
                assert_array_equal(a.vertices, b.vertices)
                assert_array_equal(a.triangles, b.triangles)
        parts = history.truncate_parts(100)
        self.assertEqual(len(parts), 2)
        self.assertLessEqual(sum(len(part.triangles) for part in parts), 100)
        with self.assertRaisesRegex(faqem.OptionError, "truncate_parts"):
            history.truncate(100)
        with self.assertRaises(faqem.InputError):
            faqem.bake_truncated(coloured, history, 100)
        with self.assertRaises(faqem.OptionError):
            faqem.History.of(faqem.simplify_levels(both, [200], **texture))

    def test_a_model_is_shown_on_another_mesh(self):
        source = faqem.load(self.coloured())
        bare = faqem.simplify(source, faces=40, bake="none")
        baked = faqem.bake_onto(source, bare, max_distance="10%", texture_size=64)
        self.assertEqual(len(baked.parts[0].triangles), len(bare.parts[0].triangles))
        self.assertEqual(len(baked.images), 1)
        self.assertEqual(baked.report["coverage"]["missing_texels"], 0)
        self.assertEqual(baked.report["coverage"]["unmatched_parts"], [])
        with self.assertRaisesRegex(faqem.OptionError, "max_distance"):
            faqem.bake_onto(source, bare, max_distance="far")

    def test_files_are_overwritten_only_on_request(self):
        model = faqem.Model.from_arrays(*flat_grid(2))
        file = self.folder / "kept.glb"
        file.write_text("precious")
        with self.assertRaisesRegex(faqem.WriteError, "kept.glb"):
            faqem.save(model, file)
        self.assertEqual(file.read_text(), "precious")
        faqem.save(model, file, overwrite=True)
        self.assertEqual(file.read_bytes()[:4], b"glTF")

    def test_data_that_a_format_cannot_store_is_a_warning(self):
        model = faqem.load(self.coloured())
        self.assertEqual(model.warnings, [])
        self.assertEqual(model.not_understood, [])
        faqem.save(model, self.folder / "grey.stl")
        self.assertTrue(any("STL" in warning for warning in model.warnings))

    def test_statements_that_were_not_understood_are_counted(self):
        (self.folder / "shiny.mtl").write_text("newmtl m\nKs 1 1 1\n")
        file = self.folder / "shiny.obj"
        file.write_text("mtllib shiny.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n")
        self.assertEqual(faqem.load(file).not_understood, ["'Ks': 1 statement"])

    def test_errors_have_specific_types(self):
        for absent in (self.folder / "missing.glb", self.folder):
            with self.assertRaisesRegex(faqem.ReadError, absent.name):
                faqem.load(absent)
        (self.folder / "damaged.glb").write_bytes(b"glTF")
        with self.assertRaisesRegex(faqem.InputError, "damaged.glb: GLB header") as raised:
            faqem.load(self.folder / "damaged.glb")
        self.assertNotIsInstance(raised.exception, OSError)
        (self.folder / "a.xyz").write_text("1 2 3")
        with self.assertRaises(faqem.UnsupportedError):
            faqem.load(self.folder / "a.xyz")
        with self.assertRaises(faqem.InputError):
            faqem.load("a\0b.glb")
        model = faqem.Model.from_arrays(*flat_grid(2))
        with self.assertRaises(faqem.UnsupportedError):
            faqem.save(model, self.folder / "a.off")
        with self.assertRaisesRegex(faqem.OptionError, "texture_size"):
            faqem.simplify(model, texture_size=100)
        for kind, also in ((faqem.OptionError, ValueError), (faqem.InputError, ValueError), (faqem.ReadError, OSError),
                           (faqem.UnsupportedError, ValueError), (faqem.WriteError, OSError),
                           (faqem.ByteLimitError, ValueError), (faqem.TimeLimitError, TimeoutError), (faqem.InternalError, Exception)):
            self.assertTrue(issubclass(kind, faqem.Error) and issubclass(kind, also))
