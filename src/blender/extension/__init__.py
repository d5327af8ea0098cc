"""Object > Simplify with faqem."""

import re

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, StringProperty

from .exchange import Exchange, Fault
from .run import Cancelled, Run


class OBJECT_OT_faqem_simplify(bpy.types.Operator):
    """Simplify the selected meshes, with new textures that show what they showed"""

    bl_idname = "object.faqem_simplify"
    bl_label = "Simplify with faqem"
    bl_options = {"UNDO"}

    target: EnumProperty(name="Target", items=[
        ("RATIO", "Ratio", "A share of the faces of the selection"),
        ("FACES", "Faces", "A number of faces of the selection"),
        ("ERROR", "Error", "As few faces as a distance from the original allows"),
        ("LEVELS", "Levels of Detail", "New objects with fewer and fewer faces; the selection stays"),
    ])
    ratio: FloatProperty(name="Ratio", default=0.1, min=1e-6, max=1, subtype="FACTOR")
    faces: IntProperty(name="Faces", description="Triangles of the selection", default=20000, min=4)
    error: FloatProperty(name="Error", description="Largest distance from the original, as a share of the diagonal of "
                         "the selection", default=0.1, min=1e-6, max=100, precision=3, subtype="PERCENTAGE")
    levels: StringProperty(name="Levels", default="50%, 25%, 10%", description="Shares or numbers of faces, or errors "
                           "such as error:0.1%, from fine to coarse")
    textures: EnumProperty(name="Textures", items=[
        ("NEW", "New", "A new UV map and one new material, whose images show what all materials showed"),
        ("BEST", "Whichever Shows More", "New UV maps and images, or the old ones where these show more"),
        ("KEEP", "Keep", "UV maps and materials stay as they are"),
    ])
    size: EnumProperty(name="Size", description="Largest side of new images, in pixels", default="2048",
                       items=[(str(2**n), str(2**n), "") for n in range(8, 14)])
    apply: BoolProperty(name="Apply Modifiers", default=True, description="Modifiers and shape keys become part of the "
                        "meshes; otherwise meshes are simplified as they are before their modifiers, which stay")

    @classmethod
    def poll(cls, context):
        return context.mode == "OBJECT" and any(one.type == "MESH" for one in context.selected_objects)

    def invoke(self, context, event):
        return context.window_manager.invoke_props_dialog(self)

    def draw(self, context):
        self.layout.use_property_split = True
        for name in ("target", self.target.lower(), "textures", "size", "apply"):
            if name != "size" or self.textures != "KEEP":
                self.layout.prop(self, name)

    def execute(self, context):
        run = start(self, context)
        if not run:
            return {"CANCELLED"}
        if bpy.app.background:
            run.join()
            return finish(self, context)
        self.timer = context.window_manager.event_timer_add(0.1, window=context.window)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        """Takes all events, so that nothing changes meanwhile. Esc cancels."""
        if event.type == "ESC" and event.value == "PRESS":
            self.running.is_cancelled = True
        context.workspace.status_text_set("faqem: cancelling" if self.running.is_cancelled else
                                          f"faqem: {self.running.progress}   Esc: cancel")
        if self.running.is_alive():
            return {"RUNNING_MODAL"}
        context.window_manager.event_timer_remove(self.timer)
        context.workspace.status_text_set(None)
        return finish(self, context)


def start(operator, context):
    """Exports the selection and starts a run of the simplifier. Returns it, or None after a message."""
    targets = {"RATIO": {"ratio": operator.ratio}, "FACES": {"faces": operator.faces},
               "ERROR": {"max_error": f"{operator.error}%"},
               "LEVELS": [int(level) if level.isdigit() else level for level in re.split(r"[,\s]+", operator.levels.strip())]}[operator.target]
    options = {"bake": {"NEW": "atlas", "BEST": "auto", "KEEP": "keep"}[operator.textures]}
    if operator.textures != "KEEP":
        options.update(texture_size=int(operator.size), image_format="png-or-jpeg", allow_larger=True)
    operator.running = Run(targets, options)
    try:
        operator.exchange = Exchange([one for one in context.selected_objects if one.type == "MESH"],
                                     keep=operator.textures == "KEEP", apply=operator.apply)
        operator.exchange.save(operator.running.source)
    except Fault as fault:
        operator.report({"ERROR"}, str(fault))
        operator.running.remove_files()
        return None
    operator.running.start()
    return operator.running


def finish(operator, context):
    """Puts the results of a run into the scene. Returns what the operator returns."""
    run, exchange = operator.running, operator.exchange
    try:
        if run.error:
            raise run.error
        exchange.load(run.paths, lambda levels: place(exchange.objects, levels, operator))
    except Cancelled:
        operator.report({"INFO"}, "Cancelled, nothing has changed")
        return {"CANCELLED"}
    except Exception as error:
        names = ", ".join(f"'{one.name}'" for one in exchange.objects[:3])
        text = exchange.in_words(str(error) or type(error).__name__)
        operator.report({"ERROR"}, text if isinstance(error, Fault) else f"Object {names}: {text}")
        return {"CANCELLED"}
    finally:
        run.remove_files()
    for warning in run.warnings:
        operator.report({"WARNING"}, exchange.in_words(warning))
    for report in run.reports:
        operator.report({"INFO"}, f"{report['faces_in']:,} faces before, {report['faces_out']:,} after")
    return {"FINISHED"}


def place(objects, levels, operator):
    """Gives the meshes of a result to the objects, or those of levels to new objects."""
    for number, meshes in enumerate(levels, 1):
        for one, mesh in zip(objects, meshes):
            if operator.target == "LEVELS":
                copy = one.copy()
                copy.name = f"{one.name}_LOD{number}"
                for collection in one.users_collection:
                    collection.objects.link(copy)
                one = copy
            elif one.vertex_groups:
                operator.report({"WARNING"}, f"Object '{one.name}': its vertex groups are empty now")
            one.data = mesh
            for slot in one.material_slots:
                slot.link = "DATA"
            if operator.apply:
                one.modifiers.clear()


def menu(self, context):
    self.layout.separator()
    self.layout.operator(OBJECT_OT_faqem_simplify.bl_idname)


def register():
    bpy.utils.register_class(OBJECT_OT_faqem_simplify)
    bpy.types.VIEW3D_MT_object.append(menu)


def unregister():
    bpy.types.VIEW3D_MT_object.remove(menu)
    bpy.utils.unregister_class(OBJECT_OT_faqem_simplify)
