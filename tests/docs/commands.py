"""Runs all `faqem` commands in the pages as they are printed. Usage: commands.py TOOL MODEL.glb WORK

Each block is run in a new directory, which contains a small model under each input file name that the pages use, and all
recipes in one directory, twice. Also types the examples of --help, and each option.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys

import pages

MODELS = ["model.glb", "statue.glb", "ref.glb", "generated.glb", "scan.glb", "remeshed.glb", "original.glb",
          "model.obj", "crate.obj", "car.obj", "scan.ply", "part.stl", "soup.stl", "tile.stl", "tiled.gltf",
          "models/urn.glb", "models/deep/crate.obj", "scans/a.ply", "parts/b.stl", "photos.obj", "robot/meshes/arm.stl"]


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
    (folder / "metadata.csv").write_text("sha256,local_path\n0a1b,scans/a.ply\n", encoding="utf-8")
    _, profile = next(pages.blocks(pages.SOURCE / "docs" / "reference.md", "json"))
    (folder / "game.json").write_text("\n".join(profile), encoding="utf-8")


def commands(lines):
    """Yields the commands that call faqem. Continuation lines are joined."""
    text = "\n".join(lines).replace("\\\n", " ")
    for line in text.splitlines():
        if re.match(r"(source <\()?(\S*/)?faqem\s", line):
            yield line


class Runner:
    """Runs commands in copies of a folder with models, and counts those that fail."""

    def __init__(self, tool, seeds, work):
        self.tool, self.seeds, self.work = tool, seeds, work
        self.count = self.failures = 0

    def folder(self, name):
        """Returns a new folder with the models, in which the command has the paths that the pages use."""
        folder = self.work / name
        shutil.copytree(self.seeds, folder)
        (folder / ".zfunc").mkdir()
        for directory in ["bin", "build/release/bin", "faqem/bin"]:
            (folder / directory).mkdir(parents=True)
            (folder / directory / "faqem").symlink_to(self.tool)
        return folder

    def run(self, where, command, folder, allowed=(0,)):
        environment = {**os.environ, "PATH": f"{folder / 'bin'}:{os.environ['PATH']}", "HOME": str(folder)}
        self.count += 1
        code, output = run(command, folder, environment)
        if code not in allowed:
            self.failures += 1
            print(f"{where}: {command}\nexit code {code}: {output}")


def run_pages(runner):
    for page in pages.PAGES:
        for first, lines in pages.blocks(page, "sh"):
            printed = list(commands(lines))
            if not printed:
                continue
            name = page.relative_to(pages.SOURCE).with_suffix("").as_posix().replace("/", "-")
            folder = runner.folder(f"{name}-{first}")
            for command in printed:
                for output in re.findall(r"--history (\S+)", command):  # an output of this command must not exist
                    (folder / output).unlink(missing_ok=True)
                runner.run(f"{page}:{first}", command, folder)


def run_recipes(runner):
    """Runs all recipes in one folder, where no one is in the way of another, and again: outputs exist then."""
    page = pages.SOURCE / "docs" / "choosing.md"
    folder = runner.folder("recipes")
    for allowed in (0,), (0, 7):
        for first, lines in pages.blocks(page, "sh"):
            for command in commands(lines):
                runner.run(f"{page}:{first}, all in one folder", command, folder, allowed)


# Values of options by their placeholder, and of those that need another one.
VALUES = {"R": "0.5", "LENGTH": "1%", "SIZE": "8GB", "S": "100", "W": "1", "D": "0", "TAU": "0.01", "X": "2", "DB": "40",
          "T": "0.1", "N": "8", "ANGLE": "60", "LIST": "50%,100", "OUT": "typed.glb", "FILE": "typed.file"}
SPECIAL = {"--texture-size": "64", "--size": "32", "--samples": "1000", "--config": "game.json", "--source": "scan.ply"}
NEEDS = {"--normals none": " --bake none", "--correspondence typed.file": " --bake atlas"}
WORDS = {"simplify": "model.glb", "lod": "model.glb out", "truncate": "scan.history", "batch": "parts out",
         "info": "model.glb", "compare": "model.glb model.glb", "render": "model.glb", "report": "model.glb model.glb"}
OUTPUTS = {"simplify": "typed.glb", "truncate": "typed.glb --faces 200", "render": "typed.png", "report": "typed.html"}


def run_help(runner):
    """Types the examples of --help, and each option with each choice, or a number, after a space."""
    done = {"--list", "--shard", "--new-run", "--missing", "--max-array", "--merge"}  # without DIR: docs/scale.md types them
    overview = subprocess.run([runner.tool, "--help"], check=True, capture_output=True, text=True).stdout
    examples = runner.folder("examples")
    for name in re.findall(r"^  ([a-z]+) ", overview, flags=re.M):
        text = subprocess.run([runner.tool, name, "--help-all"], check=True, capture_output=True, text=True).stdout
        for example in text.split("Examples:\n")[1].splitlines():
            runner.run(f"example of {name}", example.split("|")[0], examples)
        for option, placeholder in re.findall(r"^  (?:-\w, )?(--[a-z-]+)(?: (\S+))?(?:  |$)", text, flags=re.M):
            if option in done or name not in WORDS:
                continue
            done.add(option)
            value = SPECIAL.get(option) or VALUES.get(placeholder, placeholder)
            for one in value.split("|"):
                typed = f"{option} {one}".strip()
                output = OUTPUTS.get(name, "")
                if option == "--faces" and name == "truncate":
                    output = output.split()[0]
                if option == "--output":
                    output = " ".join(output.split()[1:])
                command = f"faqem {name} {WORDS[name]} {output} {typed}{NEEDS.get(typed, '')}"
                if option == "--until-eof":  # the standard input must not end
                    command = f"mkfifo open && {command} <>open"
                runner.run("each option", command, runner.folder(f"options/{runner.count}"))
    print(f"{len(done)} options")


def main():
    tool, model, work = (pathlib.Path(argument).resolve() for argument in sys.argv[1:])
    shutil.rmtree(work, ignore_errors=True)
    seeds = work / "seeds"
    seeds.mkdir(parents=True)
    make_seeds(tool, model, seeds)
    runner = Runner(tool, seeds, work)
    for part in (run_pages, run_recipes, run_help):
        part(runner)
    print(f"{runner.count} commands, {runner.failures} failed")
    sys.exit(runner.failures > 0 or runner.count == 0)


main()
