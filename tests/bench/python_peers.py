#!/usr/bin/env python3
"""Simplifies models to a tenth with Python packages, and prints tables of time and errors, the losses of faqem first.

Usage: python_peers.py [--rows FILE.jsonl] [--least-seconds S] MODEL...     measures what FILE does not have yet
Needs the packages of PACKAGES, as installed from PyPI, and faqem; those that are not installed are left out.

Each measurement is a process of its own. Tables have the CPU seconds of all threads in the call alone, with the arrays or
objects of the package at hand: the least of three calls, or of one that takes more than S seconds. Rows have wall-clock
seconds, too, which need a machine without other load. Models have one part and at most one
image. Geometric packages get the mesh with vertices at one position merged, since they drop UVs anyway. Distances and
colours are measured by faqem.compare(). The error of UVs is the difference of colours with a texture that shows u and v.
"""

import argparse
import functools
import importlib.metadata
import json
import pathlib
import subprocess
import sys
import tempfile
import time

import numpy

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "docs/statements"))
from model import png

RATIO = 0.1
TEXTURE_SIZE = 1024
SAMPLES = 100_000
CALLS = 3


class Source:
    """A model as arrays: welded vertices, triangles, UVs per corner (f, 3, 2) with v pointing down, and its image."""

    def __init__(self, file):
        import faqem

        self.model = faqem.load(file)
        (part,) = self.model.parts
        self.vertices, index = numpy.unique(part.vertices, axis=0, return_inverse=True)
        self.triangles = index.reshape(-1)[part.triangles]
        whole = (self.triangles != numpy.roll(self.triangles, 1, axis=1)).all(axis=1)
        self.triangles = self.triangles[whole]
        self.uvs, self.image = None, None
        if part.uvs and self.model.images:
            self.uvs = part.uvs[0][part.triangles][whole]
            self.image = self.model.images[self.model.materials[0].textures["base_color"].image]
        self.target = int(RATIO * len(self.triangles))


# Each function prepares its input and returns the call that is timed, and how its result becomes
# (vertices, triangles, UVs per corner or None), or a Model of faqem.


def faqem_arrays(source, **options):
    import faqem

    def result(out):
        return out.vertices, out.triangles, None

    return lambda: faqem.simplify(source.vertices, source.triangles, faces=source.target, **options), result


def faqem_uvs(source):
    import faqem

    return (lambda: faqem.simplify(source.vertices, source.triangles, uvs=source.uvs, faces=source.target),
            lambda out: (out.vertices, out.triangles, out.uvs))


def faqem_bake(source):
    import faqem

    return lambda: faqem.simplify(source.model, faces=source.target, texture_size=TEXTURE_SIZE), lambda out: out


def fast_simplification(source):
    import fast_simplification

    points, faces = source.vertices.astype(numpy.float32), source.triangles.astype(numpy.int32)
    return lambda: fast_simplification.simplify(points, faces, target_count=source.target), lambda out: (*out, None)


def trimesh(source):
    import trimesh

    mesh = trimesh.Trimesh(source.vertices, source.triangles, process=False)
    return (lambda: mesh.simplify_quadric_decimation(face_count=source.target),
            lambda out: (out.vertices, out.faces, None))


def pyfqmr(source):
    import pyfqmr

    def call():
        simplifier = pyfqmr.Simplify()
        simplifier.setMesh(source.vertices, source.triangles)  # it is timed: the package has one mesh at a time
        simplifier.simplify_mesh(target_count=source.target, verbose=False)
        return simplifier.getMesh()

    return call, lambda out: (out[0], out[1], None)


def open3d(source):
    import open3d

    mesh = open3d.geometry.TriangleMesh(open3d.utility.Vector3dVector(source.vertices),
                                        open3d.utility.Vector3iVector(source.triangles))
    return (lambda: mesh.simplify_quadric_decimation(source.target),
            lambda out: (numpy.asarray(out.vertices), numpy.asarray(out.triangles), None))


def meshlib(source):
    from meshlib import mrmeshnumpy, mrmeshpy

    faces = source.triangles.astype(numpy.int32)
    ready = [mrmeshnumpy.meshFromFacesVerts(faces, source.vertices) for _ in range(CALLS)]

    def call():
        mesh = ready.pop()
        settings = mrmeshpy.DecimateSettings()
        settings.maxError = 3.4e38
        settings.maxDeletedFaces = len(source.triangles) - source.target
        settings.packMesh = True
        mrmeshpy.decimateMesh(mesh, settings)
        return mesh

    return call, lambda out: (mrmeshnumpy.getNumpyVerts(out), mrmeshnumpy.getNumpyFaces(out.topology), None)


