"""Is every sensitivity the derivative it claims to be?

Each is compared with a central difference of the stress itself: (stress(+d) - stress(-d)) / 2d, whose own error is
d^2 times a third derivative plus rounding over d; steps are chosen so that both stay below a millionth.
"""

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose
from reference import paper

import probation
from probation import Change, Direction, SelfHeating, StressActivation

SCHEMES = ("be2", "sa2", "sa3")
FEEDBACKS = {
    "no feedback": (),
    "stress activation": (StressActivation(15.0),),
    "self heating": (SelfHeating(2.0, 0.01, 0.03, 0.01),),
    "both": (StressActivation(15.0), SelfHeating(2.0, 0.01, 0.03, 0.01)),
}


def kinked():
    """Ramp, four times faster, hold, unloading, on uneven steps (one pair beyond BDF2's 2.41), from a strain of 0.02."""
    time = np.concatenate(
        [
            paper.uneven(12, 10.0),
            [10.9, 11.3, 12.1],
            12.1 + 0.2 * np.arange(1, 9),
            paper.uneven(15, 20.0)[1:] + 13.7,
        ]
    )
    rates = np.select([time < 10.0, time < 13.7, time < 20.0], [0.004, 0.016, 0.0], -0.006)
    knots = [0.0, 10.0, 13.7, 20.0, 40.0]
    strain = 0.02 + np.interp(time, knots, np.cumsum([0.0, 0.04, 0.0592, 0.0, -0.12]))
    return time, strain, {"jumps": [10.0, 13.7]}, rates


def smooth():
    """Uneven steps, no jump."""
    time = paper.uneven(40, 30.0)
    return time, paper.smooth_strain(time), {"jumps": None}, paper.smooth_rate(time)


HISTORIES = {"kinked": kinked(), "smooth": smooth()}
COMPANION = probation.Weissenberg(*paper.WEISSENBERG, rate_floor=1e-4)
SPECTRUM = probation.Spectrum.log_spaced(10, 4.0)


def law(companion, **changed):
    base = {"unrelaxed_modulus": 2000.0, "hardening_modulus": 2.5, "spectrum": SPECTRUM}
    base |= {"companion": COMPANION, "alpha": 1.1} if companion else {"tau_max": 5.2}
    return probation.Law(**(base | changed))


def agree(found, expected, tolerance=2e-6):
    scale = np.abs(expected).max()
    assert scale > 0.0, "the difference sees nothing: the test would be empty"
    assert_allclose(found, expected, rtol=0.0, atol=tolerance * scale)


def central(stress, step):
    return (stress(step) - stress(-step)) / (2.0 * step)


histories = pytest.mark.parametrize("history", HISTORIES.values(), ids=HISTORIES)
schemes = pytest.mark.parametrize("scheme", SCHEMES)
feedbacks = pytest.mark.parametrize("feedback", FEEDBACKS.values(), ids=FEEDBACKS)
companions = pytest.mark.parametrize("companion", [False, True], ids=["constant", "companion"])


@schemes
@feedbacks
@companions
@histories
def test_parameters_are_differentiated(scheme, feedback, companion, history):
    time, strain, options, _ = history
    base, change = law(companion), Change(feedbacks=feedback)
    stress, found = base.sensitivity(time, strain, scheme, change=change, **options)
    assert_allclose(
        stress, base.stress(time, strain, scheme, change=change, **options), rtol=1e-12, atol=1e-12
    )
    for k, name in enumerate(base.parameter_names):
        value = getattr(base, name)
        expected = central(
            lambda d, name=name, value=value: replace(base, **{name: value + d}).stress(
                time, strain, scheme, change=change, **options
            ),
            1e-5 * value,
        )
        agree(found[:, k], expected)


@schemes
@feedbacks
@companions
@histories
@pytest.mark.parametrize("given_rate", [False, True], ids=["sampled", "given rate"])
def test_every_strain_sample_is_differentiated(scheme, feedback, companion, history, given_rate):
    """With rates of its own the history's rates stay, but for the secant on one side of a jump."""
    time, strain, options, rates = history
    options = options | ({"strain_rate": rates} if given_rate else {})
    base, change = law(companion), Change(feedbacks=feedback)
    found = base.strain_sensitivity(time, strain, scheme, change=change, **options)
    for k in range(0, len(time), 3):
        unit = np.eye(len(time))[k]
        expected = central(
            lambda d, unit=unit: base.stress(time, strain + d * unit, scheme, change=change, **options), 2e-7
        )
        agree(found[:, k], expected, 1e-5)


