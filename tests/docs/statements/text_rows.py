"""Checks of the rows about OBJ, PLY, STL and OFF."""
import struct

from model import expect, expect_no_warning, expect_repair, grid, png, rows_of
from mtl_rows import GREY

ROWS = {}
row = rows_of(ROWS)


def halves():
    """The grid: positions, uvs and the triangles of its lower and of its upper half."""
    positions, uvs, triangles = grid()
    middle = len(triangles) // 2
    return positions, uvs, triangles[:middle], triangles[middle:]


def obj_faces(triangles):
    return "".join("f %d %d %d\n" % tuple(i + 1 for i in t) for t in triangles)


def obj_vertices(suffix=""):
    return "".join("v %.6f %.6f %.6f" % p + suffix + "\n" for p in grid()[0])


def open_edges(runs, name):
    return runs.info(name)["total"]["boundary_edges"]


@row("OBJ", "`o`")
def objects(runs):
    _, _, low, high = halves()
    runs.write("a.obj", "o low\n" + obj_vertices() + obj_faces(low) + "o high\n" + obj_faces(high))
    for gltf in (runs.whole("a.obj"), runs.baked("a.obj"), runs.kept("a.obj")):
        expect([m["name"] for m in gltf.list("meshes")] == ["low", "high"], "a mesh for each object")
        expect([n["name"] for n in gltf.list("nodes")] == ["low", "high"], "a node for each object")
    expect(runs.info("a.obj")["parts"][0]["components"] == 1, "one part")
    report = runs.simplify("a.obj", "--ratio", 0.5, out="out.obj")
    text = runs.read("out.obj").decode()
    expect("\no low\n" in text and "\no high\n" in text, "objects in OBJ")
    expect(open_edges(runs, "out.obj") <= 32 and report["faces_out"] == 64, "no open edge between the objects")


@row("OBJ", "`g`")
def groups(runs):
    _, _, low, high = halves()
    runs.write("a.obj", obj_vertices() + "g low part\n" + obj_faces(low) + "g high\n" + obj_faces(high))
    expect_no_warning(runs, "a.obj")
    expect(not runs.info("a.obj")["not_understood"] and not runs.is_strict("a.obj"), "understood")
    for gltf in (runs.whole("a.obj"), runs.baked("a.obj"), runs.kept("a.obj")):
        expect(gltf.primitive()["extras"] == {"groups": ["low part", "high"]}, "one primitive with the names")
    for options in (("--ratio", 0.5), ("--ratio", 0.1), ("--ratio", 0.5, "--bake", "none"), ("--ratio", 1)):
        report = runs.simplify("a.obj", *options, out="out.obj")
        text = runs.read("out.obj").decode()
        expect("\ng low part\nf " in text and "\ng high\nf " in text and text.count("\ng ") == 2, "groups in OBJ")
        expect(runs.info("out.obj")["total"]["components"] == 1, "no open edge between the groups")
        expect(open_edges(runs, "out.obj") <= 32 and not report["warnings"], "no open edge between the groups")
    runs.write("b.obj", obj_vertices() + "o a\n" + obj_faces(low) + "o b\ng x\n" + obj_faces(high))
    runs.simplify("b.obj", "--ratio", 0.5, out="out.obj")
    expect("\no a\nf " in runs.read("out.obj").decode() and "\no b\ng x\nf " in runs.read("out.obj").decode(),
           "groups of objects")
    middle = "".join(f"g {i}\n" + obj_faces([t]) for i, t in enumerate(low * 5))
    runs.write("d.obj", obj_vertices() + middle)
    many = runs.whole("d.obj")
    expect("extras" not in many.primitive() and many.warns("the names of 320 groups"), "not more than 256 names")
    runs.write("c.obj", obj_vertices() + "g default\n" + obj_faces(low) + "g low\n" + obj_faces(high))
    expect("extras" not in runs.whole("c.obj").primitive(), "no extras for one group")


