"""``probation export`` and where its law comes from."""

import json
import re

import numpy as np
import pytest

import probation
from probation import Campaign, InputError, Law, Record, Weissenberg, export, fit
from probation.cli import main
from probation.exporting.check import compared
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


def test_a_card_says_what_its_fit_says_of_itself(identified, tmp_path):
    """A parameter may not be determined: whoever computes with the card must read it there."""
    (tmp_path / "fit.json").write_text(identified.to_json(), encoding="utf-8")
    for source in (identified, tmp_path / "fit.json"):
        card = export(source, "abaqus-umat")
        verdict = identified.verdict.removesuffix(".")
        assert verdict in " ".join(card.text.replace("\n** ", " ").split())
        assert verdict in " ".join(card.summary().split())


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


GOOD = {
    "parameters": {"unrelaxed_modulus_MPa": 3220.0, "alpha": 1.0, "hardening_modulus_MPa": 1.85},
    "modes": 2,
    "decades": 6.0,
    "companion": {
        "form": "weissenberg",
        "slope": 0.00464,
        "intercept": 0.0367,
        "rate_floor_per_s": 1e-7,
        "calibrated_rates_per_s": [5e-5, 1e-2],
    },
    "spectrum": {"relaxation_ratio": [0.01, 1.0], "modal_weight": [0.5, 0.5]},
}
NAN = float("nan")


def changed(place, value):
    """A good law with one entry replaced: ``changed("companion.slope", 3)``; left out where the value is `...`."""
    law = json.loads(json.dumps(GOOD))
    *above, key = place.split(".")
    table = law
    for each in above:
        table = table[each]
    if value is ...:
        del table[key]
    else:
        table[key] = value
    return law


