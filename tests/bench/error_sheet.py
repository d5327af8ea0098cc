#!/usr/bin/env python3
"""Pictures of models side by side: the original, lighter ones, and where they differ.

    error_sheet.py OUT.png VIEW FOLDER[:VIEW]...

Every FOLDER holds pictures of one model as a renderer with the same cameras made them: ref/, p.1/ and p.01/ with
lit_00.png, lit_01.png ... A row shows one model: all faces, 10%, 1%, and four times the difference of each of
the two from the first.
"""
import sys
from pathlib import Path

from PIL import Image, ImageChops

SIDE, GAP, GAIN = 240, 6, 4


def cropped(pictures):
    """All cut to the square around what any of them shows."""
    boxes = [box for picture in pictures if (box := picture.getbbox())]
    left, top = min(b[0] for b in boxes), min(b[1] for b in boxes)
    right, bottom = max(b[2] for b in boxes), max(b[3] for b in boxes)
    side = max(right - left, bottom - top) + 8
    x, y = (left + right - side) // 2, (top + bottom - side) // 2
    return [p.crop((x, y, x + side, y + side)).resize((SIDE, SIDE), Image.LANCZOS) for p in pictures]


def row(folder, view):
    pictures = [Image.open(Path(folder) / name / f"lit_{view:02d}.png").convert("RGB") for name in ("ref", "p.1", "p.01")]
    whole, *light = cropped(pictures)
    errors = [ImageChops.difference(whole, p).point(lambda v: min(255, GAIN * v)) for p in light]
    return [whole, *light, *errors]


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
