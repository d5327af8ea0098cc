"""A program for mypy --strict. Wrong calls are marked, so that it is an error if they are not found."""

import faqem
import faqem.fast_simplification as drop_in
import numpy
import trimesh

vertices = numpy.zeros((4, 3), dtype=numpy.float32)
triangles = [[0, 1, 2], [0, 2, 3]]


def show(phase: str, fraction: float) -> None:
    print(phase, fraction)


out = faqem.simplify(vertices, triangles, ratio=0.5, preset="best", max_error="0.1%", progress=show)
kept: "numpy.ndarray[tuple[int, ...], numpy.dtype[numpy.uint32]]" = out.triangles
level: faqem.SimplifiedLevel
for level in faqem.simplify_levels(vertices, triangles, [0.5, 1000, "error:1%"], history=True):
    error: float = level.error
    print(error, level.report["faces_out"], level.map([0], [[1, 0, 0]])[1].dtype)

points, faces = drop_in.simplify(vertices, triangles, 0.5, agg=3, verbose=True)
points, faces, collapses = drop_in.simplify(vertices, triangles, target_count=1, return_collapses=True)
points, faces, mapping = drop_in.replay_simplification(points=vertices, triangles=triangles, collapses=collapses)
print(points.dtype, faces.dtype, collapses.remaining, mapping.dtype)

small = faqem.simplify(trimesh.load_mesh("statue.glb"), faces=100, texture_size=512)
print(small.metadata["faqem"], len(small.faces))
scene: trimesh.Scene = faqem.simplify(trimesh.Scene(), faces=100)

model = faqem.load("statue.glb")
of_file: faqem.SimplifiedModel = faqem.simplify("statue.glb", faces=1e5)
of_model: faqem.SimplifiedModel = faqem.simplify(model)
faqem.simplify(vertices, triangles, ratio="10%")
faqem.simplify(model, bake="auto", link="by-size", normal_map="auto", allow_larger=True)
result = faqem.simplify(model, faces=20_000, texture_size=2048, image_format="webp")
faqem.save(result, "simplified.glb", overwrite=True)
faqem.save((out.vertices, out.triangles), "simplified.ply")
faqem.save_levels([model, *faqem.simplify_levels(model, [0.5, 0.1], textures="shared")], "levels.glb")
print(faqem.compare(result, "simplified.glb", samples=1000)["colors"], faqem.command("info", "statue.glb").split())
print(faqem.History.load("history").truncate(100).vertices.shape, faqem.__version__)

faqem.simplify(vertices, triangles, rato=0.5)  # type: ignore[call-overload]
faqem.simplify(vertices, triangles, preset="bes")  # type: ignore[call-overload]
faqem.simplify(model, texture_size="large")  # type: ignore[call-overload]
faqem.simplify(trimesh.Scene(), texture_size="large")  # type: ignore[call-overload]
faqem.simplify(vertices)  # type: ignore[call-overload]
