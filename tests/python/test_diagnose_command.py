"""`probation diagnose`: its options, its answers, its complaints."""

import json
from dataclasses import replace
from importlib import import_module

import pytest

from campaigns import made_up_diagnosis as made_up
from probation import cli
from probation.commands import analysis_options
from probation.effects.registry import effects
from probation.published.experiments import twin_campaign


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    campaign = twin_campaign((1, 2, 3))
    free = replace(campaign, law=replace(campaign.law, fixed={}, companion=None))
    return str(free.save(tmp_path_factory.mktemp("twins")))


@pytest.fixture
def asked(monkeypatch):
    """What `diagnose` is called with; it answers with a made-up diagnosis."""
    calls = {}

    def diagnose(campaign, scheme, **options):
        options["progress"](0.5)
        calls.update(options, campaign=campaign, scheme=scheme)
        return made_up.with_two_records(made_up.self_heating())

    monkeypatch.setattr(import_module("probation.diagnosis.diagnose"), "diagnose", diagnose)
    return calls


def test_every_option_reaches_the_diagnosis(folder, asked, capsys):
    held_out = ["--held-out", "experiment-3"]
    chosen = ["--effects", "self_heating,damage", "--effects", "force_gain", "--hold", "tau_max_s=5", "--seed", "3"]
    assert cli.main(["diagnose", folder, *held_out, *chosen, "--scheme", "sa2", "--threads", "2"]) == 0
    assert asked["scheme"] == "sa2"
    assert asked["effects"] == ["self_heating", "damage", "force_gain"]
    assert (asked["hold"], asked["seed"], asked["threads"]) == ({"tau_max_s": 5.0}, 3, 2)
    assert [record.id for record in asked["campaign"].held_out] == ["experiment-3"]
    assert capsys.readouterr().out.startswith("hdpe-2020: The simulation leaves out self-heating")


def test_all_effects_are_considered_unless_some_are_named(folder, asked):
    assert cli.main(["diagnose", folder]) == 0
    assert asked["effects"] is None


@pytest.mark.parametrize(("allowed", "taken"), [(1, 1), (3, 3), (8, 4)])
def test_a_diagnosis_takes_every_processor_that_it_may_use_up_to_four(monkeypatch, folder, asked, allowed, taken):
    monkeypatch.setattr(analysis_options, "processors", lambda: allowed)
    assert cli.main(["diagnose", folder]) == 0
    assert asked["threads"] == taken


def test_json_stands_alone_on_standard_output_and_the_summary_beside_it(folder, asked, capsys):
    assert cli.main(["diagnose", folder, "--json", "-"]) == 0
    shown = capsys.readouterr()
    answer = json.loads(shown.out)
    assert answer["schema"] == "probation.diagnosis/1"
    assert answer["answer_set"] == [["self_heating"], ["structural_softening"]]
    assert "Which effect explains the gap" in shown.err


def test_the_page_is_written_where_it_was_asked_for(folder, asked, tmp_path, capsys):
    page = tmp_path / "page.html"
    assert cli.main(["diagnose", folder, "--report", str(page)]) == 0
    assert "self-heating" in page.read_text(encoding="utf-8")
    assert "wrote report" in capsys.readouterr().err


def test_the_catalogue_is_listed_without_a_campaign(capsys):
    assert cli.main(["diagnose", "--list-effects"]) == 0
    out = capsys.readouterr().out
    assert all(f"{effect.name} ({effect.kind})" in out for effect in effects())


def test_the_catalogue_as_json_has_names_parameters_units_and_bounds(capsys):
    assert cli.main(["diagnose", "--list-effects", "--json", "-"]) == 0
    listed = json.loads(capsys.readouterr().out)["effects"]
    assert [each["name"] for each in listed] == [effect.name for effect in effects()]
    heating = next(each for each in listed if each["name"] == "self_heating")
    first = heating["forms"][0]["parameters"][0]
    assert (first["name"], first["unit"], first["bounds"]) == ("heating_degC_per_MPa", "°C/MPa", [0.0, 1.0])


def test_some_of_the_catalogue_is_listed_by_name(capsys, tmp_path):
    assert cli.main(["diagnose", "--list-effects", "--effects", "damage", "--json", str(tmp_path / "a.json")]) == 0
    assert capsys.readouterr().out.startswith("damage (material)")
    assert len(json.loads((tmp_path / "a.json").read_text(encoding="utf-8"))["effects"]) == 1


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        ([], "found no campaign, expected CAMPAIGN or --list-effects"),
        (["no-such-folder"], "no-such-folder"),
        (["x", "--effects", "selfheating"], "--effects: found no effect named 'selfheating'; did you mean"),
        (["x", "--effects", ","], "expected names such as self_heating,damage"),
        (["x", "--threads", "0"], "expected a whole number from 1"),
        (["x", "--seed", "-1"], "expected a whole number from 0"),
        (["x", "--hold", "tau_max_s"], "--hold: found 'tau_max_s', expected NAME=VALUE"),
        (["x", "--list-effects"], "found the campaign 'x' with --list-effects"),
        (["--list-effects", "--report", "a.html"], "found --report with --list-effects"),
        (["--list-effects", "--isolability"], "not allowed with"),
    ],
)
def test_bad_arguments_are_told_in_one_line_with_status_2(arguments, told, capsys):
    assert cli.main(["diagnose", *arguments]) == 2
    err = capsys.readouterr().err
    assert told in err
    assert err.count("\n") == 1


def test_a_record_that_is_not_there_cannot_be_held_out(folder, capsys):
    assert cli.main(["diagnose", folder, "--held-out", "experiment-4"]) == 2
    assert "--held-out: " in capsys.readouterr().err


def test_what_the_tests_could_tell_apart_is_said_without_a_diagnosis(folder, asked, tmp_path, capsys):
    """One ramp: a gain of the force only scales what E_u and G scale, too; an offset grows otherwise."""
    page = tmp_path / "page.html"
    held_out = ["--held-out", "experiment-2", "--held-out", "experiment-3"]
    chosen = ["--isolability", "--effects", "force_gain,force_offset,damage"]
    assert cli.main(["diagnose", folder, *held_out, *chosen, "--json", "-", "--report", str(page)]) == 0
    shown = capsys.readouterr()
    answer = json.loads(shown.out)
    assert answer["schema"] == "probation.isolability/1"
    status = {each["effect"]: each["status"] for each in answer["effects"]}
    assert status["force_gain"] == "absorbed"
    assert status["force_offset"] == "named"
    assert "gain of the force" in shown.err
    assert "hides in the base parameters" in page.read_text(encoding="utf-8")
    assert asked == {}
