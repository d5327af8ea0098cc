"""Progress as a line on standard error."""

from __future__ import annotations

import sys


_width = 40  # of the bar, in characters


class ProgressLine:
    """A line with phase, bar and percentage, which is written over itself."""

    def __init__(self) -> None:
        self._text = ""

    def __call__(self, phase: str, fraction: float) -> None:
        done = int(_width * fraction)
        text = f"{phase:<8} [{'#' * done}{' ' * (_width - done)}] {fraction:4.0%}"
        if text != self._text and sys.stderr is not None:
            sys.stderr.write("\r" + text)
            sys.stderr.flush()
            self._text = text

    def end(self) -> None:
        """Ends the line, if there is one."""
        if self._text:
            sys.stderr.write("\n")
            self._text = ""
