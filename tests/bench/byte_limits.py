#!/usr/bin/env python3
"""Draws what `faqem simplify --max-bytes` tries for a model, and its results for several limits.

Usage: tests/bench/byte_limits.py FAQEM MODEL --bytes N,N... --out FILE.svg [--options=OPTIONS]

The trials are those of the report of the last limit. A line of JSON for each result is printed.
"""

import argparse
import json
import subprocess
import sys
import tempfile
from pathlib import Path

import plots


def report(arguments, limit, folder):
    """Runs the command with a limit. Returns its report."""
    file = Path(folder) / "report.json"
    subprocess.run([arguments.faqem, "simplify", arguments.model, str(Path(folder) / "out.glb"), "--force", "--quiet",
                    "--max-bytes", str(limit), "--report", str(file), *arguments.options.split()], check=True)
    return json.loads(file.read_text())


def curve(report, kind):
    """The trials of a kind as a line of (bytes, dB)."""
    return [(trial["bytes"], trial["psnr"]) for trial in report["size_trials"] if trial["kind"] == kind]


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
        for limit in arguments.bytes:
            last = report(arguments, limit, folder)
            best = max(last["compared_results"], key=lambda point: point["psnr"])
            results.append((best["bytes"], best["psnr"]))
            print(json.dumps({"limit": limit, **best}), flush=True)
    plots.byte_limits(arguments.out, {"faces": curve(last, "faces"), "images": curve(last, "images")}, results)
    return 0


if __name__ == "__main__":
    sys.exit(main())
