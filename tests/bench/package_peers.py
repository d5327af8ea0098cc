"""Simplifies a triangle mesh with one package, for faqem-bench.

Usage: package_peers.py NAME IN.obj OUT FACES: writes OUT.obj or OUT.glb. Blender, manifold3d and MeshLib are the
packages bpy, manifold3d and meshlib of PyPI. gltfpack is the command in PATH, for example of the package of npm.
"""

import pathlib
import subprocess
import sys
import types

import numpy


def read(file):
    """Returns the vertices and triangles of an OBJ file without other elements."""
    lines = [line.split() for line in file.read_text().splitlines()]
    return (numpy.array([line[1:] for line in lines if line[0] == "v"], float),
            numpy.array([line[1:] for line in lines if line[0] == "f"], int) - 1)


def write(file, vertices, triangles):
    lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in numpy.asarray(vertices, float).tolist()]
    lines += [f"f {a} {b} {c}" for a, b, c in (numpy.asarray(triangles).astype(int) + 1).tolist()]
    file.write_text("\n".join(lines) + "\n")


def manifold3d(vertices, triangles, target):
    """Searches for a tolerance that leaves the target within 1%, because there is no target for the number of faces."""
    import manifold3d

    solid = manifold3d.Manifold(manifold3d.Mesh64(vertices, triangles.astype(numpy.uint64)))
    if solid.status() != manifold3d.Error.NoError:
        sys.exit(f"manifold3d: {solid.status().name}")
    # In one step, large tolerances may leave more faces than small ones. In many steps they do not, and reach fewer.
    diagonal = numpy.linalg.norm(numpy.ptp(vertices, axis=0))
    low, high = 0, 1e-6 * diagonal
    while high < diagonal and (found := solid.simplify(high)).num_tri() > target:
        solid, low, high = found, high, 1.25 * high
    best = solid
    for _ in range(24):
        middle = (low + high) / 2
        found = solid.simplify(middle)
        count = found.num_tri()
        if count and abs(count - target) < abs(best.num_tri() - target):
            best = found
        if abs(count - target) <= 0.01 * target:
            break
        low, high = (middle, high) if count > target else (low, middle)
    mesh = best.to_mesh64()
    return mesh.vert_properties[:, :3], mesh.tri_verts


def gltfpack(source, out, share):
    command = ["gltfpack", "-i", source, "-o", f"{out}.glb", "-si", f"{share:.9f}", "-se", "1", "-sv", "-sp", "-noq"]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"gltfpack: {done.stdout} {done.stderr}")


def main():
    name, source, out, target = sys.argv[1], pathlib.Path(sys.argv[2]), sys.argv[3], int(sys.argv[4])
    vertices, triangles = read(source)
    if name == "gltfpack":
        # It rounds down.
        gltfpack(source, out, (target + 0.5) / len(triangles))
        return
    if name == "manifold3d":
        result = manifold3d(vertices, triangles, target)
    else:
        import python_peers

        make = {"blender": python_peers.blender, "meshlib": python_peers.meshlib}[name]
        call, convert = make(types.SimpleNamespace(vertices=vertices, triangles=triangles, uvs=None, target=target))
        result = convert(call())
    write(pathlib.Path(f"{out}.obj"), *result[:2])


if __name__ == "__main__":
    main()
