"""Generates a source file from each code block of a page. Usage: code.py PAGE LANGUAGE OUT...

The files OUT are for the blocks of the language in their order. Each has exactly the includes that its block shows; a
block that shows none continues the block before it and has the same. A block that defines no function becomes the body
of a function. `= ...;` is replaced by a declaration without initializer, and READER declares other data of the reader.
#line directives make the compiler refer to the page.
"""
import pathlib
import re
import sys

import pages

# What the reader has, by language and name.
READER = {
    "cpp": {
        "positions": "std::vector<std::array<float, 3>> positions;",
        "triangles": "std::vector<std::array<std::uint32_t, 3>> triangles;",
        "materials": "std::vector<faqem::Index> materials;",
        "weights": "std::vector<float> weights;",
        "locks": "std::vector<std::uint8_t> locks;",
        "options": "faqem::Options options;",
        "use": "template <class... Results> void use(const Results&...) {}",
    },
    "c": {
        "options": "static faqem_options* options;",
        "error": "static faqem_error error;",
        "mesh": "static faqem_mesh mesh;",
        "source": "static faqem_asset* source;",
        "chain": "static faqem_asset* chain[2];",
    },
}


def is_file(lines):
    return any(re.match(r"[a-z][\w:<>*& ]* \w+\(.*\) \{$", line) for line in lines)


def source(page, language, first, lines, includes):
    code = ["" if line.startswith("#include") else line.replace(" = ...;", ";") for line in lines]
    text = "\n".join(code)
    if is_file(lines):
        body = [f'#line {first} "{page}"', text]
    else:
        data = [line for name, line in READER[language].items() if re.search(rf"(?<![\w.>:]){name}\b", text)]
        body = [*data, "void block(void) {", f'#line {first} "{page}"', text, "}"]
    return "\n".join([*includes, *body, ""])


def main():
    page, language, files = pathlib.Path(sys.argv[1]), sys.argv[2], sys.argv[3:]
    blocks = list(pages.blocks(page, language))
    if len(blocks) != len(files):
        raise SystemExit(f"{page}: {len(blocks)} blocks of {language}, expected {len(files)}: run cmake again")
    includes = []
    for file, (first, lines) in zip(files, blocks):
        includes = [line for line in lines if line.startswith("#include")] or includes
        pathlib.Path(file).write_text(source(page, language, first, lines, includes), encoding="utf-8")


main()
