"""Checks of the rows about material libraries."""
from model import expect, expect_no_warning, expect_repair, grid, png, rows_of

ROWS = {}
row = rows_of(ROWS, "MTL")
GREY, WHITE, BLACK = (128, 128, 128, 255), (255, 255, 255, 255), (0, 0, 0, 255)


def write_obj(runs, library, images=None):
    """Writes the grid as a.obj with material `m` of the statements, and images by name: a pixel or bytes of a file."""
    positions, uvs, triangles = grid()
    lines = ["mtllib a.mtl", "usemtl m"] + ["v %.6f %.6f %.6f" % p for p in positions]
    lines += ["vt %.6f %.6f" % uv for uv in uvs]
    lines += ["f " + " ".join(f"{i + 1}/{i + 1}" for i in t) for t in triangles]
    runs.write("a.obj", "\n".join(lines) + "\n")
    runs.write("a.mtl", f"newmtl m\n{library}\n")
    for name, image in (images or {}).items():
        runs.write(name, image if isinstance(image, bytes) else png(image))
    return "a.obj"


def both(runs, name):
    """The file as it was read, and with a new texture."""
    return runs.whole(name), runs.baked(name)


def pbr(gltf):
    return gltf.material().get("pbrMetallicRoughness", {})


@row("`Kd`, `map_Kd`")
def base_color(runs):
    for gltf in both(runs, write_obj(runs, "Kd 0.8 0.2 0")):
        expect(gltf.has_color((0.8, 0.2, 0, 1)), "Kd as the colour factor")
    write_obj(runs, "Kd 1 0.5 0.5\nmap_Kd c.png", {"c.png": GREY})
    whole, baked = both(runs, "a.obj")
    expect("baseColorTexture" in pbr(whole) and whole.has_color((1, 0.5, 0.5, 1)), "a texture and its factor")
    expect(abs(baked.factor()[0] - 0.2158) < 0.01 and abs(baked.factor()[1] - 0.0462) < 0.01, "their product, baked")
    expect_no_warning(runs, write_obj(runs, "Kd 0 0 0"))
    expect_repair(runs, write_obj(runs, "Kd 0 0 0\nmap_Kd c.png", {"c.png": GREY}), "Kd 0 0 0 with a map_Kd")
    expect(runs.baked("a.obj").has_color((0.5, 0.5, 0.5, 1)), "the colour of the image")


@row("`map_Ka`")
def ambient_image(runs):
    expect_repair(runs, write_obj(runs, "map_Ka a.png", {"a.png": GREY}), "map_Ka")
    expect(runs.baked("a.obj").has_color((0.5, 0.5, 0.5, 1)), "the colour of the image")
    expect_no_warning(runs, write_obj(runs, "map_Ka a.png\nmap_Kd c.png", {"a.png": BLACK, "c.png": GREY}))
    expect(runs.info("a.obj")["not_understood"] == ["'map_Ka': 1 statement"], "`info` counts it")
    expect(runs.baked("a.obj").has_color((0.5, 0.5, 0.5, 1)), "the colour of map_Kd")


@row("`d`, or 1 - `Tr`")
def opacity(runs):
    for library in ("Kd 1 0 0\nd 0.25", "Kd 1 0 0\nTr 0.75"):
        for gltf in both(runs, write_obj(runs, library)):
            expect(gltf.material().get("alphaMode") == "BLEND", "mode blend")
            expect(gltf.has_color((1, 0, 0, 0.25)), "the alpha")
    for library in ("Kd 1 0 0\nd 0", "Kd 1 0 0\nTr 1", "Kd 1 0 0\nd -halo -1\nTr 0"):
        expect_repair(runs, write_obj(runs, library), "would hide everything")
        for gltf in both(runs, "a.obj"):
            expect("alphaMode" not in gltf.material() and gltf.has_color((1, 0, 0, 1)), "opaque")


@row("`map_d`")
def alpha_image(runs):
    color = (200, 100, 50, 255)
    for name, image in {"own": png((200, 100, 50, 128)), "other": png((9, 9, 9, 128)),
                        "grey": png((128,), kind=0)}.items():
        images = {"c.png": image if name == "own" else color, "m.png": image}
        write_obj(runs, "map_Kd c.png\nmap_d " + ("c.png" if name == "own" else "m.png"), images)
        expect_no_warning(runs, "a.obj")
        whole, baked = both(runs, "a.obj")
        expect(whole.material().get("alphaMode") == "BLEND", f"{name}: mode blend")
        expect(len(whole.list("images")) == 1, f"{name}: one image")
        expect(baked.has_color((200 / 255, 100 / 255, 50 / 255, 0.5)), f"{name}: colour and alpha")
    expect_no_warning(runs, write_obj(runs, "map_Kd c.png\nmap_d m.png", {"c.png": color, "m.png": WHITE}))
    expect("alphaMode" not in runs.whole("a.obj").material(), "white: opaque")
    for library, image in (("map_d m.png", (0, 0, 0, 0)), ("map_d m.png", BLACK), ("map_d -s 2 2 m.png", GREY),
                           ("map_d m.png", b"\x89PNG\r\n\x1a\nno"), ("map_d a.obj", GREY), ("map_d gone.png", GREY)):
        write_obj(runs, "map_Kd c.png\n" + library, {"c.png": color, "m.png": image})
        expect_repair(runs, "a.obj", "gone.png" if "gone" in library else "map_d")
        expect("alphaMode" not in runs.whole("a.obj").material(), "opaque without map_d")


