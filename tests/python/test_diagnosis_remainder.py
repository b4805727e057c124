"""What is left of a gap is described by the variable it depends on; no fault here has a form of the catalogue."""

import json
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from probation import Campaign, Law, Record, diagnose
from probation.diagnosis.closure import Closure
from probation.diagnosis.free_function import Dependence, RemainderCurve
from probation.diagnosis.remainder import remainder_of
from probation.diagnosis.remainder_words import description
from probation.effects.cause import Cause
from probation.effects.registry import effect
from probation.identify.base import base_fit
from probation.identify.fit import plain_fit
from probation.inference.refit import refit
from probation.records.record import Noise
from probation.records.specimens import Specimens
from probation.report.diagnosis_tables import next_tests_table

LAW = Law(unrelaxed_modulus=2500.0, tau_max=5.0, hardening_modulus=2.0)
NOISE = 0.04
COUNT = 240


def cycles(*tops, rate, back=0.12):
    """Loading to each top, unloading by so much in between."""
    strain, time = [0.0], [0.0]
    for top in tops:
        for goal in (top, top - back):
            time.append(time[-1] + abs(goal - strain[-1]) / rate)
            strain.append(goal)
    return time[:-1], strain[:-1]


def jumps(*rates, top=1.0):
    """The same strain at several rates in turn."""
    step = top / len(rates)
    return [0.0, *np.cumsum([step / rate for rate in rates])], [step * at for at in range(len(rates) + 1)]


def campaign(histories, fault, *, temperatures=None, seed=1):
    rng = np.random.default_rng(seed)
    records = []
    for at, (instants, strains) in enumerate(histories):
        time = np.linspace(0.0, instants[-1], COUNT)
        strain = np.interp(time, instants, strains)
        temperature = None if temperatures is None else temperatures[at](time / instants[-1])
        stress = fault(time, strain, temperature, LAW.stress(time, strain, scheme="exact"))
        records.append(
            Record(
                id=f"r{at + 1}",
                time=time,
                true_strain=strain,
                true_stress=stress + NOISE * rng.standard_normal(COUNT),
                temperature=temperature,
                control="cyclic",
                role="identify",
                noise=Noise(strain=0.0),
            )
        )
    return Campaign("a remainder", tuple(records), specimens=Specimens("none"))


def softened(time, strain, temperature, stress):
    """Mullins: below the largest strain so far the stress is lower, the more so the larger that strain was."""
    largest = np.maximum.accumulate(strain)
    return stress * (1.0 - 0.3 * largest**1.5 * np.tanh((largest - strain) / 0.02))


def faster_is_stiffer(time, strain, temperature, stress):
    """3 MPa at the highest rate, in a sigmoid of its decades."""
    decades = np.log10(np.abs(np.gradient(strain, time)) + 1e-12)
    return stress + 3.0 / (1.0 + np.exp(-3.0 * (decades + 3.0)))


def warmer_is_softer(time, strain, temperature, stress):
    """2 % less per °C above 23, and more above 30."""
    above = temperature - 23.0
    return stress * (1.0 - 0.01 * above - 0.002 * np.maximum(above - 7.0, 0.0) ** 1.5)


CYCLES = [
    cycles(0.3, 0.6, 0.9, 1.1, rate=2e-3),
    cycles(0.4, 0.8, 1.2, rate=6e-4, back=0.3),
    cycles(0.25, 0.5, 0.75, 1.0, rate=5e-3, back=0.2),
]
JUMPS = [jumps(1e-4, 1e-2, 1e-3), jumps(1e-3, 3e-4, 1e-2), jumps(1e-2, 1e-4, 3e-3), jumps(3e-3, 1e-3, 1e-4)]
RAMPS = [jumps(rate) for rate in (1e-3, 2e-3, 5e-4, 1e-3)]
COURSES = [lambda part: 23.0 + 12.0 * part, lambda part: 35.0 - 10.0 * part, lambda part: 25.0 + 8.0 * part**2]
COURSES.append(lambda part: 23.0 + 10.0 * np.sin(np.pi * part))


def left_by(base, found):
    """What the law or an explanation leaves, described."""
    left = float(np.sqrt(np.mean(found.model.residual(found.parameters) ** 2)))
    return remainder_of(base, found, Closure(left, left, NOISE, None, None, ""))


