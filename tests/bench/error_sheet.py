#!/usr/bin/env python3
"""Composes renderings of original and simplified models and their differences into one image.

    error_sheet.py OUT.png VIEW FOLDER[:VIEW]...

Each FOLDER contains renderings of one model with the same cameras, as lit_00.png, lit_01.png ...: ref/; p.1/ and p.01/,
results of this version with 10% and 1% of the faces; before.1/ and before.01/, those of an earlier one. A row of the
image shows one model: all faces, then for 10% and 1% the earlier result, the present one, and the difference of the
latter from the original, multiplied by four.
"""
import sys
from pathlib import Path

from PIL import Image, ImageChops

SIDE, GAP, GAIN = 160, 4, 4


def cropped(pictures):
    """Crops all pictures to the smallest square that contains the visible pixels of all, and resizes them."""
    boxes = [box for picture in pictures if (box := picture.getbbox())]
    left, top = min(b[0] for b in boxes), min(b[1] for b in boxes)
    right, bottom = max(b[2] for b in boxes), max(b[3] for b in boxes)
    side = max(right - left, bottom - top) + 8
    x, y = (left + right - side) // 2, (top + bottom - side) // 2
    return [p.crop((x, y, x + side, y + side)).resize((SIDE, SIDE), Image.LANCZOS) for p in pictures]


def row(folder, view):
    names = ("ref", "before.1", "p.1", "before.01", "p.01")
    original, *simplified = cropped([Image.open(Path(folder, n, f"lit_{view:02d}.png")).convert("RGB") for n in names])
    errors = [ImageChops.difference(original, p).point(lambda v: min(255, GAIN * v)) for p in simplified[1::2]]
    return [original, *simplified[:2], errors[0], *simplified[2:], errors[1]]


def main():
    out, default, folders = sys.argv[1], int(sys.argv[2]), sys.argv[3:]
    if not folders:
        sys.exit(__doc__)
    rows = []
    for folder in folders:
        name, _, view = folder.partition(":")
        rows.append(row(name, int(view or default)))
    step = SIDE + GAP
    sheet = Image.new("RGB", (len(rows[0]) * step - GAP, len(rows) * step - GAP), "white")
    for j, pictures in enumerate(rows):
        for i, picture in enumerate(pictures):
            sheet.paste(picture, (i * step, j * step))
    sheet.save(out, optimize=True)


main()
