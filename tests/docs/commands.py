"""Runs all `faqem` commands in the pages as they are printed. Usage: commands.py TOOL MODEL.glb WORK

Each block is run in a new directory, which contains a small model under each input file name that the pages use.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys

import pages

MODELS = ["model.glb", "statue.glb", "ref.glb", "generated.glb", "model.obj", "crate.obj", "car.obj", "scan.ply",
          "part.stl", "soup.stl", "tile.stl", "tiled.gltf", "models/urn.glb", "models/deep/crate.obj", "scans/a.ply",
          "parts/b.stl"]


def run(command, folder, environment):
    done = subprocess.run(["bash", "-c", command], cwd=folder, env=environment, capture_output=True, text=True,
                          timeout=300)
    return done.returncode, done.stdout + done.stderr


def make_seeds(tool, model, folder):
    """Writes a model of a few hundred faces under all names, histories of some of them, and a profile."""
    small = ["--ratio", "0.1", "--texture-size", "64", "--quiet"]
    for name in MODELS:
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        subprocess.run([tool, "simplify", model, folder / name, *small], check=True, stderr=subprocess.DEVNULL)
    for name in ["model.glb", "statue.glb", "scan.ply"]:
        history = (folder / name).with_suffix(".history")
        subprocess.run([tool, "lod", folder / name, folder / "levels.tmp", "--levels", "0.9,0.2", "--history", history,
                        "--bake", "none", "--quiet"], check=True)
        shutil.rmtree(folder / "levels.tmp")
    _, profile = next(pages.blocks(pages.SOURCE / "docs" / "reference.md", "json"))
    (folder / "game.json").write_text("\n".join(profile), encoding="utf-8")


def commands(lines):
    """Yields the commands that call faqem. Continuation lines are joined."""
    text = "\n".join(lines).replace("\\\n", " ")
    for line in text.splitlines():
        if re.match(r"(source <\()?(\S*/)?faqem\s", line):
            yield line


def main():
    tool, model, work = (pathlib.Path(argument).resolve() for argument in sys.argv[1:])
    shutil.rmtree(work, ignore_errors=True)
    seeds = work / "seeds"
    seeds.mkdir(parents=True)
    make_seeds(tool, model, seeds)
    count = failures = 0
    for page in pages.PAGES:
        for first, lines in pages.blocks(page, "sh"):
            printed = list(commands(lines))
            if not printed:
                continue
            name = page.relative_to(pages.SOURCE).with_suffix("").as_posix().replace("/", "-")
            folder = work / f"{name}-{first}"
            shutil.copytree(seeds, folder)
            (folder / ".zfunc").mkdir()
            for directory in ["bin", "build/release/bin", "faqem/bin"]:
                (folder / directory).mkdir(parents=True)
                (folder / directory / "faqem").symlink_to(tool)
            environment = {**os.environ, "PATH": f"{folder / 'bin'}:{os.environ['PATH']}", "HOME": str(folder)}
            for command in printed:
                count += 1
                for output in re.findall(r"--history (\S+)", command):  # an output of this command must not exist
                    (folder / output).unlink(missing_ok=True)
                code, output = run(command, folder, environment)
                if code != 0:
                    failures += 1
                    print(f"{page}:{first}: {command}\nexit code {code}: {output}")
    print(f"{count} commands, {failures} failed")
    sys.exit(failures > 0 or count == 0)


main()