@pytest.mark.parametrize(
    ("place", "value", "complaint"),
    [
        ("parameters", None, "law.parameters: found a value of type NoneType, expected a table"),
        ("parameters", [1, 2], "law.parameters: found a value of type list, expected a table"),
        ("parameters.unrelaxed_modulus_MPa", ..., "law.parameters: found no unrelaxed_modulus_MPa, expected it"),
        ("parameters.unrelaxed_modulus_MPa", None, "law.parameters.unrelaxed_modulus_MPa is None; a number is needed"),
        ("parameters.unrelaxed_modulus_MPa", "3220", "law.parameters.unrelaxed_modulus_MPa is '3220'; a number"),
        ("parameters.unrelaxed_modulus_MPa", 10**400, "law.parameters.unrelaxed_modulus_MPa is too large|401 digits"),
        ("parameters.unrelaxed_modulus_MPa", NAN, "unrelaxed_modulus is nan"),
        ("parameters.unrelaxed_modulus_MPa", 0, "unrelaxed_modulus"),
        ("parameters.unrelaxed_modulus_MPa", 1e308, "unrelaxed_modulus"),
        ("modes", ..., "law: found no modes, expected it"),
        ("modes", "50", "law.modes is '50'; a whole number"),
        ("modes", 50, "law.modes: found 50 together with a spectrum of 2, expected as many"),
        ("decades", NAN, "decades is nan; a positive number is needed"),
        ("decades", [6], r"law.decades is \[6\]; a number is needed"),
        ("companion", "weissenberg", "law.companion: found 'weissenberg', expected a table"),
        ("companion.form", ..., "law.companion: found no form, expected it"),
        ("companion.form", ["weissenberg"], "law.companion.form: found a value of type list, expected one of"),
        ("companion.slope", ..., "law.companion: found no slope, expected it"),
        ("companion.slope", NAN, "slope is nan; a finite number is needed"),
        ("companion.slope", 1e308, "tau_max"),
        ("companion.self", 1, "law.companion: found no 'self' that is known of the form weissenberg"),
        ("companion.calibrated_rates_per_s", "x", "calibrated"),
        ("companion.calibrated_rates_per_s", [1e-3], "calibrated is .* expected two positive rates"),
        ("companion.calibrated_rates_per_s", [1e-2, 1e-3], "calibrated is .* the lower one first"),
        ("companion.calibrated_rates_per_s", [[1], [2]], "calibrated"),
        ("spectrum", [1, 2], "law.spectrum: found a value of type list, expected a table"),
        ("spectrum.modal_weight", ..., "law.spectrum: found no modal_weight, expected it"),
        ("spectrum.modal_weight", [0.5, None], "modal_weight"),
        ("spectrum.modal_weight", [1.0], "modal_weight has 1 entries, relaxation_ratio 2"),
    ],
)
def test_a_law_in_json_that_no_law_can_be_is_refused_in_one_line(tmp_path, capsys, place, value, complaint):
    text = json.dumps({"schema": "probation.fit/1", "law": changed(place, value)})
    (tmp_path / "fit.json").write_text(text, encoding="utf-8")
    assert main(["export", str(tmp_path / "fit.json"), "--format", "mgis"]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err.count("\n") == 1
    assert re.match(rf"probation: .*fit\.json: .*({complaint})", err)


def test_the_good_law_of_these_cases_is_exported(tmp_path):
    (tmp_path / "fit.json").write_text(json.dumps({"schema": "probation.fit/1", "law": GOOD}), encoding="utf-8")
    assert export(tmp_path / "fit.json", "mgis").checks[0].error == 0.0


@pytest.mark.parametrize(
    "text", ["[" * 100_000, '{"schema":' * 20_000, "null", "[1]", '{"schema": ["probation.fit/1"]}']
)
def test_a_json_of_another_shape_is_refused_in_one_line(tmp_path, capsys, text):
    (tmp_path / "fit.json").write_text(text, encoding="utf-8")
    assert main(["export", str(tmp_path / "fit.json"), "--format", "mgis"]) == 2
    _, err = capsys.readouterr()
    assert err.count("\n") == 1
    assert err.startswith(f"probation: {tmp_path / 'fit.json'}: found ")


def test_a_campaign_in_json_that_is_no_text_is_refused(tmp_path):
    answer = {"schema": "probation.fit/1", "law": GOOD, "campaign": {"a": 1}}
    (tmp_path / "fit.json").write_text(json.dumps(answer), encoding="utf-8")
    with pytest.raises(InputError, match="campaign: found a value of type dict, expected text"):
        export(tmp_path / "fit.json", "mgis")


def test_a_stress_that_is_not_finite_is_no_round_trip():
    good = np.array([0.0, 1.0])
    assert compared("x", "x", [good], [good]).error == 0.0
    for bad in (np.inf, np.nan):
        with pytest.raises(InputError, match="law: found a stress beyond all numbers"):
            compared("x", "x", [np.array([0.0, bad])], [good])


def test_a_law_that_never_flows_has_no_table(tmp_path):
    """With alpha = 1e300 every mode is elastic: no plastic strain at all."""
    answer = {"schema": "probation.fit/1", "law": changed("parameters.alpha", 1e300)}
    (tmp_path / "fit.json").write_text(json.dumps(answer), encoding="utf-8")
    with pytest.raises(InputError, match=r"fit\.json: strain: found 1\.5, expected a strain with plastic flow"):
        export(tmp_path / "fit.json", "abaqus-plastic", rates=[1e-4, 1e-2])


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


@pytest.mark.parametrize("form", ["abaqus-umat", "calculix", "mgis", "c", "list"])
def test_a_stress_tolerance_is_the_last_constant_of_a_user_material(form, capsys):
    options = ["--format", form, "--stress-tolerance", "0.05", "--accuracy", "2e-2"]
    assert main(["export", *WITH_COMPANION, *options]) == 0
    found = export(LAW, form, stress_tolerance=0.05, accuracy=2e-2)
    assert capsys.readouterr().out == found.text
    assert found.content.values == (*export(LAW, form, accuracy=2e-2).content.values, 0.05)


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
        (["x.json", *WITH_COMPANION, "--format", "c"], "found SOURCE together with --set or --companion"),
        (["x.json", "--format", "all", "--folder", "."], "x.json: found no such file"),
        ([*WITH_COMPANION, "--format", "abaqus-prony"], "rate: found none"),
        ([*WITH_COMPANION, "--format", "c", "--rates", "1e-3;2"], "expected numbers between commas"),
        ([*WITH_COMPANION, "--format", "c", "--stress-tolerance", "-1"], "stress_tolerance: found -1.0, expected a"),
    ],
)
def test_bad_arguments_are_told_in_one_line(arguments, complaint, capsys):
    assert main(["export", *arguments]) == 2
    message = capsys.readouterr().err
    assert complaint in message
    assert message.count("\n") == 1
