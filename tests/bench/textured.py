"""Colours after simplifying and baking, measured with the tool: rows of their own, made once."""

import json
import pathlib
import subprocess
import tempfile

from results import geomean

RATIO = 0.1
SAMPLES = 50000
TEXTURE_SIZE = 1024
LEAST_FACES = 2000  # a tenth of less is a handful of triangles
FLOOR = 1e-4  # smaller differences are rounding: 8 bits have steps of 4e-3


def tool(arguments, command, *words):
    return subprocess.run([arguments.tool, command, *map(str, words)], capture_output=True, text=True)


def faces(arguments, file):
    """Faces of the scene; None where the tool does not read the file."""
    result = tool(arguments, "info", file, "--json")
    return json.loads(result.stdout)["total"]["faces"] if result.returncode == 0 else None


def models(arguments):
    """(name, file) of the folder's models, the smallest first, those that the tool does not read before them."""
    folder = pathlib.Path(arguments.textured)
    found = []
    for file in sorted(folder.rglob("*")):
        if file.suffix.lower() not in (".glb", ".gltf", ".obj"):
            continue
        count = faces(arguments, file)
        if count is None or LEAST_FACES <= count <= arguments.max_textured:
            found.append((count or 0, file.relative_to(folder).as_posix(), file))
    return [(name, file) for _, name, file in sorted(found)]


def measure(arguments, file, weights):
    """RMSE of the colours, or why there is none."""
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "out.glb"
        options = [word for term, weight in weights.items()
                   for word in (f"--w-{term.replace('_', '-')}", f"{weight:g}")]
        made = tool(arguments, "simplify", file, out, "--preset", "paper", *options, "--ratio", RATIO,
                    "--texture-size", TEXTURE_SIZE, "--quiet", "--threads", 1)
        if made.returncode != 0:
            return {"why_not": made.stderr.strip().splitlines()[-1].replace(f"faqem: {file}: ", "")}
        compared = tool(arguments, "compare", file, out, "--samples", SAMPLES, "--tolerance", 1, "--threads", 1)
        colors = json.loads(compared.stdout).get("colors") if compared.returncode == 0 else None
        return {"colors": colors} if colors else {"why_not": compared.stderr.strip() or "it has none"}


def load(file):
    rows = {}
    if file.exists():
        for line in file.read_text(encoding="utf-8").splitlines():
            try:
                row = json.loads(line)
            except json.JSONDecodeError:
                continue
            rows[row["model"], row["label"]] = row
    return rows


def run(arguments, steps, file):
    """Rows by (model, label). \\param steps  (label, weights)"""
    rows = load(file)
    with file.open("a", encoding="utf-8") as out:
        for name, path in models(arguments):
            for label, weights in steps:
                if (name, label) in rows:
                    continue
                row = {"model": name, "label": label, "weights": weights, **measure(arguments, path, weights)}
                rows[name, label] = row
                out.write(json.dumps(row) + "\n")
                out.flush()
                print(f"{name:50} {label:16} {row.get('why_not') or row['colors']['rmse']}", flush=True)
    return rows


def rmse(row):
    return max(row["colors"]["rmse"], FLOOR)


def against_first(rows, labels):
    """Geometric means of the per-model ratios to the first label, models they are over, and {model: why not}."""
    names = list(dict.fromkeys(name for name, _ in rows))
    whole = [name for name in names if all("colors" in rows.get((name, label), {}) for label in labels)]
    means = {label: geomean(rmse(rows[name, label]) / rmse(rows[name, labels[0]]) for name in whole)
             for label in labels}
    left_out = {name: next((row["why_not"] for (n, _), row in rows.items() if n == name and "why_not" in row),
                           "not all terms run") for name in names if name not in whole}
    return means, whole, left_out
