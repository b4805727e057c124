"""Another law, and effects of a user's own, go through the same diagnosis."""

from itertools import pairwise

import numpy as np
import pytest

import probation
from probation.effects.effect import Effect, EffectParameter, Form
from probation.effects.registry import register, unregister
from probation.inference.callable_law import CallableLaw, maxwell_bar
from probation.records.campaign import Campaign
from probation.records.record import Record
from probation.records.specimens import Specimens

MODULUS, TIME = 1200.0, 8.0  # MPa, s


def maxwell(time, rate):
    """E tau rate (1 - e^(-t / tau)): a ramp on a Maxwell bar."""
    return MODULUS * TIME * rate * -np.expm1(-time / TIME)


def campaign(fault=None):
    records = []
    for index, (name, rate) in enumerate({"slow": 1e-3, "middle": 4e-3, "fast": 1.6e-2}.items()):
        time = np.linspace(0.0, 0.4 / rate, 160)
        noise = 0.05 * np.random.default_rng(index).standard_normal(len(time))
        stress = maxwell(time, rate) + noise
        if fault is not None:
            stress = fault(name, time, rate * time, stress)
        records.append(Record(id=name, time=time, true_strain=rate * time, true_stress=stress, control="strain-rate"))
    return Campaign("bars", tuple(records), specimens=Specimens("none"))


def test_a_maxwell_bar_that_is_one_has_no_gap():
    found = probation.diagnose(campaign(), law=maxwell_bar(), design=False)
    assert found.verdict == "no_gap"
    values = {each.name: each for each in found.base}
    assert values["modulus_MPa"].value == pytest.approx(MODULUS, abs=4.0 * values["modulus_MPa"].se)
    assert values["relaxation_time_s"].value == pytest.approx(TIME, abs=4.0 * values["relaxation_time_s"].se)


def test_nothing_is_held_in_a_law_of_ones_own():
    with pytest.raises(probation.InputError, match="hold: found modulus_MPa together with law=, expected one"):
        probation.diagnose(campaign(), law=maxwell_bar(), hold={"modulus_MPa": 1200.0})


def test_an_offset_in_one_record_of_a_maxwell_bar_is_named_with_its_record():
    shifted = campaign(lambda name, time, strain, stress: stress + 0.4 * np.exp(strain) * (name == "middle"))
    found = probation.diagnose(shifted, law=maxwell_bar(), design=False)
    assert found.verdict == "explained"
    assert found.best.effects == ("force_offset",)
    assert found.best.records == ("middle",)
    offset = found.best.parameters[0]
    assert offset.value == pytest.approx(0.4, abs=4.0 * offset.se)


def test_effects_that_a_law_does_not_understand_are_not_considered():
    found = probation.diagnose(campaign(), law=maxwell_bar(), design=False)
    assert all("rate_dependent_relaxation" not in each.effects for each in found.explanations)


def test_effects_that_a_law_does_not_understand_count_as_unknown_where_all_records_miss():
    """A second Maxwell element in parallel with the bar's: with other times alone no cause may be sure of it."""

    def second(name, time, strain, stress):
        rate = strain[-1] / time[-1]
        return stress + 60.0 * 90.0 * rate * -np.expm1(-time / 90.0)

    found = probation.diagnose(campaign(second), law=maxwell_bar())
    assert found.best.probability < 0.75
    assert ("unknown",) in found.answer_set
    [said] = [warning for warning in found.warnings if "cannot follow" in warning]
    assert "a slow process" in said
    assert "slow_process" in dict(found.isolability.left_out)


