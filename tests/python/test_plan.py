"""Planned tests: what is expected of them, against fits of simulated records, and as the command tells it."""

import json
import re
from pathlib import Path

import numpy as np
import pytest

import probation
from probation import Campaign, Law, Noise, Record, named_history, plan
from probation.cli import main
from probation.design.isolability import isolability
from probation.design.planned_record import white_noise
from probation.effects.record_view import views_of
from probation.effects.registry import effects
from probation.inference.modal_law import DnlrLaw
from probation.inference.model import CampaignModel

LAW = Law(unrelaxed_modulus=3220.0, tau_max=5.2, hardening_modulus=2.0)
SET = ["--set", "unrelaxed_modulus_MPa=3220", "--set", "tau_max_s=5.2", "--set", "hardening_modulus_MPa=2"]
ONE = ["force_offset"]


def ramps(samples=60):
    return {
        name: named_history("ramp", rate=rate, strain=1.2, samples=samples)
        for name, rate in (("slow", 0.002), ("fast", 0.02))
    }


def expected_errors(found):
    return np.array([each.se for each in (*found.parameters.values(), found.product)])


@pytest.mark.parametrize("strain_noise", [0.0, 1e-4])
def test_expected_standard_errors_are_what_fits_of_simulated_records_scatter_by_and_report(strain_noise):
    """40 draws: their own scatter is known to 11 %."""
    found = plan(LAW, ramps(), noise=0.5, strain_noise=strain_noise, effects=ONE)
    rng, estimates, reported = np.random.default_rng(1), [], []
    for _ in range(40):
        records = [
            Record(
                name,
                history.time,
                history.true_strain + strain_noise * rng.standard_normal(60),
                LAW.stress(history.time, history.true_strain, "sa3") + 0.5 * rng.standard_normal(60),
                control="strain-rate",
                noise=Noise(0.5, strain_noise),
            )
            for name, history in ramps().items()
        ]
        fitted = probation.fit(Campaign("simulated", tuple(records)), "sa3")
        estimates.append([each.value for each in (*fitted.parameters.values(), fitted.product)])
        reported.append(expected_errors(fitted))
    np.testing.assert_allclose(np.std(estimates, axis=0, ddof=1), expected_errors(found), rtol=0.25)
    np.testing.assert_allclose(np.median(reported, axis=0), expected_errors(found), rtol=0.05)


def test_half_the_noise_halves_the_errors_and_doubles_what_can_be_detected():
    loud, quiet = (plan(LAW, ramps(), noise=noise) for noise in (0.5, 0.25))
    np.testing.assert_allclose(expected_errors(loud), 2.0 * expected_errors(quiet))
    np.testing.assert_allclose(loud.correlation, quiet.correlation)
    sizes = [np.array([each.detectability for each in found.isolability.effects]) for found in (loud, quiet)]
    np.testing.assert_allclose(2.0 * sizes[0], sizes[1])
    assert len(sizes[0]) > 20


def test_a_test_done_twice_is_worth_the_root_of_two():
    history = named_history("ramp", strain=1.2, samples=60)
    once, twice = (plan(LAW, dict.fromkeys(names, history), noise=0.5, effects=ONE) for names in ("a", "ab"))
    np.testing.assert_allclose(expected_errors(once), np.sqrt(2.0) * expected_errors(twice))


def test_a_plan_says_of_effects_what_the_analysis_of_records_says_whatever_their_stress():
    stress = np.random.default_rng(0).standard_normal(60)
    records = tuple(Record(name, each.time, each.true_strain, stress) for name, each in ramps().items())
    model = CampaignModel(DnlrLaw(LAW), views_of(Campaign("done", records), scheme="sa3"))
    chosen = ["damage", "machine_compliance", "rate_dependent_hardening"]
    known = isolability(model, model.start, white_noise(model.views, [0.1, 0.4]), effects(chosen))
    found = plan(LAW, ramps(), noise={"fast": 0.4, "slow": 0.1}, effects=chosen).isolability
    np.testing.assert_allclose(found.probability, known.probability)
    np.testing.assert_allclose(
        [each.detectability for each in found.effects], [each.detectability for each in known.effects]
    )


def test_noise_of_the_strain_costs_and_hardly_depends_on_the_seed():
    without = expected_errors(plan(LAW, ramps(200), noise=0.1, effects=ONE))
    first, second = (plan(LAW, ramps(200), noise=0.1, strain_noise=2e-3, seed=seed, effects=ONE) for seed in (0, 1))
    assert (expected_errors(first) > 1.2 * without).all()
    np.testing.assert_allclose(expected_errors(first), expected_errors(second), rtol=0.08)
    assert {each.smoothing for each in first.tests} == {"quintic-spline"}


