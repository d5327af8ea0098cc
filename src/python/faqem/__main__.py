"""The command: `python -m faqem` and the script `faqem`."""

import os
import pathlib
import signal
import sys


def main() -> None:
    """Replaces this process by the command, with the same arguments."""
    command = str(pathlib.Path(__file__).with_name("faqem"))
    signal.signal(signal.SIGPIPE, signal.SIG_DFL)  # Python ignores it, and the command would inherit that
    os.execv(command, ["faqem", *sys.argv[1:]])


if __name__ == "__main__":
    main()
