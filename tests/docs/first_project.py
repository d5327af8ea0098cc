"""Builds the project of docs/getting-started.md as printed, with an installed faqem, runs it and checks its output.
Usage: first_project.py CMAKE COMPILER PREFIX WORK [FLAGS]"""
import pathlib
import re
import shutil
import subprocess
import sys

import pages


def block(page, language, mark):
    """Returns the only block of a language that contains the text `mark`."""
    found = ["\n".join(lines) for _, lines in pages.blocks(page, language) if mark in "\n".join(lines)]
    if len(found) != 1:
        raise SystemExit(f"{page}: expected one block of {language} with '{mark}', found {len(found)}")
    return found[0] + "\n"


def main():
    cmake, compiler, prefix, work = sys.argv[1:5]
    flags = sys.argv[5] if len(sys.argv) > 5 else ""
    page = pages.SOURCE / "docs" / "getting-started.md"
    folder = pathlib.Path(work)
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    (folder / "CMakeLists.txt").write_text(block(page, "cmake", "project(app"), encoding="utf-8")
    (folder / "app.cpp").write_text(block(page, "cpp", "int main()"), encoding="utf-8")
    subprocess.run([cmake, "-B", "build", f"-DCMAKE_PREFIX_PATH={prefix}", f"-DCMAKE_CXX_COMPILER={compiler}",
                    f"-DCMAKE_CXX_FLAGS={flags}"], cwd=folder, check=True)
    subprocess.run([cmake, "--build", "build"], cwd=folder, check=True)
    printed = subprocess.run(["build/app"], cwd=folder, check=True, capture_output=True, text=True).stdout
    print(printed)
    counts = re.fullmatch(r"(\d+) faces, now (\d+)\n", printed)
    sys.exit(not counts or int(counts.group(2)) * 20 > int(counts.group(1)))


main()
