"""The paper's own story: without a companion relation, tests at a changing rate ask for one."""

from dataclasses import replace

import numpy as np
import pytest

from probation import Campaign, Law, Specimens, Weissenberg, diagnose
from probation.law.history import StrainHistory
from probation.law.settings import LawSettings
from probation.published.experiments import SAMPLES, experiment_2, experiment_3, necking_history, twin_campaign
from probation_studies.paper.wavy_bias import drawn_wave

MISSING, UNKNOWN = "rate_dependent_relaxation", "unknown"
NOISE = 0.04  # MPa
HELD = {"unrelaxed_modulus_MPa": 3220.0}
TRUTH = Law(
    unrelaxed_modulus=3220.0, alpha=1.1, hardening_modulus=1.8, companion=Weissenberg(slope=0.00464, intercept=0.0367)
)


def record(number, necking, role, bias=0.0):
    """TRUTH along the strain history of experiment 2 or 3, by the exact scheme on 20 times finer a grid, with noise."""
    history = necking_history(number, necking)
    fine = np.linspace(0.0, history.duration, 20 * (SAMPLES - 1) + 1)
    stress = TRUTH.stress(StrainHistory(fine, history.true_strain(fine), jumps=None), scheme="exact")[::20]
    stress = stress + NOISE * np.random.default_rng([number, int(necking[1])]).standard_normal(SAMPLES)
    twin = (experiment_2 if number == 2 else experiment_3)(necking=necking)
    wave = drawn_wave(twin.true_strain, np.random.default_rng([7, number]))
    stress = stress + bias * wave / np.abs(wave).max()
    return replace(twin.record(role), id=f"{number}-{necking}", true_stress=stress)


def diagnosed(*records, hold=None):
    return diagnose(Campaign("one law", records, LawSettings(), Specimens("none")), hold=hold, design=False)


def nothing_else_is_named(found):
    """Relaxation alone leads by far. The set may hold it "and something unknown", of which no data are quite free, and
    pairs with a second effect that does not show, by less than one in fifty.
    """
    others = [each for each in found.explanations if each.effects not in {(MISSING,), (MISSING, UNKNOWN)}]
    return (
        found.best.effects == (MISSING,)
        and found.best.probability > 0.8
        and all(
            each.probability < 0.02 and MISSING in each.effects for each in others if each.effects in found.answer_set
        )
    )


@pytest.mark.parametrize(("number", "other", "hold"), [(2, 3, HELD), (3, 2, HELD), (3, 2, None)])
def test_the_companion_relation_is_missed_and_nothing_else(number, other, hold):
    """Without it 6 to 8 MPa; with it the noise, on the record that was fitted."""
    twins = twin_campaign((number,), held_out=(other,))
    found = diagnose(Campaign(twins.name, twins.records, LawSettings(), Specimens("none")), hold=hold, design=False)
    assert found.verdict == "explained"
    assert nothing_else_is_named(found)
    assert 6.0 < found.shrink.identify.before_MPa < 8.5
    assert found.shrink.identify.after_MPa < 1.5 * NOISE
    # The synthetic records differ by 6 % in alpha and 5 % in G, by 4 to 5 MPa at the end of the test: that is left.
    assert found.shrink.held_out.closure > 0.99
    assert NOISE < found.shrink.held_out.after_MPa < 5.0


def test_it_is_named_where_the_modulus_cannot_be_known():
    """Experiment 2 tells little of E_u: what the data leave open must not make an unknown effect of rounding errors."""
    twins = twin_campaign((2,))
    found = diagnose(Campaign(twins.name, twins.records, LawSettings(), Specimens("none")), design=False)
    assert found.best.effects == (MISSING,)
    assert found.best.probability > 0.8
    assert found.shrink.identify.after_MPa < 1.5 * NOISE


@pytest.mark.parametrize(("number", "other"), [(2, 3), (3, 2)])
def test_the_gap_falls_to_the_noise_on_other_kinematics_too(number, other):
    """One law for all: necking otherwise at the same grip speed, and at a grip speed four times another."""
    held_out = [record(number, "P1", "held-out"), record(number, "P3", "held-out"), record(other, "P2", "held-out")]
    found = diagnosed(record(number, "P2", "identify"), *held_out, hold=HELD)
    assert nothing_else_is_named(found)
    for necking in ("P1", "P3"):
        closure = found.shrink.records[f"{number}-{necking}"]
        assert closure.before_MPa > 6.0
        assert closure.after_MPa < 1.5 * NOISE
    assert found.shrink.records[f"{other}-P2"].closure > 0.9995


def test_two_grip_speeds_together_bring_it_down_to_the_noise():
    found = diagnosed(record(2, "P2", "identify"), record(3, "P2", "identify"), hold=HELD)
    assert found.verdict == "explained"
    assert nothing_else_is_named(found)
    assert found.shrink.identify.after_MPa == pytest.approx(NOISE, rel=0.1)


def test_a_wavy_bias_is_told_beside_the_missing_relation():
    """1.5 MPa at its largest, about 0.5 rms: what is left is of that size, and the headline says that it is there.

    A noise that holds such a wave leaves other effects near: a stress-activated flow is 19 log units behind. Where
    forms may be wrong by as much as the wave is large, such a distance says little.
    """
    found = diagnosed(record(3, "P2", "identify", bias=1.5), record(3, "P1", "held-out"), hold=HELD)
    assert found.verdict == "unexplained"
    assert MISSING in found.best.effects
    known_effects = [each for each in found.effects if each.name != UNKNOWN]
    assert max(known_effects, key=lambda each: each.probability).name == MISSING
    known = [each for each in found.explanations if each.effects in found.answer_set and UNKNOWN not in each.effects]
    best = max(each.log_evidence for each in known)
    assert all(MISSING in each.effects or each.log_evidence < best - 15.0 for each in known)
    assert "rate-dependent relaxation" in found.headline
    assert "part of it" in found.headline
    assert "more than noise is left" in found.headline
    assert 0.2 < found.shrink.identify.after_MPa < 1.0
    assert found.best.checks.remaining_p_value < 0.005
