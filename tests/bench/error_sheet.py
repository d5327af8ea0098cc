#!/usr/bin/env python3
"""Composes renderings of original and simplified models and their differences into one image.

    error_sheet.py OUT.png VIEW FOLDER[:VIEW]...

Each FOLDER contains renderings of one model with the same cameras: ref/, p.1/ and p.01/ with lit_00.png, lit_01.png ...
A row of the image shows one model: all faces, 10%, 1%, and the difference of each of the two from the first, multiplied
by four.
"""
import sys
from pathlib import Path

from PIL import Image, ImageChops

SIDE, GAP, GAIN = 240, 6, 4


def cropped(pictures):
    """Crops all pictures to the smallest square that contains the visible pixels of all, and resizes them."""
    boxes = [box for picture in pictures if (box := picture.getbbox())]
    left, top = min(b[0] for b in boxes), min(b[1] for b in boxes)
    right, bottom = max(b[2] for b in boxes), max(b[3] for b in boxes)
    side = max(right - left, bottom - top) + 8
    x, y = (left + right - side) // 2, (top + bottom - side) // 2
    return [p.crop((x, y, x + side, y + side)).resize((SIDE, SIDE), Image.LANCZOS) for p in pictures]


def row(folder, view):
    pictures = [Image.open(Path(folder) / name / f"lit_{view:02d}.png").convert("RGB") for name in ("ref", "p.1", "p.01")]
    original, *simplified = cropped(pictures)
    errors = [ImageChops.difference(original, p).point(lambda v: min(255, GAIN * v)) for p in simplified]
    return [original, *simplified, *errors]


def main():
    out, default, folders = sys.argv[1], int(sys.argv[2]), sys.argv[3:]
    if not folders:
        sys.exit(__doc__)
    rows = []
    for folder in folders:
        name, _, view = folder.partition(":")
        rows.append(row(name, int(view or default)))
    step = SIDE + GAP
    sheet = Image.new("RGB", (5 * step - GAP, len(rows) * step - GAP), "white")
    for j, pictures in enumerate(rows):
        for i, picture in enumerate(pictures):
            sheet.paste(picture, (i * step, j * step))
    sheet.save(out, optimize=True)


main()
