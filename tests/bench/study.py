#!/usr/bin/env python3
"""Repeats the studies of the paper: ablation, sensitivity of the weights, and comparison of the presets.

Usage: study.py --runner FAQEM-BENCH [--models DIR] [--tool FAQEM --textured DIR] [--out DIR] [--max-faces N]
                [--max-textured N] [--samples N] [--no-plots]
Measures the rows that are missing in DIR/study.jsonl, and with --textured in DIR/study-textured.jsonl, then writes
DIR/study.md, DIR/study.json and DIR/study-*.svg.
"""

import argparse
import json
import os
import pathlib
import subprocess

import textured
from results import Rows, against, load, number, percent, table

RATIOS = (0.5, 0.1, 0.01)
TERMS = ("area", "plane_area", "boundary", "normal")  # in the order of the paper's table
WEIGHTS = {"area": 100, "plane_area": 1, "boundary": 500, "normal": 0.01}  # Table 1 of the paper
FACTORS = (0, 0.1, 1, 10)
# Hausdorff, Chamfer and texture Chamfer distance at 10% in the ablation table of the paper.
PRINTED = ((0.1970, 0.0267, 0.1141), (0.1404, 0.0173, 0.1115), (0.1230, 0.0135, 0.1109), (0.0910, 0.0084, 0.1035),
           (0.0800, 0.0072, 0.0990))
# Hausdorff and Chamfer distance at 10% and at 1% in the comparison table of the paper.
PRINTED_RANKING = {"faqem-qem": (0.13, 0.46, 0.57, 1.37), "faqem-stmw": (0.10, 0.29, 0.44, 1.11),
                   "faqem-paper": (0.08, 0.0072, 0.25, 0.0173)}


def spec(**weights):
    """Returns the name of the preset `paper` with other weights, as a simplifier of faqem-bench."""
    return "".join(["faqem-paper"] + [f":w-{term.replace('_', '-')}={value:g}" for term, value in weights.items()
                                      if value != WEIGHTS[term]])


def ablation_weights():
    """Returns a list of (label, weights), where each entry has one more term than the previous one."""
    steps = [("all weights 0", {term: 0 for term in TERMS})]
    for i, term in enumerate(TERMS):
        steps.append(("+ " + term, {t: WEIGHTS[t] if t in TERMS[:i + 1] else 0 for t in TERMS}))
    return steps


def ablation():
    """Returns a list of (label, simplifier)."""
    return [(label, spec(**weights)) for label, weights in ablation_weights()]


def sensitivity():
    """Returns term -> [(label, simplifier)]."""
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
                    "--samples", str(arguments.samples), "--out", str(file)], check=True)


def means(by_ratio, name, baseline):
    """Returns Hausdorff, Chamfer and normal deviation for each ratio, as geometric means of ratios to the baseline."""
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


def split(rows):
    """Returns the rows of the meshes with boundary edges, and of those without."""
    meshes = {mesh: row["input"]["boundary_edges"] > 0 for (_, mesh, _), row in rows.items()}
    return {name: {key: row for key, row in rows.items() if meshes[key[1]] == is_open}
            for name, is_open in (("open", True), ("closed", False))}


def ablation_section(arguments, rows, by_ratio):
    """Returns text and data: all meshes at all ratios; open and closed meshes, colours and the values of the paper at
    10%."""
    steps = ablation()
    labels = [label for label, _ in steps]
    ablated, text = compared(by_ratio, steps, steps[0][1], "terms")
    columns = {"all": [cells[3:5] for cells in ablated.values()]}
    for name, part in split(rows).items():
        one = Rows(part, 0.1)
        columns[name] = [[against(one, spec_, steps[0][1])["geomean"][key] for key in ("hausdorff", "chamfer")]
                         for _, spec_ in steps]
        columns[name + " meshes"] = len(one.meshes)
    paper = [[value / first for value, first in zip(line, PRINTED[0])] for line in PRINTED]
    colours, whole, left_out = {label: None for label in labels}, [], {}
    if arguments.textured:
        colours, whole, left_out = textured.against_first(
            textured.measure_all(arguments, ablation_weights(), arguments.out / "study-textured.jsonl"), labels)
    head_ = ["terms, 10%", "H open", "C open", "H closed", "C closed", "colour RMSE", "paper: H", "C", "texture"]
    lines = [[label] + [number(x, 3) for x in (*columns["open"][i], *columns["closed"][i], colours[label], *paper[i])]
             for i, label in enumerate(labels)]
    text = ["## Ablation\n", "Relative to the composite metric with all weights 0.\n", text,
            f"{columns['open meshes']} meshes with boundary, {columns['closed meshes']} without; colours of "
            f"{len(whole)} textured models of {textured.LEAST_FACES} to {arguments.max_textured} faces; and the table "
            "of the paper, relative to its first row:\n",
            table(head_, lines)]
    if left_out:
        excluded = ", ".join(f"`{name}` ({why})" for name, why in left_out.items())
        text.append(f"Excluded from colours: {excluded}.\n")
    if not arguments.no_plots:
        import plots  # imported here, because the tables do not need matplotlib
        short = ["none"] + ["+" + term for term in TERMS]
        panels = {what: (short, {"the paper's table": [line[i] for line in paper]} |
                         {name + " meshes": [cells[i] for cells in columns[name]] for name in ("open", "closed")})
                  for i, what in enumerate(("Hausdorff", "Chamfer"))}
        panels["colours"] = (short, {"the paper's table": [line[2] for line in paper],
                                     "textured models": [colours[label] for label in labels]})
        plots.lines(arguments.out / "study-ablation.svg", panels, "Ablation at 10%", "ratio to all weights 0")
        text.append("![ablation](study-ablation.svg)\n")
    return text, {"all": ablated, **columns, "colours": colours, "paper": paper, "without_colours": left_out}