@cache
def described(name):
    histories, fault, temperatures = {
        "mullins": (CYCLES, softened, None),
        "rate": (JUMPS, faster_is_stiffer, None),
        "temperature": (RAMPS, warmer_is_softer, COURSES),
        "one record": (CYCLES[:1], softened, None),
        "nothing": (CYCLES, lambda time, strain, temperature, stress: stress, None),
    }[name]
    found = campaign(histories, fault, temperatures=temperatures)
    base = base_fit(found, plain_fit(found))
    return left_by(base, base.refit)


@pytest.mark.parametrize(
    ("name", "variable", "phases"),
    [
        ("mullins", "largest_strain", {"unloading_and_reloading"}),
        ("rate", "strain_rate", {None, "loading"}),
        ("temperature", "temperature", {None, "loading"}),
    ],
)
def test_the_variable_that_the_fault_depends_on_explains_most_of_what_is_left(name, variable, phases):
    found = described(name)
    leading = found.depends_on[0]
    assert (leading.variable, leading.judged_on) == (variable, "records")
    assert leading.when in phases
    assert leading.explained > 0.85
    assert f"function of the {variable.replace('_', ' ')}" in found.description


def test_a_softening_below_the_largest_strain_is_a_factor_on_unloading_and_reloading():
    found = described("mullins")
    assert found.depends_on[0].acts == "factor"
    assert "on unloading and reloading only" in found.description
    assert "above the measured stress" in found.description


def test_of_one_record_contiguous_parts_are_left_out():
    found = described("one record")
    leading = found.depends_on[0]
    assert leading.judged_on == "parts"
    assert leading.when == "unloading_and_reloading"
    assert "parts of the records left out" in found.description


def test_what_noise_leaves_depends_on_nothing():
    found = described("nothing")
    assert found.depends_on == ()
    assert found.curve is None
    assert "follows no single variable" in found.description


def test_what_the_law_closes_by_itself_depends_on_nothing():
    """Twice the right relaxation time leaves 13 MPa, and nothing once it is mended."""
    found = campaign(CYCLES, lambda time, strain, temperature, stress: stress)
    base = base_fit(found, plain_fit(found))
    told = left_by(base, replace(base.refit, parameters=base.parameters * [1.0, 2.0, 1.0]))
    assert told.rms_MPa > 10.0
    assert told.depends_on == ()
    assert "follows no single variable" in told.description


def test_the_function_in_the_figure_is_the_one_that_was_put_in():
    """30 % of the largest strain to the power of 1.5, in percent of the stress, to a part that the law's parameters
    may take up."""
    curve = described("mullins").curve
    assert curve.unit == "%"
    at = np.interp([0.5, 0.9], curve.function_x, curve.function_y)
    assert at == pytest.approx([-30.0 * 0.5**1.5, -30.0 * 0.9**1.5], abs=4.0)


@pytest.mark.parametrize(("largest", "stated"), [(0.9, True), (0.005, False)])
def test_a_function_that_parameters_follow_has_no_size(largest, stated):
    """What a time left, 0.6 MPa, was "up to 0.0051 MPa" of it: what the parameters do not follow, next to nothing."""
    inside = np.ones(50, dtype=bool)
    x = np.linspace(0.0, 1.0, 50)
    curve = RemainderCurve("time [s]", "MPa", x, 0.6 * np.sin(9.0 * x), inside, ~inside, x, largest * np.sin(9.0 * x))
    first = Dependence("time", "the time", None, "added", 0.44, "records")
    text = description("what is left", 0.6, 0.1, (first,), curve, 0.44)
    assert ("up to" in text) == stated
    assert ("so that its course is not known" in text) != stated


@pytest.fixture(scope="module")
def undiagnosed():
    """Nothing in what is considered explains it."""
    return diagnose(campaign(CYCLES, softened), effects=["slow_process"], threads=1)


def test_a_diagnosis_without_an_explanation_describes_what_is_left(undiagnosed, tmp_path):
    found = undiagnosed
    assert found.verdict == "unexplained"
    assert "; the gap is a function of the largest strain so far, on unloading" in found.headline
    told = json.loads(found.to_json())["remainder"]
    assert told["depends_on"][0]["variable"] == "largest_strain"
    assert told["depends_on"][0]["when"] == "unloading_and_reloading"
    assert told["depends_on"][0]["explained"] > 0.8
    assert told["rms_MPa"] > 1.0
    assert "the largest strain so far" in " ".join(found.summary().split())
    found.report(tmp_path / "page.html")
    assert "The gap, and on what it depends" in (tmp_path / "page.html").read_text(encoding="utf-8")


