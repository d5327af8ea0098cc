#!/usr/bin/env python3
"""Compares two builds of faqem-bench-speed, which run in turn because the speed of the machine varies.

Usage: speed_turns.py OLD NEW [--turns N] [-- OPTION...]     options of faqem-bench-speed, for example --sizes 10000,80000
Prints the elapsed time of NEW for file order and shuffled, relative to OLD, and to meshoptimizer if that is measured.
Every time is the least of N turns (4), because other work on the machine only makes runs slower.
"""

import argparse
import pathlib
import subprocess
import sys
import tempfile

from results import json_lines, number, table

BASELINE = "meshoptimizer"


def measure(program, options, least):
    """Runs a build once, and lowers the times in `least`, by mesh, faces, simplifier and order."""
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder, "rows.jsonl")
        subprocess.run([program, *options, "--out", out], check=True, stdout=subprocess.DEVNULL)
        for row in json_lines(out):
            for order in ("file", "shuffled"):
                if order in row:
                    key = row["mesh"], row["faces"], row["simplifier"], order
                    least[key] = min(least.get(key, float("inf")), row[order]["median"])


def main():
    parser = argparse.ArgumentParser(usage=__doc__.split("Usage: ")[1])
    parser.add_argument("old")
    parser.add_argument("new")
    parser.add_argument("--turns", type=int, default=4)
    end = sys.argv.index("--") if "--" in sys.argv else len(sys.argv)
    given, options = parser.parse_args(sys.argv[1:end]), sys.argv[end + 1:]
    old, new = {}, {}
    for _ in range(given.turns):
        measure(given.old, options, old)
        measure(given.new, options, new)
    lines = []
    for (mesh, faces, name, order), seconds in new.items():
        before, base = old.get((mesh, faces, name, order)), new.get((mesh, faces, BASELINE, order))
        lines.append([f"{mesh}, {faces}", name, order, number(seconds, 3), number(seconds / before, 3) if before else "-",
                      number(seconds / base, 3) if base else "-"])
    print(table(["mesh", "simplifier", "order", "seconds", "new / old", f"new / {BASELINE}"], lines))


if __name__ == "__main__":
    main()
