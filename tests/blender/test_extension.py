"""Tests of the Blender extension with Blender as a Python module. Usage: test_extension.py ZIP FOLDER

FOLDER is empty, and gets Blender's settings, scenes and renders.
"""

import pathlib
import sys
import types
import unittest

import bpy
import numpy
import scenes

KINDS = ("scenes", "collections", "objects", "meshes", "materials", "images", "node_groups")
FACES = 64 * 62 * 2 + 64 * 2 + (468 * 4 + 32 * 3) * 4 * 2  # of painted(): the monkey has 468 quads and 32 triangles
FOLDER = pathlib.Path(sys.argv[2])


def names():
    """Returns the names of all that is in the file, by kind."""
    return {kind: {one.name for one in getattr(bpy.data, kind)} for kind in KINDS}


def state():
    """Returns names(), and the selection, the faces and the modifiers of objects."""
    return names(), [(one.name, one.select_get(), one.data.name, len(one.data.polygons), len(one.modifiers))
                     for one in bpy.data.objects]


def simplify(**options):
    """Runs the operator with undo."""
    return bpy.ops.object.faqem_simplify("EXEC_DEFAULT", True, **options)


def faces(*objects):
    """Returns the number of triangles."""
    total = 0
    for one in objects:
        one.data.calc_loop_triangles()
        total += len(one.data.loop_triangles)
    return total


