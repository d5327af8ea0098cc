"""Checks each row of the table "What a file says" in docs/assets.md: files with the statement are generated, read,
simplified with and without a new texture, and examined. Every row must have a check and every check a row. Usage:
check.py TOOL [WORD...]; with words only the rows that contain one of them are checked."""
import pathlib
import re
import sys
import tempfile
import traceback

import gltf_rows
import gltf_scene_rows
import mtl_rows
import text_rows
from model import Failure, Runs

PAGE = pathlib.Path(__file__).resolve().parents[3] / "docs" / "assets.md"
HEADING = "## What a file says"


def rows_of_page():
    """(format, statement) of each row."""
    section = PAGE.read_text(encoding="utf-8").split(f"\n{HEADING}\n")[1].split("\n## ")[0]
    cells = [re.split(r"\s*(?<!\\)\|\s*", line.strip()) for line in section.splitlines() if line.startswith("|")]
    return [(c[1], c[2]) for c in cells[2:]]


def main(tool, folder, words):
    rows = rows_of_page()
    checks = {}
    for module in (text_rows, mtl_rows, gltf_rows, gltf_scene_rows):
        checks.update(module.ROWS)
    problems = [f"{a}, {b}: the table has no such row" for a, b in checks if (a, b) not in rows]
    problems += [f"{row}: there are two such rows" for row in set(rows) if rows.count(row) > 1]
    for number, row in enumerate(rows):
        title = ", ".join(row)
        if words and not any(word in title for word in words):
            continue
        if row not in checks:
            problems.append(f"{title}: has no check")
            continue
        try:
            checks[row](Runs(tool, f"{folder}/{number}"))
        except Failure as failure:
            problems.append(f"{title}: expected {failure}")
        except Exception:  # a result that cannot be examined is wrong, too
            problems.append(f"{title}: {traceback.format_exc()}")
    print("\n".join(problems) or f"{len(rows)} rows")
    return bool(problems)


if __name__ == "__main__":
    # In memory where that is possible: the command syncs its files.
    memory = pathlib.Path("/dev/shm")
    with tempfile.TemporaryDirectory(dir=memory if memory.is_dir() else None) as temporary:
        sys.exit(main(str(pathlib.Path(sys.argv[1]).resolve()), temporary, sys.argv[2:]))
