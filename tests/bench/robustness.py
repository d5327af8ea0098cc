"""Measures the cost of small malicious files for the command, and the time between a signal and the end of the command.

Usage: robustness.py TOOL MODEL [SIGNALS] [SIMPLIFY-OPTION...]. MODEL is simplified SIGNALS times (default: 20), and
SIGINT or SIGTERM is sent at times evenly distributed over the run. Times are longer on a busy machine.
"""

import json
import os
import pathlib
import signal
import statistics
import struct
import subprocess
import sys
import tempfile
import time
import zlib

CANCELLED, BAD_INPUT = 8, 3


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def png(side):
    """Returns a PNG whose header has side x side pixels, but which contains no pixel data."""
    header = struct.pack(">IIBBBBB", side, side, 8, 6, 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(b"")) + chunk(b"IEND", b""))


def triangle(folder, image):
    """Returns the glTF of a triangle with a texture, and writes its buffer and image."""
    corners = struct.pack("<15f", 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1)
    (folder / "corners.bin").write_bytes(corners)
    (folder / "image.png").write_bytes(image)
    return {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "material": 0}]}],
        "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
        "textures": [{"source": 0}], "images": [{"uri": "image.png"}],
        "buffers": [{"uri": "corners.bin", "byteLength": len(corners)}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 24}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]},
            {"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC2"}]}


def with_image(side):
    return lambda folder: json.dumps(triangle(folder, png(side)))


def nested(folder):
    model = json.dumps(triangle(folder, png(1)))
    return model[:-1] + ', "extras": ' + "[" * 20000 + "]" * 20000 + "}"


def large_count(folder):
    model = triangle(folder, png(1))
    model["accessors"][0]["count"] = 2**62
    return json.dumps(model)


def circle(folder):
    model = triangle(folder, png(1))
    model["nodes"] = [{"children": [1]}, {"children": [2]}, {"children": [0], "mesh": 0}]
    return json.dumps(model)


HOSTILE = {
    "20,000 nested brackets": nested,
    "a count of 2^62": large_count,
    "three nodes in a circle": circle,
    "a PNG of 16384 x 16384 without pixels": with_image(16384),
    "a PNG of 100,000 x 100,000": with_image(100000),
}


def hostile(tool, folder):
    print("| file | exit code | seconds | CPU s | peak resident memory, MB |\n|---|---:|---:|---:|---:|")
    failed = False
    for name, make in HOSTILE.items():
        model = folder / "hostile.gltf"
        model.write_text(make(folder), encoding="utf-8")
        begin = time.monotonic()
        child = subprocess.Popen([tool, "simplify", model, folder / "out.glb", "--force", "--quiet"],
                                 stderr=subprocess.DEVNULL)
        _, status, usage = os.wait4(child.pid, 0)
        seconds, code = time.monotonic() - begin, os.waitstatus_to_exitcode(status)
        failed |= code != BAD_INPUT
        print(f"| {name} | {code} | {seconds:.2f} | {usage.ru_utime + usage.ru_stime:.2f} | {usage.ru_maxrss / 1024:.0f} |")
    return failed


def seconds_to_end(command, number, delay):
    """Returns the time between a signal and the end of the process, and its exit code."""
    child = subprocess.Popen(command, stderr=subprocess.DEVNULL)
    time.sleep(delay)
    begin = time.monotonic()
    child.send_signal(number)
    code = child.wait()
    return time.monotonic() - begin, code


def signals(tool, model, folder, count, options):
    command = [tool, "simplify", model, folder / "out.glb", "--force", "--quiet", *options]
    begin = time.monotonic()
    subprocess.run(command, check=True)
    whole = time.monotonic() - begin
    (folder / "out.glb").unlink()
    ends, late, failed = [], 0, False
    for i in range(count):
        number = signal.SIGINT if i % 2 else signal.SIGTERM
        seconds, code = seconds_to_end(command, number, whole * (i + 0.5) / count)
        if code == 0:
            late += 1
            (folder / "out.glb").unlink()
            continue
        # Before the command has installed its handlers, a signal terminates it.
        if code == CANCELLED:
            ends.append(1000 * seconds)
        failed |= code not in (CANCELLED, -number) or [f.name for f in folder.glob("out.glb*")] != []
    print(f"\nDuration of a run: {whole:.1f} s. Time from signal to exit: median {statistics.median(ends):.0f} ms, "
          f"maximum {max(ends):.0f} ms over {len(ends)} signals. {count - len(ends) - late} signals were sent before "
          f"the handlers were installed, {late} after the end.")
    return failed


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    tool, model = sys.argv[1:3]
    count = int(sys.argv[3]) if len(sys.argv) > 3 else 20
    with tempfile.TemporaryDirectory() as folder:
        failed = hostile(tool, pathlib.Path(folder))
        failed |= signals(tool, model, pathlib.Path(folder), count, sys.argv[4:])
    sys.exit(failed)


main()