def test_noise_of_a_strain_too_coarse_to_be_smoothed_is_propagated_sample_by_sample():
    """Every strain sample is an error of its own: J^T (s^2 I + D D^T)^-1 J written out, D = d stress / d strain."""
    history = named_history("ramp", rate=0.01, strain=1.0, samples=40)
    found = plan(LAW, {"coarse": history}, noise=0.01, strain_noise=1e-5, effects=ONE)
    assert found.tests[0].smoothing == "raw"
    time, strain = history.time, history.true_strain
    slope = 1e-5 * LAW.strain_sensitivity(time, strain, "sa3")
    tangent = LAW.sensitivity(time, strain, "sa3")[1]
    covariance = np.linalg.inv(tangent.T @ np.linalg.solve(1e-4 * np.eye(40) + slope @ slope.T, tangent))
    np.testing.assert_allclose(expected_errors(found)[:3], np.sqrt(np.diag(covariance)), rtol=1e-3)


def test_arrays_are_a_history_and_so_is_an_imposed_stress():
    history = named_history("creep", stress=20.0, duration=60.0, samples=200)
    strain = probation.creep(LAW, history.time, history.true_stress, jumps=history.jumps)
    imposed = plan(LAW, {"creep": history}, noise=0.1, effects=ONE)
    given = plan(LAW, {"creep": (history.time, strain)}, noise=0.1, effects=ONE)
    np.testing.assert_allclose(expected_errors(imposed), expected_errors(given))
    assert [each.history for each in (*imposed.tests, *given.tests)] == [history.name, "as given"]


def test_a_parameter_that_is_held_is_not_identified_and_leaves_less_to_know():
    free, held = (plan(LAW, ramps(), noise=0.5, hold=hold, effects=ONE) for hold in (None, {"tau_max_s": 4.0}))
    assert list(held.parameters) == list(held.names) == ["unrelaxed_modulus", "hardening_modulus"]
    assert held.law.tau_max == 4.0
    assert held.correlation.shape == (2, 2)
    assert held.parameters["unrelaxed_modulus"].se < 0.5 * free.parameters["unrelaxed_modulus"].se
    assert held.product.se == pytest.approx(4.0 * held.parameters["unrelaxed_modulus"].se)
    assert "E_u·τ_max" in held.summary()
    assert probation.Plan.from_json(held.to_json()).to_json() == held.to_json()
    with pytest.raises(probation.InputError, match="found every parameter held"):
        plan(
            LAW,
            ramps(),
            noise=0.5,
            hold=dict.fromkeys(("unrelaxed_modulus_MPa", "tau_max_s", "hardening_modulus_MPa"), 1),
        )


def test_a_name_that_does_not_print_is_escaped_as_in_records():
    found = plan(LAW, {"a\x1b[1m": (np.linspace(0.0, 100.0, 50), np.linspace(0.0, 0.5, 50))}, noise=0.1, effects=ONE)
    assert found.tests[0].id.isprintable()


def test_what_the_tests_do_not_determine_is_said():
    """A relaxed specimen at rest shows G alone."""
    found = plan(LAW, {"rest": (np.linspace(0.0, 100.0, 50), np.full(50, 0.5))}, noise=0.1)
    assert [each.se is None for each in found.parameters.values()] == [True, True, False]
    assert found.product.se is None
    assert "E_u not identifiable, τ_max not identifiable, G 0.33 %" in found.verdict
    assert "correlations" not in found.summary()
    assert json.loads(found.to_json())["parameters"]["tau_max_s"]["se"] is None


def test_a_companion_relation_beyond_its_rates_is_warned_of():
    law = Law(unrelaxed_modulus=3220.0, hardening_modulus=1.8, companion=probation.Weissenberg(0.00464, 0.0367))
    found = plan(law, {"fast": named_history("ramp", rate=0.1, strain=0.5, samples=60)}, noise=0.1, effects=ONE)
    assert found.warnings[0].startswith("fast: ")
    assert "warning: fast: " in found.summary()
    assert found.names[1] == "alpha"


def test_the_example_of_the_documentation_prints_what_stands_below_it(capsys):
    text = Path(__file__).parents[2].joinpath("docs/isolability.md").read_text(encoding="utf-8")
    example, shown = (re.search(rf"```{kind}\n(.*?)```", text, re.DOTALL)[1] for kind in ("python", "text"))
    exec(example, {})
    assert " ".join(capsys.readouterr().out.split()).startswith(" ".join(shown.split()))


TIME = np.linspace(0.0, 100.0, 50)


