"""``probation excitation`` and its answers."""

import json

import numpy as np
import pytest
from numpy.testing import assert_allclose

from probation import Campaign, Record, excite
from probation.cli import main
from probation.published.experiments import twin_campaign
from probation.smoothing.answer import CSV_HEADER, describe_excitation
from probation_studies.smoothing.known_histories import KNOWN_HISTORIES


@pytest.fixture
def jump_file(tmp_path):
    """A jump by ten at 40 s, noise 2e-5."""
    known = KNOWN_HISTORIES["jump"][1](np.random.default_rng(1))
    strain = known.true_strain + 2e-5 * np.random.default_rng(2).normal(size=len(known.time))
    path = tmp_path / "jump.csv"
    rows = np.column_stack([known.time, strain, 50.0 * strain])
    np.savetxt(path, rows, delimiter=",", header="time_s,true_strain,true_stress_MPa", comments="")
    return path


def test_the_verdict_comes_first(jump_file, capsys):
    assert main(["excitation", str(jump_file)]) == 0
    said = capsys.readouterr().out
    assert said.startswith("jump: strain rate 0.0017 … 0.017 1/s (×10), known to 0.00")
    assert " ".join(said.split("\n\n")[0].split()).endswith("1 jump at 40 s")
    assert "quintic smoothing spline" in said
    assert "strain noise" in said


def test_strain_alone_will_do_and_is_said(jump_file, capsys):
    rows = [line.rsplit(",", 1)[0] for line in jump_file.read_text().splitlines()]
    jump_file.write_text("\n".join(rows))
    assert main(["excitation", str(jump_file)]) == 0
    said = capsys.readouterr().out
    assert said.startswith("jump: strain rate 0.0017 … 0.017 1/s")
    assert "warning: strain alone was read" in said
    assert "no stress column" in said


def test_csv_json_plot_and_page_are_written(jump_file, tmp_path, capsys):
    names = [str(tmp_path / name) for name in ("out.csv", "out.json", "out.png", "out.html")]
    arguments = ["--csv", names[0], "--json", names[1], "--plot", names[2], "--report", names[3]]
    assert main(["excitation", str(jump_file), "--method", "spline", *arguments]) == 0
    header = (tmp_path / "out.csv").read_text().splitlines()[0]
    assert header == CSV_HEADER == "time_s,true_strain,strain_rate_per_s,true_strain_se,strain_rate_se_per_s"
    rows = np.genfromtxt(tmp_path / "out.csv", delimiter=",", skip_header=1)
    assert rows.shape == (1501, 5)
    assert np.quantile(np.abs(rows[:740, 2] / 1.7e-3 - 1.0), 0.95) < 0.005
    answer = json.loads((tmp_path / "out.json").read_text())
    assert answer["schema"] == "probation.excitation/1"
    found = answer["records"]["jump"]
    assert found["method"] == "spline"
    assert found["rate_jumps_s"] == [pytest.approx(40.0, abs=0.1)]
    assert 0.0 < found["relative_se_of_rate"]["median"] < 0.005
    page = (tmp_path / "out.html").read_text()
    assert "known to" in page
    assert page.count("<figure") == 3


def test_a_campaigns_record_is_chosen_by_its_id(tmp_path, capsys):
    twin_campaign((2, 3)).save(tmp_path / "twins")
    assert main(["excitation", str(tmp_path / "twins"), "--record", "experiment-3"]) == 0
    said = capsys.readouterr().out
    assert said.startswith(
        "experiment-3: strain rate 0.0017 … 0.017 1/s (×10), without noise"
    )  # the synthetic record's strain has no noise: taken as it is
    assert "no jumps" in said
    assert "experiment-2" not in said
    assert main(["excitation", str(tmp_path / "twins"), "--csv", "-"]) == 2
    assert (
        "found the records experiment-2, experiment-3, expected one with --csv; add --record ID"
        in capsys.readouterr().err
    )
    assert main(["excitation", str(tmp_path / "twins"), "--record", "experiment-4"]) == 2
    assert "found no record" in capsys.readouterr().err


def test_the_necking_page_has_the_supplementary_figures(tmp_path):
    known = KNOWN_HISTORIES["necking"][1](np.random.default_rng(1))
    strain = known.true_strain[::3] + 1e-3 * np.random.default_rng(2).normal(size=501)
    record = Record("grips", known.time[::3], strain, np.zeros(501), control="displacement-rate")
    answer = describe_excitation([record], "necking")
    assert "(A-1) leaves" in answer.summary()
    page = answer.report(tmp_path / "page.html").read_text()
    for number in range(3, 9):
        assert f"Figure S{number}" in page
    steps = json.loads(answer.to_json())["records"]["grips"]["two_steps"]
    assert steps["strain"]["c"] == pytest.approx(0.7055, rel=0.05)


