"""Runs everything, prints the verdict first, records the result. See README.md."""

import argparse
import sys
import time

from bench import (
    batches,
    equal_error,
    feedbacks,
    fewer_modes,
    forward,
    identification,
    machine,
    overhead,
    record,
    report,
    sensitivities,
)
from bench.methods import INSTALL, missing_packages
from bench.rows import Findings

SECTIONS = (forward, fewer_modes, overhead, sensitivities, feedbacks, identification, equal_error, batches)


def main() -> int:
    parser = argparse.ArgumentParser(prog="bench", description=__doc__)
    parser.add_argument("--quick", action="store_true", help="few repeats, the target table's problem; not recorded")
    parser.add_argument("--json", action="store_true", help="print the result as JSON")
    arguments = parser.parse_args()

    begin = time.monotonic()

    def progress(line: str) -> None:
        print(f"[{time.monotonic() - begin:5.1f} s] {line}", file=sys.stderr, flush=True)

    found = Findings()
    found.skipped += [f"every row on {package}: not installed ({INSTALL})" for package in missing_packages()]
    for section in SECTIONS:
        section.run(found, progress, arguments.quick)
    here = machine.describe()
    beside = record.compare(found, here)
    if arguments.json:
        print(record.as_json(found, here))
    else:
        print("\n".join(["", *report.lines(found, here), "", *beside]))
    if arguments.quick:
        progress("a quick run is not recorded")
    else:
        progress(f"recorded in bench/results/{record.write(found, here).name}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