@row("OBJ", "`s`")
def smoothing_groups(runs):
    _, _, low, high = halves()
    runs.write("a.obj", obj_vertices() + "s 1\n" + obj_faces(low) + "s off\n" + obj_faces(high))
    expect_no_warning(runs, "a.obj")
    expect(not runs.is_strict("a.obj"), "accepted by --strict")
    expect("NORMAL" in runs.whole("a.obj").primitive()["attributes"], "normals")
    expect(len(runs.baked("a.obj").list("meshes")) == 1, "one mesh")
    runs.simplify("a.obj", "--ratio", 0.5, out="out.obj")
    expect("\nvn " in runs.read("out.obj").decode(), "normals of other formats")


@row("OBJ", "`usemtl`, `mtllib`")
def materials(runs):
    _, _, low, high = halves()
    runs.write("a.mtl", "newmtl red\nKd 1 0 0\nnewmtl green\nKd 0 1 0\nnewmtl unused\nKd 0 0 1\n")
    runs.write("a.obj",
               "mtllib a.mtl\n" + obj_vertices() + "usemtl red\n" + obj_faces(low) + "usemtl green\n" + obj_faces(high))
    for gltf in (runs.whole("a.obj"), runs.simplify("a.obj", "--ratio", 0.5)):
        expect([m["name"] for m in gltf.list("materials")] == ["red", "green"], "the materials in use")
        expect(len(gltf.primitives()) == 2, "a primitive for each material")
    runs.write("a.obj", runs.read("a.obj").decode().replace("usemtl red", "usemtl gone"))
    expect_repair(runs, "a.obj", "'gone' is not defined")
    runs.write("b.obj", runs.read("a.obj").decode().replace("a.mtl", "folder/gone.mtl"))
    expect_repair(runs, "b.obj", "gone.mtl")


@row("OBJ", "`v` with a colour or a weight")
def obj_colors(runs):
    triangles = grid()[2]
    expect_no_warning(runs, runs.write("a.obj", obj_vertices(" 0.8 0.2 0") + obj_faces(triangles)))
    expect(runs.info("a.obj")["parts"][0]["vertex_colors"], "vertex colours")
    expect_no_warning(runs, runs.write("b.obj", obj_vertices(" 1") + obj_faces(triangles)))
    expect(runs.baked("a.obj").has_color((0.8, 0.2, 0, 1)), "baked")
    expect("COLOR_0" in runs.kept("a.obj").primitive()["attributes"], "kept")
    expect_repair(runs, runs.write("a.obj", obj_vertices(" 2") + obj_faces(triangles)), "with a weight")
    expect_repair(runs, runs.write("a.obj", obj_vertices(" 204 51 0") + obj_faces(triangles)), "divided by 255")
    expect(runs.baked("a.obj").has_color((0.8, 0.2, 0, 1)), "from 0 to 255")


@row("OBJ", "`#MRGB`")
def zbrush_colors(runs):
    positions, _, triangles = grid()
    block = "".join("#MRGB ffcc3300\n" for _ in positions)
    expect_no_warning(runs, runs.write("a.obj", obj_vertices() + block + obj_faces(triangles)))
    expect(runs.baked("a.obj").has_color((0.8, 0.2, 0, 1)), "baked")
    runs.write("a.obj", obj_vertices() + "#MRGB 0\n" + block + obj_faces(triangles))
    expect_repair(runs, "a.obj", "1 line of #MRGB")


@row("OBJ", "`l`, `p`, other statements")
def lines(runs):
    runs.write("a.obj", obj_vertices() + obj_faces(grid()[2]) + "l 1 2\np 1\ncurv 1 2\n")
    expect_repair(runs, "a.obj", "2 line or point statements ignored")
    expect_repair(runs, "a.obj", "1 unknown statement ignored, first 'curv'")


