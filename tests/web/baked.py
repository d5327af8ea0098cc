"""Writes textured models for the test of the package, and compares what it made of them with the native library.

Usage: baked.py write FOLDER MODEL.glb    NAME.glb and NAME.options of each model
       baked.py compare FOLDER            NAME.out.glb of the package with the native result
"""
import json
import pathlib
import sys

import faqem
import numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "docs" / "statements"))
from model import gltf_grid, png


def painted(pixel, side, material, **textures):
    """A sheet of 2 side^2 faces with a colour texture, and other textures by name."""
    glb = gltf_grid(material, side=side)
    glb.json["materials"][0].update({name: {"index": glb.texture(png(other, 16))} for name, other in textures.items()})
    glb.json["materials"][0]["pbrMetallicRoughness"] = {"baseColorTexture": {"index": glb.texture(png(pixel, 32))}}
    return glb.bytes()


def cases(quad):
    """Yields name, content of a GLB, options of the package."""
    yield "quad", quad, {"ratio": 1, "bake": "atlas", "textureSize": 64}
    colours = lambda x, y: (8 * x, 255 - 7 * y, (x * y) % 251, 255)
    yield "colours", painted(colours, 24, {}), {"ratio": 0.2, "bake": "atlas", "textureSize": 128}
    maps = {"normalTexture": lambda x, y: (100 + 3 * x, 150 - 2 * y, 240, 255), "emissiveTexture": lambda x, y: (0, 13 * x, 200 - 9 * y, 255)}
    yield "maps", painted(colours, 20, {"emissiveFactor": [1, 0.5, 0]}, **maps), {"faces": 150, "bake": "atlas", "textureSize": 64}
    leaf = painted(lambda x, y: (7 * x, 200, 6 * y, 255 if x > 8 else 8 * y), 16, {"alphaMode": "BLEND"})
    yield "alpha", leaf, {"maxError": "1%", "bake": "atlas", "textureSize": 64}
    yield "kept", leaf, {"ratio": 0.5, "bake": "keep"}


def corners(part):
    """The triangles in a definite order: files have them, and vertices, in an order for GPUs."""
    rows = numpy.hstack([part.vertices, *part.uvs])[part.triangles].tolist()
    first = [row.index(min(row)) for row in rows]
    return sorted((row[i:] + row[:i], m) for row, i, m in zip(rows, first, part.materials.tolist()))


def content(model):
    return [corners(part) for part in model.parts], model.materials, [(image.name, image.pixels().tolist()) for image in model.images]


def compare(name, source, made, options):
    named = {{"textureSize": "texture_size", "maxError": "max_error"}.get(key, key): value for key, value in options.items()}
    native = faqem.simplify(source, threads=1, image_format="png", allow_larger=True, **named)
    assert content(made) == content(faqem.Model.from_glb(native.to_glb())), name
    assert options["bake"] != "keep" or made.images[0].encoded == source.images[0].encoded
    print(f"{name}: {len(made.parts[0].triangles)} faces and {len(made.images)} images as the native library makes them")


if __name__ == "__main__":
    folder = pathlib.Path(sys.argv[2])
    if sys.argv[1] == "write":
        for name, glb, options in cases(pathlib.Path(sys.argv[3]).read_bytes()):
            (folder / f"{name}.glb").write_bytes(glb)
            (folder / f"{name}.options").write_text(json.dumps(options))
    else:
        for file in sorted(folder.glob("*.options")):
            models = [faqem.Model.from_glb(file.with_suffix(suffix).read_bytes()) for suffix in (".glb", ".out.glb")]
            compare(file.stem, *models, json.loads(file.read_text()))
