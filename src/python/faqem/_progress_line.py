"""Progress as a line on standard error."""

from __future__ import annotations

import sys


class ProgressLine:
    """A line with phase and percentage, which is written over itself."""

    def __init__(self) -> None:
        self._text = ""

    def __call__(self, phase: str, fraction: float) -> None:
        text = f"{phase} {fraction:.0%}"
        if text != self._text:
            sys.stderr.write("\r" + text.ljust(len(self._text)))
            sys.stderr.flush()
            self._text = text

    def end(self) -> None:
        """Ends the line, if there is one."""
        if self._text:
            sys.stderr.write("\n")
            self._text = ""
