"""Makes tests/reference importable from every test, whatever the folder pytest was started in."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
