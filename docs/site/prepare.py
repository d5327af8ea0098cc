"""Makes of the repository's pages what Doxygen reads. Usage: prepare.py SOURCE OUT TOOL

The pages are for GitHub: headings are linked to by name, and files by their place. Doxygen wants an id for each, and
has pages for headers and examples, but not for other files. The reference of the command is asked of the command (or
left out, where TOOL is empty), and each example gets a page.
"""
import pathlib
import re
import subprocess
import sys


def slug(heading):
    text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading)
    return re.sub(r"[^\w\- ]", "", text.lower()).replace(" ", "-")


def page_id(name):
    return "mainpage" if name == "README" else "page_" + name.replace("-", "_")


def heading_id(page, heading):
    return f"{page_id(page)}-{heading}"


class Pages:
    def __init__(self, source):
        self.source = source
        files = [source / "README.md", source / "CHANGELOG.md", source / "CONTRIBUTING.md", source / "SECURITY.md",
                 *sorted((source / "docs").glob("*.md"))]
        self.pages = {file.resolve(): file.stem for file in files}
        self.examples = {file.resolve(): file.stem for file in sorted((source / "examples").glob("*.cpp"))
                         if not file.stem.startswith(("model_", "make_"))}

    def link(self, page, text, target):
        if re.match(r"[a-z]+:", target):
            return None
        path, _, heading = target.partition("#")
        file = (page.parent / path).resolve() if path else page.resolve()
        if file in self.pages:
            name = self.pages[file]
            return f"[{text}](@ref {heading_id(name, heading) if heading else page_id(name)})"
        if file in self.examples:
            return f"[{text}](@ref example_{self.examples[file]})"
        if file.suffix in (".hpp", ".h") and "include" in file.parts:
            return f"[{text}](@ref {file.name})"
        return text  # sources without a page of their own

    def convert(self, page):
        lines, code = [], False
        for line in page.read_text(encoding="utf-8").splitlines():
            fence = line.lstrip().startswith("```")
            code = code != fence
            if code or fence:
                lines.append(re.sub(r"^(\s*```)(sh|cmake|c|python)$", r"\1{.\2}", line))
                continue
            line = re.sub(r"!\[([^\]]*)\]\((?:\.\./)?(?:docs/)?([^)]*)\)", lambda m: self.image(*m.groups()), line)
            line = re.sub(r"(?<!!)\[((?:[^\[\]]|\[[^\]]*\])*)\]\(([^)\s]+)\)",
                          lambda m: self.link(page, *m.groups()) or m.group(), line)
            heading = re.match(r"(#+)\s+(.*?)\s*$", line)
            if heading and len(heading.group(1)) == 1:
                title = heading.group(2).replace("`", "")  # it goes into the side bar as it is
                line = f"# {title} {{#{page_id(page.stem)}}}"
            elif heading:
                line = f"{line} {{#{heading_id(page.stem, slug(heading.group(2)))}}}"
            lines.append(line)
        return "\n".join(lines) + "\n"

    @staticmethod
    def image(text, path):
        name = pathlib.PurePosixPath(path).name
        return f'<img src="{name}" alt="{text}"/>'


def reference(tool):
    """What the command says of itself."""
    manual = subprocess.run([tool, "--help"], check=True, capture_output=True, text=True).stdout
    text = "# What the command says of itself {#page_help}\n\n```\n" + manual + "```\n"
    for command in re.findall(r"^  ([a-z]+) ", manual.split("Subcommands:")[1], flags=re.M):
        shown = subprocess.run([tool, command, "--help"], check=True, capture_output=True, text=True).stdout
        text += f"\n## faqem {command} {{#help-{command}}}\n\n```\n{shown}```\n"
    return text


def main():
    source, out, tool = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]), sys.argv[3]
    out.mkdir(parents=True, exist_ok=True)
    pages = Pages(source)
    for file, name in pages.pages.items():
        (out / f"{name}.md").write_text(pages.convert(file), encoding="utf-8")
    index = "# Examples {#page_examples}\n\n"
    for file, name in pages.examples.items():
        comment = re.match(r"(?://.*\n)+", file.read_text(encoding="utf-8")).group()
        about = re.sub(r"^// ?", "", comment, flags=re.M).replace("\n", " ").strip()
        index += f'* @subpage example_{name} "{name}": {about}\n'
        (out / f"example_{name}.md").write_text(
            f"# {name}.cpp {{#example_{name}}}\n\n```cpp\n{file.read_text(encoding='utf-8')}```\n", encoding="utf-8")
    (out / "examples.md").write_text(index, encoding="utf-8")
    (out / "help.md").write_text(reference(tool) if tool else "", encoding="utf-8")


main()
