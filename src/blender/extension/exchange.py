"""Objects of Blender to a file and back, by Blender's own exporter and importer of glTF."""

import uuid

import bpy

from .materials import material_fault

_KINDS = ("scenes", "collections", "objects", "meshes", "materials", "images", "node_groups")  # users come before used


class Fault(Exception):
    """A message for the user. Nothing has changed in the scene."""


class _Stage:
    """Context manager for export and import beside the user's scene. At the end what was made and has no user is gone."""

    def __enter__(self):
        self._before = {kind: set(getattr(bpy.data, kind)) for kind in _KINDS}
        self._window = bpy.context.window
        self._shown = self._window.scene
        return self

    def open(self):
        """Shows an empty scene, which the exporter and the importer work on. Returns it."""
        self._window.scene = bpy.data.scenes.new("faqem")
        return self._window.scene

    def made(self, kind):
        """Returns what was made since the beginning, for example of the kind "objects"."""
        return [one for one in getattr(bpy.data, kind) if one not in self._before[kind]]

    def __exit__(self, *_):
        self._window.scene = self._shown
        for kind in _KINDS:
            bpy.data.batch_remove([one for one in self.made(kind) if kind in ("scenes", "collections") or not (
                one.users_scene if kind == "objects" else one.users)])


class Exchange:
    """The objects of one run. In files they have names that cannot be mistaken, with their number.

    keep   materials and UV maps stay; otherwise materials come back with the textures of the file
    apply  modifiers and shape keys become part of the meshes
    """

    def __init__(self, objects, *, keep, apply):
        self.objects, self._keep, self._apply = objects, keep, apply
        self._token = f"faqem-{uuid.uuid4().hex[:8]}"
        self._materials = []  # by the number in the file
        for one in objects:
            if not one.is_editable or one.override_library:
                raise Fault(f"Object '{one.name}': is linked from a library; make it local first")
            if one.data.shape_keys and not apply:
                raise Fault(f"Object '{one.name}': has shape keys, which a simplified mesh cannot keep; choose Apply "
                            "Modifiers")

    def _name(self, number):
        return f"{self._token}.{number}."

    def _number(self, name):
        return int(name.split(".")[1]) if name.startswith(self._token) else None

    def in_words(self, message):
        """Returns a message of the simplifier with the names of Blender."""
        for number, one in enumerate(self.objects):
            message = message.replace(self._name(number), one.name)
        return message

    def save(self, path):
        """Writes the objects to a file. Raises Fault."""
        depsgraph = bpy.context.evaluated_depsgraph_get()
        with _Stage() as stage:
            meshes, placed = {}, []
            for number, one in enumerate(self.objects):
                changed = self._apply and (one.modifiers or one.data.shape_keys)
                # Objects that share a mesh still do.
                key = number if changed else (one.data, *(slot.material for slot in one.material_slots))
                if key not in meshes:
                    meshes[key] = bpy.data.meshes.new_from_object(
                        one.evaluated_get(depsgraph), preserve_all_data_layers=True, depsgraph=depsgraph
                    ) if changed else one.data.copy()
                    meshes[key].name = self._name(number)
                    if not meshes[key].polygons:
                        raise Fault(f"Object '{one.name}': has no faces")
                    self._set_materials(meshes[key], one)
                placed.append(bpy.data.objects.new(self._name(number), meshes[key]))
            scene = stage.open()
            for copy, one in zip(placed, self.objects):
                scene.collection.objects.link(copy)
                copy.matrix_world = one.matrix_world
            try:
                bpy.ops.export_scene.gltf(filepath=str(path), use_active_scene=True, export_animations=False,
                                          export_morph=False, export_skins=False)
            except RuntimeError as error:
                raise Fault(f"The glTF exporter failed: {error}") from None

    def _set_materials(self, mesh, one):
        """Gives the mesh of an object the materials for the file: those that modifiers and the slots of the object set.

        Raises Fault for one that new textures cannot be made from.
        """
        slots = one.material_slots
        for slot, material in enumerate(mesh.materials):
            if slot < len(slots) and slots[slot].link == "OBJECT":
                material = slots[slot].material
            fault = material and not self._keep and material_fault(material, bool(mesh.uv_layers))
            if fault:
                raise Fault(f"Object '{one.name}': material '{material.name}': {fault}")
            if self._keep and material:
                if material not in self._materials:
                    self._materials.append(material)
                    material.copy().name = self._name(len(self._materials) - 1)
                material = bpy.data.materials[self._name(self._materials.index(material))]
            mesh.materials[slot] = material

    def load(self, paths, place):
        """Imports results, and passes a list with the meshes of each, in the order of the objects, to `place`.

        Raises Fault. What `place` does not use is removed.
        """
        with _Stage() as stage:
            stage.open()
            levels = []
            for path in paths:
                bpy.ops.import_scene.gltf(filepath=str(path), merge_vertices=True)
                found = {self._number(one.name): one.data for one in stage.made("objects") if one.type == "MESH"}
                bpy.data.batch_remove(stage.made("objects"))
                for number, one in enumerate(self.objects):
                    if number not in found:
                        raise Fault(f"Object '{one.name}': nothing is left of it")
                    self._restore(found[number], one.data)
                levels.append([found[number] for number in range(len(self.objects))])
            place(levels)

    def _restore(self, mesh, original):
        """Gives a mesh the name of the original, and with `keep` its materials and the names of its attributes."""
        mesh.name = original.name
        if not self._keep:
            return
        for slot, material in enumerate(mesh.materials):
            number = material and self._number(material.name)
            if number is not None:
                mesh.materials[slot] = self._materials[number]
        for layers in ("uv_layers", "color_attributes"):
            old, new = getattr(original, layers), getattr(mesh, layers)
            for before, after in zip(old, new) if len(old) == len(new) else ():
                after.name = before.name
