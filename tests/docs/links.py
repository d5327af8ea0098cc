"""Checks that the files and headings to which the pages link exist. Usage: links.py"""
import re
import sys

import pages


def headings(page):
    """Returns the anchors of the headings of a page, as GitHub generates them."""
    names = set()
    inside = False
    for line in page.read_text(encoding="utf-8").splitlines():
        inside = inside != line.lstrip().startswith("```")
        heading = None if inside else re.match(r"#+\s+(.*?)\s*$", line)
        if heading:
            text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading.group(1))
            name = re.sub(r"[^\w\- ]", "", text.lower()).replace(" ", "-")
            repeated = sum(1 for other in names if re.fullmatch(re.escape(name) + r"(-\d+)?", other))
            names.add(f"{name}-{repeated}" if repeated else name)
    return names


def problem(page, target):
    """Returns the reason why a link is invalid, or None."""
    if re.match(r"[a-z]+:", target):
        return None
    path, _, heading = target.partition("#")
    file = (page.parent / path).resolve() if path else page
    if not file.exists():
        return "the file does not exist"
    if not file.is_relative_to(pages.SOURCE):
        return "the file is outside the repository"
    if heading and file.suffix == ".md" and heading not in headings(file):
        return "the heading does not exist"
    return None


links = problems = 0
for page in pages.PAGES:
    for number, line in enumerate(pages.without_blocks(page), 1):
        for target in re.findall(r"\]\(([^)\s]+)\)|(?:src|href)=\"([^\"]+)\"", line):
            links += 1
            why = problem(page, target[0] or target[1])
            if why:
                problems += 1
                print(f"{page}:{number}: {target[0] or target[1]}: {why}")
print(f"{links} links on {len(pages.PAGES)} pages, {problems} are invalid")
sys.exit(problems > 0 or links == 0)
