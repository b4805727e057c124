"""Compares every scheme of the engine with what a user would write or install instead.

One thread each: the comparison is of methods, not of how many cores a linear algebra library takes.
"""

import os

for _variable in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(_variable, "1")