def write_ply(runs, vertex="", face="", vertex_data=None, face_data=None, comments="", other="", other_data="",
              faces=True):
    """Writes the grid as a.ply, with properties and their values in text, by vertex and by face."""
    positions, _, triangles = grid()
    lines = ["ply", "format ascii 1.0"] + comments.splitlines() + [f"element vertex {len(positions)}"]
    lines += [f"property float {axis}" for axis in "xyz"] + vertex.splitlines()
    if faces:
        lines += [f"element face {len(triangles)}", "property list uchar int vertex_indices"] + face.splitlines()
    lines += other.splitlines() + ["end_header"]
    lines += ["%.6f %.6f %.6f " % p + (vertex_data(i) if vertex_data else "") for i, p in enumerate(positions)]
    if faces:
        lines += ["3 %d %d %d " % t + (face_data(i) if face_data else "") for i, t in enumerate(triangles)]
    return runs.write("a.ply", "\n".join(lines) + "\n" + other_data)


RGB = "".join(f"property uchar {c}\n" for c in ("red", "green", "blue"))


def uv_text(i):
    return "%.6f %.6f" % grid()[1][i]


def corner_uvs(t):
    return "6 " + " ".join(uv_text(i) for i in grid()[2][t])


def images_of(gltf):
    return sorted({m["name"] for m in gltf.list("materials")})


@row("PLY", "`comment TextureFile`")
def ply_texture(runs):
    runs.write("a.png", png(GREY))
    runs.write("b.png", png((255, 0, 0, 255)))
    comments = "comment TextureFile a.png\ncomment TextureFile b.png"
    write_ply(runs, "property float s\nproperty float t", vertex_data=uv_text, comments=comments)
    expect_no_warning(runs, "a.ply")
    expect(images_of(runs.whole("a.ply")) == ["a"], "a material for a file that faces refer to")
    expect(runs.baked("a.ply").has_color((0.5, 0.5, 0.5, 1)), "baked")
    expect_repair(runs, write_ply(runs, comments=comments), "texture files are not read")


@row("PLY", "`texcoord` (face), `s t` (vertex)")
def ply_coordinates(runs):
    write_ply(runs, face="property list uchar float texcoord", face_data=corner_uvs)
    whole = runs.whole("a.ply")
    expect(len(whole.attribute("POSITION")) == 81 and whole.attribute("TEXCOORD_0")[1] == (0.125, 1),
           "UVs of the corners")
    write_ply(runs, face="property list uchar float texcoord", face_data=lambda t: f"6 {t} 0 {t} 1 {t} 0")
    expect(len(runs.whole("a.ply").attribute("POSITION")) == 3 * 128, "vertices are repeated")
    write_ply(runs, "property float s\nproperty float t", vertex_data=uv_text)
    expect(runs.whole("a.ply").attribute("TEXCOORD_0")[1] == (0.125, 1), "UVs of the vertices")
    expect(runs.kept("a.ply").attribute("TEXCOORD_0") is not None, "kept")


@row("PLY", "`texnumber` (face)")
def ply_texture_numbers(runs):
    runs.write("a.png", png(GREY))
    runs.write("b.png", png((255, 0, 0, 255)))
    comments = "comment TextureFile a.png\ncomment TextureFile b.png"

    def write(number):
        write_ply(runs, face="property list uchar float texcoord\nproperty int texnumber", comments=comments,
                  face_data=lambda t: f"{corner_uvs(t)} {number(t)}")
    write(lambda t: t % 2)
    expect(images_of(runs.whole("a.ply")) == ["a", "b"], "both textures")
    write(lambda t: 1)
    expect(images_of(runs.whole("a.ply")) == ["b"], "the second one")
    write(lambda t: -1 if t else 0)
    whole = runs.whole("a.ply")
    plain = whole.json["materials"][whole.primitives()[-1]["material"]]
    expect("baseColorTexture" not in plain["pbrMetallicRoughness"], "none")
    expect_no_warning(runs, "a.ply")
    write(lambda t: 7 if t else 0)
    expect_repair(runs, "a.ply", "127 faces with the number of a texture that the file does not name")