@row("`Ke`, `map_Ke`")
def emissive(runs):
    for gltf in both(runs, write_obj(runs, "Ke 1 0 0.5")):
        expect([round(x, 2) for x in gltf.material()["emissiveFactor"]] == [1, 0, 0.21], "the emissive factor")
    write_obj(runs, "map_Ke e.png", {"e.png": GREY})
    whole, baked = both(runs, "a.obj")
    expect("emissiveTexture" in whole.material(), "an emissive texture")
    expect(abs(baked.material()["emissiveFactor"][0] - 0.2158) < 0.01, "baked")


@row("`Pr`, else `Ns`")
def roughness(runs):
    for library, value in (("Pr 0.3\nNs 10", 0.3), ("Ns 10", (2 / 12) ** 0.25), ("Ns 0", 1)):
        for gltf in both(runs, write_obj(runs, library)):
            expect(abs(pbr(gltf).get("roughnessFactor", 1) - value) < 1e-3, f"roughness {value}")


@row("`Pm`")
def metallic(runs):
    for library, value in (("Pm 0.5", 0.5), ("Kd 1 1 1", 0)):
        for gltf in both(runs, write_obj(runs, library)):
            expect(pbr(gltf)["metallicFactor"] == value, f"metallic {value}")


@row("`map_Pr`, `map_Pm`")
def roughness_metallic_images(runs):
    def values(library, images):
        write_obj(runs, "Pr 0.1\nPm 0.9\n" + library, images)
        whole, baked = both(runs, "a.obj")
        expect("metallicRoughnessTexture" in pbr(whole) and len(whole.list("images")) == 1, "one texture")
        return [round(pbr(baked).get(k, 1), 2) for k in ("roughnessFactor", "metallicFactor")]
    grey, dark = (128, 128, 128, 255), (51, 51, 51, 255)
    expect(values("map_Pr r.png\nmap_Pm m.png", {"r.png": grey, "m.png": dark}) == [0.5, 0.2], "both images")
    expect(values("map_Pr r.png\nmap_Pm r.png", {"r.png": (0, 128, 51, 255)}) == [0.5, 0.2], "green and blue")
    expect(values("map_Pr r.png", {"r.png": grey}) == [0.5, 0.9], "the factor beside an image")
    expect_no_warning(runs, "a.obj")
    write_obj(runs, "map_Pr r.png\nmap_Pm -s 2 2 m.png", {"r.png": grey, "m.png": dark})
    expect_repair(runs, "a.obj", "map_Pm left out")


NORMALS = png(lambda x, y: (128 + 20 * (x % 3 - 1), 128 + 20 * (y % 3 - 1), 250), size=9, kind=2)
HEIGHTS = png(lambda x, y: (x * 25,), size=8, kind=0)


@row("`norm`")
def normal_map(runs):
    write_obj(runs, "norm -bm 0.5 n.png", {"n.png": NORMALS})
    whole, baked = both(runs, "a.obj")
    expect(whole.material()["normalTexture"]["scale"] == 0.5, "the scale")
    expect("normalTexture" in baked.material(), "a baked normal map")
    expect_no_warning(runs, "a.obj")


@row("`bump`, `map_Bump`")
def bump(runs):
    for key in ("bump", "map_Bump"):
        write_obj(runs, f"{key} -bm 0.5 n.png", {"n.png": NORMALS})
        whole, baked = both(runs, "a.obj")
        expect(whole.material()["normalTexture"].get("scale") == 0.5, "a normal map with its scale")
        expect("normalTexture" in baked.material(), "baked")
        write_obj(runs, f"{key} -bm 0.5 h.png", {"h.png": HEIGHTS})
        whole = runs.whole("a.obj")
        expect("scale" not in whole.material()["normalTexture"], "a normal map made of heights")
        expect_no_warning(runs, "a.obj")
    write_obj(runs, "norm n.png\nbump h.png", {"n.png": NORMALS, "h.png": HEIGHTS})
    expect_repair(runs, "a.obj", "bump left out beside norm")


