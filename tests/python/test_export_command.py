"""``probation export`` and where its law comes from."""

import json

import numpy as np
import pytest

import probation
from probation import Campaign, InputError, Law, Record, Weissenberg, export, fit
from probation.cli import main
from probation.law.settings import CompanionSettings, LawSettings

SET = ["--set", "unrelaxed_modulus_MPa=3220", "--set", "hardening_modulus_MPa=1.85", "--set", "alpha=1.045"]
WITH_COMPANION = [*SET, "--companion", "weissenberg:0.00464,0.0367"]
LAW = Law(unrelaxed_modulus=3220.0, alpha=1.045, hardening_modulus=1.85, companion=Weissenberg(0.00464, 0.0367))


@pytest.fixture(scope="module")
def campaign():
    """A ramp with noise, identified under a companion relation."""
    time = np.linspace(0.0, 200.0, 301)
    noise = 0.04 * np.random.default_rng(3).normal(size=301)
    record = Record("ramp", time, 0.005 * time, LAW.stress(time, 0.005 * time, "exact") + noise, control="strain-rate")
    settings = CompanionSettings("weissenberg", {"slope": 0.00464, "intercept": 0.0367})
    return Campaign("hdpe", (record,), LawSettings(companion=settings))


@pytest.fixture(scope="module")
def identified(campaign):
    return fit(campaign)


def test_a_fit_its_json_and_its_campaign_give_the_same_law(campaign, identified, tmp_path):
    (tmp_path / "fit.json").write_text(identified.to_json(), encoding="utf-8")
    campaign.save(tmp_path)
    values = export(identified, "mgis").content.values
    assert export(tmp_path / "fit.json", "mgis").content.values == values
    assert export(campaign, "mgis").content.values == values
    assert export(tmp_path, "mgis").content.values == values
    assert "identified on hdpe (fit.json)" in export(tmp_path / "fit.json", "c").text
    assert values[4] == identified.parameters["alpha"].value


@pytest.mark.parametrize(
    "law",
    [
        LAW.reduced(modes=7),
        Law(unrelaxed_modulus=1.0, hardening_modulus=0.1, companion=probation.Table((1e-4, 1e-2), (9.0, 1.0), 1e-6)),
        Law(unrelaxed_modulus=1.0, hardening_modulus=0.1, tau_max=2.0, modes=20, decades=4.0),
    ],
    ids=["reduced", "table", "constant"],
)
def test_a_law_survives_json(law):
    from probation.answers import json_answer  # noqa: PLC0415
    from probation.law.answer import law_answer, law_from_answer  # noqa: PLC0415

    back = law_from_answer(json.loads(json_answer("law", {"law": law_answer(law)}))["law"])
    assert (back, back.spectrum, back.companion) == (back, law.spectrum, law.companion)
    assert back.parameters.tolist() == law.parameters.tolist()


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ("{", r"fit\.json: found no JSON"),
        (
            '{"schema": "probation.diagnosis/1"}',
            r"found the schema 'probation\.diagnosis/1', expected 'probation\.fit/1'",
        ),
        ('{"schema": "probation.fit/1"}', r"found no law .* fit again, or give the parameters by --set"),
        (
            '{"schema": "probation.fit/1", "law": {"parameters": {"beta": 1}, "modes": 50}}',
            r"fit\.json: law: found no 'beta' that is known",
        ),
    ],
)
def test_a_json_that_is_no_fit_is_named(tmp_path, text, complaint):
    (tmp_path / "fit.json").write_text(text, encoding="utf-8")
    with pytest.raises(InputError, match=complaint):
        export(tmp_path / "fit.json", "c")


def test_one_format_goes_to_standard_output_and_its_errors_to_the_other(capsys):
    assert main(["export", *WITH_COMPANION, "--format", "calculix"]) == 0
    out, err = capsys.readouterr()
    assert out == export(LAW, "calculix").text
    assert "round trip" in err


def test_one_format_goes_to_a_file_and_the_errors_to_json(tmp_path, capsys):
    target, answer = tmp_path / "hdpe.inp", tmp_path / "answer.json"
    options = ["--format", "abaqus-prony", "--rate", "1e-3", "--accuracy", "1e-3", "--strain", "0.2"]
    assert main(["export", *WITH_COMPANION, *options, "-o", str(target), "--json", str(answer)]) == 0
    assert target.read_text(encoding="utf-8") == export(LAW, "abaqus-prony", rate=1e-3, accuracy=1e-3, strain=0.2).text
    (told,) = json.loads(answer.read_text(encoding="utf-8"))["exports"]
    assert told["reduction"]["modes"] == 9
    assert told["checks"]["round_trip"]["relative"] < told["reduction"]["error"]
    assert "9 modes for 50" in capsys.readouterr().out


def test_all_formats_go_to_a_folder_but_those_that_cannot_represent_the_law(tmp_path, capsys):
    """Without --rate there is no Prony series of a law whose tau_max follows the rate."""
    assert (
        main(["export", *WITH_COMPANION, "--format", "all", "--folder", str(tmp_path / "new"), "--name", "HDPE"]) == 0
    )
    written = sorted(path.name for path in (tmp_path / "new").iterdir())
    assert written == [
        "hdpe-abaqus-plastic.inp",
        "hdpe-abaqus-umat.inp",
        "hdpe-c.h",
        "hdpe-calculix.inp",
        "hdpe-list.inc",
        "hdpe-ls-dyna-mat-024.k",
        "hdpe-mgis.json",
    ]
    assert capsys.readouterr().err.count("is left out: rate: found none") == 3


def test_the_formats_are_listed(capsys):
    assert main(["export", "--list-formats"]) == 0
    assert all(name in capsys.readouterr().out for name in ("abaqus-umat",))


@pytest.mark.parametrize(
    ("arguments", "complaint"),
    [
        (WITH_COMPANION, "--format: found none, expected one of abaqus-umat"),
        ([*WITH_COMPANION, "--format", "calculx"], "did you mean 'calculix'?"),
        ([*WITH_COMPANION, "--format", "c", "--format", "mgis"], "found 2 formats and no --folder"),
        ([*WITH_COMPANION, "--format", "c", "-o", "a", "--folder", "b"], "found both -o and --folder"),
        (["--format", "c"], "found neither SOURCE nor --set"),
        (["x.json", *WITH_COMPANION, "--format", "c"], "found SOURCE beside --set or --companion"),
        (["x.json", "--format", "all", "--folder", "."], "x.json: found no such file"),
        ([*WITH_COMPANION, "--format", "abaqus-prony"], "rate: found none"),
        ([*WITH_COMPANION, "--format", "c", "--rates", "1e-3;2"], "expected numbers between commas"),
    ],
)
def test_bad_arguments_are_told_in_one_line(arguments, complaint, capsys):
    assert main(["export", *arguments]) == 2
    message = capsys.readouterr().err
    assert complaint in message
    assert message.count("\n") == 1