def test_the_integrated_rate_follows_the_strain_across_a_jump(jump_file):
    (record,) = Campaign.from_files([jump_file]).records
    (found,) = describe_excitation([record]).records
    assert np.abs(found.integrated - record.true_strain).max() < 5e-4  # half a step at the wrong rate at most


def test_load_and_unload_have_a_turning_point_and_no_ratio():
    time = np.linspace(0.0, 20.0, 1001)
    strain = 0.01 * np.minimum(time, 20.0 - time) + 1e-6 * np.random.default_rng(0).normal(size=1001)
    (found,) = describe_excitation([Record("cycle", time, strain, np.zeros(1001), control="cyclic")]).records
    assert found.verdict.startswith("cycle: strain rate -0.01 … 0.01 1/s, known to")
    assert found.verdict.endswith("1 jump at 10 s")


def test_a_record_that_does_not_move_has_rate_zero():
    time = np.linspace(0.0, 20.0, 101)
    (found,) = describe_excitation([Record("still", time, np.zeros(101), np.zeros(101), control="hold")]).records
    assert found.verdict == "still: strain rate zero"


def test_noise_that_is_left_in_the_rate_is_warned_of():
    """Central differences of noise 1e-3 at 0.02 s scatter by 0.035 1/s, three times the rate."""
    time = np.linspace(0.0, 20.0, 1001)
    strain = 0.01 * time + 1e-3 * np.random.default_rng(0).normal(size=1001)
    (found,) = describe_excitation([Record("ramp", time, strain, np.zeros(1001))], "raw").records
    assert any("mostly noise" in warning for warning in found.warnings)


def test_a_run_up_of_two_samples_is_followed():
    """The machine reaches its speed within two samples, and loses five hundred times the noise."""
    time = np.linspace(0.0, 20.0, 1001)
    strain = 0.01 * np.maximum(time - 0.05, 0.0)
    record = Record("run-up", time, strain + 1e-6 * np.random.default_rng(0).normal(size=1001), np.zeros(1001))
    (found,) = describe_excitation([record], "quintic-spline").records
    assert not found.warnings
    assert_allclose(excite(record, "quintic-spline").true_strain, strain, atol=2e-6)


def test_a_twitch_that_is_too_sharp_to_follow_is_warned_of():
    """Of four samples, amid a ramp: so short a bend is no segment, and no spline follows it."""
    time = np.linspace(0.0, 20.0, 1001)
    twitch = 1e-4 * np.exp(-(((time - 10.0) / 0.04) ** 2))
    strain = 0.01 * time + twitch + 1e-6 * np.random.default_rng(0).normal(size=1001)
    record = Record("twitch", time, strain, np.zeros(1001))
    (found,) = describe_excitation([record], "quintic-spline").records
    assert any("more than 8 times the noise" in warning and "raw takes" in warning for warning in found.warnings)
    (found,) = describe_excitation([record], "raw").records
    assert not any("times the noise" in warning for warning in found.warnings)


def test_the_comparison_names_the_default_and_the_aim(tmp_path, capsys, monkeypatch):
    monkeypatch.setattr("probation_studies.smoothing.comparison.NOISES", (2e-5,))
    monkeypatch.setattr("probation_studies.smoothing.comparison.COMPARED", ("raw", "quintic-spline"))
    monkeypatch.setattr("probation_studies.smoothing.comparison.KNOWN_HISTORIES", {"jump": KNOWN_HISTORIES["jump"]})
    arguments = ["--draws", "1", "--json", str(tmp_path / "c.json"), "--plot", str(tmp_path / "c.png")]
    assert main(["excitation", "--compare", *arguments]) == 0
    assert capsys.readouterr().out.startswith("Default quintic-spline: 95 % of the rates are within 0.0")
    answer = json.loads((tmp_path / "c.json").read_text())
    assert answer["schema"] == "probation.excitation-comparison/1"
    assert {row["method"] for row in answer["results"]} == {"raw", "quintic-spline"}


@pytest.mark.parametrize(
    ("arguments", "complaint"),
    [
        ([], "found no file, expected FILE"),
        (["--compare", "--csv", "a.csv"], "found --csv together with --compare"),
        (["{file}", "--draws", "3"], "found --draws or --seed without --compare"),
        (["{file}", "--method", "loess"], "invalid choice: 'loess'"),
        (["{file}", "--method", "necking"], "record 'jump', excitation 'necking': found a rate that jumps at 40"),
        (["{file}", "--json", "-", "--csv", "-"], "expected one of them on standard output"),
        (["missing.csv"], "missing.csv"),
        (["--compare", "--draws", "0"], "expected a whole number from 1"),
    ],
)
def test_bad_input_is_said_in_one_line(arguments, complaint, jump_file, capsys):
    assert main(["excitation", *(each.format(file=jump_file) for each in arguments)]) == 2
    said = capsys.readouterr().err
    assert complaint in said
    assert said.count("\n") == 1
