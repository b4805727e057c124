"""``probation simulate`` as users' scripts rely on it."""

import csv
import json

import numpy as np
import pytest

import probation
from probation.cli import main

SET = {"unrelaxed_modulus_MPa": 3220.0, "tau_max_s": 5.2, "hardening_modulus_MPa": 2.5}


def settings(**values):
    return [text for name, value in values.items() for text in ("--set", f"{name}={value}")]


LAW = settings(**SET)
WITH_COMPANION = settings(unrelaxed_modulus_MPa=3220.0, hardening_modulus_MPa=1.8)


@pytest.fixture
def history(tmp_path):
    """A history whose numbers need every digit."""
    time = np.cumsum(np.random.default_rng(1).uniform(0.1, 0.3, 60))
    strain = 0.004 * time + 0.01 * np.sin(time / 3.0)
    path = tmp_path / "history.csv"
    rows = [f"{a!r},{b!r}" for a, b in zip(time.tolist(), strain.tolist(), strict=True)]
    path.write_text("\n".join(["time_s,true_strain", *rows]) + "\n", encoding="utf-8")
    return path, time, strain


def columns(path):
    with path.open(encoding="utf-8", newline="") as stream:
        header, *rows = csv.reader(stream)
    return header, np.array(rows, dtype=np.float64).T


@pytest.mark.parametrize("scheme", ["be2", "sa2", "sa3", "exact", "cvode"])
def test_the_answer_is_that_of_the_library_to_the_last_digit_at_the_same_instants(scheme, history, tmp_path):
    path, time, strain = history
    out = tmp_path / "out.csv"
    assert main(["simulate", str(path), "--scheme", scheme, *LAW, "-o", str(out)]) == 0
    header, (times, strains, stress) = columns(out)
    assert header == ["time_s", "true_strain", "true_stress_MPa"]
    law = probation.Law(unrelaxed_modulus=3220.0, tau_max=5.2, hardening_modulus=2.5)
    assert (times == time).all()
    assert (strains == strain).all()
    assert (stress == law.stress(time, strain, scheme)).all()


def test_given_rates_are_used(tmp_path):
    time = np.linspace(0.0, 100.0, 41)
    strain, rate = 1e-5 * time**2, 2e-5 * time
    path, out = tmp_path / "h.csv", tmp_path / "o.csv"
    rows = "".join(
        f"{a!r},{b!r},{c!r}\n" for a, b, c in zip(*map(np.ndarray.tolist, (time, strain, rate)), strict=True)
    )
    path.write_text("time_s,true_strain,strain_rate_per_s\n" + rows, encoding="utf-8")
    assert main(["simulate", str(path), "--scheme", "sa3", *LAW, "-o", str(out)]) == 0
    law = probation.Law(unrelaxed_modulus=3220.0, tau_max=5.2, hardening_modulus=2.5)
    assert (
        columns(out)[1][2] == law.stress(probation.StrainHistory(time, strain, strain_rate=rate), scheme="sa3")
    ).all()


def test_modes_and_decades_can_be_set(history, tmp_path):
    path, time, strain = history
    out = tmp_path / "o.csv"
    assert main(["simulate", str(path), *LAW, *settings(modes=30, decades=5), "-o", str(out)]) == 0
    law = probation.Law(unrelaxed_modulus=3220.0, tau_max=5.2, hardening_modulus=2.5, modes=30, decades=5)
    assert (columns(out)[1][2] == law.stress(time, strain)).all()


@pytest.mark.parametrize(
    ("companion", "relation"),
    [
        ("weissenberg:0.00464,0.0367", probation.Weissenberg(0.00464, 0.0367)),
        ("exponential:27.24,-2.1", probation.Exponential(27.24, -2.1)),
        ("power:0.03,-0.95", probation.PowerLaw(0.03, -0.95)),
    ],
)
def test_a_companion_relation_is_applied(companion, relation, history, tmp_path, capsys):
    path, time, strain = history
    out = tmp_path / "o.csv"
    arguments = ["simulate", str(path), "--companion", companion, *WITH_COMPANION, *settings(alpha=1.1)]
    assert main([*arguments, "-o", str(out)]) == 0
    law = probation.Law(unrelaxed_modulus=3220.0, alpha=1.1, hardening_modulus=1.8, companion=relation)
    assert (columns(out)[1][2] == law.stress(time, strain)).all()