@schemes
@companions
@histories
def test_no_stress_answers_to_a_later_strain(scheme, companion, history):
    """But for the central differences of sa2 and sa3, which see tau_max one sample ahead."""
    time, strain, options, _ = history
    found = law(companion).strain_sensitivity(time, strain, scheme, **options)
    ahead = 2 if companion and scheme != "be2" else 1
    assert not np.triu(found, ahead).any()
    assert np.abs(np.diag(found)).min() > 0.0


@schemes
@companions
@feedbacks
@histories
def test_given_rates_are_differentiated(scheme, companion, feedback, history):
    time, strain, options, rates = history
    rng = np.random.default_rng(3)
    base, change = law(companion), Change(feedbacks=feedback)
    towards = rng.standard_normal(len(time)) * 1e-3
    if scheme != "be2" and not companion:
        pytest.skip("sa2 and sa3 use given rates for the companion relation alone")
    _, found = base.sensitivity(
        time,
        strain,
        scheme,
        change=change,
        strain_rate=rates,
        directions=[Direction(strain_rate=towards)],
        **options,
    )
    expected = central(
        lambda d: base.stress(
            time, strain, scheme, change=change, strain_rate=rates + d * towards, **options
        ),
        1e-4,
    )
    agree(found[:, 0], expected)


def fields(n, modes):
    """Each field of Direction, a direction in it, and the same move of law and change."""
    rng = np.random.default_rng(11)
    wave = 1.0 + 0.3 * np.sin(np.linspace(0.0, 4.0, n))
    per_mode = rng.uniform(-1.0, 1.0, modes)
    start = 0.2 + 0.1 * rng.uniform(-1.0, 1.0, modes)
    extra = Change(extra_modulus=[300.0, 40.0, 7.0], extra_relaxation_time=[0.3, 9.0, 80.0])
    each = np.array([1.0, -0.5, 2.0])

    def scaled(change, name, d, samples):
        old = getattr(change, name)
        return replace(change, **{name: (1.0 if old is None else np.asarray(old)) * np.exp(d * samples)})

    def spectrum(law, d_weight=0.0, d_log_ratio=0.0):
        old = law.spectrum
        moved = probation.Spectrum(old.relaxation_ratio * np.exp(d_log_ratio), old.modal_weight + d_weight)
        return replace(law, spectrum=moved)

    full = Change(
        relaxation_time_factor=np.linspace(1.0, 0.7, n),
        unrelaxed_modulus_factor=1.0 + 0.2 * np.cos(np.linspace(0.0, 5.0, n)),
        hardening_factor=np.linspace(1.0, 1.5, n),
        added_relaxed_stress=np.linspace(0.5, 2.0, n),
        load_bearing_area=np.linspace(1.0, 0.8, n),
    )
    plain = Change()
    cases = {}
    for label, base in (("plain", plain), ("sampled", full)):
        cases |= {
            f"modal weight, {label}": (
                base, Direction(modal_weight=0.01 * per_mode), lambda law, c, d: (spectrum(law, d_weight=0.01 * d * per_mode), c)),
            f"log relaxation ratio, {label}": (
                base, Direction(log_relaxation_ratio=per_mode), lambda law, c, d: (spectrum(law, d_log_ratio=d * per_mode), c)),
            f"log relaxation time, {label}": (
                base, Direction(log_relaxation_time=wave), lambda law, c, d: (law, scaled(c, "relaxation_time_factor", d, wave))),
            f"load-bearing area, {label}": (
                base, Direction(log_load_bearing_area=wave), lambda law, c, d: (law, scaled(c, "load_bearing_area", d, wave))),
            f"relaxed stress, {label}": (
                base, Direction(relaxed_stress=wave),
                lambda law, c, d: (law, replace(c, added_relaxed_stress=(0.0 if c.added_relaxed_stress is None else c.added_relaxed_stress) + d * wave))),
            f"sampled modulus, {label}": (
                base, Direction(unrelaxed_modulus=2000.0 * wave),
                lambda law, c, d: (law, replace(c, unrelaxed_modulus_factor=(1.0 if c.unrelaxed_modulus_factor is None else c.unrelaxed_modulus_factor) + d * wave))),
        }  # fmt: skip
    started = replace(full, initial_modal_stress=start)
    cases |= {
        "initial modal stress": (
            started, Direction(initial_modal_stress=per_mode),
            lambda law, c, d: (law, replace(c, initial_modal_stress=start + d * per_mode))),
        "modal weight under a given start": (
            started, Direction(modal_weight=0.01 * per_mode), lambda law, c, d: (spectrum(law, d_weight=0.01 * d * per_mode), c)),
        "relaxed stress under a given start": (
            started, Direction(relaxed_stress=wave),
            lambda law, c, d: (law, replace(c, added_relaxed_stress=c.added_relaxed_stress + d * wave))),
        "extra modulus": (
            extra, Direction(extra_modulus=100.0 * each), lambda law, c, d: (law, replace(c, extra_modulus=c.extra_modulus + d * 100.0 * each))),
        "log extra time": (
            extra, Direction(log_extra_time=each),
            lambda law, c, d: (law, replace(c, extra_relaxation_time=c.extra_relaxation_time * np.exp(d * each)))),
        "modal weight beside extra modes": (
            extra, Direction(modal_weight=0.01 * per_mode), lambda law, c, d: (spectrum(law, d_weight=0.01 * d * per_mode), c)),
        "several at once": (
            replace(started, extra_modulus=[300.0, 40.0, 7.0], extra_relaxation_time=[0.3, 9.0, 80.0]),
            Direction(modal_weight=0.01 * per_mode, log_relaxation_ratio=per_mode, log_relaxation_time=wave, extra_modulus=100.0 * each),
            lambda law, c, d: (
                spectrum(law, 0.01 * d * per_mode, d * per_mode),
                replace(scaled(c, "relaxation_time_factor", d, wave), extra_modulus=c.extra_modulus + d * 100.0 * each))),
    }  # fmt: skip
    return {
        name: (replace(change, **as_arrays(change)), direction, move)
        for name, (change, direction, move) in cases.items()
    }