def pymeshlab(source, with_uvs=False):
    import pymeshlab

    def prepare():
        meshes = pymeshlab.MeshSet(verbose=False)
        if with_uvs:
            with tempfile.TemporaryDirectory() as folder:  # arrays of UVs are rejected without an image
                mesh = source.vertices, source.triangles, source.uvs
                meshes.load_new_mesh(str(write_textured(pathlib.Path(folder), "source", mesh, uv_picture(), ".png")))
        else:
            meshes.add_mesh(pymeshlab.Mesh(source.vertices, source.triangles))
        return meshes

    ready = [prepare() for _ in range(CALLS)]
    name = "meshing_decimation_quadric_edge_collapse" + ("_with_texture" if with_uvs else "")

    def call():
        meshes = ready.pop()
        meshes.apply_filter(name, targetfacenum=source.target)
        return meshes

    def result(meshes):
        out = meshes.current_mesh()
        out.compact()
        uvs = out.wedge_tex_coord_matrix().reshape(-1, 3, 2) * [1, -1] + [0, 1] if with_uvs else None
        return out.vertex_matrix(), out.face_matrix(), uvs

    return call, result


def blender(source):
    import bpy

    mesh = bpy.data.meshes.new("source")
    mesh.from_pydata(source.vertices.tolist(), [], source.triangles.tolist())
    if source.uvs is not None:
        flipped = source.uvs.reshape(-1, 2) * [1, -1] + [0, 1]
        mesh.uv_layers.new().data.foreach_set("uv", flipped.astype(numpy.float32).ravel())
    thing = bpy.data.objects.new("source", mesh)
    bpy.context.collection.objects.link(thing)
    modifier = thing.modifiers.new("decimate", "DECIMATE")
    modifier.ratio, modifier.use_collapse_triangulate = source.target / len(source.triangles), True

    def call():
        thing.update_tag()
        mesh.update()
        return thing.evaluated_get(bpy.context.evaluated_depsgraph_get()).to_mesh()

    def result(out):
        out.calc_loop_triangles()
        vertices = numpy.array([vertex.co[:] for vertex in out.vertices])
        triangles = numpy.array([triangle.vertices[:] for triangle in out.loop_triangles])
        if source.uvs is None:
            return vertices, triangles, None
        loops = numpy.array([triangle.loops[:] for triangle in out.loop_triangles])
        return vertices, triangles, numpy.array([uv.uv[:] for uv in out.uv_layers[0].data])[loops] * [1, -1] + [0, 1]

    return call, result


# Title: function, distribution on PyPI, whether it needs UVs.
PACKAGES = {
    "faqem.simplify": (faqem_arrays, "faqem", False),
    "faqem.simplify, preset fast": (lambda source: faqem_arrays(source, preset="fast"), "faqem", False),
    "faqem.simplify with uvs": (faqem_uvs, "faqem", True),
    "faqem.simplify, a new texture": (faqem_bake, "faqem", True),
    "fast_simplification": (fast_simplification, "fast-simplification", False),
    "trimesh": (trimesh, "trimesh", False),
    "pyfqmr": (pyfqmr, "pyfqmr", False),
    "Open3D": (open3d, "open3d", False),
    "MeshLib": (meshlib, "meshlib", False),
    "PyMeshLab": (pymeshlab, "pymeshlab", False),
    "PyMeshLab with texture": (lambda source: pymeshlab(source, with_uvs=True), "pymeshlab", True),
    "Blender (bpy)": (blender, "bpy", False),
}


def write_textured(folder, name, mesh, image, suffix):
    """Writes an OBJ file with the image, and returns its name."""
    vertices, triangles, uvs = mesh
    (folder / f"{name}{suffix}").write_bytes(image)
    (folder / f"{name}.mtl").write_text(f"newmtl m\nmap_Kd {name}{suffix}\n")
    lines = [f"mtllib {name}.mtl", "usemtl m", *(f"v {x:.9g} {y:.9g} {z:.9g}" for x, y, z in vertices)]
    lines += [f"vt {u:.7f} {1 - v:.7f}" for u, v in numpy.asarray(uvs, dtype=float).reshape(-1, 2)]
    lines += [f"f {a}/{3 * f + 1} {b}/{3 * f + 2} {c}/{3 * f + 3}" for f, (a, b, c) in enumerate(triangles + 1)]
    file = folder / f"{name}.obj"
    file.write_text("\n".join(lines) + "\n")
    return file