def test_a_companion_table_is_read_from_a_file(history, tmp_path):
    path, time, strain = history
    table, out = tmp_path / "table.csv", tmp_path / "o.csv"
    table.write_text("rate_per_s,tau_max_s\n1e-5,2000\n1e-3,22\n1e-1,0.3\n", encoding="utf-8")
    assert main(["simulate", str(path), "--companion", f"table:{table}", *WITH_COMPANION, "-o", str(out)]) == 0
    relation = probation.Table((1e-5, 1e-3, 1e-1), (2000.0, 22.0, 0.3))
    law = probation.Law(unrelaxed_modulus=3220.0, hardening_modulus=1.8, companion=relation)
    assert (columns(out)[1][2] == law.stress(time, strain)).all()


def test_extrapolating_the_companion_relation_is_warned_of(capsys):
    arguments = ["--history", "ramp:rate=0.1", "--companion", "weissenberg:0.00464,0.0367", *WITH_COMPANION]
    assert main(["simulate", *arguments]) == 0
    err = capsys.readouterr().err
    assert err.startswith("warning: ")
    assert "strain rates 0.1 to 0.1 1/s leave the range" in err


def test_without_output_a_picture_goes_to_the_terminal(capsys):
    assert main(["simulate", "--history", "ramp", *LAW]) == 0
    out = capsys.readouterr().out
    assert out.startswith("Simulated ramp at 0.005 1/s to true strain 2: true stress from 0 to ")
    assert "true stress [MPa]" in out


def test_json_alone_goes_to_standard_output(capsys):
    assert main(["simulate", "--history", "ramp:samples=11", *LAW, "--json", "-"]) == 0
    captured = capsys.readouterr()
    answer = json.loads(captured.out)
    assert answer["schema"] == "probation.simulation/1"
    assert answer["version"] == probation.__version__
    assert answer["law"]["parameters"] == SET
    assert len(answer["true_stress_MPa"]) == 11
    assert len(answer["data_sha256"]) == 64
    assert captured.err.startswith("Simulated ramp")


@pytest.mark.parametrize("ending", ["png", "svg", "pdf"])
def test_a_plot_is_saved(ending, tmp_path):
    plot = tmp_path / f"plot.{ending}"
    assert main(["simulate", "--history", "cyclic:samples=200", *LAW, "--plot", str(plot)]) == 0
    assert plot.stat().st_size > 3000


def test_creep_finds_the_strain_that_carries_the_stress(tmp_path):
    out = tmp_path / "o.csv"
    arguments = ["--history", "creep:stress=20,duration=60,samples=300", *LAW, "-o", str(out)]
    assert main(["simulate", *arguments]) == 0
    _, (time, strain, stress) = columns(out)
    assert stress[-1] == 20.0
    assert (np.diff(strain) > 0).all()
    law = probation.Law(unrelaxed_modulus=3220.0, tau_max=5.2, hardening_modulus=2.5)
    np.testing.assert_allclose(
        law.stress(probation.StrainHistory(time, strain, jumps=[1.0]), scheme="be2"), stress, atol=1e-6
    )


def test_histories_are_listed_with_units_and_defaults(capsys):
    assert main(["simulate", "--list-histories"]) == 0
    out = capsys.readouterr().out
    for name in ("ramp", "rate-jump", "relaxation", "load-unload", "cyclic", "necking", "creep"):
        assert f"{name}: " in out
    assert "rate=0.005 1/s" in out


@pytest.mark.parametrize(
    ("rows", "told"),
    [
        ("0,0\n1,abc\n2,0.2\n", ["row 3", "'true_strain'", "found 'abc'", "expected a number"]),
        ("0,0\n1,nan\n2,0.2\n", ["row 3", "'true_strain'", "found 'nan'", "expected a finite number"]),
        ("0,0\n1,\n2,0.2\n", ["row 3", "'true_strain'", "found an empty cell"]),
        ("0,0\n2,0.1\n1,0.2\n", ["row 4", "'time_s'", "found 1 after 2", "increases"]),
        ("0,0\n1,0.1\n1,0.2\n", ["row 4", "found 1 after 1"]),
        ("0,0\n", ["row 2", "found one instant", "at least two"]),
    ],
)
def test_a_bad_history_is_told_by_file_row_and_column(rows, told, tmp_path, capsys):
    path = tmp_path / "bad.csv"
    path.write_text("time_s,true_strain\n" + rows, encoding="utf-8")
    assert main(["simulate", str(path), *LAW]) == 2
    err = capsys.readouterr().err
    assert err.count("\n") == 1
    assert all(part in err for part in ["bad.csv", *told])


