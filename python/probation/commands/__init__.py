"""The commands, one per file: arguments to a call, an answer to the terminal and to files.

Each has NAME, ``add_parser(subparsers)`` and ``run(options) -> exit status``, and imports what it computes with only
when it runs, so that ``probation --help`` is instant.
"""