@row("`<UDIM>`, `%(UDIM)d`, `<UVTILE>` in file names")
def tiles(runs):
    images = {"c.1001.png": GREY, "c.1002.png": WHITE, "c.u1_v1.png": GREY, "c.u2_v1.png": WHITE}
    for mark in ("<UDIM>", "%(UDIM)d", "<UVTILE>"):
        expect_no_warning(runs, write_obj(runs, f"map_Kd -s 2 1 1 c.{mark}.png", images))
        whole = runs.whole("a.obj")
        expect([m["name"] for m in whole.list("materials")] == ["m.1001", "m.1002"], "a material for each tile")
        expect(len(whole.list("images")) == 2, "its image")
    write_obj(runs, "map_Kd -s 4 1 1 c.<UDIM>.png", images)
    expect_repair(runs, "a.obj", "material 'm.1003': texture left out")
    expect_repair(runs, write_obj(runs, "map_Kd -o -1 0 c.<UDIM>.png", images), "outside of the UDIM tiles")
    expect_repair(runs, write_obj(runs, "map_Kd -o 0.55 0 c.<UDIM>.png", images), "across borders of UDIM tiles")


@row("`-o`, `-s`, `-clamp`")
def placement(runs):
    write_obj(runs, "map_Kd -s 2 3 -o 0.25 0.5 -clamp on c.png", {"c.png": png(lambda x, y: (60 * x, 60 * y, 0, 255))})
    whole, baked = both(runs, "a.obj")
    transform = pbr(whole)["baseColorTexture"]["extensions"]["KHR_texture_transform"]
    expect(transform == {"offset": [0.25, -2.5], "scale": [2, 3]}, "a transform")
    expect(whole.list("samplers")[0]["wrapS"] == 33071, "clamping")
    expect("extensions" not in pbr(baked)["baseColorTexture"], "a new page without a transform")
    expect_no_warning(runs, "a.obj")


@row("`-imfchan`")
def channel(runs):
    write_obj(runs, "map_Kd c.png\nmap_d -imfchan b m.png\nmap_Pr -imfchan r m.png",
              {"c.png": GREY, "m.png": (51, 0, 128, 255)})
    baked = runs.baked("a.obj")
    expect(abs(baked.factor()[3] - 0.5) < 0.01 and abs(pbr(baked)["roughnessFactor"] - 0.2) < 0.01, "the channels")
    expect_no_warning(runs, "a.obj")


@row("`Ka`, `Ks`, `Ni`, `Tf`, `Km`, `illum`, `sharpness`, other texture options")
def without_meaning(runs):
    write_obj(runs,
              "Ka 1 1 1\nKs 1 1 1\nNi 1\nTf 1 1 1\nKm 0\nillum 2\nsharpness 60\n"
              "map_Kd -mm 0 1 -blendu on c.png", {"c.png": GREY})
    expect_no_warning(runs, "a.obj")
    expect(not runs.is_strict("a.obj"), "accepted by --strict")
    counted = [line.split(":")[0] for line in runs.info("a.obj")["not_understood"]]
    expect(counted == ["'Ka'", "'Km'", "'Ks'", "'Ni'", "'Tf'", "'illum'", "'sharpness'", "option '-blendu'",
                       "option '-mm'"],
           "`info` counts them")
    expect(runs.baked("a.obj").has_color((0.5, 0.5, 0.5, 1)), "the colour")


@row("other statements (`disp`, `map_Ks` ...)")
def other_statements(runs):
    write_obj(runs, "Kd 1 0 0\ndisp d.png\nmap_Ks s.png\naniso 1", {"d.png": GREY, "s.png": GREY})
    for key in ("disp", "map_Ks", "aniso"):
        expect_repair(runs, "a.obj", f"'{key}' is not supported")


@row("values outside 0 to 1")
def clamped(runs):
    expect_repair(runs, write_obj(runs, "Kd 2 0 0"), "clamped")
    expect(runs.whole("a.obj").factor() == [1, 0, 0, 1], "the clamped colour")


@row("a missing file, or one that is not in the folder")
def missing_file(runs):
    expect_repair(runs, write_obj(runs, "Kd 1 0 0\nmap_Kd gone.png"), "gone.png")
    runs.write("../outside.png", png(GREY))
    expect_repair(runs, write_obj(runs, "Kd 1 0 0\nmap_Kd ../outside.png"), "outside.png")
    expect_repair(runs, write_obj(runs, "Kd 1 1 1\nmap_Kd C:\\job\\C.PNG", {"c.png": GREY}), "c.png")
    expect(runs.baked("a.obj").has_color((0.5, 0.5, 0.5, 1)), "the file beside the model")