def as_arrays(change):
    names = ("extra_modulus", "extra_relaxation_time")
    return {name: np.asarray(getattr(change, name)) for name in names if getattr(change, name) is not None}


FIELDS = tuple(fields(4, SPECTRUM.modal_weight.size))


@schemes
@feedbacks
@histories
@pytest.mark.parametrize("field", FIELDS)
def test_every_field_of_a_direction_is_differentiated(scheme, feedback, history, field):
    time, strain, options, _ = history
    change, direction, move = fields(len(time), SPECTRUM.modal_weight.size)[field]
    change = replace(change, feedbacks=feedback)
    for companion in (False, True):
        base = law(companion)
        _, found = base.sensitivity(time, strain, scheme, change=change, directions=[direction], **options)

        def stress(d, base=base):
            moved, changed = move(base, change, d)
            return moved.stress(time, strain, scheme, change=changed, **options)

        agree(found[:, 0], central(stress, 1e-5), 3e-6)


@schemes
@companions
@histories
@pytest.mark.parametrize("parameter", range(5))
def test_feedback_parameters_are_differentiated(scheme, companion, history, parameter):
    """activation_stress, then the four of SelfHeating, with both feedbacks and an extra mode at work."""
    time, strain, options, _ = history
    base = law(companion)
    values = np.array([15.0, 2.0, 0.01, 0.03, 0.01])

    def change(v):
        return Change(
            feedbacks=(StressActivation(v[0]), SelfHeating(*v[1:])),
            extra_modulus=[50.0],
            extra_relaxation_time=[4.0],
        )

    where = (0, 0) if parameter == 0 else (1, parameter - 1)
    direction = Direction(feedback=where[0], feedback_parameter=where[1])
    _, found = base.sensitivity(
        time, strain, scheme, change=change(values), directions=[direction], **options
    )
    step = 1e-4 * values[parameter]
    moved = np.eye(5)[parameter]
    expected = central(
        lambda d: base.stress(time, strain, scheme, change=change(values + d * moved), **options), step
    )
    agree(found[:, 0], expected, 3e-6)
