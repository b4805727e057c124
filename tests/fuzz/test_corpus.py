"""Every case that ever failed is read or refused, in one line and in time; a short run finds no new one."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from fuzz.case import Case, corpus
from fuzz.judge import FAILURE, judge
from fuzz.kinds import KINDS
from fuzz.run import run

if TYPE_CHECKING:
    from pathlib import Path

    from fuzz.pool import Workers

CASES = 25
"""Of each kind, beside the corpus."""


@pytest.mark.parametrize("path", corpus(), ids=lambda path: f"{path.parent.name}/{path.stem}")
def test_what_failed_once_fails_no_more(path: Path, workers: Workers):
    case = Case.from_json(path.read_text(encoding="ascii"))
    verdict = judge(case, workers.run(case))
    assert verdict.answer != FAILURE, f"{case.why}: {verdict.failure}: {verdict.detail}"


@pytest.mark.parametrize("kind", KINDS)
def test_a_short_run_finds_nothing(kind: str, workers: Workers):
    findings = run(workers, CASES, seed=17, kinds=[kind])
    told = [
        f"{number}: {verdict.failure}: {verdict.detail}"
        for each in findings.failures.values()
        for number, _, verdict in each
    ]
    assert not told, "\n".join(told)


def test_the_corpus_names_its_kinds():
    """A case whose kind is gone is never made again."""
    kinds = {Case.from_json(path.read_text(encoding="ascii")).kind for path in corpus()}
    assert kinds <= set(KINDS)
