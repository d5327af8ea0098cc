"""Simplifies meshes and scenes of the package trimesh."""

import faqem
import numpy
import PIL.Image
import trimesh


def ball():
    """A sphere with a texture whose colour tells the place: red grows downwards, green to the right."""
    mesh = trimesh.creation.uv_sphere(count=[96, 96])
    x, y, z = mesh.vertices.T
    uv = numpy.stack([numpy.arctan2(y, x) / (2 * numpy.pi) + 0.5, numpy.arccos(numpy.clip(z, -1, 1)) / numpy.pi], axis=1)
    texels = numpy.mgrid[0:256, 0:256].transpose(1, 2, 0)[..., [0, 1, 0]].astype(numpy.uint8)
    material = trimesh.visual.material.PBRMaterial(baseColorTexture=PIL.Image.fromarray(texels))
    mesh.visual = trimesh.visual.TextureVisuals(uv=uv, material=material)
    mesh.metadata["note"] = "kept"
    return mesh


source = ball()
small = faqem.simplify(source, faces=2000, texture_size=512)
assert isinstance(small, trimesh.Trimesh) and len(small.faces) == 2000
assert small.visual.material.baseColorTexture.size == (512, 512)
assert small.metadata["note"] == "kept" and small.metadata["faqem"]["faces_out"] == 2000
colours = small.visual.to_color().vertex_colors[:, :2].astype(int)
_, nearest = source.kdtree.query(small.vertices)
error = abs(colours - source.visual.to_color().vertex_colors[nearest, :2].astype(int))
assert numpy.median(error) <= 4, numpy.median(error)
assert len(source.faces) > 30_000, "the source is unchanged"

scene = trimesh.Scene([source, source.copy().apply_translation([3, 0, 0])])
small = faqem.simplify(scene, ratio=0.2, texture_size=512)
assert isinstance(small, trimesh.Scene) and set(small.graph.nodes_geometry) == set(scene.graph.nodes_geometry)
assert abs(small.bounds - scene.bounds).max() < 0.01
assert sum(len(mesh.faces) for mesh in small.geometry.values()) <= 0.2 * 2 * len(source.faces)

plain = faqem.simplify(trimesh.creation.icosphere(4), ratio=0.5)
assert len(plain.faces) == 2560

for wrong, message in ((trimesh.Scene(), "no faces"), (trimesh.Trimesh(), "no faces"), (5, "triangles: missing")):
    try:
        faqem.simplify(wrong, ratio=0.5)
        raise AssertionError(wrong)
    except faqem.InputError as error:
        assert message in str(error)
print(f"trimesh {trimesh.__version__}")
