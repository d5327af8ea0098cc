"""Rows of faqem-bench and statistics shared by the scripts that write tables."""

import json
import math
import pathlib
import resource
import subprocess

# Smaller values are due to rounding. Units: the diagonal, its square, degrees, the diagonal.
FLOORS = {"hausdorff": 1e-7, "chamfer": 1e-14, "normal_degrees": 1e-2, "border_hausdorff": 1e-7}
TOLERANCE = 0.01
ONE_COLLAPSE = 4  # faces removed by one collapse: two, or more at a non-manifold edge


def run(*words, **options):
    """Runs a command. Returns what subprocess.run() does, with the texts of the command, and its CPU seconds."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(list(map(str, words)), **{"capture_output": True, "text": True, **options})
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return done, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def models(folder):
    """Returns the models below a folder that may have textures, sorted by name."""
    return [file for file in sorted(folder.rglob("*")) if file.suffix.lower() in (".glb", ".gltf", ".obj")]


def json_lines(file):
    """Yields the objects of a file of JSON lines. Truncated lines are ignored."""
    for line in pathlib.Path(file).read_text(encoding="utf-8").splitlines():
        try:
            yield json.loads(line)
        except json.JSONDecodeError:
            continue


def load(files):
    """Returns the rows by (ratio, mesh, simplifier). Later rows replace earlier ones."""
    return {(row["ratio"], row["mesh"], row["simplifier"]): row for file in files for row in json_lines(file)}


class Rows:
    """All rows of one ratio."""

    def __init__(self, rows, ratio):
        self.ratio = ratio
        self.by = {(mesh, name): row for (r, mesh, name), row in rows.items() if r == ratio}
        faces = {mesh: row["input"]["faces"] for (mesh, _), row in self.by.items()}
        self.meshes = sorted(faces, key=lambda mesh: (faces[mesh], mesh))
        self.simplifiers = list(dict.fromkeys(name for _, name in self.by))

    def get(self, mesh, name):
        return self.by.get((mesh, name))

    def usable(self, mesh, name):
        """Returns the row if the result could be measured, whether or not it is on target."""
        row = self.get(mesh, name)
        return row if row and row["status"] == "ok" and finite(row.get("hausdorff")) else None

    def not_above(self, mesh, name):
        """Returns the row if it has at most 1% more faces than the target."""
        row = self.usable(mesh, name)
        return row if row and excess(row) <= TOLERANCE * row["target"] else None

    def hit(self, mesh, name):
        """Returns the row if its face count is within 1% of the target or at most one collapse below it."""
        row = self.not_above(mesh, name)
        return row if row and -excess(row) <= max(TOLERANCE * row["target"], ONE_COLLAPSE) else None

    def why_not(self, mesh, name):
        """Returns the reason why hit() returns nothing."""
        row = self.get(mesh, name)
        if not row:
            return "not run"
        if row["status"] != "ok":
            return row["status"]
        return f"{row['output']['faces']} of {row['target']} faces"


def excess(row):
    return row["output"]["faces"] - row["target"]


def finite(value):
    return isinstance(value, (int, float)) and math.isfinite(value)


def floored(row, key):
    return max(row[key], FLOORS.get(key, 0))


def geomean(values):
    values = [value for value in values if finite(value) and value > 0]
    return math.exp(sum(map(math.log, values)) / len(values)) if values else None


def median(values):
    values = sorted(value for value in values if finite(value))
    if not values:
        return None
    middle = len(values) // 2
    return values[middle] if len(values) % 2 else (values[middle - 1] + values[middle]) / 2


def against(rows, name, baseline):
    """Returns geometric means of per-mesh ratios over the meshes where both are on target, and the excluded meshes."""
    pairs, left_out = [], {}
    for mesh in rows.meshes:
        if not rows.get(mesh, name):
            continue
        row, base = rows.hit(mesh, name), rows.hit(mesh, baseline)
        if row and base:
            pairs.append((mesh, row, base))
        else:
            who = name if not row else baseline
            left_out[mesh] = f"{who}: {rows.why_not(mesh, who)}"
    means = {key: geomean(floored(row, key) / floored(base, key) for _, row, base in pairs)
             for key in ("hausdorff", "chamfer", "normal_degrees", "seconds", "cpu_seconds")}
    means["seconds_to_core"] = geomean(row["seconds"] / base["core_seconds"] for _, row, base in pairs)
    per_mesh = {mesh: {key: floored(row, key) / floored(base, key)
                       for key in ("hausdorff", "chamfer", "normal_degrees", "seconds")}
                for mesh, row, base in pairs}
    return {"meshes": len(pairs), "geomean": means, "per_mesh": per_mesh, "left_out": left_out}


def number(value, digits=2):
    if value is None:
        return "-"
    if value != 0 and not 1e-3 <= abs(value) < 1e4:
        return f"{value:.{digits}g}"
    return f"{value:.{max(0, digits - 1 - math.floor(math.log10(abs(value) or 1)))}f}"


def table(head, lines):
    """Returns a Markdown table. The first column is text, the others are numbers."""
    text = ["| " + " | ".join(head) + " |", "|---" + "|---:" * (len(head) - 1) + "|"]
    text += ["| " + " | ".join(str(cell) for cell in line) + " |" for line in lines]
    return "\n".join(text) + "\n"


def percent(ratio):
    return f"{100 * ratio:g}%"
