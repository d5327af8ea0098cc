#!/usr/bin/env python3
"""Fits the base colours of results to pictures of their sources: about the best texture that mesh and UVs can have.

    ceiling.py OUT SHARED/tools SOURCE RESULT.glb [SOURCE RESULT.glb]...

Least squares over 24 unlit views of the source, at pixels that both cover, in sRGB; the texture of the result counts as
a weak observation of each texel. The filter is that of the judge, the renderer of shared/tools: four samples in a
pixel, trilinear, mip levels averaged in linear light. Prints the unlit PSNR of the result and of the same mesh with
fitted pages, from six other views. Faces with alpha or a colour factor stay as they are. Time grows with the pages:
--texture-size 1024 is enough for these views. Needs numpy, scipy and pillow. Not for skins, instances and texture
transforms.
"""

import io
import json
import pathlib
import subprocess
import sys

import numpy
from PIL import Image
from scipy.sparse import csr_matrix
from scipy.sparse.linalg import LinearOperator, cg
from scipy.spatial.transform import Rotation

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "docs/statements"))
from model import Glb, Gltf

SIZE, VIEWS, HALF_ANGLE, PULL = 384, 24, numpy.pi / 12, 0.05
SAMPLES = numpy.array([[-2, 6, 0], [6, 2, 0], [-6, -2, 0], [2, -6, 0]]) / 16  # of a pixel, as renderers place four


def linear(c):
    return numpy.where(c <= 0.04045, c / 12.92, ((c + 0.055) / 1.055) ** 2.4)


def srgb(c):
    return numpy.where(c <= 0.0031308, 12.92 * c, 1.055 * c ** (1 / 2.4) - 0.055)


def slope(function, x):
    return (function(x + 1e-6) - function(x)) / 1e-6


def faces_of(gltf, nodes, parent):
    """Yields corners, their UVs, and for each face whether it has two sides and its texture (-1: stays as it is)."""
    for node in (gltf.json["nodes"][n] for n in nodes):
        local = numpy.reshape(node.get("matrix", numpy.eye(4)), (4, 4)).T.copy()
        turn = Rotation.from_quat(node.get("rotation", [0, 0, 0, 1])).as_matrix()
        local[:3, :3] = local[:3, :3] @ turn * node.get("scale", 1)
        local[:3, 3] += node.get("translation", 0)
        to_scene = parent @ local
        yield from faces_of(gltf, node.get("children", []), to_scene)
        for primitive in gltf.primitives(node["mesh"]) if "mesh" in node else []:
            turned = -1 if numpy.linalg.det(to_scene) < 0 else 1
            order = numpy.reshape(gltf.accessor(primitive["indices"]), (-1, 3))[:, ::turned]
            points = numpy.array(gltf.accessor(primitive["attributes"]["POSITION"])) @ to_scene[:3, :3].T
            material = gltf.json["materials"][primitive["material"]] if "material" in primitive else {}
            colors = material.get("pbrMetallicRoughness", {})
            fits = material.get("alphaMode", "OPAQUE") == "OPAQUE" and "baseColorFactor" not in colors
            texture = colors.get("baseColorTexture", {}) if fits else {}
            uvs = primitive["attributes"].get(f"TEXCOORD_{texture.get('texCoord', 0)}")
            uvs = numpy.zeros((len(points), 2)) if uvs is None else numpy.array(gltf.accessor(uvs))
            each = [material.get("doubleSided", False), texture.get("index", -1)]
            yield points[order] + to_scene[:3, 3], uvs[order], *(numpy.full(len(order), value) for value in each)


