"""Is the engine as fast as promised, and by how much faster than the alternatives?

`python bench/run.py` is `python -m bench` from any directory; see README.md beside this file.
"""

import runpy
import sys
from pathlib import Path

sys.path[0] = str(Path(__file__).resolve().parent.parent)
runpy.run_module("bench", run_name="__main__")
