"""The fuzzer itself: the same seed makes the same cases, good files are read, and each kind of failure is seen."""

from __future__ import annotations

import json
from random import Random

import pytest

from fuzz.case import Case
from fuzz.content import from_bytes, to_bytes, write
from fuzz.judge import FAILURE, READ, REFUSED, judge
from fuzz.kinds import KINDS, campaign, field_store, fit_json, history, units, workbook
from fuzz.minimise import minimised
from fuzz.pool import Outcome, Workers
from fuzz.rows import HISTORIES, RECORDS, WITH_HEADINGS, Rows, plain, plain_truth, rate_table
from fuzz.run import Number, numbers
from fuzz.texts import encoded, render


@pytest.mark.parametrize("kind", KINDS)
def test_a_number_always_makes_the_same_case(kind):
    first = [Number(kind, 3, at).case() for at in range(20)]
    assert [Number(kind, 3, at).case() for at in range(20)] == first
    assert [Number(kind, 4, at).case() for at in range(20)] != first


def test_every_kind_gets_its_share():
    """Of 1000 cases each kind gets its share of all shares, rounded."""
    shares = {kind: KINDS[kind].SHARE for kind in KINDS}
    made = [number.kind for number in numbers(1000, seed=1)]
    for kind, share in shares.items():
        assert abs(made.count(kind) - 1000 * share / sum(shares.values())) < len(KINDS)


@pytest.mark.parametrize("kind", KINDS)
def test_a_case_survives_the_corpus(kind):
    case = Number(kind, 5, 1).case()
    assert Case.from_json(case.to_json()) == case


def _good_cases():
    for make in RECORDS:
        rows = make()
        data = encoded(render(rows), rows.encoding)
        yield make.__name__, Case("csv", ("preview", "x7.csv", *rows.options), {"x7.csv": from_bytes(data)})
    for make in WITH_HEADINGS:
        rows = make()
        yield f"{make.__name__}-tsv", Case("tsv", ("preview", "x7.tsv", *rows.options), {"x7.tsv": render(rows, "\t")})
        for shared in (True, False):
            parts = {"x7.xlsx": {"zip": workbook.members(rows.cells, shared=shared)}}
            yield f"{make.__name__}-xlsx-{shared}", Case("xlsx", ("preview", "x7.xlsx", *rows.options), parts)
    for make in HISTORIES:
        files = {"history-7.csv": render(make())}
        yield make.__name__, Case("history", ("simulate", "history-7.csv", *history.LAW, "--set", "tau_max_s=5"), files)
    yield "rates", Case("companion table", ("companion", "times-7.csv"), {"times-7.csv": render(rate_table())})
    for at, text in enumerate(campaign.SEEDS):
        files = {**campaign.records(Random(0), wrong=0.0), "campaign.toml": text}
        yield f"campaign-{at}", Case("campaign", ("load", "."), files)
    for at, law in enumerate(fit_json.LAWS):
        files = {"fit-7.json": json.dumps(fit_json.answer(law))}
        yield f"fit-{at}", Case("fit.json", ("export", "fit-7.json", "--format", "c"), files)
    yield "truth", Case("csv", ("read", "x7.csv"), {"x7.csv": render(plain())}, truth=plain_truth())


GOOD = dict(_good_cases())


@pytest.mark.parametrize("name", GOOD)
def test_what_has_not_gone_wrong_is_read(name, workers: Workers):
    """Or else the fuzzer would find refusals only."""
    outcome = workers.run(GOOD[name])
    assert judge(GOOD[name], outcome).answer == READ, outcome.err


def test_stores_that_have_not_gone_wrong_are_read(workers: Workers):
    field = Case("field store", field_store.IDENTIFY, field_store.field_store())
    maps = Case("field store", field_store.MAP, field_store.maps_store(), answer=field_store.maps_answer())
    assert [judge(case, workers.run(case)).answer for case in (field, maps)] == [READ, READ]


CASE = Case("csv", ("preview", "tension-7.csv"), {"tension-7.csv": "x"})
COMPLAINT = "probation: tension-7.csv: found a single column, expected three\n"