def seen(corners, uvs, two_sided, frame, view, sample):
    """Pixels of a view, the face at a sample of each, and its UVs at the centre, a pixel to the right and one below."""
    y, turn = 1 - 2 * (view + 0.5) / VIEWS, view * numpy.pi * (3 - 5**0.5)
    x, flat = numpy.array([numpy.sin(turn), 0, -numpy.cos(turn)]), (1 - y * y) ** 0.5
    z = numpy.array([numpy.cos(turn) * flat, y, numpy.sin(turn) * flat])
    at = (corners - frame["center"]) @ numpy.stack([x, numpy.cross(z, x), z]).T
    at[..., 2] -= 1.02 * frame["radius"] / numpy.sin(HALF_ANGLE)
    pixels = (1 + at[..., :2] / at[..., 2:] / numpy.tan(HALF_ANGLE) * [-1, 1]) * SIZE / 2 - 0.5
    low = numpy.clip(numpy.floor(pixels.min(1)), 0, SIZE).astype(int)
    wide, high = numpy.clip(numpy.ceil(pixels.max(1)).astype(int) + 1 - low, 0, SIZE - low).T
    edges = numpy.cross(at[:, [1, 2, 0]], at[:, [2, 0, 1]])  # their products with a ray are its barycentric weights
    volume = (at[:, 0] * edges[:, 0]).sum(1)  # negative in front
    counts = wide * high * ((volume < 0) | two_sided & (volume > 0))
    face = numpy.repeat(numpy.arange(len(counts)), counts)
    within = numpy.arange(len(face)) - numpy.repeat(numpy.cumsum(counts) - counts, counts)
    column, row = low[face, 0] + within % wide[face], low[face, 1] + within // wide[face]
    step = 2 / SIZE * numpy.tan(HALF_ANGLE)
    ray = numpy.stack([column + 0.5 - SIZE / 2, SIZE / 2 - row - 0.5, 0 * row - 1 / step], 1)
    near = [numpy.einsum("nij,nj->ni", edges[face], ray + move) for move in (sample, [0, 0, 0], [1, 0, 0], [0, -1, 0])]
    inside = numpy.flatnonzero((near[0] * numpy.sign(volume[face])[:, None] >= 0).all(1))
    order = inside[numpy.lexsort((face[inside], (volume[face] / near[0].sum(1))[inside]))]
    pixel, first = numpy.unique((row * SIZE + column)[order], return_index=True)
    face, near = face[order[first]], [w[order[first]] for w in near]
    return pixel, face, *(numpy.einsum("ni,nij->nj", w / w.sum(1, keepdims=True), uvs[face]) for w in near[1:])