@row("PLY", "`red green blue alpha` (vertex)")
def ply_vertex_colors(runs):
    expect_no_warning(runs, write_ply(runs, RGB + "property uchar alpha", vertex_data=lambda i: "204 51 0 255"))
    expect(runs.baked("a.ply").has_color((0.8, 0.2, 0, 1)), "baked")
    expect(runs.kept("a.ply").attribute("COLOR_0") is not None, "kept")
    write_ply(runs, RGB.replace("uchar", "float"), vertex_data=lambda i: "204 51 0")
    expect_repair(runs, "a.ply", "divided by 255")
    expect(runs.baked("a.ply").has_color((0.8, 0.2, 0, 1)), "divided")


@row("PLY", "`red green blue alpha` (face)")
def ply_face_colors(runs):
    expect_no_warning(runs, write_ply(runs, face=RGB, face_data=lambda t: "255 0 0" if t % 2 else "0 0 255"))
    expect(len(set(runs.whole("a.ply").attribute("COLOR_0"))) == 2, "constant on each face")
    write_ply(runs, RGB, RGB, lambda i: "204 51 0", lambda t: "0 0 255")
    expect_repair(runs, "a.ply", "face colours are ignored")
    expect(runs.baked("a.ply").has_color((0.8, 0.2, 0, 1)), "the colours of the vertices")


@row("PLY", "colours of faces with a texture")
def ply_colors_of_textured(runs):
    runs.write("a.png", png(GREY))
    write_ply(runs, RGB, "property list uchar float texcoord", lambda i: "255 0 0", corner_uvs,
              "comment TextureFile a.png")
    expect_repair(runs, "a.ply", "colours of 128 faces with a texture left out")
    expect(runs.baked("a.ply").has_color((0.5, 0.5, 0.5, 1)), "the colour of the image")


STRIPS = "element tristrips 1\nproperty list int int vertex_indices\n"


@row("PLY", "`texcoord`, `red` of `tristrips`")
def ply_strips(runs):
    write_ply(runs, other=STRIPS + "property list uchar float texcoord\nproperty uchar red\n",
              other_data="4 0 1 9 10 2 0 0 7\n", faces=False)
    for name in ("texcoord", "red"):
        expect_repair(runs, "a.ply", f"'{name}' of tristrips is ignored")


@row("PLY", "other elements and properties")
def ply_other(runs):
    write_ply(runs, "property float quality\nproperty float nx\nproperty float s", "property int flags\nproperty uchar red",
              lambda i: "1 1 1", lambda t: "3 4", other="element edge 1\nproperty int vertex1\n", other_data="0\n")
    expect_no_warning(runs, "a.ply")
    expect(not runs.is_strict("a.ply"), "accepted by --strict")
    expect(runs.info("a.ply")["not_understood"] == [
        "property 'quality' of vertex", "property 'nx' of vertex", "property 's' of vertex", "property 'flags' of face",
        "property 'red' of face", "element 'edge'"], "`info` names them")
    expect(len(runs.baked("a.ply").attribute("POSITION")) < 81, "the mesh")


def write_stl(runs, attribute, header=b""):
    """Writes the grid as a binary a.stl with an attribute for each facet."""
    positions, _, triangles = grid()
    data = header.ljust(80, b" ") + struct.pack("<I", len(triangles))
    for i, t in enumerate(triangles):
        data += struct.pack("<12fH", 0, 0, 0, *(x for v in t for x in positions[v]), attribute(i))
    return runs.write("a.stl", data)


@row("STL", "colours of facets (binary)")
def stl_colors(runs):
    bits = 31 | 15 << 10
    write_stl(runs, lambda i: bits, b"COLOR=\x00\x33\xcc\xff")
    expect(runs.baked("a.stl").has_color((1, 0, 15 / 31, 1)), "Magics: red is lowest")
    write_stl(runs, lambda i: 0x8000, b"COLOR=\x00\x33\xcc\x80")
    expect(runs.baked("a.stl").has_color((0, 0.2, 0.8, 1)), "Magics: the colour of the header")
    expect(round(runs.whole("a.stl").attribute("COLOR_0")[0][3] / 65535, 2) == 0.5, "its alpha")
    write_stl(runs, lambda i: 0x8000 | bits)
    expect(runs.baked("a.stl").has_color((15 / 31, 0, 1, 1)), "VisCAM: blue is lowest")
    write_stl(runs, lambda i: 0x8000 | bits if i else bits)
    whole = runs.whole("a.stl")
    expect(len(set(whole.attribute("COLOR_0"))) == 2 and (65535,) * 4 in whole.attribute("COLOR_0"), "VisCAM: white")
    expect_no_warning(runs, "a.stl")