@pytest.mark.parametrize(
    ("outcome", "failure"),
    [
        (Outcome(1, err="probation: unexpected ValueError: x\n"), "unexpected error"),
        (Outcome(1, err="Traceback (most recent call last):\nValueError: x\n"), "traceback"),
        (Outcome(1, err="probation: something\n"), "status 1"),
        (Outcome(None, ended="the process died with status -11"), "crash"),
        (Outcome(None, ended="stopped after its time"), "hang"),
        (Outcome(0, out="x" * 2_000_000), "flood"),
        (Outcome(0, out="heading \x1b[31m\n"), "control character"),
        (Outcome(2, err=COMPLAINT.replace("single", "\u202e")), "control character"),
        (Outcome(0, err="warning: overflow encountered in exp\n"), "warning of a library"),
        (Outcome(0, err=" ** On entry to DLASCL parameter number 4 had an illegal value\n"), "warning of a library"),
        (Outcome(2, err=COMPLAINT * 2), "2 lines of complaint"),
        (Outcome(2, err=""), "0 lines of complaint"),
        (Outcome(2, out="E_u 2800\n", err=COMPLAINT), "an answer beside the complaint"),
        (Outcome(2, err="probation: found a single column\n"), "a complaint that names no file"),
    ],
)  # fmt: skip
def test_each_failure_is_seen(outcome, failure):
    verdict = judge(CASE, outcome)
    assert (verdict.answer, verdict.failure) == (FAILURE, failure)


def test_an_answer_and_a_line_of_complaint_are_fine():
    assert judge(CASE, Outcome(0, out="E_u 2800\n", err="wrote JSON fit.json\n")).answer == READ
    assert judge(CASE, Outcome(2, err=COMPLAINT)).answer == REFUSED


def test_an_answer_where_a_refusal_is_right_is_seen():
    case = Case("csv", CASE.command, CASE.files, outcome="refused")
    assert judge(case, Outcome(0, out="E_u 2800\n")).failure == "read and not refused"


def _told(factor: float, *warnings: str) -> Outcome:
    samples = {**plain_truth(), "true_stress": [factor * each for each in plain_truth()["true_stress"]]}
    return Outcome(0, out=json.dumps([{"samples": samples, "warnings": warnings}]))


def test_a_wrong_unit_is_seen_unless_the_doubt_is_told():
    case = Case("units", ("read", "x7.csv"), {}, truth=plain_truth(), doubts={"true_stress": ["force", "Load"]})
    assert judge(case, _told(1.0)).answer == READ
    assert judge(case, _told(1000.0)).failure == "wrong values"
    assert judge(case, _told(1000.0, "column 'Displacement' has no unit: read in mm")).failure == "wrong values"
    assert judge(case, _told(1000.0, "column 'Load' has no unit: read in N")).answer == READ


def test_files_of_known_values_say_so_in_units_of_their_own():
    """Every role is met in several units, and the truth is the same whatever the units are."""
    cases = [units.make(Random(at)) for at in range(200)]
    assert {case.truth["time"][1] for case in cases if case.truth} == {0.5}
    words = {word for case in cases for behind in case.doubts.values() for word in behind}
    assert {"lbf", "psi", "GPa", "ms", "Load", "Zeit", "displacement"} <= words


def test_a_case_that_hangs_is_stopped_and_the_next_one_runs():
    """A file of 280 000 rows is not read in a millisecond."""
    stuck = Case("csv", ("read", "tension-7.csv"), {"tension-7.csv": {"repeat": render(plain()), "times": 20_000}})
    with Workers(1) as own:
        assert own.run(stuck, limit=1e-3).ended == "stopped after its time"
        assert own.run(GOOD["truth"]).status == 0


def test_a_case_is_made_small():
    """What fails is one cell among fourteen rows."""
    rows = plain()
    cells = [list(row) for row in rows.cells]
    cells[7][2] = "#BAD"
    case = Case("csv", CASE.command, {"tension-7.csv": render(Rows(cells, 1, 0)), "other.csv": "x"})
    small = minimised(case, lambda candidate: "#BAD" in candidate.files["tension-7.csv"])
    assert small.files == {"tension-7.csv": "#BAD\n"}


def test_a_content_is_short_where_the_file_is_long(tmp_path):
    content = ["a", {"repeat": {"gzip": "b"}, "times": 3}, {"base64": "/w=="}]
    write(tmp_path / "folder" / "file", content)
    data = (tmp_path / "folder" / "file").read_bytes()
    assert data == to_bytes(content)
    assert (data[:1], data[-1:]) == (b"a", b"\xff")
    assert len(data) == 2 + 3 * len(to_bytes({"gzip": "b"}))