def sampling(uv, right, below, height, width):
    """The linear maps from mip levels to samples, and from texels to mip levels."""
    tall, wide = numpy.maximum(1, [[height >> n, width >> n] for n in range(max(height, width).bit_length())]).T
    start, texel = numpy.cumsum(tall * wide) - tall * wide, numpy.arange(height * width)
    rows = [s + texel // width * h // height * w + texel % width * w // width for s, h, w in zip(start, tall, wide)]
    shares = numpy.repeat(tall * wide / len(texel), len(texel))
    mips = csr_matrix((shares, (numpy.ravel(rows), numpy.tile(texel, len(tall)))))
    rho = [numpy.linalg.norm((other - uv) * [width, height], axis=1) for other in (right, below)]
    lod = numpy.clip(numpy.log2(numpy.maximum(numpy.maximum(*rho), 1e-9)), 0, len(tall) - 1)
    columns, shares = [], []
    for up, dx, dy in numpy.ndindex(2, 2, 2):
        level = numpy.minimum(numpy.floor(lod).astype(int) + up, len(tall) - 1)
        at = uv * numpy.stack([wide[level], tall[level]], 1) - 0.5
        x, y = (numpy.floor(at).astype(int) + [dx, dy]).T
        shares.append((1 - abs(at - numpy.stack([x, y], 1))).prod(1) * abs(1 - up - lod % 1))
        columns.append(start[level] + y % tall[level] * wide[level] + x % wide[level])
    rows = numpy.tile(numpy.arange(len(uv)), 8)
    return csr_matrix((numpy.ravel(shares), (rows, numpy.ravel(columns))), (len(uv), mips.shape[0])), mips


def fit(pixels, samples, mips, observed, texels):
    """A Gauss-Newton step, solved by conjugate gradients. Colours are rows."""
    back = [m.T.tocsr() for m in (mips, samples, pixels)]
    value = samples @ (mips @ linear(texels))
    outer, inner = slope(srgb, value), slope(linear, texels)
    to_texels = lambda v: inner * (back[0] @ (back[1] @ (outer * (back[2] @ v))))
    to_pixels = lambda v: pixels @ (outer * (samples @ (mips @ (inner * v.reshape(texels.shape)))))
    product = lambda v: to_texels(to_pixels(v)).ravel() + PULL * v.ravel()
    right = to_texels(observed - pixels @ srgb(value))
    step, _ = cg(LinearOperator((texels.size, texels.size), product, dtype=float), right.ravel(), maxiter=50)
    return numpy.clip(texels + step.reshape(texels.shape), 0, 1)


def pictures(tools, views, *words):
    options = ["--frame-of", words[0], "--views", str(views), "--size", str(SIZE), "--passes", "unlit"]
    subprocess.run([tools / "render/render.mjs", *words, *options], stdout=subprocess.DEVNULL)


def measure(tools, source, result, folder):
    pictures(tools, VIEWS, source, folder / "views")
    frame = json.loads((folder / "views/report.json").read_text())["frame"]
    gltf, glb, found = Gltf(result.read_bytes(), {"warnings": []}), Glb(), []
    glb.json, glb.buffer = gltf.json, gltf.buffer
    faces = faces_of(gltf, gltf.json["scenes"][gltf.json["scene"]]["nodes"], numpy.eye(4))
    corners, uvs, two_sided, textures = map(numpy.concatenate, zip(*faces))
    for view in range(VIEWS):
        picture = numpy.array(Image.open(folder / f"views/unlit_{view:02d}.png").convert("RGBA")).reshape(-1, 4) / 255
        samples = (seen(corners, uvs, two_sided, frame, view, sample) for sample in SAMPLES)
        pixel, face, *at = map(numpy.concatenate, zip(*samples))
        row, shared = numpy.unique(pixel * len(corners) + face, return_index=True, return_counts=True)[1:]
        found.append([view * SIZE**2 + pixel[row], picture[pixel[row]], face[row], shared / 4, *(a[row] for a in at)])
    pixel, colors, face, share, *at = map(numpy.concatenate, zip(*found))
    for texture in numpy.unique(textures[face][textures[face] >= 0]):
        whole = numpy.bincount(pixel, share * (textures[face] == texture) * (colors[:, 3] == 1)) == 1
        mine = numpy.flatnonzero(whole[pixel])
        _, first, row = numpy.unique(pixel[mine], return_index=True, return_inverse=True)
        image = gltf.json["images"][gltf.json["textures"][texture]["source"]]
        view = gltf.json["bufferViews"][image["bufferView"]]
        page = numpy.array(Image.open(io.BytesIO(gltf.buffer[view["byteOffset"]:])).convert("RGB")) / 255
        maps = sampling(*(a[mine] for a in at), *page.shape[:2])
        pixels = csr_matrix((share[mine], (row, numpy.arange(len(row)))))
        fitted = fit(pixels, *maps, colors[mine, :3][first], page.reshape(-1, 3)).reshape(page.shape)
        content = io.BytesIO()
        Image.fromarray(numpy.rint(255 * fitted).astype("u1")).save(content, "PNG")
        image.update(bufferView=glb.view(content.getvalue()), mimeType="image/png")
    (folder / "fitted.glb").write_bytes(glb.bytes())
    pictures(tools, 6, source, folder / "source", result, folder / "result", folder / "fitted.glb", folder / "fitted")
    compare = [sys.executable, tools / "compare/compare.py", folder / "source"]
    values = [json.loads(subprocess.check_output([*compare, folder / name])) for name in ("result", "fitted")]
    print("|", result.stem, *(f"| {value['unlit']['psnr_fg']['mean']:.2f}" for value in values), "|", flush=True)


if __name__ == "__main__":
    out, judge, *models = map(pathlib.Path, sys.argv[1:])
    for source, result in zip(models[::2], models[1::2]):
        measure(judge, source, result, out / result.stem)
