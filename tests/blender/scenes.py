"""Scenes for the tests of the Blender extension."""

import bpy
import numpy

SIZE = 128


def image(name, red, green, blue, alpha=1.0, is_data=False):
    """Makes an image from arrays or numbers; rows go upwards."""
    made = bpy.data.images.new(name, SIZE, SIZE, alpha=True, is_data=is_data)
    channels = [numpy.broadcast_to(values, (SIZE, SIZE)) for values in (red, green, blue, alpha)]
    made.pixels.foreach_set(numpy.stack(channels, axis=-1).astype(numpy.float32).ravel())
    made.pack()
    return made


def material(name, images, **values):
    """Makes a material. `images` and `values` are by input of the Principled BSDF, with _ for spaces."""
    made = bpy.data.materials.new(name)
    tree = made.node_tree
    shader = next(node for node in tree.nodes if node.type == "BSDF_PRINCIPLED")
    for key, value in values.items():
        shader.inputs[key.replace("_", " ")].default_value = value
    for key, (picture, output) in images.items():
        node = tree.nodes.new("ShaderNodeTexImage")
        node.image = picture
        source = node.outputs["Alpha" if output == "Alpha" else "Color"]
        if key == "Normal":
            tangent = tree.nodes.new("ShaderNodeNormalMap")
            tree.links.new(source, tangent.inputs["Color"])
            source = tangent.outputs["Normal"]
        elif output in ("Red", "Green", "Blue"):
            split = tree.nodes.new("ShaderNodeSeparateColor")
            tree.links.new(source, split.inputs["Color"])
            source = split.outputs[output]
        tree.links.new(source, shader.inputs[key.replace("_", " ")])
    return made


def every_channel():
    """Makes a material with an image at every input that is supported."""
    y, x = numpy.mgrid[:SIZE, :SIZE] / SIZE
    checks = (x * 8).astype(int) % 2 ^ (y * 8).astype(int) % 2
    colour = image("colour", 0.2 + 0.8 * checks, y, 1 - y, 1 - 0.5 * (x > 0.5))
    surface = image("surface", 0, 0.2 + 0.6 * y, (x > 0.5), is_data=True)
    normal = image("normal", 0.5 + 0.2 * numpy.sin(40 * x), 0.5, 0.95, is_data=True)
    glow = image("glow", 0, 0, (y > 0.9))
    return material("Painted", {
        "Base_Color": (colour, "Color"), "Alpha": (colour, "Alpha"), "Roughness": (surface, "Green"),
        "Metallic": (surface, "Blue"), "Normal": (normal, "Color"), "Emission_Color": (glow, "Color")},
        Emission_Strength=1)


def add(kind, materials, **options):
    """Adds a primitive with UVs, for example "uv_sphere". Returns the object, which is selected."""
    getattr(bpy.ops.mesh, f"primitive_{kind}_add")(**options)
    made = bpy.context.object
    for one in materials:
        made.data.materials.append(one)
    return made


def select(*objects):
    """Selects these objects only."""
    for one in bpy.data.objects:
        one.select_set(one in objects)
    bpy.context.view_layer.objects.active = objects[0]


def shot(path):
    """Renders the scene by Cycles to a file. Returns the pixels (height, width, 3), from 0 to 1."""
    scene = bpy.context.scene
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    sun = bpy.data.objects.new("Sun", bpy.data.lights.new("Sun", "SUN"))
    world = bpy.data.worlds.new("World")
    camera.location, camera.rotation_euler = (0.5, -8, 1), (1.45, 0, 0)
    sun.rotation_euler, sun.data.energy = (0.8, 0.3, 0), 3
    for one in (camera, sun):
        scene.collection.objects.link(one)
    scene.camera, scene.world, scene.render.engine = camera, world, "CYCLES"
    scene.cycles.samples, scene.cycles.use_denoising = 8, False
    scene.render.resolution_x, scene.render.resolution_y = 320, 180
    scene.view_settings.view_transform, scene.render.filepath = "Standard", str(path)
    bpy.ops.render.render(write_still=True)
    loaded = bpy.data.images.load(str(path))
    pixels = numpy.array(loaded.pixels[:])
    bpy.data.batch_remove([camera, sun, world, loaded])
    return pixels.reshape(180, 320, -1)[..., :3]