@functools.cache
def uv_picture():
    """Returns a PNG whose red is u and whose green is v, of 1024 x 1024 texels."""
    return png(lambda x, y: (x * 255 // 1023, y * 255 // 1023, 0), 1024, kind=2)


def errors(source, result):
    """Returns distances in % of the diagonal; with UVs also the errors of colours and UVs, root mean square."""
    import faqem

    if isinstance(result, faqem.Model):
        (part,) = result.parts
        mesh, uvs = (part.vertices, part.triangles), None
    else:
        mesh, uvs = (numpy.asarray(result[0], float), numpy.asarray(result[1]).astype(numpy.int64)), result[2]
    found = faqem.compare((source.vertices, source.triangles), mesh, samples=SAMPLES)
    row = {"faces": len(mesh[1]), "max": 100 * found["hausdorff"] / found["diagonal"],
           "mean": 50 * (found["a_to_b"]["mean"] + found["b_to_a"]["mean"]) / found["diagonal"]}
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        if isinstance(result, faqem.Model):
            row["color"] = faqem.compare(source.model, result, samples=SAMPLES)["colors"]["rmse"]
        elif uvs is not None:
            suffix = {"image/png": ".png", "image/jpeg": ".jpg"}[source.image.mime_type]
            original = source.vertices, source.triangles, source.uvs
            for kind, image, extension in (("color", source.image.encoded, suffix), ("uv", uv_picture(), ".png")):
                a = write_textured(folder, f"{kind}-a", original, image, extension)
                b = write_textured(folder, f"{kind}-b", (*mesh, uvs), image, extension)
                row[kind] = faqem.compare(a, b, samples=SAMPLES)["colors"]["rmse"]
    return row


def measure(title, file, least_seconds):
    """Prints the row of one package and model as JSON."""
    source = Source(file)
    make, package, needs_uvs = PACKAGES[title]
    if needs_uvs and source.uvs is None:
        return
    call, result = make(source)
    seconds, cpu_seconds = [], []
    while len(seconds) < CALLS and (not seconds or seconds[0] <= least_seconds):
        start, cpu_start = time.perf_counter(), time.process_time()
        out = call()
        seconds.append(time.perf_counter() - start)
        cpu_seconds.append(time.process_time() - cpu_start)
    row = {"model": file.parent.name if file.stem == "textured" else file.stem, "faces_in": len(source.triangles),
           "package": title, "version": importlib.metadata.version(package), "seconds": min(seconds), "cpu": min(cpu_seconds)}
    print("\nROW " + json.dumps({**row, **errors(source, result(out))}))


def read(file):
    rows = [json.loads(line) for line in file.read_text().splitlines()] if file.exists() else []
    return {(row["file"], row["package"]): row for row in rows}


def number(value, digits=2):
    return "" if value is None else f"{value:.{digits}g}"


def table(rows):
    """Returns the tables: for each model, packages by mean distance; first where more of them are better than faqem."""
    blocks = []
    for file in dict.fromkeys(row["file"] for row in rows):
        here = sorted((row for row in rows if row["file"] == file and "mean" in row), key=lambda row: row["mean"])
        ours = next(row for row in here if row["package"] == "faqem.simplify")
        others = [row for row in here if not row["package"].startswith("faqem")]
        lost = {key: sum(row[key] < ours[key] for row in others) for key in ("mean", "max", "cpu")}
        keys = ("cpu", "mean", "max", "uv", "color")
        lines = ["| " + " | ".join([row["package"], str(row["faces"]), *(number(row.get(key)) for key in keys)]) + " |"
                 for row in here]
        title = (f"### {ours['model']}, {ours['faces_in']} faces\n\nBetter than `faqem.simplify`: {lost['cpu']} of "
                 f"{len(others)} in time, {lost['mean']} in the mean distance, {lost['max']} in the maximum.")
        kept = [row for row in here if "uv" in row]
        for row in (row for row in kept if row["package"].startswith("faqem")):
            better = {key: [one["package"] for one in kept if one[key] < row[key]] for key in ("uv", "color")}
            lost.update({key: len(names) for key, names in better.items()})
            title += (f"\nBetter than `{row['package']}`: {', '.join(better['uv']) or 'none'} in UVs, "
                      f"{', '.join(better['color']) or 'none'} in colours.")
        title += "\n\n"
        head = "| package | faces | CPU s | mean, % | max, % | UV | colour |\n|---|---:|---:|---:|---:|---:|---:|\n"
        blocks.append((sum(lost.values()), title + head + "\n".join(lines)))
    return "\n\n".join(text for _, text in sorted(blocks, key=lambda block: -block[0]))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("models", nargs="+", type=pathlib.Path)
    parser.add_argument("--rows", type=pathlib.Path, default=pathlib.Path("python_peers.jsonl"))
    parser.add_argument("--least-seconds", type=float, default=4)
    parser.add_argument("--one", choices=PACKAGES)
    given = parser.parse_args()
    if given.one:
        measure(given.one, given.models[0], given.least_seconds)
        return
    rows = read(given.rows)
    for file in given.models:
        for title in PACKAGES:
            if (str(file), title) in rows:
                continue
            command = [sys.executable, __file__, "--one", title, "--least-seconds", str(given.least_seconds), str(file)]
            done = subprocess.run(command, capture_output=True, text=True)
            found = [line[4:] for line in done.stdout.splitlines() if line.startswith("ROW ")]
            if not found and done.returncode != 0:
                print(f"{file.name}, {title}: {(done.stderr.strip().splitlines() or ['failed'])[-1]}", file=sys.stderr)
            row = {"file": str(file), "package": title, **(json.loads(found[0]) if found else {})}
            if found or done.returncode == 0:
                rows[str(file), title] = row
                with given.rows.open("a") as out:
                    out.write(json.dumps(row) + "\n")
    versions = {row["package"]: row["version"] for row in rows.values() if "version" in row}
    print(table(list(rows.values())))
    print("\n" + ", ".join(f"{title} {version}" for title, version in versions.items()))


if __name__ == "__main__":
    main()
