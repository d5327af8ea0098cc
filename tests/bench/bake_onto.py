"""Compares `faqem bake` with a bake by Blender, on meshes that are not made by faqem.

Needs Blender as a module (`pip install bpy`, for the Python that it names), the judge of the folder shared/tools, and
its build of texdist. Targets are made by Blender, to 10% of the faces: its decimation, and its voxel remesh with
decimation. Those of other programs are given after the model. Blender's UVs and one page size serve both sides: smart
UVs with the largest angle without overlaps, else those for light maps. Blender bakes from selected to active with
Cycles; of three ray distances the one with the best unlit PSNR counts. CPU seconds are those of base colour and normals
in one distance, with one thread. Models must be static, and their factors such as Blender reads them (not Kd of OBJ).

    bake_onto.py OUT --faqem TOOL --tools SHARED/tools --texdist TEXDIST MODEL[,TARGET.ply...]...
"""

import argparse
import json
import math
import pathlib
import statistics
import time

import bpy
import numpy
from results import run

DISTANCES = [0.03, 0.01, 0.1]
ANGLES = [66, 45, 30, 15, 5, 0]
EMITTED = {"color": ["Base Color"], "orm": ["Roughness", "Metallic"]}


def load(path):
    """Reads a model and returns its meshes. All readers turn the same way."""
    bpy.ops.object.select_all(action="DESELECT")
    axes = {"forward_axis": "NEGATIVE_Z", "up_axis": "Y"}
    if path.suffix in (".obj", ".ply"):
        {".obj": bpy.ops.wm.obj_import, ".ply": bpy.ops.wm.ply_import}[path.suffix](filepath=str(path), **axes)
    else:
        bpy.ops.import_scene.gltf(filepath=str(path))
    return [o for o in bpy.context.selected_objects if o.type == "MESH"]


def select(objects, active):
    bpy.ops.object.select_all(action="DESELECT")
    for o in objects:
        o.select_set(True)
    bpy.context.view_layer.objects.active = active


def joined(objects):
    """A copy of meshes as one, in world space, without materials and attributes."""
    points, faces = [], []
    for o in objects:
        faces += [[len(points) + v for v in p.vertices] for p in o.data.polygons]
        points += [o.matrix_world @ v.co for v in o.data.vertices]
    mesh = bpy.data.meshes.new("target")
    mesh.from_pydata(points, [], faces)
    result = bpy.data.objects.new("target", mesh)
    bpy.context.scene.collection.objects.link(result)
    return result


def modify(target, kind, **settings):
    select([target], target)
    modifier = target.modifiers.new(kind, kind)
    for key, value in settings.items():
        setattr(modifier, key, value)
    bpy.ops.object.modifier_apply(modifier=modifier.name)


def make_target(sources, kind):
    """Returns the target of a kind, or of a file, with smooth normals; and the diagonal of the source."""
    target = joined(sources)
    diagonal = numpy.linalg.norm(numpy.ptp(numpy.array([v.co for v in target.data.vertices]), axis=0))
    triangles = sum(len(p.vertices) - 2 for p in target.data.polygons)
    modify(target, "WELD", merge_threshold=1e-6 * diagonal)
    if kind == "voxel":
        modify(target, "REMESH", mode="VOXEL", voxel_size=diagonal / 150)
    if kind in ("voxel", "decimate"):
        modify(target, "TRIANGULATE")
        modify(target, "DECIMATE", ratio=min(1, 0.1 * triangles / len(target.data.polygons)))
    else:
        target = joined(load(pathlib.Path(kind)))
    select([target], target)
    bpy.ops.object.shade_smooth()
    return target, diagonal


def unwrap(target, angle):
    select([target], target)
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    if angle > 0:
        bpy.ops.uv.smart_project(angle_limit=math.radians(angle), island_margin=0.004)
    else:
        bpy.ops.uv.lightmap_pack(PREF_MARGIN_DIV=0.1)
    bpy.ops.object.mode_set(mode="OBJECT")


def save(target, path):
    select([target], target)
    bpy.ops.export_scene.gltf(filepath=str(path), use_selection=True)


def emit(sources, inputs):
    """Lets the materials emit inputs of their shader: one, or several as green and blue."""
    for tree in {s.material.node_tree for o in sources for s in o.material_slots if s.material}:
        shader, out = (next(n for n in tree.nodes if n.type == kind) for kind in ("BSDF_PRINCIPLED", "OUTPUT_MATERIAL"))
        emission, channels = tree.nodes.new("ShaderNodeEmission"), tree.nodes.new("ShaderNodeCombineColor")
        for i, name in enumerate(inputs):
            to = emission.inputs["Color"] if len(inputs) == 1 else channels.inputs[i + 1]
            if shader.inputs[name].is_linked:
                tree.links.new(shader.inputs[name].links[0].from_socket, to)
            else:
                to.default_value = shader.inputs[name].default_value
        if len(inputs) > 1:
            tree.links.new(channels.outputs[0], emission.inputs["Color"])
        tree.links.new(emission.outputs[0], out.inputs["Surface"])


