"""``probation companion``."""

import json
import tomllib

import numpy as np
import pytest

import probation
from probation import Campaign, Law, Record, Weissenberg
from probation.cli import main


@pytest.fixture(scope="module")
def campaign(tmp_path_factory):
    """Ramps at three rates, from (11) with the intercept of Table 2."""
    relation = Weissenberg(0.0046, 0.0406)
    records = []
    for seed, rate in enumerate((1e-4, 1e-3, 1e-2)):
        law = Law(unrelaxed_modulus=3220.0, alpha=1.0, hardening_modulus=1.8, companion=relation)
        time = np.linspace(0.0, 1.5 / rate, 80)
        stress = probation.ramp_stress(law, rate, time) + 0.04 * np.random.default_rng(seed).normal(size=80)
        records.append(Record(f"ramp-{seed}", time, rate * time, stress, control="strain-rate"))
    folder = tmp_path_factory.mktemp("ramps")
    Campaign("ramps", tuple(records)).save(folder)
    return folder


def table(tmp_path, rows, heading="rate_per_s,tau_max_s"):
    path = tmp_path / "times.csv"
    path.write_text("\n".join([heading, *rows]) + "\n", encoding="utf-8")
    return path


def test_table_2_tells_its_verdict_first_and_the_findings_after(tmp_path, capsys):
    files = [
        f"--{kind}={tmp_path / name}" for kind, name in (("json", "a.json"), ("report", "a.html"), ("plot", "a.png"))
    ]
    assert main(["companion", "--table-2", *files]) == 0
    out = capsys.readouterr().out
    assert out.startswith("Table 2 (André et al.): τ_max follows the form")
    assert (
        out.index("Relations")
        < out.index("left out of the calibration")
        < out.index("Eq. (11) as printed does not fit")
    )
    assert "+7.2, +4.4, +3.9 %" in out
    assert "1.196 and 1.222" in out
    told = json.loads((tmp_path / "a.json").read_text(encoding="utf-8"))
    assert told["schema"] == "probation.companion/1"
    assert told["relations"]["weissenberg"]["parameters"]["intercept"]["value"] == pytest.approx(0.0406, abs=5e-5)
    assert told["paper"]["alpha_ratios"][0]["as_printed"] == pytest.approx(1.196, abs=0.01)
    page = (tmp_path / "a.html").read_text(encoding="utf-8")
    assert all(text in page for text in ("0.00464", "0.0367", "0.0406", "Figure S2", "0.976"))
    assert (tmp_path / "a.png").stat().st_size > 10_000


def test_a_table_prints_what_goes_into_a_campaign(tmp_path, capsys):
    path = table(tmp_path, ["0.001,25.0,0.5", "0.01,3.0,0.06", "0.1,0.36,0.007"], "rate_per_s,tau_max_s,se_s")
    assert main(["companion", str(path), "--form", "power", "--toml"]) == 0
    companion = tomllib.loads(capsys.readouterr().out)["law"]["companion"]
    assert companion["form"] == "power"
    assert companion["calibrated_rates_per_s"] == [0.001, 0.1]
    assert np.shape(companion["covariance"]) == (2, 2)


def test_a_campaign_is_written_with_its_relation_and_can_be_fitted(campaign, tmp_path, capsys):
    out = tmp_path / "calibrated"
    assert main(["companion", str(campaign), "--form", "weissenberg", "--apply", str(out)]) == 0
    assert "wrote campaign" in capsys.readouterr().err
    assert main(["fit", str(out), "--json", "-"]) == 0
    alpha = json.loads(capsys.readouterr().out)["parameters"]["alpha"]
    assert abs(alpha["value"] - 1.0) < 4 * alpha["se"]


def test_data_files_stand_in_for_a_campaign_and_each_is_predicted_by_the_right_form_only(campaign, tmp_path, capsys):
    files = sorted(str(path) for path in campaign.glob("*.csv"))
    page, plot = tmp_path / "a.html", tmp_path / "a.svg"
    outputs = ["--json", "-", f"--report={page}", f"--plot={plot}"]
    assert main(["companion", *files, "--control", "strain-rate", "--route", "direct", *outputs]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["route"] == "direct"
    assert told["chosen"] == "weissenberg"
    middle = {each["form"]: each for each in told["predicted"] if each["record"] == "ramp-1"}
    assert middle["weissenberg"]["rms_MPa"] == pytest.approx(0.04, rel=0.3)  # nothing adjusted: the noise is left
    assert middle["power"]["rms_MPa"] > 0.1
    assert middle["constant"]["hardening_free_rms_MPa"] > 1.0
    scores = {name: each["left_out"]["rms"] for name, each in told["relations"].items()}
    assert scores["weissenberg"] < 1e-3 < scores["power"] < scores["constant"]
    assert "Records predicted from those at other rates" in page.read_text(encoding="utf-8")
    assert plot.exists()


@pytest.mark.parametrize(
    ("rows", "message"),
    [
        (["0.001,25.0", "0.01,-3.0"], "row 3: found tau_max = -3 s, expected a positive number"),
        (["0.001,25.0", "0.01,"], "row 3, column 'tau_max_s': found an empty cell, expected a number"),
        (["0.001,25.0", "0.01,abc"], "row 3, column 'tau_max_s': found 'abc', expected a number"),
        (["0.001,25.0"], "found one strain rate only"),
        (["0.001,25.0", "0.001,24.0"], "found one strain rate only (0.001, 0.001 1/s in row 2, row 3)"),
    ],
)
def test_a_bad_table_is_told_by_row_in_one_line(rows, message, tmp_path, capsys):
    assert main(["companion", str(table(tmp_path, rows))]) == 2
    captured = capsys.readouterr()
    assert message in captured.err
    assert captured.err.count("\n") == 1
    assert captured.out == ""


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ([], "found no CAMPAIGN"),
        (["x.csv", "--table-2"], "found 'x.csv' together with --table-2"),
        (["--table-2", "--apply", "out"], "--apply: found a table, expected a campaign"),
        (["--table-2", "--toml", "--json", "-"], "found both --toml and --json -"),
        (["nowhere"], "nowhere"),
    ],
)
def test_arguments_that_do_not_go_together_are_told(arguments, message, capsys):
    assert main(["companion", *arguments]) == 2
    assert message in capsys.readouterr().err
