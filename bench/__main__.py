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
    full_field,
    identification,
    instructions,
    limit,
    machine,
    markdown,
    material_point,
    overhead,
    record,
    report,
    sensitivities,
)
from bench.methods import INSTALL, missing_packages
from bench.rows import Findings

SECTIONS = (
    forward, limit, fewer_modes, material_point, feedbacks, overhead, sensitivities, identification, full_field,
    equal_error, batches, instructions,
)  # fmt: skip


def main() -> int:
    parser = argparse.ArgumentParser(prog="bench", description=__doc__)
    parser.add_argument("--quick", action="store_true", help="few repeats, the target table's problem; not recorded")
    parser.add_argument("--json", action="store_true", help="print the result as JSON")
    parser.add_argument("--markdown", action="store_true", help="print the target table as README.md holds it")
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
    elif arguments.markdown:
        print("\n".join(markdown.lines(found, here)))
    else:
        print("\n".join(["", *report.lines(found, here), "", *beside]))
    if arguments.quick:
        progress("a quick run is not recorded")
    else:
        progress(f"recorded in bench/results/{record.write(found, here).name}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
