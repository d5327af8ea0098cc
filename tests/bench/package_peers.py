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
    """Bisects the tolerance, because there is no target, until at most the target and within 1% of it are left."""
    import manifold3d

    solid = manifold3d.Manifold(manifold3d.Mesh64(vertices, triangles.astype(numpy.uint64)))
    if solid.status() != manifold3d.Error.NoError:
        sys.exit(f"manifold3d: {solid.status().name}")
    high = numpy.linalg.norm(numpy.ptp(vertices, axis=0))
    low, best = 1e-9 * high, None
    for _ in range(28):
        middle = (low * high) ** 0.5
        found = solid.simplify(middle)
        if found.num_tri() > target:
            low = middle
            continue
        high = middle
        if found.num_tri() > (best.num_tri() if best else 0):
            best = found
        if found.num_tri() >= 0.99 * target:
            break
    if not best:
        sys.exit("manifold3d: no tolerance leaves so few faces")
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
