"""Measures colour differences after simplifying and baking textured models with the command. Keeps existing rows."""

import json
import pathlib
import tempfile

from results import geomean, json_lines, models, run

RATIO = 0.1
SAMPLES = 50000
TEXTURE_SIZE = 1024
LEAST_FACES = 2000  # a tenth of a smaller model would be too few triangles
FLOOR = 1e-4  # smaller differences are due to rounding: 8 bits have steps of 4e-3


def tool(arguments, *words):
    return run(arguments.tool, *words)[0]


def faces(arguments, file):
    """Returns the number of faces of the scene; None if the command cannot read the file."""
    result = tool(arguments, "info", file, "--json")
    return json.loads(result.stdout)["total"]["faces"] if result.returncode == 0 else None


def subjects(arguments):
    """Returns (name, file) of the models by increasing face count; models that the command cannot read come first."""
    folder = pathlib.Path(arguments.textured)
    found = []
    for file in models(folder):
        count = faces(arguments, file)
        if count is None or LEAST_FACES <= count <= arguments.max_textured:
            found.append((count or 0, file.relative_to(folder).as_posix(), file))
    return [(name, file) for _, name, file in sorted(found)]


def measure(arguments, file, weights):
    """Returns the colour comparison, or the reason why there is none."""
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "out.glb"
        options = [word for term, weight in weights.items()
                   for word in (f"--w-{term.replace('_', '-')}", f"{weight:g}")]
        made = tool(arguments, "simplify", file, out, "--preset", "paper", *options, "--ratio", RATIO,
                    "--texture-size", TEXTURE_SIZE, "--quiet", "--threads", 1)
        if made.returncode != 0:
            return {"why_not": made.stderr.strip().splitlines()[-1].replace(f"faqem: {file}: ", "")}
        compared = tool(arguments, "compare", "--json", file, out, "--samples", SAMPLES, "--tolerance", 1, "--threads", 1)
        colors = json.loads(compared.stdout).get("colors") if compared.returncode == 0 else None
        return {"colors": colors} if colors else {"why_not": compared.stderr.strip() or "the model has no colours"}


def load(file):
    return {(row["model"], row["label"]): row for row in json_lines(file)} if file.exists() else {}


def measure_all(arguments, steps, file):
    """Measures missing rows and returns all rows by (model, label). steps: list of (label, weights)"""
    rows = load(file)
    with file.open("a", encoding="utf-8") as out:
        for name, path in subjects(arguments):
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
    """Returns geometric means of per-model ratios to the first label, included models, and {excluded model: reason}."""
    names = list(dict.fromkeys(name for name, _ in rows))
    whole = [name for name in names if all("colors" in rows.get((name, label), {}) for label in labels)]
    means = {label: geomean(rmse(rows[name, label]) / rmse(rows[name, labels[0]]) for name in whole)
             for label in labels}
    left_out = {name: next((row["why_not"] for (n, _), row in rows.items() if n == name and "why_not" in row),
                           "not all terms were measured") for name in names if name not in whole}
    return means, whole, left_out
