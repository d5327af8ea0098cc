"""Finds the pages of the documentation and parses their code blocks."""
import pathlib
import re

SOURCE = pathlib.Path(__file__).resolve().parents[2]
PAGES = sorted(SOURCE.glob("*.md")) + sorted(SOURCE.glob("docs/**/*.md")) + sorted(SOURCE.glob("data/*.md"))


def blocks(page, language):
    """Yields (number of the first line inside, list of lines) for each fenced code block of a language."""
    inside = None
    for number, line in enumerate(page.read_text(encoding="utf-8").splitlines(), 1):
        if inside is None:
            fence = re.match(r"\s*```(\w*)\s*$", line)
            if fence:
                inside = (fence.group(1), number + 1, [])
        elif line.strip() == "```":
            if inside[0] == language:
                yield inside[1], inside[2]
            inside = None
        else:
            inside[2].append(line)
    if inside is not None:
        raise SystemExit(f"{page}:{inside[1] - 1}: the code block is not closed")


def without_blocks(page):
    """Yields the lines of a page. Fenced code blocks and the content of `backticks` are replaced by empty text."""
    inside = False
    for line in page.read_text(encoding="utf-8").splitlines():
        fence = re.match(r"\s*```", line)
        inside = inside != bool(fence)
        yield "" if inside or fence else re.sub(r"`[^`]*`", "``", line)
