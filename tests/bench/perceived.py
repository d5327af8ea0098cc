#!/usr/bin/env python3
"""Prints the FLIP error and the SSIMULACRA 2 score of folders of pictures against a reference, as means of the views.

    perceived.py lit|unlit REFERENCE FOLDER...

Folders are those of the renderer of shared/tools. Pictures are laid over grey. FLIP (0 is best; a pixel is 1/67 degree)
is the mean over pixels that either shows, SSIMULACRA 2 (100 is best) is that of the smallest box with all of these.
Needs the packages flip-evaluator and ssimulacra2, and scipy 1.11.
"""

import io
import pathlib
import sys

import flip_evaluator
import numpy
from PIL import Image, ImageChops
from ssimulacra2 import compute_ssimulacra2


def measure(reference, test):
    """Both values of one picture."""
    pair = [Image.open(path).convert("RGBA") for path in (reference, test)]
    covered = ImageChops.lighter(*(picture.getchannel("A") for picture in pair))
    pair = [Image.alpha_composite(Image.new("RGBA", p.size, "grey"), p).convert("RGB") for p in pair]
    errors = flip_evaluator.evaluate(*(numpy.float32(p) / 255 for p in pair), "LDR", applyMagma=False)[0]
    files = [io.BytesIO(), io.BytesIO()]
    for picture, file in zip(pair, files):
        picture.crop(covered.getbbox()).save(file, "PNG")
    return errors[numpy.array(covered) > 0].mean(), compute_ssimulacra2(*files)


if __name__ == "__main__":
    kind, reference, *folders = sys.argv[1:]
    for folder in map(pathlib.Path, folders):
        values = [measure(pathlib.Path(reference, test.name), test) for test in sorted(folder.glob(f"{kind}_*.png"))]
        print(folder, *numpy.mean(values, axis=0).round(4), flush=True)
