"""Small models of every format, runs of the command on them, and what the results say."""
import json
import math
import pathlib
import struct
import subprocess
import zlib

COMPONENTS = {"b": 5120, "B": 5121, "h": 5122, "H": 5123, "I": 5125, "f": 5126}
TYPES = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4", 16: "MAT4"}
SIDE = 8  # of the grid, in quads


class Failure(Exception):
    """A statement of the table that does not hold."""


def expect(condition, what):
    """Raises Failure, with a description of what should hold, unless the condition is true."""
    if not condition:
        raise Failure(what)


def rows_of(rows, *kind):
    """A decorator of checks: its arguments, after those of the kind, are the row of the table that is checked."""
    def row(*statement):
        def add(check):
            rows[kind + statement] = check
            return check
        return add
    return row


def grid(side=SIDE):
    """A bumpy square of 2 x side^2 faces: positions, (u, v) with v upwards, triangles."""
    n = side + 1
    positions = [(x / side, y / side, 0.05 * math.sin(5 * x / side) * math.cos(4 * y / side))
                 for y in range(n) for x in range(n)]
    uvs = [(x / side, y / side) for y in range(n) for x in range(n)]
    corners = [y * n + x for y in range(side) for x in range(side)]
    triangles = [t for c in corners for t in ((c, c + 1, c + n + 1), (c, c + n + 1, c + n))]
    return positions, uvs, triangles


def png_of(size, kind, *chunks):
    """A PNG of size x size pixels of a kind: 0 grey, 2 RGB, 6 RGBA. `chunks`: names and bytes, between the first and last."""
    header = struct.pack(">IIBBBBB", size, size, 8, kind, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + b"".join(
        struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
        for name, data in ((b"IHDR", header), *chunks, (b"IEND", b"")))


def png(pixel, size=4, kind=6):
    """A PNG of size x size pixels: bytes of one, or a function of (x, y). `kind`: 0 grey, 2 RGB, 6 RGBA."""
    at = pixel if callable(pixel) else lambda x, y: pixel
    rows = b"".join(b"\0" + b"".join(bytes(at(x, y)) for x in range(size)) for y in range(size))
    return png_of(size, kind, (b"IDAT", zlib.compress(rows)))


class Runs:
    """A folder with files, and the command applied to them."""

    def __init__(self, tool, folder):
        self.tool, self.folder, self.results = tool, pathlib.Path(folder), {}
        self.folder.mkdir(exist_ok=True)

    def write(self, name, content):
        self.results.clear()
        (self.folder / name).write_bytes(content.encode() if isinstance(content, str) else content)
        return name

    def read(self, name):
        return (self.folder / name).read_bytes()

    def run(self, *arguments):
        return subprocess.run([self.tool, *map(str, arguments)], cwd=self.folder, capture_output=True, timeout=60)

    def info(self, name):
        """What `info` says about a file."""
        done = self.run("info", name, "--json")
        expect(done.returncode == 0, f"info {name}: {done.stderr.decode()}")
        return json.loads(done.stdout)

    def simplify(self, name, *options, out="out.glb"):
        """Simplifies a file. Returns the result: a Gltf, or the report if it is none. Results are remembered."""
        key = (name, options, out)
        if key not in self.results:
            self.results[key] = self.new_result(name, options, out)
        return self.results[key]

    def new_result(self, name, options, out):
        """As simplify(), for a first run."""
        if out != "out.glb":  # it may be an input later
            self.results.clear()
        done = self.run("simplify", name, out, "--force", "--quiet", "--report", "report.json", *options)
        expect(done.returncode == 0, f"simplify {name} {options}: {done.stderr.decode()}")
        report = json.loads(self.read("report.json"))
        return Gltf(self.read(out), report) if out.endswith(".glb") else report

    def whole(self, name):
        """The file written as glTF without simplification: what was read."""
        return self.simplify(name, "--ratio", 1)

    def baked(self, name, *options):
        """The simplified file with a new texture."""
        return self.simplify(name, "--bake", "atlas", "--ratio", 0.5, "--texture-size", 64, *options)

    def kept(self, name, *options):
        """The simplified file with its own texture coordinates and images."""
        return self.simplify(name, "--bake", "keep", "--ratio", 0.5, *options)

    def is_strict(self, name):
        """Whether --strict rejects a file."""
        return self.run("simplify", name, "strict.glb", "--force", "--strict", "--ratio", 1).returncode == 3


def warns(texts, part):
    """Whether one of the texts, those of `info` or of a report, contains the part."""
    return any(part in text for text in texts)


def expect_repair(runs, name, message):
    """A repair is in `info` and in the report, and an error with --strict."""
    expect(warns(runs.info(name)["warnings"], message), f"`info` warns: {message}")
    expect(runs.baked(name).warns(message), f"the report warns: {message}")
    expect(runs.is_strict(name), f"--strict rejects it: {message}")


def expect_no_warning(runs, name):
    expect(not runs.info(name)["warnings"], "no warning on reading")


class Gltf:
    """A GLB and the report of the run that wrote it."""

    def __init__(self, data, report):
        length, = struct.unpack_from("<I", data, 12)
        self.json, self.buffer = json.loads(data[20:20 + length]), data[28 + length:]
        self.warnings = report["warnings"]

    def warns(self, part):
        return warns(self.warnings, part)

    def list(self, key):
        return self.json.get(key, [])

    def material(self, name=None):
        """The material with a name, or the only one."""
        all_ = [m for m in self.list("materials") if name in (None, m.get("name"))]
        expect(len(all_) == 1, f"one material {name or ''}, not {len(all_)}")
        return all_[0]

    def factor(self, name=None):
        """The colour factor of a material."""
        return self.material(name).get("pbrMetallicRoughness", {}).get("baseColorFactor", [1, 1, 1, 1])

    def has_color(self, rgba, name=None):
        """Whether the colour factor is that of sRGB values, up to rounding of eight bits."""
        linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in rgba[:3]] + [rgba[3]]
        return all(abs(a - b) < 0.02 for a, b in zip(self.factor(name), linear))

    def primitives(self, mesh=0):
        return self.json["meshes"][mesh]["primitives"]

    def primitive(self):
        expect(len(self.list("meshes")) == 1 and len(self.primitives()) == 1, "one primitive")
        return self.primitives()[0]

    def accessor(self, index):
        """The numbers of an accessor, as one tuple for each element."""
        a = self.json["accessors"][index]
        kind = {code: letter for letter, code in COMPONENTS.items()}[a["componentType"]]
        width = {name: n for n, name in TYPES.items()}[a["type"]]
        view = self.json["bufferViews"][a["bufferView"]]
        stride = view.get("byteStride") or width * struct.calcsize(kind)
        start = view.get("byteOffset", 0) + a.get("byteOffset", 0)
        return [struct.unpack_from(f"<{width}{kind}", self.buffer, start + i * stride) for i in range(a["count"])]

    def attribute(self, name):
        """The values of an attribute of the only primitive, or None."""
        index = self.primitive()["attributes"].get(name)
        return None if index is None else self.accessor(index)