@row("STL", "other attributes of facets")
def stl_attributes(runs):
    expect_repair(runs, write_stl(runs, lambda i: 5), "attributes of 128 facets ignored")


def solid(name, triangles):
    positions = grid()[0]
    facets = "".join("facet normal 0 0 1\nouter loop\n" + "".join("vertex %.6f %.6f %.6f\n" % positions[v] for v in t)
                     + "endloop\nendfacet\n" for t in triangles)
    return f"solid {name}\n{facets}endsolid {name}\n"


@row("STL", "several solids (ASCII)")
def stl_solids(runs):
    _, _, low, high = halves()
    expect_no_warning(runs, runs.write("a.stl", solid("low", low) + solid("high", high)))
    for gltf in (runs.whole("a.stl"), runs.baked("a.stl")):
        expect([m["name"] for m in gltf.list("meshes")] == ["low", "high"], "a mesh for each solid")


@row("STL", "text after the last solid")
def stl_rest(runs):
    runs.write("a.stl", solid("a", grid()[2]) + "made by hand\n")
    expect_repair(runs, "a.stl", "13 bytes after the last solid ignored")
    runs.write("b.stl", solid("a", grid()[2]) + "facet\n")
    expect(runs.run("info", "b.stl").returncode == 3, "code 3")


@row("STL", "bytes after the last facet, a wrong count (binary)")
def stl_sizes(runs):
    write_stl(runs, lambda i: 0)
    data = runs.read("a.stl")
    expect_repair(runs, runs.write("a.stl", data + b"rest"), "4 bytes after the last facet ignored")
    runs.write("a.stl", data[:80] + struct.pack("<I", 999) + data[84:])
    expect_repair(runs, "a.stl", "the header states 999 facets")
    expect(runs.info("a.stl")["total"]["faces"] == 128, "all facets")


def write_off(runs, color, keyword="OFF", vertex=""):
    positions, _, triangles = grid()
    return runs.write("a.off", f"{keyword}\n{len(positions)} {len(triangles)} 0\n"
                      + "".join("%.6f %.6f %.6f" % p + vertex + "\n" for p in positions)
                      + "".join("3 %d %d %d" % t + color(i) + "\n" for i, t in enumerate(triangles)))


@row("OFF", "colours of faces")
def off_face_colors(runs):
    expect_no_warning(runs, write_off(runs, lambda i: (" 255 0 0", " 0.0 1.0 0.0 0.5", "")[i % 3]))
    colors = {tuple(round(c / 65535, 3) for c in color) for color in runs.whole("a.off").attribute("COLOR_0")}
    expect(colors == {(1, 0, 0, 1), (0, 1, 0, 0.5), (1, 1, 1, 1)}, "constant on each face, and white")
    expect_repair(runs, write_off(runs, lambda i: " 0 0 255", "COFF", " 204 51 0"), "face colours are ignored")
    expect(runs.baked("a.off").has_color((0.8, 0.2, 0, 1)), "the colours of the vertices")


@row("OFF", "index into a colour map")
def off_color_map(runs):
    expect_repair(runs, write_off(runs, lambda i: " 3"), "colours of 128 faces ignored")


@row("OFF", "bytes after the last face")
def off_rest(runs):
    write_off(runs, lambda i: "")
    runs.write("a.off", runs.read("a.off") + b"3 0 1 2\n")
    expect_repair(runs, "a.off", "8 bytes after the last face ignored")
