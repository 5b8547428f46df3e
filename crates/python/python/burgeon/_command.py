"""Command ``burgeon`` of the package."""

import signal
import sys

from ._burgeon import run_command


def main() -> None:
    """Runs the command with the arguments of the process, and exits with its status."""
    # Python's handler only takes note of Ctrl-C until Python code runs again, so the system's replaces it.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    sys.exit(run_command(["burgeon", *sys.argv[1:]]))
