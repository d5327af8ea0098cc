#!/usr/bin/env python3
"""Writes a table and a plot of the results of faqem-bench-speed.

Usage: speed.py [--out DIR] [--no-plots] SPEED.jsonl...
Prints a table and writes it to DIR/performance.md, the rows to DIR/performance.json and a plot of CPU time over
mesh size to DIR/speed.svg. Later rows of the same mesh, size and simplifier replace earlier ones.
"""

import argparse
import json
import pathlib

from results import json_lines, number, table

BASELINE = "meshoptimizer"
LAMP = {"FA-QEM (the paper's lamp)": (240e3, 1710), "Liu et al. (the paper's lamp)": (240e3, 25201)}  # seconds


def load(files):
    rows = {(row["mesh"], row["faces"], row["simplifier"]): row for file in files for row in json_lines(file)}
    return list(rows.values())


def subjects(rows):
    """Returns meshes and their sizes in the order in which they were measured."""
    return list(dict.fromkeys((row["mesh"], row["faces"]) for row in rows))


def ratio(row, base, *keys):
    for key in keys:
        if key not in row or key not in base:
            return "-"
        row, base = row[key], base[key]
    return number(row / base, 3)


def simplifiers(rows):
    lines = []
    for mesh, faces in subjects(rows):
        here = {row["simplifier"]: row for row in rows if (row["mesh"], row["faces"]) == (mesh, faces)}
        base = here.get(BASELINE, {})
        for name, row in here.items():
            if "error" in row:
                lines.append([f"{mesh}, {faces / 1e6:.3g} M", name, row["error"]] + ["-"] * 6)
                continue
            memory = row.get("peak_bytes_per_face")
            lines.append([f"{mesh}, {faces / 1e6:.3g} M", name, number(1e6 * row["file"]["cpu"] / faces, 3),
                          ratio(row, base, "file", "median"), ratio(row, base, "file", "cpu"),
                          ratio(row, base, "shuffled", "median"), ratio(row, base, "shuffled", "cpu"),
                          ratio(row, base, "chamfer"), f"{memory:.0f}" if memory else "-"])
    return table(["mesh", "simplifier", "CPU s per M faces", f"time / {BASELINE}", "CPU", "shuffled: time", "CPU", "Chamfer",
                  "B per face"], lines)


def plot(rows, file):
    from plots import plt, save

    figure, axis = plt.subplots(figsize=(5.4, 3.4))
    generated = [row for row in rows if row["mesh"] == "isosurface" and "file" in row]
    for name in dict.fromkeys(row["simplifier"] for row in generated):
        points = sorted((row["faces"], row["file"]["cpu"]) for row in generated if row["simplifier"] == name)
        style = "--" if name == BASELINE else "-"
        axis.plot([x for x, _ in points], [y for _, y in points], style, marker="o", markersize=3, label=name)
    for marker, (name, point) in zip("x+", LAMP.items()):
        axis.plot(*point, marker, color="black", label=name)
    axis.set_xscale("log")
    axis.set_yscale("log")
    axis.set_xlabel("faces, simplified to a tenth")
    axis.set_ylabel("CPU seconds")
    axis.legend(fontsize=7)
    save(figure, file)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("results", nargs="+", type=pathlib.Path)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("."))
    parser.add_argument("--no-plots", action="store_true")
    args = parser.parse_args()
    rows = load(args.results)
    args.out.mkdir(parents=True, exist_ok=True)
    text = simplifiers(rows)
    (args.out / "performance.md").write_text(text, encoding="utf-8")
    (args.out / "performance.json").write_text(json.dumps(rows, indent=1) + "\n", encoding="utf-8")
    print(text)
    if not args.no_plots:
        plot(rows, args.out / "speed.svg")


main()
