"""Checks of the rows about meshes and materials of glTF."""
from model import Glb, expect, expect_no_warning, gltf_grid, grid, png, rows_of, warns

ROWS = {}
row = rows_of(ROWS, "glTF")
RED = {"name": "red", "pbrMetallicRoughness": {"baseColorFactor": [1, 0, 0, 1]}}
VERTICES = len(grid()[0])
PATTERN = png(lambda x, y: (60 * x, 60 * y, 0, 255))
TURNED = png(lambda x, y: (60 * y, 60 * x, 0, 255))


def write(runs, glb, used=()):
    if used:
        glb.json["extensionsUsed"] = list(used)
    return runs.write("a.glb", glb.bytes())


def textured(pixels, texture=None, material=None, **attributes):
    """The grid with a base colour texture."""
    glb = gltf_grid({"name": "m", **(material or {})}, **attributes)
    index = glb.texture(png(pixels) if isinstance(pixels, tuple) else pixels)
    pbr = glb.json["materials"][0].setdefault("pbrMetallicRoughness", {})
    pbr["baseColorTexture"] = {"index": index, **(texture or {})}
    return glb


def primitive_of(glb):
    return glb.json["meshes"][0]["primitives"][0]


def three(runs):
    """The result without simplification, with its own and with new texture coordinates."""
    return runs.whole("a.glb"), runs.kept("a.glb"), runs.baked("a.glb")


@row("strips, fans, sparse and normalised numbers")
def triangles(runs):
    glb = Glb()
    strip = glb.accessor([(0, 0, 0), (1, 0, 0), (0, 1, 0), (9, 9, 9)])
    glb.json["accessors"][strip]["sparse"] = {
        "count": 1, "indices": {"bufferView": glb.view(b"\3\0\0\0"), "componentType": 5123},
        "values": {"bufferView": glb.view(bytes.fromhex("0000803f0000803f00000000"))}}
    uvs = glb.accessor([(0, 0), (65535, 0), (0, 65535), (65535, 65535)], "H", normalized=True)
    fan = glb.accessor([(2, 0, 0), (3, 0, 0), (3, 1, 0), (2, 1, 0)])
    glb.add("meshes", {"primitives": [{"attributes": {"POSITION": strip, "TEXCOORD_0": uvs}, "mode": 5},
                                      {"attributes": {"POSITION": fan, "TEXCOORD_0": uvs}, "mode": 6}]})
    glb.add("nodes", {"mesh": 0})
    glb.json["scenes"] = [{"nodes": [0]}]
    expect_no_warning(runs, write(runs, glb))
    info = runs.info("a.glb")["total"]
    expect(info["faces"] == 4 and abs(info["area"] - 2) < 1e-6, "four triangles")
    expect(all(p.get("mode", 4) == 4 for p in runs.whole("a.glb").primitives()), "triangles")


@row("points and lines")
def points(runs):
    glb = gltf_grid(RED)
    glb.add("materials", {"name": "unused"})
    attributes = {"POSITION": glb.accessor([(0, 0, 1), (1, 0, 1)])}
    glb.json["meshes"][0]["primitives"] += [
        {"attributes": attributes, "mode": mode, "material": glb.add("materials", {"name": "ink"}), "extras": "line",
         "indices": glb.accessor([1, 0], "I")} for mode in (0, 1)]
    expect_no_warning(runs, write(runs, glb))
    for gltf in three(runs):
        modes = [p["mode"] for p in gltf.primitives() if p.get("mode", 4) < 4]
        expect(modes == [0, 1], "kept")
        for line in gltf.primitives()[-2:]:
            expect(gltf.accessor(line["attributes"]["POSITION"])[1] == (1, 0, 1), "their vertices")
            expect(gltf.accessor(line["indices"]) == [(1,), (0,)], "their indices")
            expect(gltf.json["materials"][line["material"]]["name"] == "ink" and line["extras"] == "line", "the others")


