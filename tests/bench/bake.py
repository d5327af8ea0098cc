"""Measures the seconds of the baker's stages on textured models, by number of threads, and compares builds in turn.

Prints a table as Markdown: seconds of map and bake, the CPU seconds of the whole command, and with --baseline the
ratio to another build of the command. Every number is the least of --runs runs, which alternate between the builds,
because other work on the machine only makes runs slower. With --same the bytes of the two builds are compared."""

import argparse
import json
import os
import pathlib
import statistics
import sys
import tempfile

from results import models, run

BAKE = ["--bake", "atlas", "--texture-size", "2048", "--normal-map", "off", "--image-format", "png"]


def measured(program, model, out, ratio, threads, extra):
    """Runs one command. Returns its seconds by stage, its CPU seconds and texels of pages."""
    report = out.with_suffix(".json")
    made, cpu = run(program, "simplify", model, out, "--ratio", ratio, "--threads", threads, "--report", report, "--force",
                    "--quiet", *BAKE, *extra)
    if made.returncode != 0:
        sys.exit(f"{model}: {made.stderr.strip()}")
    content = json.loads(report.read_text(encoding="utf-8"))
    texels = sum(page["width"] * page["height"] for page in content.get("pages", []))
    return {"map": content["seconds"]["map"], "bake": content["seconds"]["bake"], "cpu": cpu, "texels": texels}


def accepts(program, option):
    """Whether a build knows an option."""
    return option in run(program, "simplify", "--help-all")[0].stdout


def best(runs):
    return {key: min(row[key] for row in runs) for key in runs[0]}


def measure(arguments, model, ratio, threads, folder):
    """Returns the rows of the builds, and whether their files are the same."""
    builds = [arguments.tool] + ([arguments.baseline] if arguments.baseline else [])
    runs = [[] for _ in builds]
    outs = [folder / f"{index}.glb" for index in range(len(builds))]
    for _ in range(arguments.runs):
        for index, program in enumerate(builds):
            extra = ["--allow-larger"] if accepts(program, "--allow-larger") else []
            runs[index].append(measured(program, model, outs[index], ratio, threads, extra))
    return [best(rows) for rows in runs], len({out.read_bytes() for out in outs}) == 1


def row_of(name, ratio, threads, rows, same):
    own = rows[0]
    cells = [name, f"{ratio:g}", threads, f"{own['map']:.2f}", f"{own['bake']:.2f}", f"{own['cpu']:.1f}",
             f"{own['texels'] / 2**20:.1f}"]
    if len(rows) > 1:
        cells += [f"{relative(rows):.2f}", f"{own['cpu'] / rows[1]['cpu']:.2f}", "yes" if same else "no"]
    return "| " + " | ".join(map(str, cells)) + " |"


def relative(rows):
    """Map and bake of the first build over those of the second one; per texel if their pages differ in size."""
    seconds = [row["map"] + row["bake"] for row in rows]
    if rows[0]["texels"] != rows[1]["texels"]:
        seconds = [time / max(row["texels"], 1) for time, row in zip(seconds, rows)]
    return seconds[0] / seconds[1]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("tool", type=pathlib.Path, help="the command faqem")
    parser.add_argument("models", type=pathlib.Path, nargs="*",
                        help="textured models; default: those in the directory FAQEM_BENCH_TEXTURED")
    parser.add_argument("--baseline", type=pathlib.Path, help="another build of the command, to compare with")
    parser.add_argument("--ratios", type=float, nargs="+", default=[0.1, 0.01])
    parser.add_argument("--threads", type=int, nargs="+", default=[1, os.cpu_count()])
    parser.add_argument("--runs", type=int, default=3)
    arguments = parser.parse_args()
    if not arguments.models and "FAQEM_BENCH_TEXTURED" not in os.environ:
        parser.error("no models: pass some or set FAQEM_BENCH_TEXTURED")
    arguments.tool = arguments.tool.resolve()
    arguments.baseline = arguments.baseline and arguments.baseline.resolve()
    columns = ["model", "ratio", "threads", "map s", "bake s", "CPU s", "Mtexels"]
    if arguments.baseline:
        columns += ["map + bake / baseline", "CPU / baseline", "same bytes"]
    print("| " + " | ".join(columns) + " |")
    print("|---" + "|---:" * (len(columns) - 1) + "|", flush=True)
    ratios = []
    with tempfile.TemporaryDirectory() as folder:
        for model in arguments.models or models(pathlib.Path(os.environ["FAQEM_BENCH_TEXTURED"])):
            for ratio in arguments.ratios:
                for threads in dict.fromkeys(arguments.threads):
                    rows, same = measure(arguments, model, ratio, threads, pathlib.Path(folder))
                    print(row_of(model.stem, ratio, threads, rows, same), flush=True)
                    if len(rows) > 1:
                        ratios.append(relative(rows))
    if ratios:
        print(f"\nmap + bake / baseline: median {statistics.median(ratios):.2f}, largest {max(ratios):.2f}")


if __name__ == "__main__":
    main()