class Extension(unittest.TestCase):
    def setUp(self):
        bpy.ops.wm.read_homefile(use_empty=True)

    def painted(self):
        """Adds a sphere with an image at every input and a second material, and a monkey with a modifier."""
        painted = scenes.every_channel()
        red = scenes.material("Red", {}, Base_Color=(0.8, 0, 0, 1))
        sphere = scenes.add("uv_sphere", [painted, red], segments=64, ring_count=64, location=(-1.5, 0, 0))
        for face in sphere.data.polygons:
            face.material_index = face.index % 64 < 8
        monkey = scenes.add("monkey", [painted], location=(1.5, 0, 0))
        bpy.ops.object.shade_smooth()
        monkey.modifiers.new("Subdivision", "SUBSURF").levels = 2
        scenes.select(sphere, monkey)
        bpy.ops.ed.undo_push(message="the scene")
        return sphere, monkey

    def refused(self, *words, **options):
        """Runs the operator, which must end with an error that has these words, and change nothing."""
        before = state()
        with self.assertRaises(RuntimeError) as caught:
            simplify(**options)
        for word in words:
            self.assertIn(word, str(caught.exception))
        self.assertEqual(state(), before)

    def test_new_textures_show_what_all_materials_showed(self):
        objects = self.painted()
        before = scenes.shot(FOLDER / "before.png")
        given = names()
        self.assertEqual(simplify(ratio=0.1, size="1024"), {"FINISHED"})
        after = scenes.shot(FOLDER / "after.png")
        self.assertLessEqual(faces(*objects), FACES * 0.1)
        self.assertGreater(faces(*objects), FACES * 0.095)
        self.assertLess(abs(after - before).mean(), 0.01)
        made = {kind: now - given[kind] for kind, now in names().items()}
        self.assertFalse(made["scenes"] | made["collections"] | made["objects"])
        shader = next(node for node in objects[1].data.materials[0].node_tree.nodes if node.type == "BSDF_PRINCIPLED")
        for socket in ("Base Color", "Alpha", "Roughness", "Metallic", "Normal", "Emission Color"):
            self.assertTrue(shader.inputs[socket].is_linked, socket)
        self.assertEqual([list(one.modifiers) for one in objects], [[], []])

    def test_one_undo_brings_everything_back(self):
        self.painted()
        before = state()
        simplify(ratio=0.1, size="256")
        self.assertNotEqual(state(), before)
        bpy.ops.ed.undo()
        self.assertEqual(state(), before)

    def test_kept_materials_are_those_of_the_objects(self):
        sphere, monkey = self.painted()
        noise = sphere.data.materials[1].node_tree  # what new textures could not show is no obstacle
        noise.links.new(noise.nodes.new("ShaderNodeTexNoise").outputs["Color"], noise.nodes[0].inputs["Base Color"])
        sphere.data.uv_layers[0].name = "Mine"
        sphere.material_slots[0].link = "OBJECT"
        sphere.material_slots[0].material = bpy.data.materials.new("Mine")
        materials, given = [slot.material for slot in sphere.material_slots], names()
        self.assertEqual(simplify(target="FACES", faces=3000, textures="KEEP", apply=False), {"FINISHED"})
        self.assertEqual(list(sphere.data.materials), materials)
        self.assertEqual([layer.name for layer in sphere.data.uv_layers], ["Mine"])
        self.assertLessEqual(faces(sphere, monkey), 3000)
        self.assertEqual([one.name for one in monkey.modifiers], ["Subdivision"])
        self.assertEqual({**names(), "meshes": 0}, {**given, "meshes": 0})

    def test_levels_of_detail_are_new_objects_in_place(self):
        sphere, monkey = self.painted()
        before = {one.name: (one.data.name, len(one.modifiers)) for one in (sphere, monkey)}
        self.assertEqual(simplify(target="LEVELS", levels="50%, 1000", size="256"), {"FINISHED"})
        levels = [[bpy.data.objects[f"{one.name}_LOD{level}"] for one in (sphere, monkey)] for level in (1, 2)]
        self.assertEqual({one.name: (one.data.name, len(one.modifiers)) for one in (sphere, monkey)}, before)
        self.assertLessEqual(faces(*levels[1]), 1000)
        self.assertLessEqual(faces(*levels[0]), FACES // 2)
        self.assertGreater(faces(*levels[0]), 10000)
        for level in levels:
            self.assertEqual([one.matrix_world for one in level], [sphere.matrix_world, monkey.matrix_world])
            self.assertEqual([one.users_collection for one in level], [sphere.users_collection] * 2)

    def test_an_error_is_a_share_of_the_diagonal(self):
        sphere = scenes.add("uv_sphere", [], segments=64, ring_count=64, radius=5)
        sphere.scale = 2, 2, 2
        simplify(target="ERROR", error=1)
        radii = numpy.linalg.norm([vertex.co for vertex in sphere.data.vertices], axis=1)
        self.assertLess(faces(sphere), 2000)
        self.assertLess(abs(radii - 5).max(), 0.01 * 5 * 2 * 3**0.5)

    def test_objects_that_share_a_mesh_still_do(self):
        sphere = scenes.add("uv_sphere", [])
        twin = sphere.copy()
        bpy.context.collection.objects.link(twin)
        scenes.select(sphere, twin)
        simplify()
        self.assertEqual(sphere.data, twin.data)

    def test_the_scene_can_be_saved_and_opened(self):
        self.painted()
        simplify(size="256")
        before = state()
        bpy.ops.wm.save_as_mainfile(filepath=str(FOLDER / "saved.blend"))
        bpy.ops.wm.open_mainfile(filepath=str(FOLDER / "saved.blend"))
        self.assertEqual(state()[1], before[1])
        self.assertTrue(all(image.packed_file and 0 not in image.size for image in bpy.data.images))

    def test_errors_name_the_object_and_change_nothing(self):
        sphere, monkey = self.painted()
        tree = sphere.data.materials[1].node_tree
        shader = next(node for node in tree.nodes if node.type == "BSDF_PRINCIPLED")
        tree.links.new(tree.nodes.new("ShaderNodeTexNoise").outputs["Color"], shader.inputs["Base Color"])
        self.refused("'Sphere'", "'Red'", "'Noise Texture'")
        missing = tree.nodes.new("ShaderNodeTexImage")
        missing.image = bpy.data.images.new("lost", 4, 4)
        missing.image.source, missing.image.filepath = "FILE", "/no/such.png"
        tree.links.new(missing.outputs["Color"], shader.inputs["Base Color"])
        self.refused("'Sphere'", "'lost'", "/no/such.png")
        scenes.select(monkey)
        monkey.data.uv_layers.remove(monkey.data.uv_layers[0])
        self.refused("'Suzanne'", "UV map", apply=False)
        monkey.shape_key_add(name="Basis")
        self.refused("'Suzanne'", "shape keys", apply=False)
        scenes.select(sphere)
        self.refused("'Sphere'", "apples", target="LEVELS", levels="50%, apples", textures="KEEP")
        sphere.modifiers.new("Nothing", "MASK").vertex_group = sphere.vertex_groups.new(name="Nobody").name
        self.refused("'Sphere'", "no faces", textures="KEEP")

    def test_escape_cancels_and_changes_nothing(self):
        """The module has no window with events: they are given to the functions of the operator."""
        self.painted()
        before = state()
        kind = bpy.types.OBJECT_OT_faqem_simplify
        module = sys.modules[kind.__module__]
        said, status = [], []
        operator = types.SimpleNamespace(target="RATIO", ratio=0.01, faces=4, error=1, levels="", textures="NEW", size="4096",
                                         apply=True, timer=None, report=lambda kinds, text: said.append((kinds, text)))
        context = types.SimpleNamespace(selected_objects=bpy.context.selected_objects,
                                        window_manager=types.SimpleNamespace(event_timer_remove=lambda timer: None),
                                        workspace=types.SimpleNamespace(status_text_set=status.append))
        run = module.start(operator, context)
        while run.is_alive() and not run.progress:
            run.join(0.001)
        timer, escape = (types.SimpleNamespace(type=kind, value="PRESS") for kind in ("TIMER", "ESC"))
        self.assertEqual(kind.modal(operator, context, timer), {"RUNNING_MODAL"})
        self.assertRegex(status[-1], r"^faqem: [a-z]+ [0-9]+%   Esc: cancel$")
        result = kind.modal(operator, context, escape)
        run.join(10)
        self.assertFalse(run.is_alive())
        while result == {"RUNNING_MODAL"}:
            result = kind.modal(operator, context, timer)
        self.assertEqual((result, status[-1]), ({"CANCELLED"}, None))
        self.assertEqual(said, [({"INFO"}, "Cancelled, nothing has changed")])
        self.assertEqual(state(), before)

    def test_an_imported_model_keeps_its_picture(self):
        bpy.ops.import_scene.gltf(filepath=sys.argv[3])
        (quad,) = bpy.context.selected_objects
        quad.scale = 2, 2, 2
        quad.modifiers.new("Grid", "SUBSURF").subdivision_type = "SIMPLE"
        quad.modifiers[0].levels = quad.modifiers[0].render_levels = 5
        before = scenes.shot(FOLDER / "quad-before.png")
        simplify(ratio=0.1, textures="BEST")
        after = scenes.shot(FOLDER / "quad-after.png")
        self.assertLessEqual(faces(quad), 2 * 3 * 4**4 * 2 * 0.1)
        self.assertLess(abs(after - before).mean(), 0.005)


bpy.ops.extensions.package_install_files(filepath=sys.argv[1], repo="user_default", enable_on_install=True)
unittest.main(argv=sys.argv[:1], verbosity=2)
