"""One file per alternative. Each has `prepare(case)`, which returns the call that is timed.

What an identification would do once (the grid, e_HT, compilation, buffers) is done in `prepare`.
"""
