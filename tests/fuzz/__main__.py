"""``python -m fuzz``: a long run; ``make fuzz`` calls it."""

from __future__ import annotations

import argparse
import sys
import time

from fuzz.kinds import KINDS
from fuzz.pool import Workers
from fuzz.run import keep, run


def main() -> int:
    """Run, and say what came of it; status 1 where anything failed."""
    parser = argparse.ArgumentParser(prog="python -m fuzz", description=__doc__)
    parser.add_argument("--cases", type=int, default=20_000, help="how many (20000)")
    parser.add_argument("--seed", type=int, default=1, help="of all chance (1): the same seed makes the same cases")
    parser.add_argument("--kind", choices=KINDS, action="append", help="only these; may be given several times")
    parser.add_argument("--workers", type=int, help="processes (all cores)")
    parser.add_argument("--keep-nothing", action="store_true", help="leave the corpus as it is")
    options = parser.parse_args()
    begun = told = time.monotonic()

    def progress(done: int, failed: int) -> None:
        nonlocal told
        if time.monotonic() - told > 10.0 or done == options.cases:
            told = time.monotonic()
            print(f"fuzz: {done} of {options.cases} cases, {failed} failed, {told - begun:.0f} s", file=sys.stderr)

    with Workers(options.workers) as workers:
        findings = run(workers, options.cases, options.seed, options.kind, progress)
        print(findings.table())
        print(f"\nseed {options.seed}, {time.monotonic() - begun:.0f} s on {workers.count} cores")
        if options.keep_nothing:
            for (kind, signature), failures in findings.failures.items():
                print(f"{kind}, {len(failures)} times, first {failures[0][0].at}: {signature}")
        else:
            print(*keep(workers, findings), sep="\n")
    return 1 if findings.failures else 0


if __name__ == "__main__":
    sys.exit(main())