@row("`NORMAL`, `TANGENT`")
def normals(runs):
    write(runs,
          textured((9, 9, 9, 255), NORMAL=([(0, 0, 1)] * VERTICES, "f"), TANGENT=([(1, 0, 0, 1)] * VERTICES, "f")))
    whole, kept, baked = three(runs)
    expect(whole.attribute("TANGENT") == [(1, 0, 0, 1)] * VERTICES, "kept where nothing changed")
    for gltf in (kept, baked):
        expect(all(abs(n[2] - 1) < 1e-3 for n in gltf.attribute("NORMAL")), "transferred")
        expect(gltf.attribute("TANGENT") is None, "no tangents without a normal map")


@row("`TEXCOORD_n`")
def coordinates(runs):
    write(runs, textured(PATTERN, TEXCOORD_1=([(0.5, i / VERTICES) for i in range(VERTICES)], "f")))
    whole, kept, baked = three(runs)
    for gltf in (whole, kept):
        expect(gltf.attribute("TEXCOORD_1")[0][0] == 0.5, "both sets")
    expect(baked.attribute("TEXCOORD_0") is not None and baked.attribute("TEXCOORD_1") is None, "one set of a new page")
    expect(baked.warns("no texture uses were left out for a new page: set 1"), "a warning of the other")
    write(runs, gltf_grid(RED, TEXCOORD_0=([(0.5, 0.25)] * VERTICES, "f")))
    for gltf in three(runs):
        expect(gltf.attribute("TEXCOORD_0")[0] == (0.5, 0.25), "kept without textures")


@row("`COLOR_0`")
def colors(runs):
    write(runs,
          gltf_grid({"pbrMetallicRoughness": {"baseColorFactor": [1, 0.5, 1, 1]}},
                    COLOR_0=([(1, 1, 0, 1)] * VERTICES, "f")))
    whole, kept, baked = three(runs)
    for gltf in (whole, kept):
        expect(gltf.attribute("COLOR_0") is not None, "kept")
    expect(baked.attribute("COLOR_0") is None and [round(x, 1) for x in baked.factor()] == [1, 0.5, 0, 1], "baked")


@row("`JOINTS_n`, `WEIGHTS_n`, `skins`")
def skin(runs):
    glb = textured(PATTERN, JOINTS_0=([(0, 1, 0, 0)] * VERTICES, "B"), WEIGHTS_0=([(0.75, 0.25, 0, 0)] * VERTICES, "f"))
    glb.json["nodes"] += [{"children": [2]}, {"translation": [0, 0, 0]}]
    glb.json["nodes"][0]["skin"] = 0
    matrices = [(1.0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x, 8, 7, 1) for x in (9, 6)]
    glb.add("skins", {"joints": [1, 2], "inverseBindMatrices": glb.accessor(matrices)})
    glb.json["scenes"][0]["nodes"].append(1)
    expect_no_warning(runs, write(runs, glb))
    for gltf in three(runs):
        skin, = gltf.json["skins"]
        expect(skin["joints"] == [1, 2] and gltf.accessor(skin["inverseBindMatrices"]) == matrices, "the skin")
        weights = gltf.attribute("WEIGHTS_0")
        expect(all(abs(w[0] / sum(w) - 0.75) < 0.01 for w in weights), "the weights")
    # Joints 0, 1 and 1 in the first set, 1 and 0 in the second one: joint 1 has three quarters.
    primitive_of(glb)["attributes"].update(
        JOINTS_0=glb.accessor([(0, 1, 1, 0)] * VERTICES, "B"), WEIGHTS_0=glb.accessor([(0.125, 0.25, 0.25, 0)] * VERTICES),
        JOINTS_1=glb.accessor([(1, 0, 0, 0)] * VERTICES, "B"), WEIGHTS_1=glb.accessor([(0.25, 0.125, 0, 0)] * VERTICES))
    expect_no_warning(runs, write(runs, glb))
    for gltf in three(runs):
        weights, joints = gltf.attribute("WEIGHTS_0"), gltf.attribute("JOINTS_0")
        expect(all(abs(w[0] - 0.75) < 0.01 and j[0] == 1 for w, j in zip(weights, joints)), "the weights of both sets")