def sensitivity_section(arguments, by_ratio):
    text = ["## Sensitivity\n", "Preset `paper` with one weight changed, relative to the unchanged preset.\n"]
    data, panels = {}, {}
    for term, steps in sensitivity().items():
        data[term], one = compared(by_ratio, steps, "faqem-paper", term)
        text.append(one)
        panels[term] = ([label for label, _ in steps],
                        {f"Chamfer {percent(ratio)}": [cells[3 * i + 1] for cells in data[term].values()]
                         for i, ratio in enumerate(RATIOS)})
    if not arguments.no_plots:
        import plots  # imported here, because the tables do not need matplotlib
        plots.lines(arguments.out / "study-sensitivity.svg", panels, "Sensitivity of the paper's weights",
                    "ratio to the preset")
        text.append("![sensitivity](study-sensitivity.svg)\n")
    return text, data


def averages(rows, names):
    """Returns arithmetic means of Hausdorff and Chamfer, as in the paper, over meshes where all are on target."""
    meshes = [mesh for mesh in rows.meshes if all(rows.hit(mesh, name) for name in names)]
    return len(meshes), {name: [sum(rows.get(mesh, name)[key] for mesh in meshes) / max(len(meshes), 1)
                                for key in ("hausdorff", "chamfer")] for name in names}


def ranking_section(by_ratio, ours):
    data, text = compared(by_ratio, [(name, name) for name in ours], "faqem-stmw", "preset")
    means = {ratio: averages(by_ratio[ratio], ours) for ratio in (0.1, 0.01)}
    lines = []
    for name in ours:
        cells = [means[ratio][1][name][i] * scale for ratio in means for i, scale in ((0, 1e3), (1, 1e5))]
        printed = [value / of for value, of in zip(PRINTED_RANKING[name], PRINTED_RANKING["faqem-stmw"])] \
            if name in PRINTED_RANKING else [None] * 4
        lines.append([name] + [number(x, 3) for x in cells + printed])
    head_ = ["preset", "H 10%, 1e-3", "C 10%, 1e-5", "H 1%, 1e-3", "C 1%, 1e-5",
             "paper: H 10%", "C 10%", "H 1%", "C 1%"]
    counts = " and ".join(f"{count} meshes at {percent(ratio)}" for ratio, (count, _) in means.items())
    return ["## Presets\n", "Relative to `stmw`.\n", text,
            f"Arithmetic means, as in the paper, over meshes where all are on target: {counts}. Relative to the "
            "diagonal and its square. The values of the paper are ratios to its row of Liu et al.:\n",
            table(head_, lines)], {"to_stmw": data, "means": means}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--runner", required=True)
    parser.add_argument("--models", default=os.environ.get("FAQEM_BENCH_MODELS"))
    parser.add_argument("--tool")
    parser.add_argument("--textured", default=os.environ.get("FAQEM_BENCH_TEXTURED"))
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("."))
    parser.add_argument("--max-faces", type=int, default=25000)
    parser.add_argument("--max-textured", type=int, default=60000, help="maximum face count of textured models")
    parser.add_argument("--samples", type=int, default=20000, help="samples per direction of each comparison")
    parser.add_argument("--no-plots", action="store_true")
    arguments = parser.parse_args()
    if not arguments.models:
        parser.error("no directory of meshes: use --models DIR or set FAQEM_BENCH_MODELS")
    if arguments.textured and not arguments.tool:
        parser.error("--textured requires --tool FAQEM")
    arguments.out.mkdir(parents=True, exist_ok=True)
    file = arguments.out / "study.jsonl"
    ours = presets(arguments.runner)
    run(arguments, file, ours)
    rows = load([file])
    by_ratio = {ratio: Rows(rows, ratio) for ratio in RATIOS}
    meshes = {mesh for _, mesh, _ in rows}
    ablation_text, ablation_data = ablation_section(arguments, rows, by_ratio)
    sensitivity_text, sensitivity_data = sensitivity_section(arguments, by_ratio)
    ranking_text, ranking_data = ranking_section(by_ratio, ours)
    text = [f"{len(meshes)} meshes with at most {arguments.max_faces} faces, {arguments.samples} samples per "
            "direction. H: Hausdorff, C: Chamfer, N: normal deviation; geometric means of per-mesh ratios over the "
            "meshes where both are on target; below 1 is better.\n",
            *ablation_text, *sensitivity_text, *ranking_text]
    (arguments.out / "study.md").write_text("\n".join(text), encoding="utf-8")
    data = {"ratios": RATIOS, "columns": ["hausdorff", "chamfer", "normal_degrees"], "ablation": ablation_data,
            "sensitivity": sensitivity_data, "presets": ranking_data}
    (arguments.out / "study.json").write_text(json.dumps(data, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
