"""``python -m probation`` is the command line."""

import sys

from probation.cli import main

sys.exit(main())
