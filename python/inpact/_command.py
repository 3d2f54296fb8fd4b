"""The command ``inpact``."""

import signal
import sys

from inpact import _inpact


def main() -> int:
    """Run the command line with the arguments of the process; give its exit code."""
    # The program has its own way to end on Ctrl-C and on a closed pipe: not with a traceback.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    return _inpact.command(["inpact", *sys.argv[1:]])
