"""Compiles all Python blocks of the pages. Usage: python_blocks.py"""
import sys

import pages

count = 0
for page in pages.PAGES:
    for first, lines in pages.blocks(page, "python"):
        compile("\n" * (first - 1) + "\n".join(lines), str(page), "exec")
        count += 1
print(f"{count} blocks compiled")
sys.exit(count == 0)
