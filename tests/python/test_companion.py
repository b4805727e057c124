"""Do the companion relations give the paper's numbers, and say where they end?"""

import copy
import pickle
from dataclasses import replace

import numpy as np
import pytest

import probation
from probation import Exponential, PowerLaw, RateFunction, Table, Weissenberg
from probation.histories import history_from
from probation.law.settings import CompanionSettings, LawSettings
from probation.simulation import simulate
from reference import paper

FORMS = {
    "weissenberg": Weissenberg(0.00464, 0.0367),
    "exponential": Exponential(27.24, -2.1),
    "power": PowerLaw(0.03, -0.9),
    "table": Table(list(paper.TABLE_2), list(paper.TABLE_2.values())),
}
forms = pytest.mark.parametrize("companion", FORMS.values(), ids=FORMS)


def test_eq_11_by_hand():
    """At 0.001 1/s: (0.00464 (-3) + 0.0367) / 0.001 = 22.78 s; at 0.005, section 4 of docs/law.md says 5.205 s."""
    assert FORMS["weissenberg"].relaxation_time([0.001, 0.005]) == pytest.approx([22.78, 5.205], rel=1e-4)
    assert FORMS["weissenberg"].weissenberg_number([0.001]) == pytest.approx([0.02278])


def test_eq_12_by_hand():
    """At 0.001 1/s log10(1000 r) = 0: 27.24 s; ten times faster, e^-2.1 of it."""
    found = FORMS["exponential"].relaxation_time([0.001, 0.01])
    assert found == pytest.approx([27.24, 27.24 * np.exp(-2.1)], rel=1e-14)


def test_eq_12_errs_by_what_physics_states():
    """+7.2, +4.4, +3.9 % at the three fastest rates of Table 2."""
    rates = sorted(paper.TABLE_2)[-3:]
    found = FORMS["exponential"].relaxation_time(rates) / [paper.TABLE_2[rate] for rate in rates] - 1.0
    assert found == pytest.approx([0.072, 0.044, 0.039], abs=1e-3)


def test_a_table_passes_through_its_points_and_is_straight_between():
    """Log-log: halfway in ln r is the geometric mean; beyond the end the last segment goes on."""
    table = Table([1e-3, 1e-1], [100.0, 1.0])  # slope -1
    assert table.relaxation_time([1e-3, 1e-2, 1e-1, 1.0, 1e-4]) == pytest.approx([100.0, 10.0, 1.0, 0.1, 1000.0])
    assert FORMS["table"].relaxation_time(list(paper.TABLE_2)) == pytest.approx(list(paper.TABLE_2.values()))


@forms
@pytest.mark.parametrize("rate", [7e-5, 1e-3, 9e-3])
def test_the_slope_is_the_derivative(companion, rate):
    engine = companion._engine()
    step = 1e-5
    up, down = (np.log(engine.relaxation_time(rate * np.exp(d))) for d in (step, -step))
    assert engine.log_slope(rate) == pytest.approx((up - down) / (2 * step), rel=1e-7)


@forms
def test_the_modulus_of_the_rate_counts_and_the_floor_below_it(companion):
    assert companion.relaxation_time([-0.002]) == companion.relaxation_time([0.002])
    assert companion.relaxation_time([0.0]) == companion.relaxation_time([1e-7])


def test_a_function_is_as_good_as_the_form_it_states():
    function = RateFunction(lambda rate: (0.00464 * np.log10(rate) + 0.0367) / rate, between=(1e-6, 1.0))
    rates = np.geomspace(2e-6, 0.9, 57)
    assert function.relaxation_time(rates) == pytest.approx(FORMS["weissenberg"].relaxation_time(rates), rel=1e-6)
    assert RateFunction(lambda rate: 5.0).relaxation_time([1e-3]) == pytest.approx([5.0])


@pytest.mark.parametrize(
    ("rates", "outside"),
    [
        ([5e-5, 1e-2], None),
        ([1e-3, -2e-2], (1e-3, 2e-2)),
        ([1e-5], (1e-5, 1e-5)),
        ([0.0], None),
        ([0.0, 1e-3], None),
        ([1e-9, 1e-3], None),
        ([0.0, 1e-9, 2e-9], (1e-9, 2e-9)),
    ],
)
def test_rates_outside_the_calibrated_range_are_told(rates, outside):
    assert FORMS["weissenberg"].outside(rates) == outside
    assert FORMS["power"].outside(rates) is None