@row("further colours")
def further(runs):
    write(runs, gltf_grid(RED, COLOR_1=([(1, 1, 1, 1)] * VERTICES, "f")))
    warnings = runs.info("a.glb")["warnings"]
    expect(warns(warnings, "COLOR_1 was left out"), "a warning with the name")
    expect(runs.is_strict("a.glb"), "an error with --strict")
    for gltf in three(runs):
        expect("COLOR_1" not in gltf.primitive()["attributes"] and gltf.warns("COLOR_1"), "left out")


@row("`targets`, `weights`")
def targets(runs):
    glb = textured(PATTERN)
    primitive_of(glb)["targets"] = [{"POSITION": glb.accessor([(0, 0, p[0]) for p in grid()[0]])}]
    glb.json["meshes"][0]["weights"] = [0.25]
    expect_no_warning(runs, write(runs, glb))
    for gltf in three(runs):
        expect(gltf.json["meshes"][0]["weights"] == [0.25], "the weights")
        moves = gltf.accessor(gltf.primitive()["targets"][0]["POSITION"])
        expect(all(abs(m[2] - p[0]) < 0.02 for m, p in zip(moves, gltf.attribute("POSITION"))), "the displacements")


@row("attributes with an underscore")
def custom(runs):
    number = [(i // 9) * 100 for i in range(VERTICES)]
    glb = textured(PATTERN, _BATCHID=([float(n) for n in number], "f"), _HEAT=([p[0] for p in grid()[0]], "f"),
                   _COUNT=(number, "I"))
    expect_no_warning(runs, write(runs, glb))
    for gltf in three(runs):
        for name in ("_BATCHID", "_COUNT"):
            expect({v[0] for v in gltf.attribute(name)} <= set(number), f"numbers of {name} from vertices")
        expect(all(abs(v[0] - p[0]) < 0.02 for v, p in zip(gltf.attribute("_HEAT"), gltf.attribute("POSITION"))),
               "interpolated")
    matrix = glb.accessor([(1.0,) * 16] * VERTICES)
    primitive_of(glb)["attributes"]["_M"] = matrix
    write(runs, glb)
    expect(warns(runs.info("a.glb")["warnings"], "_M was left out"), "a warning of matrices")
    expect(runs.is_strict("a.glb"), "an error with --strict")


@row("`materials`")
def materials(runs):
    glb = textured((128, 128, 128, 255),
                   material={"emissiveFactor": [0.5, 0, 0], "alphaMode": "MASK", "alphaCutoff": 0.25,
                                                   "doubleSided": True, "extras": {"a": 1}})
    glb.json["materials"][0]["pbrMetallicRoughness"].update(baseColorFactor=[1, 0.5, 1, 1], roughnessFactor=0.5)
    glb.json["materials"][0]["occlusionTexture"] = {"index": glb.texture(PATTERN), "strength": 0.5}
    write(runs, glb)
    whole, kept, baked = three(runs)
    for gltf in (whole, kept):
        material = gltf.material()
        expect(material["occlusionTexture"]["strength"] == 0.5 and gltf.factor() == [1, 0.5, 1, 1],
               "factors and textures")
        expect(len(gltf.list("images")) == 2, "both images")
    expect("occlusionTexture" in baked.material() and len(baked.list("images")) == 1, "a new image where pixels differ")
    expect(abs(baked.factor()[1] - 0.108) < 0.01, "the colour as a factor where they are equal")
    for gltf in (whole, kept, baked):
        material = gltf.material()
        expect(material["alphaMode"] == "MASK" and material["alphaCutoff"] == 0.25 and material["doubleSided"],
               "alpha and sides")
        expect(material["extras"] == {"a": 1} and material["name"] == "m", "extras and name")
        expect(material["pbrMetallicRoughness"]["roughnessFactor"] == 0.5
               and material["emissiveFactor"] == [0.5, 0, 0], "factors")


@row("textures of material extensions")
def extension_textures(runs):
    glb = textured(PATTERN)
    extensions = {"KHR_materials_sheen": {"sheenColorFactor": [1, 1, 1],
                                          "sheenColorTexture": {"index": glb.texture(TURNED)}},
                  "KHR_materials_anisotropy": {"anisotropyStrength": 0.5},
                  "EXT_other": {"otherTexture": {"index": 0}, "otherFactor": 0.5}}
    glb.json["materials"][0]["extensions"] = extensions
    write(runs, glb, extensions)
    whole, kept, baked = three(runs)
    for gltf in (whole, kept):
        expect(set(gltf.material()["extensions"]) == set(extensions), "kept")
        expect("otherTexture" in gltf.material()["extensions"]["EXT_other"], "kept with textures")
    left = baked.material()["extensions"]
    expect("sheenColorTexture" in left["KHR_materials_sheen"] and len(baked.list("images")) == 2, "baked")
    expect("KHR_materials_anisotropy" not in left and baked.warns("KHR_materials_anisotropy"), "directions left out")
    expect(left["EXT_other"] == {"otherFactor": 0.5} and baked.warns("textures of EXT_other"),
           "unknown textures left out")


@row("KHR_texture_transform")
def transform(runs):
    transforms = {"KHR_texture_transform": {"offset": [0.5, 0], "scale": [2, 2]}}
    write(runs, textured(PATTERN, {"extensions": transforms}), transforms)
    whole, kept, baked = three(runs)
    texture = [g.material()["pbrMetallicRoughness"]["baseColorTexture"] for g in (whole, kept, baked)]
    expect(texture[0]["extensions"] == texture[1]["extensions"] == transforms, "kept")
    expect("extensions" not in texture[2], "applied to a new page")


@row("KHR_materials_variants")
def variants(runs):
    glb = textured(PATTERN)
    glb.add("materials", {"name": "other", **RED})
    glb.json["extensions"] = {"KHR_materials_variants": {"variants": [{"name": "v"}]}}
    primitive_of(glb)["extensions"] = {"KHR_materials_variants": {"mappings": [{"material": 1, "variants": [0]}]}}
    expect_no_warning(runs, write(runs, glb, ["KHR_materials_variants"]))
    for gltf in (runs.whole("a.glb"), runs.kept("a.glb"), runs.simplify("a.glb", "--ratio", 0.5)):
        mapping, = gltf.primitive()["extensions"]["KHR_materials_variants"]["mappings"]
        expect(gltf.json["materials"][mapping["material"]]["name"] == "red", "kept by default")
    baked = runs.baked("a.glb")
    expect("extensions" not in baked.json and baked.warns("variants do not fit the new material"),
           "left out with a new texture")


@row("KHR_animation_pointer")
def animation_pointer(runs):
    glb = textured(PATTERN, {"extensions": {"KHR_texture_transform": {"offset": [0, 0]}}})
    pointer = "/materials/0/pbrMetallicRoughness/baseColorTexture/extensions/KHR_texture_transform/offset"
    sampler = {"input": glb.accessor([0.0, 1.0]), "output": glb.accessor([(0.0, 0.0), (1.0, 0.0)])}
    target = {"path": "pointer", "extensions": {"KHR_animation_pointer": {"pointer": pointer}}}
    glb.add("animations", {"samplers": [sampler], "channels": [{"sampler": 0, "target": target}]})
    write(runs, glb, ["KHR_animation_pointer", "KHR_texture_transform"])
    for gltf in (runs.whole("a.glb"), runs.kept("a.glb"), runs.simplify("a.glb", "--ratio", 0.5)):
        channel, = gltf.json["animations"][0]["channels"]
        expect(channel["target"]["extensions"]["KHR_animation_pointer"]["pointer"] == pointer, "kept by default")
        expect("KHR_texture_transform" in gltf.material()["pbrMetallicRoughness"]["baseColorTexture"]["extensions"],
               "its target")
    baked = runs.baked("a.glb")
    expect("animations" not in baked.json and baked.warns("animation ''"), "left out with a new texture")


@row("`samplers` without a filter (NEAREST)")
def nearest(runs):
    glb = textured(png(lambda x, y: (40 * x, 20 * y, 100, 255), size=6))
    glb.json["textures"][0]["sampler"] = glb.add("samplers", {"magFilter": 9728, "minFilter": 9728})
    write(runs, glb)
    for gltf in (runs.whole("a.glb"), runs.kept("a.glb"), runs.simplify("a.glb", "--ratio", 0.5)):
        sampler = gltf.json["samplers"][gltf.json["textures"][0]["sampler"]]
        expect(sampler == {"magFilter": 9728, "minFilter": 9728}, "no filter")
        expect(gltf.attribute("TEXCOORD_0") is not None, "its own UVs")


@row("EXT_texture_webp, KHR_texture_basisu, EXT_texture_avif, MSFT_texture_dds")
def image_extensions(runs):
    files = {"KHR_texture_basisu": (b"\xabKTX 20\xbb\r\n\x1a\n and more", "image/ktx2"),
             "EXT_texture_avif": (b"\0\0\0\x1cftypavif and more", "image/avif"),
             "MSFT_texture_dds": (b"DDS | and much more", "image/vnd-ms.dds")}
    for name, (data, mime) in files.items():
        for is_core in (False, True):
            glb = textured(PATTERN)
            image = glb.add("images", {"bufferView": glb.view(data), "mimeType": mime})
            glb.json["textures"] = [{"source": image} if is_core else {"extensions": {name: {"source": image}}}]
            write(runs, glb, [name])
            expect(bool(runs.info("a.glb")["warnings"]) == is_core, "a warning of a core source")
            for gltf in three(runs):
                expect(gltf.json["textures"][0]["extensions"] == {name: {"source": 0}}, f"{name}: kept")
                view = gltf.json["bufferViews"][gltf.json["images"][0]["bufferView"]]
                expect(gltf.buffer[view["byteOffset"]:][:len(data)] == data, f"{name}: its bytes")
            expect(gltf.warns("cannot be baked"), "a warning instead of a new texture")
            for command in (("compare", "a.glb", "a.glb", "--samples", 10), ("render", "a.glb", "a.png", "--force"),
                            ("report", "a.glb", "a.glb", "-o", "a.html", "--force", "--samples", 10)):
                done = runs.run(*command)
                expect(done.returncode == 0 and b"not supported" in done.stderr, f"{command[0]}: a warning: {done.stderr}")
    write(runs, textured(png(lambda x, y: (x * 3 % 256, y * 5 % 256, (x * y) % 256, 255), size=64)))
    webp = runs.baked("a.glb", "--image-format", "webp")
    expect("EXT_texture_webp" in webp.json["textures"][0]["extensions"], "a WebP texture")
    expect_no_warning(runs, runs.write("a.glb", runs.read("out.glb")))
    expect(runs.info("a.glb")["images"][0].get("width"), "decoded")
    expect(len(runs.baked("a.glb").list("images")) == 1, "baked")


@row("materials, textures and images that no mesh uses")
def unused(runs):
    glb = textured(PATTERN)
    glb.add("materials", {"name": "unused"})
    glb.texture(png((1, 2, 3, 255)))
    glb.accessor([1.0] * 1000)
    glb.add("meshes", dict(glb.json["meshes"][0], name="hidden"))
    expect_no_warning(runs, write(runs, glb))
    for gltf in three(runs):
        expect(all(a["count"] < 1000 for a in gltf.list("accessors")), "accessors are not written")
        expect(len(gltf.list("materials")) == len(gltf.list("images")) == len(gltf.list("textures")) == 1,
               "not written")
        expect(gltf.warns("1 material and 1 image that no mesh uses: left out"), "a warning counts them")
        expect([m["name"] for m in gltf.list("meshes")] == ["sheet", "hidden"], "meshes that no node shows")
    expect(not runs.is_strict("a.glb"), "accepted by --strict")
