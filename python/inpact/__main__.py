"""``python -m inpact``: the command line."""

import sys

from inpact._command import main

sys.exit(main())