@forms
def test_relations_are_values(companion):
    assert pickle.loads(pickle.dumps(companion)) == companion
    assert copy.deepcopy(companion) == companion
    assert eval(repr(companion), vars(probation)) == companion


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Weissenberg("a", 1.0), r"slope is 'a'"),
        (lambda: Exponential(1.0, None), r"exponent is None"),
        (lambda: PowerLaw(1.0, 1.0, rate_floor=0.0), r"rate_floor"),
        (lambda: PowerLaw(1.0, 1.0, rate_floor=np.nan), r"rate_floor"),
        (lambda: Table([1.0], [1.0]), r"1 rates and 1 times"),
        (lambda: Table([1.0, 2.0], [1.0]), r"2 rates and 1 times"),
        (lambda: Table([2.0, 1.0], [1.0, 2.0]), r"row 2"),
        (lambda: Table([1.0, 2.0], [0.0, 2.0]), r"row 1"),
        (lambda: Table([1.0, 2.0], ["a", "b"]), r"tau_max holds"),
        (lambda: Table([1.0, 2.0], [1.0, 2.0], rate_floor="0"), r"rate_floor is '0'"),
        (lambda: RateFunction(lambda rate: -rate), r"row 1"),
        (lambda: RateFunction(lambda rate: rate[:3]), r"function\(rates\) has the shape \(3,\)"),
        (lambda: RateFunction(lambda rate: rate, between=(1.0, 0.1)), r"between"),
        (lambda: Weissenberg(0.00464, 0.0367, 1e-9).relaxation_time([0.0]), r"raise rate_floor"),
        (lambda: Exponential(-1.0, 1.0).relaxation_time([1.0]), r"tau_max = -"),
        (lambda: FORMS["power"].relaxation_time([np.nan]), r"tau_max = nan"),
    ],
)
def test_a_relation_that_cannot_be_is_refused(make, message):
    with pytest.raises(probation.InputError, match=message):
        make()


def test_a_time_that_cannot_be_is_named_with_its_rate():
    law = probation.Law(
        unrelaxed_modulus=3220.0, hardening_modulus=1.8, companion=probation.Weissenberg(0.00464, 0.0044)
    )
    with pytest.raises(probation.InputError, match=r"tau_max = -[\d.]+ s at a strain rate of 0\.05 1/s"):
        law.stress([0.0, 1.0, 2.0], [0.0, 0.05, 0.1])


SLOWED = 1e-6
"""A record whose times were read a million times too long: 1e-3 1/s becomes 1e-9, below the floor of 1e-7 1/s."""


def slowed_record(name="slow", role="identify"):
    law = probation.Law(
        unrelaxed_modulus=3220.0, alpha=1.0, hardening_modulus=1.8, companion=probation.Weissenberg(0.00464, 0.0367)
    )
    time = np.linspace(0.0, 300.0, 60)
    stress = law.stress(time, 1e-3 * time, scheme="sa3")
    return probation.Record(name, time / SLOWED, 1e-3 * time, stress, control="strain-rate", role=role)


def campaign_of(*records):
    companion = CompanionSettings("weissenberg", {"slope": 0.00464, "intercept": 0.0367})
    return probation.Campaign("x", records, LawSettings(companion=companion))


def test_records_wholly_below_the_calibrated_range_are_warned_about():
    warnings = probation.fit(campaign_of(slowed_record())).warnings
    assert any(each.startswith("slow: strain rates 1e-09 to 1e-09 1/s leave the range") for each in warnings)


def test_a_held_out_record_outside_the_calibrated_range_is_warned_about():
    record = slowed_record()
    at_rate = replace(record, id="right", time=record.time * SLOWED, sha256="")
    warnings = probation.certify(campaign_of(at_rate, slowed_record(role="held-out"))).warnings
    assert any(each.startswith("slow: strain rates 1e-09 to 1e-09 1/s leave the range") for each in warnings)


def test_a_history_below_the_calibrated_range_is_warned_about():
    law = probation.Law(
        unrelaxed_modulus=3220.0, alpha=1.0, hardening_modulus=1.8, companion=probation.Weissenberg(0.00464, 0.0367)
    )
    (warning,) = simulate(law, history_from("ramp:rate=1e-9,strain=0.1")).warnings
    assert "leave the range" in warning


def test_a_users_relation_that_raises_is_named_with_the_rates_it_was_asked_for():
    with pytest.raises(
        probation.InputError, match=r"function\(rates\) raised KeyError: 'tau'; .* from 1e-08 to 1000 1/s"
    ):
        RateFunction(lambda rates: {}["tau"])