def test_an_explanation_down_to_the_noise_leaves_nothing_to_describe():
    def shifted(time, strain, temperature, stress):
        return stress + 2.0 * np.exp(strain)

    found = diagnose(campaign(CYCLES, shifted), effects=["force_offset"], threads=1, design=False)
    assert found.verdict == "explained"
    assert found.remainder is None
    assert json.loads(found.to_json())["remainder"] is None


def test_without_an_explanation_the_next_tests_settle_what_the_rest_depends_on(undiagnosed):
    found = undiagnosed
    assert found.next_test == found.next_tests[0]
    variables = {each.variable for each in found.remainder.depends_on}
    for each in found.next_tests:
        assert {name for names in each.separates for name in names} <= variables
        assert each.cost
    assert found.next_test.probability_after > found.next_test.probability_before
    assert "between the largest strain so far and" in found.next_test.what
    assert "unload" in found.next_test.what


@pytest.fixture(scope="module")
def rivalled():
    """An unknown effect leads; known ones behind it are open, the softening being a fifth of the one above."""

    def slightly(time, strain, temperature, stress):
        return stress + 0.2 * (softened(time, strain, temperature, stress) - stress)

    return diagnose(campaign(CYCLES[:2], slightly), effects=["structural_softening", "damage"], threads=1)


def test_where_an_unknown_effect_leads_tests_of_what_the_rest_depends_on_come_first(rivalled):
    assert rivalled.verdict == "unexplained"
    variables = {each.variable for each in rivalled.remainder.depends_on}
    of_the_rest = [{name for names in each.separates for name in names} <= variables for each in rivalled.next_tests]
    assert of_the_rest[0]
    assert of_the_rest == sorted(of_the_rest, reverse=True)
    assert "the largest strain so far" in rivalled.next_test.what
    assert json.loads(rivalled.to_json())["next_test"]["separates"] == [list(n) for n in rivalled.next_test.separates]


def test_of_tests_for_two_questions_all_help(rivalled):
    for each in rivalled.next_tests:
        assert each.probability_after > each.probability_before
        assert each.cost


def test_the_page_says_what_each_test_settles(rivalled):
    settled = [row[1] for row in next_tests_table(rivalled).rows]
    assert settled[0] == "on what the gap depends"


def test_a_free_function_predicts_a_record_it_was_fitted_to():
    """The same record as a test that is not done yet: to within what the function leaves elsewhere."""
    left = described("temperature")
    first = left.functions[0]
    for view in first.found.model.views:
        stress, spread = first.on(view)
        assert np.sqrt(np.mean((stress - view.data) ** 2)) < 2.0 * first.error_MPa
        assert spread.shape[0] == len(view.data)


def test_a_function_of_the_specimen_says_of_which():
    """The second of three reads 2 MPa too much; its level is no function that another record could confirm."""

    def second_is_higher(time, strain, temperature, stress):
        return stress + 2.0 * (time[-1] > 3000.0) * np.minimum(strain / 0.02, 1.0)

    found = campaign(CYCLES, second_is_higher)
    base = base_fit(found, plain_fit(found))
    told = left_by(base, base.refit)
    own = next(each for each in told.depends_on if each.variable in ("specimen", "order"))
    assert own.explained > 0.5
    assert "of 3 ." not in told.description


def test_a_fault_of_one_record_does_not_hide_on_what_the_rest_depends():
    """Its instant is known from that record alone, and from nothing where that record is left out."""

    def second_jumps(time, strain, temperature, stress):
        jump = 2.0 * (time[-1] < 1500.0) * (time > 0.6 * time[-1])
        return faster_is_stiffer(time, strain, temperature, stress) + jump

    found = campaign(JUMPS, second_jumps)
    base = base_fit(found, plain_fit(found))
    offset = effect("force_offset")
    problem = base.problem.with_causes([Cause(offset, offset.form("jump"), ("r2",))])
    told = left_by(base, refit(problem, problem.model.parameters(base.parameters, (1.0, 0.6))))
    assert told.depends_on[0].variable == "strain_rate"
    assert told.depends_on[0].explained > 0.8
