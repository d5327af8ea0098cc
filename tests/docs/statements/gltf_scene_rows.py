"""Checks of the rows about scenes, compression and extensions of glTF."""
from gltf_rows import PATTERN, RED, VERTICES, primitive_of, textured, three, write
from model import expect, expect_no_warning, gltf_grid, grid, png, rows_of, warns

ROWS = {}
row = rows_of(ROWS, "glTF")


@row("nodes, scenes, cameras, lights, `extras`, names")
def scene(runs):
    glb = gltf_grid(RED)
    glb.json["nodes"] += [{"name": "eye", "camera": 0, "extras": {"a": [1, "b"]}, "translation": [1, 2, 3]},
                          {"extensions": {"KHR_lights_punctual": {"light": 0}}}]
    glb.json["nodes"][0].update(children=[1, 2], matrix=[2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1])
    glb.add("cameras", {"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}})
    glb.json["extensions"] = {"KHR_lights_punctual": {"lights": [{"type": "point", "intensity": 5}]},
                              "KHR_xmp_json_ld": {"packets": [{"dc:title": "t"}]}}
    glb.json["asset"].update(copyright="c", extras={"x": 1234567890123456789}, generator="someone")
    glb.json["scenes"].append({"name": "empty", "extras": 7})
    glb.json["meshes"][0]["extras"] = {"kept": True}
    expect_no_warning(runs, write(runs, glb, ["KHR_lights_punctual", "KHR_xmp_json_ld", "KHR_materials_sheen"]))
    for gltf in three(runs):
        for key in ("nodes", "scenes", "cameras", "extensions"):
            expect(gltf.json[key] == glb.json[key], f"the same {key}")
        expect(gltf.json["extensionsUsed"] == ["KHR_lights_punctual", "KHR_xmp_json_ld"], "extensions in use")
        expect(gltf.json["meshes"][0]["extras"] == {"kept": True}, "the extras of the mesh")
        asset = gltf.json["asset"]
        expect(asset["copyright"] == "c" and asset["extras"] == {"x": 1234567890123456789}, "the copyright")
        expect(asset["generator"].startswith("faqem "), "the generator")


@row("`animations`")
def animations(runs):
    glb = textured(PATTERN)
    primitive_of(glb)["targets"] = [{"POSITION": glb.accessor([(0, 0, p[0]) for p in grid()[0]])}]
    times = glb.accessor([0.0, 1.0])
    moves = glb.accessor([(0.0, 0.0, 0.0), (0.0, 0.0, 0.0)])
    glb.json["accessors"][moves]["sparse"] = {
        "count": 1, "indices": {"bufferView": glb.view(b"\1\0\0\0"), "componentType": 5121},
        "values": {"bufferView": glb.view(bytes.fromhex("0000803f0000000000000000"))}}
    samplers = [{"input": times, "output": moves, "interpolation": "STEP"},
                {"input": times, "output": glb.accessor([0.0, 1.0])}]
    channels = [{"sampler": i, "target": {"node": 0, "path": path}}
                for i, path in enumerate(("translation", "weights"))]
    glb.add("animations", {"name": "move", "samplers": samplers, "channels": channels})
    expect_no_warning(runs, write(runs, glb))
    for gltf in three(runs):
        animation, = gltf.json["animations"]
        expect(animation["channels"] == channels and animation["name"] == "move", "the channels")
        expect(gltf.accessor(animation["samplers"][0]["output"]) == [(0, 0, 0), (1, 0, 0)], "the values, also sparse ones")
        expect(animation["samplers"][0]["interpolation"] == "STEP", "the interpolation")
        expect(gltf.json["accessors"][animation["samplers"][0]["input"]]["min"] == [0], "the least time")
    done = runs.run("lod", "a.glb", "levels.glb", "--levels", "0.5,0.25", "--force", "--quiet")
    expect(done.returncode == 0, done.stderr.decode())
    levels = type(gltf)(runs.read("levels.glb"), {"warnings": []})
    paths = [c["target"]["path"] for c in levels.json["animations"][0]["channels"]]
    expect(paths.count("weights") == 3, "a channel of the weights for each level")


@row("EXT_mesh_gpu_instancing")
def instancing(runs):
    glb = gltf_grid(RED)
    moves = [(0.0, 0.0, 0.0), (2.0, 0.0, 0.0), (4.0, 0.0, 0.0)]
    attributes = {"TRANSLATION": glb.accessor(moves)}
    glb.json["nodes"][0]["extensions"] = {"EXT_mesh_gpu_instancing": {"attributes": attributes}}
    glb.json["extensionsRequired"] = ["EXT_mesh_gpu_instancing"]
    write(runs, glb, ["EXT_mesh_gpu_instancing"])
    expect(runs.info("a.glb")["instances"] == 3, "three instances")
    for gltf in three(runs):
        kept = gltf.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]
        expect(gltf.accessor(kept["TRANSLATION"]) == moves, "kept")
    for out in ("out.obj", "out.ply", "out.stl"):
        runs.simplify("a.glb", "--ratio", 0.5, out=out)
        expect(runs.info(out)["total"]["components"] == 3, "every instance")
    glb.json["accessors"][-1]["count"] = 2
    attributes["SCALE"] = glb.accessor(moves)
    write(runs, glb)
    expect(runs.run("info", "a.glb").returncode == 3, "code 3 for counts that differ")


@row("VRM, VRMC_*")
def numbers(runs):
    glb = textured(PATTERN)
    pictures = [0] + [glb.texture(png((shade, 0, 0, 255))) for shade in (10, 20)]
    glb.add("materials", {"name": "unused"})
    for name in ("VRM", "VRMC_vrm"):
        glb.json["extensions"] = {name: {"meta": {"texture": 2}, "materials": [1, 0]}}
        expect_no_warning(runs, write(runs, glb, [name]))
        runs.results.clear()
        for gltf in three(runs):
            expect(gltf.json["extensions"] == glb.json["extensions"], "kept")
            sources = [t.get("source") for t in gltf.json["textures"]]
            expect(sources[:3] == pictures and len(gltf.json["images"]) >= 3, "the textures and images")
            expect([m["name"] for m in gltf.json["materials"]][:2] == ["m", "unused"], "the materials")
        plain = runs.simplify("a.glb", "--ratio", 0.5)
        expect(plain.attribute("TEXCOORD_0") is not None and len(plain.json["materials"]) == 2, "no page by default")


@row("CESIUM_RTC")
def center(runs):
    glb = gltf_grid(RED)
    glb.json["extensions"] = {"CESIUM_RTC": {"center": [1000, 2000, 3000]}}
    glb.json["extensionsRequired"] = ["CESIUM_RTC"]
    expect_no_warning(runs, write(runs, glb, ["CESIUM_RTC"]))
    for gltf in three(runs):
        expect(gltf.json["extensions"] == glb.json["extensions"], "kept")
    # The grid, from 0 to 1 along x and y and bumpy along z, stands upright.
    for out in ("out.obj", "out.ply", "out.stl"):
        runs.simplify("a.glb", "--ratio", 0.5, out=out)
        total = runs.info(out)["total"]
        corners = zip(total["box_min"] + total["box_max"], (1000, 2000, 3000, 1001, 2000, 3001))
        expect(all(abs(a - b) < 0.1 for a, b in corners), out)


def numbered():
    """The grid with extensions that refer to vertices, triangles and features."""
    glb = textured(PATTERN, _FEATURE_ID_0=([float(i // 9) for i in range(VERTICES)], "f"))
    primitive, mesh = primitive_of(glb), glb.json["meshes"][0]
    edges = glb.accessor([0, 1, 1, 2], "H")
    primitive["extensions"] = {"CESIUM_primitive_outline": {"indices": edges}, "FB_ngon_encoding": {}}
    mesh["extensions"] = {"EXT_mesh_manifold": {
        "manifoldPrimitive": {"indices": primitive["indices"],
                              "attributes": {"POSITION": primitive["attributes"]["POSITION"]}},
        "mergeIndices": glb.accessor([0, 1], "H"), "mergeValues": glb.accessor([0, 1], "H")}}
    return glb


NUMBERED = ("CESIUM_primitive_outline", "FB_ngon_encoding", "EXT_mesh_manifold")


@row("CESIUM_primitive_outline, EXT_mesh_manifold, FB_ngon_encoding")
def index_extensions(runs):
    expect_no_warning(runs, write(runs, numbered(), NUMBERED))
    whole, kept, baked = three(runs)
    outline = whole.primitive()["extensions"]["CESIUM_primitive_outline"]["indices"]
    expect(whole.accessor(outline) == [(0,), (1,), (1,), (2,)], "the outline")
    expect(sorted(whole.json["extensionsUsed"]) == sorted(NUMBERED), "all of them where nothing changed")
    expect("EXT_mesh_manifold" in whole.json["meshes"][0]["extensions"], "the manifold")
    for gltf in (kept, baked):
        expect("extensionsUsed" not in gltf.json, "left out where triangles changed")
        expect(all(gltf.warns(name) for name in NUMBERED), "with a warning")


@row("EXT_mesh_features")
def features(runs):
    glb = numbered()
    del glb.json["meshes"][0]["extensions"]
    texture = {"channels": [0], "index": 0, "texCoord": 0}
    ids = [{"featureCount": 9, "attribute": 0}, {"featureCount": 9, "texture": texture}, {"featureCount": VERTICES}]
    primitive_of(glb)["extensions"] = {"EXT_mesh_features": {"featureIds": ids}}
    expect_no_warning(runs, write(runs, glb, ["EXT_mesh_features"]))

    def kinds(gltf):
        left = gltf.primitive().get("extensions", {}).get("EXT_mesh_features", {}).get("featureIds", [])
        return ["attribute" if "attribute" in f else "texture" if "texture" in f else "vertices" for f in left]
    whole, kept, baked = three(runs)
    expect(kinds(whole) == ["attribute", "texture", "vertices"], "all where nothing changed")
    expect(kinds(kept) == ["attribute", "texture"] and kept.warns("feature ids that"), "without numbers of vertices")
    expect(kinds(baked) == ["attribute"] and baked.warns("feature ids that"), "only attributes with new UVs")


@row("EXT_structural_metadata")
def metadata(runs):
    glb = numbered()
    del glb.json["meshes"][0]["extensions"]
    values = glb.view(b"\1\0\0\0\2\0\0\0")
    schema = {"id": "s", "classes": {"c": {"properties": {"p": {"type": "SCALAR", "componentType": "UINT32"}}}}}
    property_texture = {"class": "c", "properties": {"p": {"index": 0, "texCoord": 0, "channels": [0]}}}
    glb.json["extensions"] = {"EXT_structural_metadata": {
        "schema": schema, "propertyTables": [{"class": "c", "count": 2, "properties": {"p": {"values": values}}}],
        "propertyTextures": [property_texture]}}
    primitive_of(glb)["extensions"] = {"EXT_structural_metadata": {"propertyTextures": [0]}}
    expect_no_warning(runs, write(runs, glb, ["EXT_structural_metadata"]))
    whole, kept, baked = three(runs)
    for gltf in (whole, kept, baked):
        table, = gltf.json["extensions"]["EXT_structural_metadata"]["propertyTables"]
        view = gltf.json["bufferViews"][table["properties"]["p"]["values"]]
        expect(gltf.buffer[view["byteOffset"]:][:8] == b"\1\0\0\0\2\0\0\0", "the values of the table")
    for gltf in (whole, kept):
        expect("EXT_structural_metadata" in gltf.primitive()["extensions"], "the texture with its UVs")
    expect("extensions" not in baked.primitive() and baked.warns("EXT_structural_metadata"), "left out with new UVs")


@row("MSFT_lod")
def levels_of_detail(runs):
    glb = textured(PATTERN)
    fine = primitive_of(glb)
    positions, uvs, triangles = grid(4)
    glb.add("meshes", {"primitives": [{
        "attributes": {"POSITION": glb.accessor(positions), "TEXCOORD_0": glb.accessor(uvs)},
        "indices": glb.accessor([i for t in triangles for i in t], "I"), "material": 1}]})
    for name in ("coarse", "far"):
        glb.add("materials", {"name": name})
    glb.json["nodes"] += [{"name": "coarse", "mesh": 1}, {"name": "coarsest"}]
    glb.json["nodes"][0]["extensions"] = {"MSFT_lod": {"ids": [1, 2]}}
    glb.json["nodes"][0]["extras"] = {"MSFT_screencoverage": [0.5, 0.1, 0]}
    glb.json["materials"][fine["material"]]["extensions"] = {"MSFT_lod": {"ids": [2]}}
    glb.json["extensionsRequired"] = ["MSFT_lod"]
    expect_no_warning(runs, write(runs, glb, ["MSFT_lod"]))
    expect([p["faces"] for p in runs.info("a.glb")["parts"]] == [128, 32], "`info` lists all")
    for gltf in three(runs):
        expect(gltf.warns("2 coarser levels of 1 node and 1 coarser level of 1 material"), "a warning counts them")
        expect(len(gltf.json["meshes"]) == len(gltf.json["nodes"]) == len(gltf.json["materials"]) == 1, "one level")
        expect("extensionsUsed" not in gltf.json and "extras" not in gltf.json["nodes"][0], "no trace of levels")
    expect(runs.is_strict("a.glb"), "--strict")
    done = runs.run("lod", "a.glb", "levels.glb", "--levels", "0.5,0.25,0.1", "--force", "--quiet")
    expect(done.returncode == 0, done.stderr.decode())
    levels = type(gltf)(runs.read("levels.glb"), {"warnings": []})
    expect(levels.json["nodes"][0]["extensions"]["MSFT_lod"]["ids"] == [1, 2, 3], "`lod` writes new ones")
    expect(len(levels.json["meshes"]) == 4, "of the finest level")
    glb.json["nodes"][0]["extensions"]["MSFT_lod"]["ids"] = [9]
    write(runs, glb)
    expect(runs.run("info", "a.glb").returncode == 3, "code 3 for a level that does not exist")


@row("other extensions")
def unknown(runs):
    glb = gltf_grid(RED)
    primitive_of(glb)["extensions"] = {"EXT_of_primitive": {"a": 1}}
    glb.json["nodes"][0]["extensions"] = {"EXT_of_node": {"a": 1}}
    glb.json["extensions"] = {"EXT_of_document": {"a": "b"}}
    names = ["EXT_of_primitive", "EXT_of_node", "EXT_of_document"]
    expect_no_warning(runs, write(runs, glb, names))
    expect(runs.info("a.glb")["not_understood"] == [f"extension {n}" for n in sorted(names)], "`info` names them")
    whole, kept, baked = three(runs)
    expect(whole.primitive()["extensions"] == {"EXT_of_primitive": {"a": 1}}, "kept where nothing changed")
    for gltf in (kept, baked):
        expect("extensions" not in gltf.primitive() and gltf.warns("EXT_of_primitive is not known"),
               "left out with a warning")
        expect(gltf.json["extensionsUsed"] == ["EXT_of_document", "EXT_of_node"], "others stay")
        expect(gltf.warns("EXT_of_node is unknown") and not gltf.warns("EXT_of_document"), "a warning of numbers")
    glb.json["extensionsRequired"] = names[:1]
    write(runs, glb)
    expect(runs.run("info", "a.glb").returncode == 4, "code 4 if it is required")


@row("KHR_draco_mesh_compression, EXT_meshopt_compression, KHR_mesh_quantization")
def compression(runs):
    write(runs, textured(PATTERN))
    for name, options in {"KHR_draco_mesh_compression": ("--compress", "draco"),
                          "EXT_meshopt_compression": ("--compress", "meshopt"),
                          "KHR_mesh_quantization": ("--quantize", "on")}.items():
        packed = runs.simplify("a.glb", "--ratio", 0.9, *options, out="packed.glb")
        if warns(packed.warnings, "faqem was built without"):
            continue
        expect(name in packed.json["extensionsRequired"], f"{name}: written")
        expect(not runs.info("packed.glb")["warnings"], f"{name}: read")
        for gltf in (runs.kept("packed.glb"), runs.baked("packed.glb")):
            expect(name in gltf.json["extensionsRequired"], f"{name}: written again")
        plain = runs.kept("packed.glb", "--compress", "none", "--quantize", "off")
        expect("extensionsRequired" not in plain.json, f"{name}: left out on request")