class Glb:
    """Builds a GLB. `json` may be edited."""

    def __init__(self):
        self.json, self.buffer = {"asset": {"version": "2.0"}}, b""

    def add(self, key, value):
        self.json.setdefault(key, []).append(value)
        return len(self.json[key]) - 1

    def view(self, data):
        self.buffer += b"\0" * (-len(self.buffer) % 4)
        view = {"buffer": 0, "byteOffset": len(self.buffer), "byteLength": len(data)}
        self.buffer += data
        return self.add("bufferViews", view)

    def accessor(self, rows, kind="f", **other):
        """Adds an accessor of tuples (or numbers) of one `struct` type. Elements must have a multiple of 4 bytes."""
        rows = [r if isinstance(r, (tuple, list)) else (r,) for r in rows]
        data = b"".join(struct.pack(f"<{len(r)}{kind}", *r) for r in rows)
        accessor = {"bufferView": self.view(data), "componentType": COMPONENTS[kind], "count": len(rows),
                    "type": TYPES[len(rows[0])], **other}
        if kind == "f" and len(rows[0]) < 4:
            accessor.update(min=[min(c) for c in zip(*map(_floats, rows))],
                            max=[max(c) for c in zip(*map(_floats, rows))])
        return self.add("accessors", accessor)

    def texture(self, data, mime="image/png", **other):
        image = self.add("images", {"bufferView": self.view(data), "mimeType": mime})
        return self.add("textures", {"source": image, **other})

    def bytes(self):
        self.buffer += b"\0" * (-len(self.buffer) % 4)
        text = json.dumps({**self.json, "buffers": [{"byteLength": len(self.buffer)}]}).encode()
        text += b" " * (-len(text) % 4)
        body = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(self.buffer), b"BIN\0")
        return struct.pack("<4sII", b"glTF", 2, 12 + len(body) + len(self.buffer)) + body + self.buffer


def _floats(row):
    return struct.unpack(f"<{len(row)}f", struct.pack(f"<{len(row)}f", *row))


def gltf_grid(material=None, side=SIDE, **attributes):
    """A Glb with the grid as mesh 0 at node 0. `attributes`: accessor arguments, as (rows, kind)."""
    glb = Glb()
    positions, uvs, triangles = grid(side)
    primitive = {"attributes": {"POSITION": glb.accessor(positions),
                                "TEXCOORD_0": glb.accessor([(u, 1 - v) for u, v in uvs])},
                 "indices": glb.accessor([i for t in triangles for i in t], "I")}
    for name, (rows, kind) in attributes.items():
        primitive["attributes"][name] = glb.accessor(rows, kind)
    if material is not None:
        primitive["material"] = glb.add("materials", material)
    glb.add("meshes", {"name": "sheet", "primitives": [primitive]})
    glb.add("nodes", {"mesh": 0, "name": "sheet"})
    glb.json["scenes"] = [{"nodes": [0]}]
    return glb
