"""The command: `python -m faqem` and the script `faqem`."""

import os
import pathlib
import signal
import subprocess
import sys


def program() -> str:
    """Returns the file of the command."""
    return str(pathlib.Path(__file__).with_name("faqem.exe" if os.name == "nt" else "faqem"))


def main() -> None:
    """Replaces this process by the command, with the same arguments."""
    if os.name == "nt":  # where the shell would go on at once after execv()
        sys.exit(subprocess.run([program(), *sys.argv[1:]], check=False).returncode)
    signal.signal(signal.SIGPIPE, signal.SIG_DFL)  # Python ignores it, and the command would inherit that
    os.execv(program(), ["faqem", *sys.argv[1:]])


if __name__ == "__main__":
    main()
