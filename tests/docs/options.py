"""Checks that docs/reference.md lists exactly the options of the commands, and docs/cli.md no others and all that
`faqem simplify --help` has. Usage: options.py TOOL"""
import re
import subprocess
import sys

import pages

# Sections that refer to the options of simplify instead of listing them.
SAME_AS_SIMPLIFY = {"lod", "batch", "truncate", "bake"}


def options_of_tool(tool):
    """Returns command -> options, from the help of all commands."""
    def output(*arguments):
        return subprocess.run([tool, *arguments], check=True, capture_output=True, text=True).stdout

    names = re.findall(r"^  ([a-z]+)  ", output("--help").split("Commands:")[1].split("\n\n")[0], flags=re.M)
    return {name: set(re.findall(r"^  (?:-\w, )?(--[a-z-]+)", output(name, "--help-all"), flags=re.M)) -
            {"--help", "--help-all"} for name in names}


def options_of_page(page):
    """Returns command -> options in the first column of the tables below its heading."""
    commands, name = {}, None
    for line in page.read_text(encoding="utf-8").splitlines():
        heading = re.match(r"## (?:faqem (\w+))?", line)
        if heading and not line.startswith("###"):
            name = heading.group(1)
            if name:
                commands[name] = set()
        if name and line.startswith("| `-"):
            commands[name] |= set(re.findall(r"--[a-z-]+", line.split("|")[1]))
    return commands


tool = options_of_tool(sys.argv[1])
usual, reference = (options_of_page(pages.SOURCE / "docs" / name) for name in ["cli.md", "reference.md"])
problems = []
for command, existing in tool.items():
    listed = reference.get(command, set())
    documented = listed | reference["simplify"] if command in SAME_AS_SIMPLIFY else listed
    problems += [f"faqem {command}: {option} is missing in docs/reference.md" for option in existing - documented]
    for name, options in [("reference.md", listed), ("cli.md", usual.get(command, set()))]:
        problems += [f"faqem {command}: {option} in docs/{name} does not exist" for option in options - existing]
shown = subprocess.run([sys.argv[1], "simplify", "--help"], check=True, capture_output=True, text=True).stdout
for option in set(re.findall(r"^  (?:-\w, )?(--[a-z-]+)", shown, flags=re.M)) - usual["simplify"]:
    problems.append(f"faqem simplify: {option} is missing in docs/cli.md")
print("\n".join(sorted(problems)) or f"{sum(map(len, tool.values()))} options of {len(tool)} commands")
sys.exit(bool(problems))
