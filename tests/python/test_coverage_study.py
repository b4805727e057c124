"""The coverage study, in small: what it counts, and that the intervals hold; docs/uncertainty.md has it in full."""

import json

import numpy as np
import pytest
from numpy.testing import assert_allclose

import probation
from probation import InputError, Law
from probation.cli import main
from probation_studies.coverage import study as coverage
from probation_studies.coverage.study import CASES, Case, exact_interval, ramp_response, study

DRAWS = 40
LEAST = 33
"""Of 40 draws at 95 %, fewer have a chance of 0.1 %."""


def test_the_exact_interval_is_that_of_clopper_and_pearson():
    """No hit in n: 1 - 0.005^(1/n); and 95 of 100: 86.4 to 98.9 % by the binomial tails themselves."""
    assert_allclose(exact_interval(0, 10), (0.0, 1.0 - 0.005**0.1))
    assert_allclose(exact_interval(10, 10), (0.005**0.1, 1.0))
    low, high = exact_interval(95, 100)
    logs = np.cumsum(np.log(np.concatenate([[1.0], np.arange(1, 101)])))

    def below(hits, chance):  # P(X <= hits)
        k = np.arange(hits + 1)
        return np.exp(logs[100] - logs[k] - logs[100 - k] + k * np.log(chance) + (100 - k) * np.log1p(-chance)).sum()

    assert 1.0 - below(94, low) == pytest.approx(0.005, rel=1e-6)
    assert below(95, high) == pytest.approx(0.005, rel=1e-6)


def test_the_generator_is_eq_7():
    time = np.linspace(0.0, 400.0, 50)
    law = Law(unrelaxed_modulus=3224.0, tau_max=5.207, hardening_modulus=2.556)
    assert_allclose(ramp_response(time), probation.ramp_stress(law, 0.005, time), atol=1e-9)


def test_where_strain_noise_dominates_only_the_re_evaluated_weighting_holds(monkeypatch):
    monkeypatch.setattr(coverage, "SAMPLES", 80)
    case = Case("strain noise 1e-3, unsmoothed", 1e-3, excitation="raw")
    auto = study(DRAWS, seed=1, cases=(case,), methods=("auto",)).of(case.name, "auto")
    assert min(auto.hits.values()) >= LEAST
    assert abs(auto.bias["unrelaxed_modulus"]) < 0.05
    failing = study(12, seed=1, cases=(case,), methods=("plain", "strain-noise-frozen"))
    for method in ("plain", "strain-noise-frozen"):
        assert min(failing.of(case.name, method).hits.values()) <= 7  # of 12 at 95 %: a chance of 1 in 5000
        assert failing.of(case.name, method).bias["unrelaxed_modulus"] < -0.1


def test_where_stress_noise_dominates_or_is_autocorrelated_the_intervals_hold(monkeypatch):
    monkeypatch.setattr(coverage, "SAMPLES", 150)
    cases = (CASES[3], CASES[4])
    found = study(DRAWS, seed=2, cases=cases, methods=("auto",))
    for case in cases:
        assert min(found.of(case.name, "auto").hits.values()) >= LEAST


def test_a_study_goes_on_where_it_was_stopped(tmp_path, monkeypatch):
    state = tmp_path / "state.jsonl"
    options = {"cases": (CASES[3],), "methods": ("plain",), "state": state}
    first = study(2, **options)
    with state.open("a") as file:
        file.write('[0, "cut o')
    monkeypatch.setattr(coverage, "_judge", None)  # nothing is left to do
    again = study(2, **options)
    assert again == first
    state.write_text("rubbish\n" + state.read_text())
    with pytest.raises(InputError, match="line 1"):
        study(2, **options)


def test_a_line_that_a_kill_cut_off_does_not_spoil_the_next(tmp_path, monkeypatch):
    """The next one was appended to it: started a third time, the study refused its own file."""
    state = tmp_path / "state.jsonl"
    options = {"cases": (CASES[3],), "methods": ("plain",), "state": state}
    study(1, **options)
    with state.open("a") as file:
        file.write('[0, "cut o')
    second = study(2, **options)
    monkeypatch.setattr(coverage, "_judge", None)  # nothing is left to do
    assert study(2, **options) == second


def test_the_command_tells_and_writes(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(coverage, "CASES", (CASES[3],))
    monkeypatch.setattr(coverage.study, "__kwdefaults__", {**coverage.study.__kwdefaults__, "cases": (CASES[3],)})
    assert (
        main(["coverage", "--draws", "2", "--json", str(tmp_path / "c.json"), "--plot", str(tmp_path / "c.png")]) == 0
    )
    assert "stress noise 0.04 MPa" in capsys.readouterr().out
    answer = json.loads((tmp_path / "c.json").read_text())
    assert (answer["schema"], answer["seed"]) == ("probation.coverage/1", 0)
    assert main(["coverage", "--draws", "0"]) == 2


def counted(hits, draws):
    names = dict.fromkeys(coverage.TRUTH, hits)
    return coverage.Coverage((coverage.Counted("noise", "auto", draws, names, dict.fromkeys(names, 0.0)),), 0)


def test_few_draws_do_not_tell_that_intervals_hold():
    """3 of 3: the exact interval begins at 0.005^(1/3) = 17 %, and nothing is said to hold."""
    found = counted(3, 3)
    assert found.verdict.startswith("3 draws are too few to tell")
    assert "a coverage of 17 %" in found.verdict
    assert json.loads(found.to_json())["rows"][0]["parameters"]["tau_max"]["holds"] is None


def test_enough_draws_tell_whether_intervals_hold():
    """190 of 200: the interval begins at 89.5 %. None of 3: it ends at 83 %, and holds at no number of draws."""
    assert " hold: over 200 draws" in counted(190, 200).verdict
    assert "do not hold" in counted(0, 3).verdict
    needed = int(counted(3, 3).verdict.split("%. ")[1].split()[0])
    assert exact_interval(round(0.95 * needed), needed)[0] >= 0.85
