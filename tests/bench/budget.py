#!/usr/bin/env python3
"""Draws what `faqem simplify --max-bytes` tries for a model, and its results for several budgets.

Usage: tests/bench/budget.py FAQEM MODEL --bytes N,N... --out FILE.svg [--options=OPTIONS]

The trials are those of the report of the last budget. A line of JSON for each result is printed.
"""

import argparse
import json
import subprocess
import sys
import tempfile
from collections import defaultdict
from pathlib import Path

import plots


def report(arguments, budget, folder):
    """Runs the command with a budget. Returns its report."""
    file = Path(folder) / "report.json"
    subprocess.run([arguments.faqem, "simplify", arguments.model, str(Path(folder) / "out.glb"), "--force", "--quiet",
                    "--max-bytes", str(budget), "--report", str(file), *arguments.options.split()], check=True)
    return json.loads(file.read_text())


def trials_of(report, kind):
    return [trial for trial in report["budget_trials"] if trial["kind"] == kind]


def curves(report):
    """The trials as lines of (bytes, dB): faces with the images of the model, and images on all faces by their side."""
    result = {"faces": [(t["bytes"], t["psnr"]) for t in trials_of(report, "faces")]}
    by_side = defaultdict(list)
    for trial in trials_of(report, "images"):
        by_side[trial["image_side"]].append((trial["bytes"], trial["psnr"]))
    for side, points in sorted(by_side.items()):
        result[f"images, {side} texels"] = sorted(points)
    return result


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("faqem")
    parser.add_argument("model")
    parser.add_argument("--bytes", required=True, type=lambda text: [int(n) for n in text.split(",")])
    parser.add_argument("--out", required=True)
    parser.add_argument("--options", default="--profile web")
    arguments = parser.parse_args()
    results, last = [], None
    with tempfile.TemporaryDirectory() as folder:
        for budget in arguments.bytes:
            last = report(arguments, budget, folder)
            best = max(last["budget_points"], key=lambda point: point["psnr"])
            results.append((best["bytes"], best["psnr"]))
            print(json.dumps({"budget": budget, **best}), flush=True)
    plots.budget(arguments.out, curves(last), results)
    return 0


if __name__ == "__main__":
    sys.exit(main())
