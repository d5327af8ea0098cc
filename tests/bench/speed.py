#!/usr/bin/env python3
"""Writes tables and a plot of the results of faqem-bench-speed.

Usage: speed.py [--out DIR] [--no-plots] SPEED.jsonl...
Prints the tables and writes them to DIR/performance.md, the rows to DIR/performance.json and a plot of CPU time over
mesh size to DIR/speed.svg. Later rows of the same mesh, size and simplifier replace earlier ones.
"""

import argparse
import json
import pathlib

from results import number, table

BASELINE = "meshoptimizer"
LAMP = {"FA-QEM (the paper's lamp)": (240e3, 1710), "Liu et al. (the paper's lamp)": (240e3, 25201)}  # seconds


def load(files):
    rows = {}
    for file in files:
        for line in pathlib.Path(file).read_text(encoding="utf-8").splitlines():
            row = json.loads(line)
            key = [row.get(k) for k in ("section", "mesh", "faces", "simplifier", "format", "uvs", "preset", "samples")]
            rows[tuple(key)] = row
    return list(rows.values())


def section(rows, name):
    return [row for row in rows if row["section"] == name]


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


def files(rows):
    lines = []
    for row in rows:
        line = [row["format"], "yes" if row["uvs"] else "no", number(row["megabytes"], 3)]
        for way in ("load", "save"):
            line += [number(row[way]["median"], 3)]
            line += [f"{row['megabytes'] / row[way][kind]:.0f}" for kind in ("median", "cpu")]
        lines.append(line)
    return table(["format", "UVs", "MB", "load s", "MB/s", "MB per CPU s", "save s", "MB/s", "MB per CPU s"], lines)


def pipeline(rows):
    phases = ["load", "weld", "simplify", "map", "bake", "save", "total"]
    return table(["preset", "samples"] + phases + ["CPU"],
                 [[row["preset"], f"{row['samples']}x{row['samples']}"] +
                  [number(row["phases"][phase], 3) for phase in phases] + [number(row["cpu"], 3)] for row in rows])


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
    parts = [("simplify", "Simplifying", simplifiers), ("files", "Files", files), ("pipeline", "Phases", pipeline)]
    text = "\n".join(f"## {title}\n\n{make(section(rows, name))}\n" for name, title, make in parts if section(rows, name))
    (args.out / "performance.md").write_text(text, encoding="utf-8")
    (args.out / "performance.json").write_text(json.dumps(rows, indent=1) + "\n", encoding="utf-8")
    print(text)
    if not args.no_plots and section(rows, "simplify"):
        plot(section(rows, "simplify"), args.out / "speed.svg")


main()
