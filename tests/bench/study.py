#!/usr/bin/env python3
"""The paper's own studies with our engine: ablation, sensitivity of the weights, and the presets side by side.

Usage: study.py --runner FAQEM-BENCH [--models DIR] [--out DIR] [--max-faces N] [--no-plots]
Runs what is missing in DIR/study.jsonl, then writes DIR/study.md, DIR/study.json and DIR/study-*.svg.
"""

import argparse
import json
import os
import pathlib
import subprocess

from results import Rows, against, load, number, percent, table

RATIOS = (0.5, 0.1, 0.01)
TERMS = ("area", "plane_area", "boundary", "normal")  # in the order of the paper's table
WEIGHTS = {"area": 100, "plane_area": 1, "boundary": 500, "normal": 0.01}  # its Table 1
FACTORS = (0, 0.1, 1, 10)
# Hausdorff and Chamfer distance at 10% as the paper's ablation table prints them.
PRINTED = ((0.1970, 0.0267), (0.1404, 0.0173), (0.1230, 0.0135), (0.0910, 0.0084), (0.0800, 0.0072))


def spec(**weights):
    """Name of the preset paper with other weights than its own."""
    return "".join(["faqem-paper"] + [f":{term}={value:g}" for term, value in weights.items()
                                      if value != WEIGHTS[term]])


def ablation():
    """(label, simplifier) with one more term each time."""
    steps = [("all weights 0", spec(**{term: 0 for term in TERMS}))]
    for i, term in enumerate(TERMS):
        steps.append(("+ " + term, spec(**{later: 0 for later in TERMS[i + 1:]})))
    return steps


def sensitivity():
    """term -> [(label, simplifier)]."""
    return {term: [(f"{weight * factor:g}", spec(**{term: weight * factor})) for factor in FACTORS]
            for term, weight in WEIGHTS.items()}


def presets(runner):
    names = subprocess.run([runner, "--list"], check=True, capture_output=True, text=True).stdout.split()
    return [name for name in names if name.startswith("faqem-")]


def run(arguments, file, ours):
    names = dict.fromkeys(ours + [name for _, name in ablation()] +
                          [name for steps in sensitivity().values() for _, name in steps])
    subprocess.run([arguments.runner, "--models", arguments.models, "--max-faces", str(arguments.max_faces),
                    "--ratios", ",".join(f"{ratio:g}" for ratio in RATIOS), "--simplifiers", ",".join(names),
                    "--out", str(file)], check=True)


def means(by_ratio, name, baseline):
    """Hausdorff, Chamfer and normals for each ratio, as geometric means to the baseline."""
    cells = []
    for ratio in RATIOS:
        mean = against(by_ratio[ratio], name, baseline)["geomean"]
        cells += [mean["hausdorff"], mean["chamfer"], mean["normal_degrees"]]
    return cells


def head(first):
    return [first] + [f"{what} {percent(ratio)}" for ratio in RATIOS for what in ("H", "C", "N")]


def compared(by_ratio, steps, baseline, first):
    data = {label: means(by_ratio, name, baseline) for label, name in steps}
    return data, table(head(first), [[label] + [number(cell, 3) for cell in cells] for label, cells in data.items()])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--runner", required=True)
    parser.add_argument("--models", default=os.environ.get("FAQEM_BENCH_MODELS"))
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("."))
    parser.add_argument("--max-faces", type=int, default=100000)
    parser.add_argument("--no-plots", action="store_true")
    arguments = parser.parse_args()
    if not arguments.models:
        parser.error("give a folder of meshes: --models DIR or FAQEM_BENCH_MODELS")
    arguments.out.mkdir(parents=True, exist_ok=True)
    file = arguments.out / "study.jsonl"
    ours = presets(arguments.runner)
    run(arguments, file, ours)
    rows = load([file])
    by_ratio = {ratio: Rows(rows, ratio) for ratio in RATIOS}
    meshes = {mesh for _, mesh, _ in rows}

    steps = ablation()
    ablated, ablation_text = compared(by_ratio, steps, steps[0][1], "terms")
    printed = table(["terms", "H 10% in the paper", "C 10% in the paper"],
                    [[label, number(h / PRINTED[0][0], 3), number(c / PRINTED[0][1], 3)]
                     for (label, _), (h, c) in zip(steps, PRINTED)])
    text = [f"{len(meshes)} meshes with at most {arguments.max_faces} faces. H Hausdorff, C Chamfer, N normals: geometric "
            "means of per-mesh ratios, over the meshes where both are on target; below 1 is better.\n",
            "## Ablation\n", "To the composite metric with all weights 0.\n", ablation_text,
            "The paper's own table, as ratios to its first row:\n", printed, "## Sensitivity\n",
            "Preset `paper` with one weight changed, to the preset as it is.\n"]
    sensitive, panels = {}, {}
    for term, steps in sensitivity().items():
        sensitive[term], one = compared(by_ratio, steps, "faqem-paper", term)
        text.append(one)
        panels[term] = ([label for label, _ in steps],
                        {f"Chamfer {percent(ratio)}": [cells[3 * i + 1] for cells in sensitive[term].values()]
                         for i, ratio in enumerate(RATIOS)})
    if not arguments.no_plots:
        import plots  # only here: the tables need no plotting library
        plots.lines(arguments.out / "study-sensitivity.svg", panels, "Sensitivity of the paper's weights",
                    "ratio to the preset")
        text.append("![sensitivity](study-sensitivity.svg)\n")
    side_by_side, presets_text = compared(by_ratio, [(name, name) for name in ours], "faqem-stmw", "preset")
    text += ["## Presets\n", "To `stmw`.\n", presets_text]
    (arguments.out / "study.md").write_text("\n".join(text), encoding="utf-8")
    data = {"ratios": RATIOS, "columns": ["hausdorff", "chamfer", "normal_degrees"], "ablation": ablated,
            "sensitivity": sensitive, "presets": side_by_side}
    (arguments.out / "study.json").write_text(json.dumps(data, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
