#!/usr/bin/env python3
"""Prints a table of the bytes and texels of simplified models, each in the format of its source.

Usage: python3 tests/bench/size.py FAQEM FOLDER [--ratio R] [--least-faces N] [--options "WORDS"]

The models are all .glb, .gltf and .obj files below FOLDER. Bytes are those of the model and of the files that it
refers to; texels are those of all images. Models with fewer than N faces (8000) are left out of the medians.
"""

import argparse
import json
import os
import pathlib
import statistics
import sys
import tempfile

from results import models, run


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("tool")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--ratio", type=float, default=0.1)
    parser.add_argument("--least-faces", type=int, default=8000)
    parser.add_argument("--options", default="")
    return parser.parse_args()


def source_texels(tool, file):
    """Texels of all images of a model; None if the command cannot read it."""
    info, _ = run(tool, "info", file, "--json")
    if info.returncode != 0:
        return None
    return texels(json.loads(info.stdout).get("images", []))


def texels(images):
    """Texels of images; those of KTX2 and AVIF, whose headers are not read, do not count."""
    return sum(image.get("width", 0) * image.get("height", 0) for image in images)


def simplified(args, file):
    """The report of a run, and its CPU seconds; None if it failed."""
    with tempfile.TemporaryDirectory() as folder:
        report = pathlib.Path(folder) / "report.json"
        made, seconds = run(args.tool, "simplify", file, pathlib.Path(folder) / f"out{file.suffix.lower()}", "--ratio",
                            args.ratio, "--quiet", "--report", report, *args.options.split())
        if made.returncode != 0:
            print(f"| {file.stem} | {made.stderr.strip().splitlines()[-1]} |")
            return None
        return json.loads(report.read_text()), seconds


def main():
    args = arguments()
    print("| model | faces in | kB in | kB out | out / in | texels out / in | meshes with kept UVs | CPU s |")
    print("|---|---:|---:|---:|---:|---:|---:|---:|")
    bytes_ratios, texel_ratios, bytes_in, bytes_out = [], [], 0, 0
    for file in models(args.folder):
        texels_in = source_texels(args.tool, file)
        result = simplified(args, file)
        if not result:
            continue
        report, seconds = result
        texels_out = texels(report["images"])
        ratio = report["bytes_out"] / report["bytes_in"]
        texel_ratio = texels_out / texels_in if texels_in else None
        bytes_in += report["bytes_in"]
        bytes_out += report["bytes_out"]
        if report["faces_in"] >= args.least_faces:
            bytes_ratios.append(ratio)
            if texel_ratio is not None:
                texel_ratios.append(texel_ratio)
        texel_text = "" if texel_ratio is None else f"{texel_ratio:.2f}"
        print(f"| {os.path.relpath(file, args.folder)} | {report['faces_in']} | {report['bytes_in'] / 1e3:.0f} | "
              f"{report['bytes_out'] / 1e3:.0f} | {ratio:.2f} | {texel_text} | {len(report['kept_uvs'])} | "
              f"{seconds:.1f} |", flush=True)
    if bytes_ratios:
        print(f"\n{len(bytes_ratios)} models with at least {args.least_faces} faces: bytes out / in median "
              f"{statistics.median(bytes_ratios):.3f}, most {max(bytes_ratios):.2f}; texels median "
              f"{statistics.median(texel_ratios or [0]):.2f}, most {max(texel_ratios or [0]):.2f}")
    print(f"all: {bytes_in / 1e6:.1f} -> {bytes_out / 1e6:.1f} MB")
    return 0


if __name__ == "__main__":
    sys.exit(main())