def bake(sources, target, distance, size):
    """Bakes onto a new material of the target. Returns the CPU seconds of normals and base colour."""
    scene, seconds = bpy.context.scene, {}
    scene.render.engine, scene.cycles.samples = "CYCLES", 16
    scene.render.threads_mode, scene.render.threads = "FIXED", 1
    material = bpy.data.materials.new("baked")
    material.use_nodes = True
    target.data.materials.clear()
    target.data.materials.append(material)
    tree = material.node_tree
    shader = next(n for n in tree.nodes if n.type == "BSDF_PRINCIPLED")
    for kind in ("normal", "color", "orm"):
        node = tree.nodes.new("ShaderNodeTexImage")
        node.image = bpy.data.images.new(kind, size, size)
        node.image.colorspace_settings.name = "sRGB" if kind == "color" else "Non-Color"
        tree.nodes.active = node
        if kind in EMITTED:
            emit(sources, EMITTED[kind])
        select([*sources, target], target)
        before = time.process_time()
        bpy.ops.object.bake(type="EMIT" if kind in EMITTED else "NORMAL", use_selected_to_active=True,
                            cage_extrusion=distance, max_ray_distance=2 * distance, margin=16)
        seconds[kind] = time.process_time() - before
        node.image.pack()
        between = {"normal": "ShaderNodeNormalMap", "orm": "ShaderNodeSeparateColor"}.get(kind)
        last = tree.nodes.new(between) if between else node
        if between:
            tree.links.new(node.outputs[0], last.inputs["Color"])
        for name, output in {"normal": {"Normal": 0}, "color": {"Base Color": 0},
                             "orm": {"Roughness": 1, "Metallic": 2}}[kind].items():
            tree.links.new(last.outputs[output], shader.inputs[name])
    return seconds["normal"] + seconds["color"]


def psnr(arguments, source, tests, folder):
    """Unlit and lit PSNR of each test."""
    pairs = [word for t in tests for word in (t, folder / t.stem)]
    run(arguments.tools / "render/render.mjs", source, folder / "source", *pairs, "--frame-of", source, "--views", 6,
        "--size", 384)
    compare = ["/usr/bin/python3", arguments.tools / "compare/compare.py", folder / "source"]
    found = {t: json.loads(run(*compare, folder / t.stem)[0].stdout) for t in tests}
    return {t: [found[t][p]["psnr_fg"]["mean"] for p in ("unlit", "lit")] for t in tests}


def measure(arguments, model, kind, folder):
    """Returns unlit and lit PSNR, percent of wrong sides and CPU seconds, each of Blender and of faqem."""
    folder.mkdir(parents=True, exist_ok=True)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    target, diagonal = make_target(load(model), kind)
    bare, own, seconds = folder / "target.glb", folder / "faqem.glb", []
    for angle in ANGLES:
        unwrap(target, angle)
        save(target, bare)
        made, own_seconds = run(arguments.faqem, "bake", bare, own, "--source", model, "--uvs", "keep", "--texture-size",
                                arguments.size, "--normal-map", "on", "--image-format", "png", "--threads", 1, "--force")
        if "cannot be kept" not in made.stderr:
            break
    tests = [own]
    for distance in DISTANCES:
        bpy.ops.wm.read_factory_settings(use_empty=True)
        sources, target = load(model), load(bare)[0]
        seconds.append(bake(sources, target, distance * diagonal, arguments.size))
        tests.append(folder / f"blender_{distance:g}.glb")
        save(target, tests[-1])
    values = psnr(arguments, model, tests, folder)
    for t in tests:
        wrong = json.loads(run(arguments.texdist, model, t, "--no-chamfer")[0].stdout)["wrong_side_rate"]
        values[t] += [100 * wrong, own_seconds if t == own else seconds[0]]
    best = max(tests[1:], key=lambda t: values[t][0])
    return [value for pair in zip(values[best], values[own]) for value in pair]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out", type=pathlib.Path)
    for name in ("--faqem", "--tools", "--texdist"):
        parser.add_argument(name, type=pathlib.Path, required=True)
    parser.add_argument("--size", type=int, default=1024, help="of the page, in texels")
    parser.add_argument("models", nargs="+")
    arguments = parser.parse_args()
    rows = []
    for words in (m.split(",") for m in arguments.models):
        model = pathlib.Path(words[0])
        for kind in ["decimate", "voxel", *words[1:]]:
            name = f"{model.parent.name} {pathlib.Path(kind).stem}"
            rows.append(measure(arguments, model, kind, arguments.out / name.replace(" ", "_")))
            print(f"| {name} | " + " | ".join(f"{value:.2f}" for value in rows[-1]) + " |", flush=True)
    print("| median | " + " | ".join(f"{statistics.median(c):.2f}" for c in zip(*rows)) + " |")


if __name__ == "__main__":
    main()
