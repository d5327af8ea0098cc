"""Generates a source file from the code blocks of a page. Usage: code.py PAGE LANGUAGE OUT PREAMBLE

A block that defines no function becomes the body of a function. `= ...;` is replaced by a declaration without
initializer; other data of the reader is declared in the preamble. #line directives make the compiler refer to the page.
"""
import pathlib
import re
import sys

import pages


def is_file(lines):
    return any(re.match(r"[a-z][\w:<>*& ]* \w+\(.*\) \{$", line) for line in lines)


def source(page, language, preamble):
    includes, bodies = [], []
    for number, (first, lines) in enumerate(pages.blocks(page, language)):
        code = []
        for line in lines:
            if line.startswith("#include"):
                includes.append(line)
                line = ""
            code.append(line.replace(" = ...;", ";"))
        text = f'#line {first} "{page}"\n' + "\n".join(code) + "\n"
        if not is_file(lines):
            text = f"void block_{number}(void) {{\n{text}}}\n"
        if language == "cpp":
            text = f"namespace block_{number} {{\n{text}}}\n"
        bodies.append(text)
    return "\n".join(includes + [f'#include "{preamble}"'] + bodies)


page, language, out, preamble = sys.argv[1:]
pathlib.Path(out).write_text(source(pathlib.Path(page), language, preamble), encoding="utf-8")
