"""The cross-check of the schemes, and its command."""

import json
from dataclasses import replace

import numpy as np
import pytest

import probation
from probation.cli import main
from probation.law.schemes import make_solver
from probation.published.experiments import RAMP_LAW, experiment_1, experiment_3, twin_campaign
from probation.records.record import Record
from probation.report.crosscheck_page import sections
from probation.schemes import candidates
from probation.schemes.steps import observed_order


@pytest.fixture(scope="module")
def answer():
    return probation.crosscheck()


def schemes(answer, record):
    return {check.name: check for check in answer.records[record].schemes}


@pytest.mark.parametrize("record", [0, 1])
@pytest.mark.parametrize(("name", "order"), [("be2", 2), ("be2, paper's start", 2), ("sa2", 2), ("sa3", 3)])
def test_each_scheme_shows_its_order_on_a_smooth_history(record, name, order, answer):
    assert schemes(answer, record)[name].order == pytest.approx(order, abs=0.1)


def test_the_schemes_agree_on_the_ramp_within_what_physics_states(answer):
    """sa3 1e-6, cvode 1e-6, eq. (7) round-off; the paper's start some five times worse than the better one."""
    found = {name: check.largest_error_MPa for name, check in schemes(answer, 0).items()}
    assert found["sa3"] < 1e-6
    assert found["cvode"] < 1e-6
    assert found["eq. (7)"] < 1e-11
    assert 3 < found["be2, paper's start"] / found["be2"] < 8


def test_the_closed_form_is_left_out_where_it_does_not_hold(answer):
    assert "eq. (7)" not in schemes(answer, 1)


def test_the_verdict_comes_first_and_says_the_largest_difference(answer):
    summary = answer.summary()
    assert summary.startswith(
        f"All schemes agree within {answer.agreement_MPa:.2g} MPa; leaving out be2 with the paper"
    )
    assert "cvode: steps " in summary


def test_the_answer_as_json_carries_every_scheme(answer):
    told = json.loads(answer.to_json())
    assert told["schema"] == "probation.crosscheck/1"
    first = told["records"][0]
    assert {check["name"] for check in first["schemes"]} == set(schemes(answer, 0))
    assert first["schemes"][4]["order"] is None
    assert len(first["steps"]["step_s"]) == 6
    assert len(first["data_sha256"]) == 64


def test_without_a_smooth_history_there_is_no_order_and_an_empty_plot(answer):
    flat = replace(answer, records=tuple(replace(record, steps=None) for record in answer.records))
    assert len(sections(flat)) == 2
    assert flat.plot().axes == []


def test_progress_is_told():
    told = []
    twin = experiment_1()
    record = Record(id="r", time=twin.time[:50], true_strain=twin.true_strain[:50], true_stress=twin.true_stress[:50])
    probation.crosscheck([record, replace(record, id="s")], RAMP_LAW, progress=lambda *what: told.append(what))
    assert told[0][:2] == (0, 2)
    assert told[-1] == (1, 2, "s by eq. (7)")


def test_the_page_is_one_small_file(answer, tmp_path):
    answer.report(tmp_path / "page.html")
    assert 50_000 < (tmp_path / "page.html").stat().st_size < 2_000_000


def test_on_a_rough_record_cvode_still_agrees_with_exact():
    """It starts afresh at every sample: it cannot step across the kinks of a piecewise-linear history."""
    twin = experiment_1(strain_noise=1e-4)
    record = Record(
        id="rough", time=twin.time[:300], true_strain=twin.true_strain[:300], true_stress=twin.true_stress[:300]
    )
    found = schemes(probation.crosscheck([record], RAMP_LAW), 0)
    assert found["cvode"].failure == ""
    assert found["cvode"].largest_error_MPa < 1e-6


def test_a_scheme_that_fails_is_told_and_the_others_go_on(monkeypatch):
    twin = experiment_3()

    def refuse(history, scheme):
        if scheme.name == "cvode" and len(history) == len(twin.time):  # not the finer reference of the study of steps
            raise probation.ConvergenceError("stopped at t = 3 s")
        return make_solver(history, scheme)

    monkeypatch.setattr(candidates, "make_solver", refuse)
    answer = probation.crosscheck([twin.record()], twin.truth)
    assert schemes(answer, 0)["cvode"].failure == "stopped at t = 3 s"
    assert answer.verdict.startswith("All schemes but cvode, which failed, agree within")
    assert "cvode failed: stopped at t = 3 s" in answer.summary()


def test_an_order_is_not_observed_below_round_off():
    assert np.isnan(observed_order(np.array([1e-12, 1e-12, 1e-13])))
    assert observed_order(np.array([8e-3, 1e-3, 1e-10])) == pytest.approx(3.0)


def test_records_need_a_law():
    with pytest.raises(probation.InputError, match="expected both or neither"):
        probation.crosscheck([experiment_1().record()])


def test_the_command_takes_a_campaign_and_a_law(tmp_path, capsys):
    twin_campaign((2,)).save(tmp_path / "c")
    arguments = [str(tmp_path / "c"), "--record", "experiment-2", "--set", "alpha=1.1"]
    page, plot = tmp_path / "p.html", tmp_path / "p.png"
    arguments += ["--set", "hardening_modulus_MPa=1.8", "--json", "-", "--report", str(page), "--plot", str(plot)]
    assert main(["crosscheck", *arguments]) == 0
    captured = capsys.readouterr()
    told = json.loads(captured.out)
    assert told["law"].startswith(
        "unrelaxed_modulus_MPa 3220, alpha 1.1, hardening_modulus_MPa 1.8, companion relation"
    )
    assert captured.err.startswith("All schemes agree within")
    assert page.exists()
    assert plot.exists()


def test_the_command_identifies_what_is_not_set(tmp_path, capsys):
    twin_campaign((1,)).save(tmp_path / "c")
    assert main(["crosscheck", str(tmp_path / "c" / "campaign.toml")]) == 0
    assert "Law: unrelaxed_modulus_MPa 32" in capsys.readouterr().out


def test_the_command_suggests_the_nearest_record(tmp_path, capsys):
    twin_campaign((1,)).save(tmp_path / "c")
    assert main(["crosscheck", str(tmp_path / "c"), "--record", "experiment-2"]) == 2
    assert "experiment-1" in capsys.readouterr().err