def test_a_history_without_strain_names_the_headings(tmp_path, capsys):
    path = tmp_path / "bad.csv"
    path.write_text("time_s,stress\n0,0\n1,1\n", encoding="utf-8")
    assert main(["simulate", str(path), *LAW]) == 2
    assert "found no column 'true_strain' among 'time_s' and 'stress'" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        ([], "neither a file nor --history"),
        (["a.csv", "--history", "ramp"], "both a file and --history"),
        (["--history", "rmap"], "did you mean 'ramp'?"),
        (["--history", "ramp:rte=1"], "did you mean 'rate'?"),
        (["--history", "ramp:rate=fast"], "found rate=fast, expected a number in 1/s above 0"),
        (["--history", "ramp:rate=0"], "expected a number in 1/s above 0"),
        (["--history", "ramp:rate"], "expected parameter=value"),
        (["--history", "ramp:rate=1,rate=2"], "found rate twice"),
        (["--history", "ramp:samples=3.5"], "expected a whole number of at least 10"),
        (["--history", "ramp:strain=0"], "found strain=0"),
        (["--history", "necking:set=P4"], "expected one of P1, P2, P3"),
        (["--history", "rate-jump:jump_at=2"], "expected less than strain"),
        (["--history", "load-unload:unload_to=2"], "expected less than strain"),
        (["--history", "cyclic:cycles=50,samples=100"], "expected at least 201 for 100 legs"),
        (["--history", "ramp", "--set", "tau_max=5"], "did you mean 'tau_max_s'?"),
        (["--history", "ramp", "--set", "tau_max_s"], "expected NAME=VALUE"),
        (["--history", "ramp", "--set", "tau_max_s=slow"], "--set tau_max_s: found 'slow', expected a number"),
        (["--history", "ramp", "--set", "tau_max_s=nan"], "expected a finite number"),
        (["--history", "ramp", "--set", "tau_max_s=5", "--set", "tau_max_s=5"], "found tau_max_s twice"),
        (["--history", "ramp", "--companion", "weisenberg:1,2"], "did you mean 'weissenberg'?"),
        (["--history", "ramp", "--companion", "power:1"], "expected power:C,E"),
        (["--history", "ramp", "--companion", "power:1,inf"], "expected finite numbers"),
        (["--history", "ramp", "--companion", "table"], "expected table:FILE"),
        (["--history", "ramp", "-o", "-", "--json", "-"], "expected one of them on standard output"),
    ],
)
def test_bad_options_are_told_in_one_line(arguments, told, capsys):
    assert main(["simulate", *arguments]) == 2
    err = capsys.readouterr().err
    assert err.count("\n") == 1
    assert told in err


@pytest.mark.parametrize(
    ("values", "told"),
    [
        ({"unrelaxed_modulus_MPa": 3220, "hardening_modulus_MPa": 2.5}, "found no tau_max_s"),
        ({**SET, "alpha": 1}, "found it without --companion"),
        ({**SET, "modes": 2.5}, "expected a whole number"),
        ({**SET, "tau_max_s": -1}, "tau_max is -1"),
    ],
)
def test_a_law_that_cannot_be_is_told_in_one_line(values, told, capsys):
    assert main(["simulate", "--history", "ramp", *settings(**values)]) == 2
    assert told in capsys.readouterr().err


def test_tau_max_and_a_companion_relation_exclude_each_other(capsys):
    assert main(["simulate", "--history", "ramp", "--companion", "power:0.03,-1", *LAW]) == 2
    assert "found it together with --companion, expected alpha" in capsys.readouterr().err


def test_an_existing_answer_is_replaced_whole_or_not_at_all(history, tmp_path):
    path, *_ = history
    out = tmp_path / "out.csv"
    out.write_text("old", encoding="utf-8")
    assert main(["simulate", str(path), "--set", "tau_max_s=0", "-o", str(out)]) == 2
    assert out.read_text(encoding="utf-8") == "old"
    assert main(["simulate", str(path), *LAW, "-o", str(out)]) == 0
    assert out.read_text(encoding="utf-8").startswith("time_s,")
    assert sorted(each.name for each in tmp_path.iterdir()) == ["history.csv", "out.csv"]


def test_an_answer_that_cannot_be_written_is_bad_input(history, tmp_path, capsys):
    path, *_ = history
    assert main(["simulate", str(path), *LAW, "-o", str(tmp_path / "missing" / "o.csv")]) == 2
    assert "cannot be written: found no folder" in capsys.readouterr().err


def test_a_strain_history_in_percent_is_refused_with_the_way_to_say_so(tmp_path, capsys):
    """25 % read as 25 is a stretch of 7e10."""
    (tmp_path / "percent.csv").write_text("time_s,true_strain\n0,0\n1,4\n2,25\n", encoding="utf-8")
    assert main(["simulate", str(tmp_path / "percent.csv"), *LAW, "-o", str(tmp_path / "out.csv")]) == 2
    told = capsys.readouterr().err
    assert "row 4, column 'true_strain': found true strain 25 without a unit, expected at most 5" in told
    assert 'head the column "true_strain (%)"' in told
