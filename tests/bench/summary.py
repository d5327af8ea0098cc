#!/usr/bin/env python3
"""Writes tables, plots and a JSON summary of the results of faqem-bench.

Usage: summary.py [--baseline NAME] [--out DIR] [--no-plots] RESULTS.jsonl...
Writes DIR/quality.md, DIR/quality.json and DIR/quality-*.svg, and prints the two main tables. Rows in later files
replace those of the same mesh, ratio and simplifier in earlier ones.
"""

import argparse
import json
import pathlib
from collections import Counter

from results import FLOORS, Rows, against, floored, geomean, load, median, number, percent, table

TIE = 1.001  # smaller differences are due to sampling and rounding
MEASURES = [("hausdorff", "Hausdorff"), ("chamfer", "Chamfer"), ("normal_degrees", "normals"), ("seconds", "time")]


def is_ours(name):
    return name.startswith("faqem-")


def ratios_to_baseline(rows, baseline):
    results = {name: against(rows, name, baseline) for name in rows.simplifiers}
    lines = []
    for name, result in results.items():
        mean = result["geomean"]
        lines.append([name, result["meshes"]] +
                     [number(mean[key], 3) for key in ("hausdorff", "chamfer", "normal_degrees", "seconds",
                                                       "seconds_to_core", "cpu_seconds")])
    head = ["to " + baseline, "meshes", "Hausdorff", "Chamfer", "normals", "time", "time / its core", "CPU time"]
    return results, table(head, lines)


def absolute(rows):
    lines = []
    for name in rows.simplifiers:
        hits = [row for row in (rows.hit(mesh, name) for mesh in rows.meshes) if row]
        lines.append([name, len(hits)] +
                     [number(median(row[key] * scale for row in hits), 3)
                      for key, scale in (("hausdorff", 1e3), ("chamfer", 1e7), ("normal_degrees", 1))] +
                     [number(median(1e6 * row["seconds"] / row["input"]["faces"] for row in hits), 3)])
    return table(["median", "meshes", "Hausdorff 1e-3", "Chamfer 1e-7", "normals degrees", "s per 1e6 faces"], lines)


def wins(rows, name):
    """Counts the meshes where a preset is at or below the best peer, including results below the target face count."""
    result = {"meshes": 0, "lost": {}}
    counts = Counter()
    for mesh in rows.meshes:
        if not rows.get(mesh, name):
            continue
        peers = [row for row in (rows.not_above(mesh, peer) for peer in rows.simplifiers if not is_ours(peer)) if row]
        if not peers:
            continue
        result["meshes"] += 1
        row = rows.not_above(mesh, name)
        if not row:
            result["lost"][mesh] = rows.why_not(mesh, name)
            continue
        lost = []
        for key, label in MEASURES[:2]:
            best = min(peers, key=lambda peer: floored(peer, key))
            factor = floored(row, key) / floored(best, key)
            counts[key] += factor <= TIE
            if factor > TIE:
                lost.append(f"{label} {number(factor, 3)}x {best['simplifier']}")
        counts["both"] += not lost
        if lost:
            result["lost"][mesh] = ", ".join(lost)
    for key in ("hausdorff", "chamfer", "both"):
        result[key] = counts[key] / result["meshes"] if result["meshes"] else None
    return result


def share(value):
    return "-" if value is None else f"{100 * value:.0f}%"


def wins_tables(rows):
    results = {name: wins(rows, name) for name in rows.simplifiers if is_ours(name)}
    text = table(["at or below the best peer", "meshes", "Hausdorff", "Chamfer", "both"],
                 [[name, r["meshes"], share(r["hausdorff"]), share(r["chamfer"]), share(r["both"])]
                  for name, r in results.items()])
    return results, text


def robustness(rows, name):
    count = Counter()
    rungs, ladder_meshes = Counter(), []
    for mesh in rows.meshes:
        row = rows.get(mesh, name)
        if not row:
            continue
        count["meshes"] += 1
        count["on_target"] += bool(rows.hit(mesh, name))
        count["failed"] += row["status"] != "ok"
        if "output" not in row:
            continue
        before, after = row["input"], row["output"]
        count["above"] += not rows.not_above(mesh, name)
        for key in ("foldovers", "nonmanifold_edges", "flat_faces"):
            count[key] += max(0, after[key] - before[key])
        if before["boundary_edges"] == 0 and before["nonmanifold_edges"] == 0:
            count["closed"] += 1
            count["kept_closed"] += all(after[key] == before[key]
                                        for key in ("boundary_edges", "nonmanifold_edges", "euler"))
        taken = {rung: n for rung, n in row.get("report", {}).get("rungs", {}).items() if n and rung != "reseed"}
        rungs.update(taken)
        if taken:
            ladder_meshes.append(mesh)
    return {**count, "rungs": dict(rungs), "ladder_meshes": ladder_meshes}


