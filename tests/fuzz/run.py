"""Many cases of every kind: made, run on all workers, judged, counted; each new failure made small and kept."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field
from random import Random
from typing import TYPE_CHECKING

from fuzz.judge import FAILURE, judge
from fuzz.kinds import KINDS
from fuzz.minimise import minimised

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from fuzz.case import Case
    from fuzz.judge import Verdict
    from fuzz.pool import Workers


@dataclass(frozen=True)
class Number:
    """Names a case: equal ones are the same case, on every machine."""

    kind: str
    seed: int
    at: int

    def case(self) -> Case:
        """The case itself."""
        return KINDS[self.kind].make(Random(f"{self.seed}/{self.kind}/{self.at}"))


@dataclass
class Findings:
    """What came of a run.

    Attributes
    ----------
    counts : Counter
        Of (kind, answer).
    failures : dict of (kind, signature) to list of (Number, Case, Verdict)
        In the order of the run.
    """

    counts: Counter[tuple[str, str]] = field(default_factory=Counter)
    failures: dict[tuple[str, str], list[tuple[Number, Case, Verdict]]] = field(default_factory=dict)

    def table(self) -> str:
        """Cases, read, refused and failures by kind, as Markdown."""
        rows = [("kind", "cases", "read", "refused", "failures"), ("---", "--:", "--:", "--:", "--:")]
        for kind in [*KINDS, "all"]:
            chosen = {answer: n for (each, answer), n in self.counts.items() if kind == each}
            if kind == "all":
                chosen = Counter(answer for (_, answer), n in self.counts.items() for _ in range(n))
            answers = [chosen.get(answer, 0) for answer in ("read", "refused", FAILURE)]
            rows.append((kind, *map(str, [sum(answers), *answers])))
        return "\n".join(f"| {row[0]:<15} | " + " | ".join(f"{text:>8}" for text in row[1:]) + " |" for row in rows)


def numbers(cases: int, seed: int, kinds: list[str] | None = None) -> Iterator[Number]:
    """So many cases, each kind by its share and spread over the run."""
    chosen = kinds or list(KINDS)
    total = sum(KINDS[kind].SHARE for kind in chosen)
    due = dict.fromkeys(chosen, 0.0)
    made = dict.fromkeys(chosen, 0)
    for _ in range(cases):
        for kind in chosen:
            due[kind] += KINDS[kind].SHARE / total
        kind = max(chosen, key=lambda kind: due[kind])
        due[kind] -= 1.0
        yield Number(kind, seed, made[kind])
        made[kind] += 1


def run(
    workers: Workers,
    cases: int,
    seed: int,
    kinds: list[str] | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> Findings:
    """Run so many cases.

    Parameters
    ----------
    workers : Workers
    cases, seed : int
    kinds : list of str, optional
        All if left out.
    progress : callable, optional
        Told how many cases are done, and how many of them failed.
    """
    findings, failed = Findings(), 0

    def judged(number: Number) -> tuple[Number, Case, Verdict]:
        case = number.case()
        return number, case, judge(case, workers.run(case))

    for done, (number, case, verdict) in enumerate(workers.map(judged, numbers(cases, seed, kinds)), start=1):
        findings.counts[number.kind, verdict.answer] += 1
        if verdict.answer == FAILURE:
            failed += 1
            findings.failures.setdefault((number.kind, verdict.signature), []).append((number, case, verdict))
        if progress is not None:
            progress(done, failed)
    return findings


def keep(workers: Workers, findings: Findings) -> list[str]:
    """Put the first case of every kind of failure into the corpus, made small; returns a line for each."""

    def kept(item: tuple[tuple[str, str], list[tuple[Number, Case, Verdict]]]) -> str:
        (kind, signature), failures = item
        number, case, verdict = failures[0]

        def fails_alike(candidate: Case) -> bool:
            return judge(candidate, workers.run(candidate)).signature == signature

        small = case if verdict.failure == "hang" else minimised(case, fails_alike)
        path = small.save(f"{verdict.failure} {number.seed} {number.at}")
        told = f"{kind}, {len(failures)} times: {verdict.failure}: {verdict.detail[:200]}"
        return f"{told}\n    {path.name}: {' '.join(small.command)[:150]}"

    return [str(line) for line in workers.map(kept, list(findings.failures.items()))]
