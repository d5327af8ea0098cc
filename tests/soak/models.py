"""Simplifies all models of a folder with every preset at several ratios, and bakes each model once.

Crashes and invalid results are failures. Usage: models.py TOOL FOLDER [--seconds N] [--only NAME...] [--record FILE];
meant for the tool of a build with sanitizers (CMake preset `sanitize` or `fuzz`). The smallest files come first. If the
program is interrupted, it prints the table of the completed runs; with --record the next call continues from there.
"""

import argparse
import collections
import json
import os
import pathlib
import signal
import subprocess
import tempfile

KINDS = (".glb", ".gltf", ".obj", ".ply", ".stl", ".off")
PRESETS = ("qem", "paper", "stmw", "fast", "balanced", "best")
RATIOS = (0.1, 0.01, 0.001, 1)
BAKED = "--ratio 0.1 --texture-size 256"
COLUMNS = ("tried", "refused", "on target", "stopped above", "repaired", "not finished", "failed")
REFUSED = (3, 4)  # exit codes: bad input, unsupported input


def run(*words, seconds):
    """Runs a command. Returns standard output, standard error and the exit code; the code is None after a timeout."""
    suppressions = pathlib.Path(__file__).resolve().parent.parent / "support/lsan-suppressions.txt"
    environment = {**os.environ, "LSAN_OPTIONS": f"suppressions={suppressions}:print_suppressions=0"}
    try:
        done = subprocess.run([*map(str, words)], capture_output=True, text=True, timeout=seconds, env=environment,
                              errors="replace")
    except subprocess.TimeoutExpired:
        return "", "", None
    return done.stdout, done.stderr, done.returncode


def fault(arguments, report, out, ratio):
    """Checks the result of a run. Returns a description of the fault, or an empty string."""
    if (report["faces_out"] <= report["target_faces"]) != (report["stop_reason"] == "reached_target"):
        return "the stop reason does not fit the face count"
    if report["faces_out"] == 0:
        return "the result is empty"
    if ratio == 1 and report["collapses"] > 0:
        return "there were collapses at ratio 1"
    if report["faces_dropped"] > 0 and not report["warnings"]:
        return "faces were removed without a warning"
    text, errors, code = run(arguments.tool, "info", out, "--json", seconds=arguments.seconds)
    if code != 0:
        return f"the output cannot be read: {last_line(errors)}"
    total = json.loads(text)["total"]
    faces = total["faces"] + total["degenerate_faces"]  # rounding to float can make faces degenerate
    return "" if faces >= report["faces_out"] else f"the output has {faces} faces, the report {report['faces_out']}"


def last_line(errors):
    """The most informative line of standard error."""
    lines = [line for line in errors.splitlines() if line.strip()]
    important = [line for line in lines if line.startswith(("SUMMARY:", "faqem:")) or "runtime error" in line]
    return (important or lines or ["no message"])[0]


def judge(arguments, file, options, ratio, row):
    """Runs the tool once and updates the counts in `row`. Returns a description of the fault, or an empty string."""
    with tempfile.TemporaryDirectory() as folder:
        out, report = pathlib.Path(folder) / "out.glb", pathlib.Path(folder) / "report.json"
        _, errors, code = run(arguments.tool, "simplify", file, out, *options.split(), "--report", report, "--quiet",
                              seconds=arguments.seconds)
        row["tried"] += 1
        if code is None:
            row["not finished"] += 1
            return ""
        if code in REFUSED and errors.startswith(f"faqem: {file}: "):
            row["refused"] += 1
            return ""
        if code != 0:
            return f"exit code {code}: {last_line(errors)}"
        result = json.loads(report.read_text(encoding="utf-8"))
        row["on target" if result["stop_reason"] == "reached_target" else "stopped above"] += 1
        row["repaired"] += result["faces_dropped"] > 0
        return fault(arguments, result, out, ratio)


def load(record):
    """Entries of earlier runs by file and options."""
    if not record or not record.exists():
        return {}
    entries = map(json.loads, record.read_text(encoding="utf-8").splitlines())
    return {(entry["file"], entry["options"]): entry for entry in entries}


def try_one(arguments, file, options, ratio):
    """Runs the tool once. Returns the entry for the record: file, options, counts and fault."""
    row = collections.Counter()
    found = judge(arguments, file, options, ratio, row)
    row["failed"] += found != ""
    return {
        "file": str(file.relative_to(arguments.folder)),
        "options": options,
        "counts": {column: count for column, count in row.items() if count},
        "found": "not finished" if row["not finished"] else found,
    }


def size(file):
    """Size of a model in bytes, for .gltf including its buffers."""
    buffers = file.parent.rglob("*.bin") if file.suffix.lower() == ".gltf" else ()
    return sum(part.stat().st_size for part in (file, *buffers))


def models(folder):
    """The models of a folder, the smallest first."""
    found = [file for file in pathlib.Path(folder).rglob("*") if file.suffix.lower() in KINDS and file.is_file()]
    return sorted(found, key=lambda file: (size(file), file))


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("tool")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--seconds", type=float, default=120, help="limit for one run (default 120)")
    parser.add_argument("--only", nargs="+", help="names of the files to run")
    parser.add_argument("--record", type=pathlib.Path, help="file of completed runs, which are not repeated")
    arguments = parser.parse_args()
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    work = [(preset, ratio, f"--preset {preset} --ratio {ratio} --bake none") for ratio in RATIOS for preset in PRESETS]
    work.append(("balanced, baked", 0.1, BAKED))
    files = [file for file in models(arguments.folder) if not arguments.only or file.name in arguments.only]
    done = load(arguments.record)
    rows = collections.defaultdict(collections.Counter)
    refused = {}
    seen = {}
    try:
        for file, (name, ratio, options) in ((file, item) for file in files for item in work):
            entry = done.get((str(file.relative_to(arguments.folder)), options))
            if entry is None:
                entry = try_one(arguments, file, options, ratio)
                if arguments.record:
                    with arguments.record.open("a", encoding="utf-8") as out:
                        out.write(json.dumps(entry) + "\n")
            rows[name].update(entry["counts"])
            seen[file] = True
            if entry["found"]:
                print(f"{file} {options}: {entry['found']}", flush=True)
            if "refused" in entry["counts"]:
                refused[file.name] = True
    except KeyboardInterrupt:
        print("interrupted", flush=True)
    print(f"models: {len(seen)} of {len(files)}, refused: {', '.join(refused) or 'none'}")
    print("| preset |", " | ".join(COLUMNS), "|")
    print("|---" * (len(COLUMNS) + 1) + "|")
    for name, row in rows.items():
        print(f"| {name} |", " | ".join(str(row[column]) for column in COLUMNS), "|")
    return 1 if any(row["failed"] for row in rows.values()) else 0


if __name__ == "__main__":
    raise SystemExit(main())