def robustness_table(rows):
    results = {name: robustness(rows, name) for name in rows.simplifiers}
    lines = []
    for name, r in results.items():
        lines.append([name, r.get("meshes", 0), r.get("on_target", 0), r.get("above", 0), r.get("failed", 0),
                      r.get("foldovers", 0), r.get("nonmanifold_edges", 0), r.get("flat_faces", 0),
                      f"{r.get('kept_closed', 0)} of {r.get('closed', 0)}",
                      len(r["ladder_meshes"]) if is_ours(name) else "-"])
    head = ["", "meshes", "on target", "above it", "no result", "new foldovers", "new non-manifold edges",
            "new faces of zero area", "closed manifold, same Euler number", "meshes that needed the ladder"]
    return results, table(head, lines)


def border(rows, name, baseline):
    """Compares the distance between boundaries with that between surfaces and with that of the baseline."""
    measured, within, lost, worse, ratios = 0, 0, [], {}, []
    for mesh in rows.meshes:
        row = rows.hit(mesh, name)
        if not row or row["input"]["boundary_edges"] == 0:
            continue
        if "border_hausdorff" not in row:
            lost.append(mesh)
            continue
        measured += 1
        factor = floored(row, "border_hausdorff") / floored(row, "hausdorff")
        within += factor <= 1
        if factor > 1:
            worse[mesh] = factor
        base = rows.hit(mesh, baseline)
        if base and "border_hausdorff" in base:
            ratios.append(floored(row, "border_hausdorff") / floored(base, "border_hausdorff"))
    return {"meshes": measured, "within_surface": within, "closed_up": lost, "worse": worse,
            "to_baseline": geomean(ratios)}


def border_table(rows, baseline):
    results = {name: border(rows, name, baseline) for name in rows.simplifiers}
    return results, table(["boundaries", "meshes", "at or below the surface's Hausdorff", "no boundary left",
                           "Hausdorff to " + baseline],
                          [[name, r["meshes"], r["within_surface"], len(r["closed_up"]), number(r["to_baseline"], 3)]
                           for name, r in results.items()])


def named(items):
    return "".join(f"- `{mesh}`: {why}\n" for mesh, why in items) or "- none\n"


def section(rows, baseline, folder, plots):
    """Returns Markdown and data of one ratio."""
    compared, ratio_text = ratios_to_baseline(rows, baseline)
    won, wins_text = wins_tables(rows)
    robust, robust_text = robustness_table(rows)
    borders, border_text = border_table(rows, baseline)
    text = [f"## {percent(rows.ratio)} of the faces\n", "Geometric means of per-mesh ratios; below 1 is better.\n",
            ratio_text]
    if plots:
        import plots as drawing  # imported here, because the tables do not need matplotlib
        name = f"quality-{rows.ratio:g}.svg"
        drawing.per_mesh_ratios(folder / name, {k: v for k, v in compared.items() if k != baseline},
                                f"{percent(rows.ratio)} of the faces: ratio to {baseline}, a dot per mesh", MEASURES[:3])
        text.append(f"![ratios per mesh]({name})\n")
    text += ["Comparison with the best peer on each mesh:\n", wins_text]
    for name, result in won.items():
        text += [f"<details><summary>{name}: meshes where a peer is better</summary>\n", named(result["lost"].items()),
                 "</details>\n"]
    text += ["Medians over the meshes where each reached its target:\n", absolute(rows),
             "Robustness:\n", robust_text, border_text]
    for name, result in borders.items():
        if is_ours(name) and result["worse"]:
            text.append(f"{name}, boundary distance above surface distance: " +
                        ", ".join(f"`{mesh}` {number(f, 3)}x" for mesh, f in result["worse"].items()) + "\n")
    text += ["Excluded from the ratios:\n"]
    for name, result in compared.items():
        if name != baseline and result["left_out"]:
            text += [f"<details><summary>{name}: {len(result['left_out'])}</summary>\n",
                     named(result["left_out"].items()), "</details>\n"]
    print(f"{percent(rows.ratio)} of the faces\n\n{ratio_text}\n{wins_text}")
    data = {"ratio": rows.ratio, "to_baseline": compared, "wins": won, "robustness": robust, "borders": borders}
    return "\n".join(text), data


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("results", nargs="+")
    parser.add_argument("--baseline", default="cgal-lt")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("."))
    parser.add_argument("--no-plots", action="store_true")
    arguments = parser.parse_args()
    rows = load(arguments.results)
    ratios = sorted({ratio for ratio, _, _ in rows}, reverse=True)
    arguments.out.mkdir(parents=True, exist_ok=True)
    meshes = {mesh for _, mesh, _ in rows}
    text = [f"{len(meshes)} meshes. Values are clamped to at least {FLOORS['hausdorff']:g} of the diagonal (Chamfer: "
            f"{FLOORS['chamfer']:g} of its square, normals: {FLOORS['normal_degrees']:g} degrees). A result is on "
            "target if its face count is within 1% of the target or at most four faces below it, because one collapse "
            "may remove four; ratios are over meshes where both are on target. A value within 0.1% of the best peer "
            "counts as equal.\n"]
    data = []
    for ratio in ratios:
        one, numbers = section(Rows(rows, ratio), arguments.baseline, arguments.out, not arguments.no_plots)
        text.append(one)
        data.append(numbers)
    (arguments.out / "quality.md").write_text("\n".join(text), encoding="utf-8")
    (arguments.out / "quality.json").write_text(json.dumps(data, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
