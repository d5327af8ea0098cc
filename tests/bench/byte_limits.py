#!/usr/bin/env python3
"""Prints the results of `faqem simplify --max-bytes` for a model and several limits, each as a line of JSON.

Usage: tests/bench/byte_limits.py FAQEM MODEL --bytes N,N... [--options=OPTIONS]
"""

import argparse
import json
import subprocess
import sys
import tempfile
from pathlib import Path


def report(arguments, limit, folder):
    """Runs the command with a limit. Returns its report."""
    file = Path(folder) / "report.json"
    subprocess.run([arguments.faqem, "simplify", arguments.model, str(Path(folder) / "out.glb"), "--force", "--quiet",
                    "--max-bytes", str(limit), "--report", str(file), *arguments.options.split()], check=True)
    return json.loads(file.read_text())


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("faqem")
    parser.add_argument("model")
    parser.add_argument("--bytes", required=True, type=lambda text: [int(n) for n in text.split(",")])
    parser.add_argument("--options", default="--profile web")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        for limit in arguments.bytes:
            compared = report(arguments, limit, folder)["compared_results"]
            best = max(compared, key=lambda point: point["psnr"])
            print(json.dumps({"limit": limit, **best}), flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