@pytest.mark.parametrize(
    ("histories", "options", "told"),
    [
        ({}, {}, "histories: found none"),
        ([(TIME, TIME)], {}, "histories: found list, expected at least one planned test by its name"),
        ({"a": 3}, {}, "histories, 'a': found int, expected an ImposedHistory or"),
        ({"a": (TIME, TIME[:3])}, {}, "histories, 'a': true_strain has 3 samples; expected 50"),
        ({"a": (TIME, np.nan * TIME)}, {}, r"histories, 'a': true_strain\[0\] is nan"),
        ({"a": (TIME[::-1], 0.01 * TIME)}, {}, "'a', time, sample 1: found time going back"),
        ({"a": (TIME, TIME)}, {}, "'a', true_strain, sample 49: found 100, expected at most 5"),
        ({"a": (TIME, 0.01 * TIME)}, {"noise": 0.0}, "noise of 'a': found 0.0, expected a positive number"),
        ({"a": (TIME, 0.01 * TIME)}, {"noise": {"b": 1.0}}, "noise: found numbers for b, expected one for each of a"),
        (
            {"a": (TIME, 0.01 * TIME)},
            {"strain_noise": -1.0},
            "strain_noise of 'a': found -1.0, expected a number of at",
        ),
        ({"a": (TIME, 0.01 * TIME)}, {"effects": ["damge"]}, "found no effect named 'damge'"),
        ({"a": named_history("ramp", samples=3001)}, {"strain_noise": 1e-3}, "'a': found 3001 samples, expected at"),
    ],
)
def test_what_is_not_possible_is_named(histories, options, told):
    with pytest.raises(probation.InputError, match=told):
        plan(LAW, histories, **{"noise": 0.1, "effects": ONE, **options})


def test_the_command_says_what_the_library_says(tmp_path, capsys):
    path = tmp_path / "slow.csv"
    slow, fast = ramps().values()
    rows = [f"{a!r},{b!r}" for a, b in zip(slow.time.tolist(), slow.true_strain.tolist(), strict=True)]
    path.write_text("\n".join(["time_s,true_strain", *rows]) + "\n", encoding="utf-8")
    spec = "ramp:rate=0.02,strain=1.2,samples=60"
    arguments = [str(path), "--history", spec, "--history", spec, "--noise", "0.5", "--effects", ONE[0], *SET]
    assert main(["plan", *arguments, "--json", "-"]) == 0
    captured = capsys.readouterr()
    answer = json.loads(captured.out)
    known = plan(LAW, {"slow": slow, "ramp": fast, "ramp 2": fast}, noise=0.5, effects=ONE)
    assert answer["schema"] == "probation.plan/1"
    assert [test["id"] for test in answer["tests"]] == ["slow", "ramp", "ramp 2"]
    assert answer["parameters"] == json.loads(known.to_json())["parameters"]
    assert answer["correlation"]["names"] == ["unrelaxed_modulus_MPa", "tau_max_s", "hardening_modulus_MPa"]
    assert answer["isolability"] == json.loads(known.to_json())["isolability"]
    page = tmp_path / "plan.html"
    assert main(["plan", *arguments, "--hold", "tau_max_s=5.2", "--json", "-", "--report", str(page)]) == 0
    assert "These 3 tests would give standard errors of E_u " in page.read_text(encoding="utf-8")
    assert list(json.loads(capsys.readouterr().out)["parameters"]) == ["unrelaxed_modulus_MPa", "hardening_modulus_MPa"]
    assert captured.err.startswith("These 3 tests would give standard errors of E_u ")
    assert max(map(len, captured.err.splitlines()[1:])) <= 100


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (
            ["--history", "ramp:rate=-1", "--noise", "0.1"],
            "history 'ramp': found rate=-1, expected a number in 1/s above 0",
        ),
        (["--history", "ramp:strain=9", "--noise", "0.1"], "true_strain, sample 1500: found 9, expected at most 5"),
        (["--history", "ramp", "--noise", "-1"], "noise of 'ramp': found -1.0, expected a positive number"),
        (["--history", "ramp"], "required: --noise"),
        (["--noise", "0.1"], "found no planned test, expected HISTORY.csv or --history"),
        (["--history", "ramp", "--noise", "0.1", "--effects", "damge"], "--effects: found no effect named 'damge'"),
    ],
)
def test_a_bad_plan_is_one_line_with_status_2(arguments, told, capsys):
    assert main(["plan", *arguments, *SET]) == 2
    err = capsys.readouterr().err
    assert err.count("\n") == 1
    assert told in err


def test_the_plot_is_the_map_of_isolability(tmp_path):
    arguments = ["--history", "ramp:samples=60", "--noise", "0.5", "--effects", "damage,force_offset", *SET]
    assert main(["plan", *arguments, "--plot", str(tmp_path / "plan.png")]) == 0
    assert (tmp_path / "plan.png").stat().st_size > 3000