def test_no_form_is_tried_that_a_law_does_not_understand():
    """Mullins softening has forms of the area and of the network; the law follows the area alone, over a cycle."""

    def area_alone(time, strain, parameters, modification):
        area = None if modification is None else modification.load_bearing_area
        return parameters[0] * strain * (1.0 if area is None else area)

    law = CallableLaw(
        area_alone, ("modulus_MPa",), (100.0,), (0.0,), (1e4,), capabilities=frozenset({"load_bearing_area"})
    )
    made = []
    for index, rate in enumerate((1e-3, 4e-3)):
        strain = np.concatenate([[0.0], *(np.linspace(a, b, 91)[1:] for a, b in pairwise([0.0, 0.3, 0.1, 0.45]))])
        time = np.append(0.0, np.cumsum(np.abs(np.diff(strain)))) / rate
        lost = -0.08 * np.expm1(-(np.maximum.accumulate(strain) - strain) / 0.05)
        noise = 0.05 * np.random.default_rng(index).standard_normal(len(time))
        stress = 120.0 * strain * (1.0 - lost) + noise
        made.append(Record(id=f"r{index}", time=time, true_strain=strain, true_stress=stress))
    found = probation.diagnose(Campaign("cycles", tuple(made), specimens=Specimens("none")), law=law, design=False)
    assert any("mullins_softening" in effects for effects in found.answer_set)


def test_a_users_own_effect_is_found_once_it_is_registered():
    amplitude = EffectParameter("bend_MPa", "MPa", -5.0, 5.0, 0.5, "some tenths of a MPa")
    bend = Form("bend", (amplitude,), recorded_stress=lambda view, values, stress: stress + values[0] * _bend(view))
    register(Effect("bent_grip", "bent grip", "A grip bends.\nAmplitude: of the bend.", "none", "all", "rig", (bend,)))
    try:
        bent = campaign(lambda name, time, strain, stress: stress + 0.3 * np.sin(3.0 * np.pi * strain / 0.4))
        found = probation.diagnose(bent, law=maxwell_bar(), design=False)
    finally:
        unregister("bent_grip")
    assert found.best.effects == ("bent_grip",)
    assert found.best.parameters[0].value == pytest.approx(0.3, abs=0.03)


def _bend(view):
    return np.sin(3.0 * np.pi * view.recorded_strain / 0.4)


def test_a_law_that_raises_is_named_with_its_record_and_parameters():
    def broken(time, true_strain, parameters, modification):
        if time[-1] < 50.0:
            raise ZeroDivisionError("float division by zero")
        return parameters[0] * true_strain

    law = CallableLaw(broken, ("modulus_MPa",), (1000.0,), (0.0,), (1e5,))
    said = r"record 'fast': .* modulus_MPa = \d.*; it raised ZeroDivisionError: float division by zero"
    with pytest.raises(probation.InputError, match=said):
        probation.diagnose(campaign(), law=law, design=False)


def test_a_law_that_gives_no_numbers_is_named_with_its_record_and_parameters():
    law = CallableLaw(lambda *_: np.full(160, np.nan), ("modulus_MPa",), (1000.0,), (0.0,), (1e5,))
    with pytest.raises(probation.InputError, match=r"record 'slow': .* at modulus_MPa = 1000; it raised function\("):
        probation.diagnose(campaign(), law=law, design=False)


def test_a_parameter_on_which_nothing_depends_ends_no_description_of_what_is_left():
    """A saturation that is never reached, say; what is left is one function of the strain."""
    law = probation.CallableLaw(
        lambda time, strain, parameters, modification: parameters[0] * strain,
        ("modulus_MPa", "idle"),
        (100.0, 1.0),
        (0.0, 0.0),
        (1e4, 10.0),
    )
    records = []
    for seed, rate in enumerate((1e-3, 2e-3, 4e-3)):
        strain = np.linspace(0.0, 0.5, 150)
        stress = 100.0 * strain + np.sin(9.0 * strain) + 0.02 * np.random.default_rng(seed).standard_normal(150)
        records.append(Record(id=f"r{seed}", time=strain / rate, true_strain=strain, true_stress=stress))
    campaign = probation.Campaign(name="idle", records=tuple(records), specimens=probation.Specimens("none"))
    found = probation.diagnose(campaign, law=law, effects=["force_gain"], design=False)
    assert found.remainder.depends_on[0].variable == "strain"
