#!/usr/bin/env python3
"""Measures the peak memory of `faqem simplify --max-memory` on small files that need much memory.

Usage: tests/bench/memory_limit.py FAQEM [FILE...]

For each file, limits of 500 MB, 1 GB and 2 GB are tried: the exit code, the peak resident memory as a share of the
limit, and the seconds are printed. The exit code of this script is 1 if a peak exceeds 1.2 times the limit or the
command ends with anything but a result (0) or an error for bad input or memory (3, 4, 11). Without files, it makes
glTF files with many numbers, accessors and meshes that are used many times, a PNG whose text expands, an image of many
pixels, and triangles that share one edge; and malicious ones, which are refused: nested brackets, a count of 2^62, nodes
in a circle, and images without the pixels that their headers claim.
"""

import multiprocessing
import os
import subprocess
import sys
import tempfile
import time
import zlib
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "docs/statements"))
from gltf_rows import textured
from model import gltf_grid, png_of

LIMITS = (500, 1000, 2000)  # MB
ALLOWED = 1.2
EXIT_CODES = (0, 3, 4, 11)


def black(side, texts=(), rows=None):
    """Returns a black grey-scale PNG with compressed texts, and only the given number of rows."""
    compressor = zlib.compressobj(9)
    row = bytes(side + 1)
    data = b"".join(compressor.compress(row) for _ in range(side if rows is None else rows)) + compressor.flush()
    return png_of(side, 0, *((b"zTXt", text) for text in texts), (b"IDAT", data))


def write_files(folder):
    """Writes one file of each family."""
    files = {}
    files["numbers in extras"] = numbers = gltf_grid()
    numbers.json["meshes"][0]["extras"] = {"a": [0] * 20_000_000}
    files["numbers in weights"] = weights = gltf_grid()
    weights.json["meshes"][0]["weights"] = [0] * 20_000_000
    files["targets of one accessor"] = targets = gltf_grid(side=150)
    targets.json["meshes"][0]["primitives"][0]["targets"] = [{"POSITION": 0}] * 4000
    files["meshes of one accessor"] = meshes = gltf_grid(side=300)
    meshes.json["meshes"] *= 2000
    meshes.json["nodes"] = [{"mesh": i} for i in range(2000)]
    meshes.json["scenes"][0]["nodes"] = list(range(2000))
    files["nodes of one mesh"] = nodes = gltf_grid(side=100)
    nodes.json["nodes"] = [{"mesh": 0}] * 100_000
    nodes.json["scenes"][0]["nodes"] = list(range(100_000))
    text = b"Comment\0\0" + zlib.compress(bytes(1 << 30), 9)
    files["text of a PNG"] = textured(black(4, [text] * 3))
    files["image of 16384 x 16384 pixels"] = textured(black(16384))
    for side in (16384, 100_000):
        files[f"image of {side} without pixels"] = textured(black(side, rows=0))
    files["count of 2^62"] = count = gltf_grid()
    count.json["accessors"][0]["count"] = 2**62
    files["nodes in a circle"] = circle = gltf_grid()
    circle.json["nodes"] = [{"children": [1]}, {"children": [2]}, {"children": [0], "mesh": 0}]
    for name, glb in files.items():
        (folder / (name.replace(" ", "_") + ".glb")).write_bytes(glb.bytes())
    nested = '{"asset": {"version": "2.0"}, "extras": ' + "[" * 20_000 + "]" * 20_000 + "}"
    (folder / "nested_brackets.gltf").write_text(nested)
    fan = folder / "triangles_at_one_edge.obj"
    with fan.open("w") as out:
        out.write("v 0 0 0\nv 0 0 1\n")
        for i in range(10_000):
            out.write(f"v 1 {i} 0\nf 1 2 {i + 3}\n")


def measure(command):
    """Runs a command. Returns its exit code, peak resident bytes and seconds."""
    start = time.monotonic()
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    return os.waitstatus_to_exitcode(status), usage.ru_maxrss * 1024, time.monotonic() - start


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    failed = False
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        files = [Path(file) for file in sys.argv[2:]]
        if not files:
            # In a process of its own: the peak of a command includes that of the process that starts it.
            writer = multiprocessing.Process(target=write_files, args=(folder,))
            writer.start()
            writer.join()
            files = sorted(folder.iterdir())
        print(f"{'file':36} " + " ".join(f"{f'{limit} MB':>16}" for limit in LIMITS))
        print(f"{'':36} " + " ".join(f"{'exit share    s':>16}" for _ in LIMITS))
        for file in files:
            cells = []
            for limit in LIMITS:
                out = folder / ("out.glb" if file.suffix != ".obj" else "out.ply")
                # The other presets take time that grows with the square of the faces at an edge, for each collapse.
                preset = "fast" if "edge" in file.stem else "balanced"
                code, peak, seconds = measure([sys.argv[1], "simplify", str(file), str(out), "--ratio", "0.1",
                                               "--preset", preset, "--force", "--max-memory", f"{limit}MB"])
                share = peak / (limit * 1e6)
                bad = not share <= ALLOWED or code not in EXIT_CODES
                failed |= bad
                cells.append(f"{code:3} {share:5.2f} {seconds:5.1f}{' !' if bad else '  '}")
            print(f"{file.stem:36} " + " ".join(cells), flush=True)
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
