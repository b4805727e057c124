"""Is every sensitivity the derivative it claims to be?

Each is compared with a central difference of the stress itself, (stress(+d) - stress(-d)) / 2d, whose
own error is d^2 times a third derivative plus rounding over d; steps keep both below a millionth.
"""

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

import probation
from probation import Direction, Modification, PowerActivation, SelfHeating, StrainHistory, StressActivation
from reference import literal, paper

SCHEMES = ("be2", "sa2", "sa3")
FEEDBACKS = {
    "no feedback": (),
    "stress activation": (StressActivation(15.0),),
    "activation by a power": (PowerActivation(30.0, 2.5),),
    "self heating": (SelfHeating(2.0, 0.01, 0.03, 0.01),),
    "both": (StressActivation(15.0), SelfHeating(2.0, 0.01, 0.03, 0.01)),
}


def kinked():
    """Ramp, four times faster, hold, unloading, from a strain of 0.02; uneven steps, one pair beyond 2.41."""
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
    base, change = law(companion), Modification(feedbacks=feedback)
    stress, found = base.sensitivity(StrainHistory(time, strain, **options), scheme=scheme, modification=change)
    assert_allclose(
        stress,
        base.stress(StrainHistory(time, strain, **options), scheme=scheme, modification=change),
        rtol=1e-12,
        atol=1e-12,
    )
    for k, name in enumerate(base.parameter_names):
        value = getattr(base, name)
        expected = central(
            lambda d, name=name, value=value: replace(base, **{name: value + d}).stress(
                StrainHistory(time, strain, **options), scheme=scheme, modification=change
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
    base, change = law(companion), Modification(feedbacks=feedback)
    found = base.strain_sensitivity(StrainHistory(time, strain, **options), scheme=scheme, modification=change)
    for k in range(0, len(time), 3):
        unit = np.eye(len(time))[k]
        expected = central(
            lambda d, unit=unit: base.stress(
                StrainHistory(time, strain + d * unit, **options), scheme=scheme, modification=change
            ),
            2e-7,
        )
        agree(found[:, k], expected, 1e-5)


@schemes
@companions
@histories
def test_no_stress_answers_to_a_later_strain(scheme, companion, history):
    """But for the central differences of sa2 and sa3, which see tau_max one sample ahead."""
    time, strain, options, _ = history
    found = law(companion).strain_sensitivity(StrainHistory(time, strain, **options), scheme=scheme)
    ahead = 2 if companion and scheme != "be2" else 1
    assert not np.triu(found, ahead).any()
    assert np.abs(np.diag(found)).min() > 0.0


@pytest.mark.parametrize(
    ("scheme", "companion"), [("be2", False), ("be2", True), ("sa2", True), ("sa3", True)]
)  # sa2 and sa3 use given rates for the companion relation alone
@feedbacks
@histories
def test_given_rates_are_differentiated(scheme, companion, feedback, history):
    time, strain, options, rates = history
    rng = np.random.default_rng(3)
    base, change = law(companion), Modification(feedbacks=feedback)
    towards = rng.standard_normal(len(time)) * 1e-3
    _, found = base.sensitivity(
        StrainHistory(time, strain, strain_rate=rates, **options),
        scheme=scheme,
        modification=change,
        directions=[Direction(strain_rate=towards)],
    )
    expected = central(
        lambda d: base.stress(
            StrainHistory(time, strain, strain_rate=rates + d * towards, **options), scheme=scheme, modification=change
        ),
        1e-4,
    )
    agree(found[:, 0], expected)


def or_else(values, otherwise):
    return otherwise if values is None else np.asarray(values)


def moved(law, change, direction, d, start_strain):
    """The law and the change, moved by d along a direction: what each field of Direction means."""

    def step(name):
        return d * or_else(getattr(direction, name), 0.0)

    p = law.spectrum.modal_weight
    factors = {
        "relaxation_time_factor": np.exp(step("log_relaxation_time")),
        "load_bearing_area": np.exp(step("log_load_bearing_area")),
    }
    fields = {name: or_else(getattr(change, name), 1.0) * factor for name, factor in factors.items()}
    fields["unrelaxed_modulus_factor"] = (
        or_else(change.unrelaxed_modulus_factor, 1.0) + step("unrelaxed_modulus") / law.unrelaxed_modulus
    )
    fields["added_relaxed_stress"] = or_else(change.added_relaxed_stress, 0.0) + step("relaxed_stress")
    if change.extra_modulus is not None:
        fields["extra_modulus"] = np.asarray(change.extra_modulus) + step("extra_modulus")
        fields["extra_relaxation_time"] = np.asarray(change.extra_relaxation_time) * np.exp(step("log_extra_time"))
    if change.initial_modal_stress is not None:
        fields["initial_modal_stress"] = np.asarray(change.initial_modal_stress) + step("initial_modal_stress")
    elif direction.initial_modal_stress is not None:
        hardening = law.hardening_modulus * np.atleast_1d(or_else(change.hardening_factor, 1.0))[0]
        relaxed = hardening * literal.hardening_strain(start_strain) + np.atleast_1d(fields["added_relaxed_stress"])[0]
        fields["initial_modal_stress"] = (p + step("modal_weight")) * relaxed + step("initial_modal_stress")
    spectrum = probation.Spectrum(
        law.spectrum.relaxation_ratio * np.exp(step("log_relaxation_ratio")), p + step("modal_weight")
    )
    return replace(law, spectrum=spectrum), replace(change, **fields)


def directions(n, modes=10, extras=3):
    """One per field of Direction, and several at once."""
    rng = np.random.default_rng(11)
    wave = 1.0 + 0.3 * np.sin(np.linspace(0.0, 4.0, n))
    per_mode = rng.uniform(-1.0, 1.0, modes)
    of_mode = {"modal_weight": 0.01 * per_mode, "log_relaxation_ratio": per_mode[::-1]}
    of_extra = {
        "extra_modulus": np.linspace(100.0, -50.0, extras),
        "log_extra_time": np.linspace(-1.0, 2.0, extras),
    }
    sampled = {
        "unrelaxed_modulus": 2000.0 * wave,
        "log_relaxation_time": wave,
        "relaxed_stress": wave,
        "log_load_bearing_area": wave,
    }
    starts = {"initial_modal_stress": rng.uniform(-1.0, 1.0, modes)}
    each = of_mode | of_extra | sampled | starts
    one_by_one = {name: Direction(**{name: values}) for name, values in each.items()}
    constant = {f"constant {name}": Direction(**{name: values[:1]}) for name, values in sampled.items()}
    return one_by_one | constant | {"all at once": Direction(**each)}


def changes(n, modes=10):
    """Nothing but extra modes; every sampled input; a start that is not relaxed."""
    extra = {"extra_modulus": [300.0, 40.0, 7.0], "extra_relaxation_time": [0.3, 9.0, 80.0]}
    sampled = extra | {
        "relaxation_time_factor": np.linspace(1.0, 0.7, n),
        "unrelaxed_modulus_factor": 1.0 + 0.2 * np.cos(np.linspace(0.0, 5.0, n)),
        "hardening_factor": np.linspace(1.0, 1.5, n),
        "added_relaxed_stress": np.linspace(0.5, 2.0, n),
        "load_bearing_area": np.linspace(1.0, 0.8, n),
    }
    start = 0.2 + 0.1 * np.random.default_rng(5).uniform(-1.0, 1.0, modes)
    return {
        "plain": Modification(**extra),
        "sampled": Modification(**sampled),
        "given start": Modification(**sampled, initial_modal_stress=start),
    }


@schemes
@feedbacks
@companions
@histories
@pytest.mark.parametrize("changed", ["plain", "sampled", "given start"])
def test_every_field_of_a_direction_is_differentiated(scheme, feedback, companion, history, changed):
    time, strain, options, _ = history
    n = len(time)
    base, change = law(companion), replace(changes(n)[changed], feedbacks=feedback)
    for name, direction in directions(n).items():
        _, found = base.sensitivity(
            StrainHistory(time, strain, **options), scheme=scheme, modification=change, directions=[direction]
        )

        def stress(d, direction=direction):
            moved_law, moved_change = moved(base, change, direction, d, strain[0])
            return moved_law.stress(StrainHistory(time, strain, **options), scheme=scheme, modification=moved_change)

        try:
            agree(found[:, 0], central(stress, 1e-5), 3e-6)
        except AssertionError as error:
            raise AssertionError(f"direction {name}: {error}") from None


@schemes
@pytest.mark.parametrize("start", [None, np.full(10, 0.3)], ids=["relaxed", "given"])
@feedbacks
def test_directions_add_up(scheme, start, feedback):
    """A derivative is linear: along several fields at once it is the sum of those along each."""
    time, strain, options, _ = HISTORIES["kinked"]
    fields = directions(len(time))
    every = fields["all at once"]
    alone = [fields[name] for name in vars(every) if name in fields]
    change = replace(changes(len(time))["plain"], initial_modal_stress=start, feedbacks=feedback)
    _, found = law(True).sensitivity(
        StrainHistory(time, strain, **options), scheme=scheme, modification=change, directions=[every, *alone]
    )
    scale = np.abs(found).max()
    assert_allclose(found[:, 0], found[:, 1:].sum(axis=1), rtol=0.0, atol=1e-11 * scale)


@schemes
@feedbacks
@pytest.mark.parametrize("start", [None, [0.2, 0.0, 0.4]], ids=["relaxed", "given"])
def test_a_mode_of_weight_zero_has_a_tangent(scheme, feedback, start):
    """Weights cannot be negative: a one-sided difference of second order, (4 f(d) - f(2d) - 3 f(0)) / 2d."""
    time, strain, options, _ = HISTORIES["smooth"]
    strain = strain + 0.3
    base = law(False, spectrum=probation.Spectrum([0.01, 0.1, 1.0], [0.5, 0.0, 0.5]))
    change, direction = (
        Modification(initial_modal_stress=start, feedbacks=feedback),
        Direction(modal_weight=[0.0, 1.0, 0.0]),
    )
    _, found = base.sensitivity(
        StrainHistory(time, strain, **options), scheme=scheme, modification=change, directions=[direction]
    )
    f = [
        law.stress(StrainHistory(time, strain, **options), scheme=scheme, modification=changed)
        for law, changed in (moved(base, change, direction, d, strain[0]) for d in (0.0, 1e-4, 2e-4))
    ]
    agree(found[:, 0], (4.0 * f[1] - f[2] - 3.0 * f[0]) / 2e-4, 2e-6)


@feedbacks
@pytest.mark.parametrize("given", [True, False])
def test_a_start_that_is_not_relaxed_in_a_mode_of_weight_zero_has_none(feedback, given):
    time, strain, _, _ = HISTORIES["smooth"]
    base = law(False, spectrum=probation.Spectrum([0.01, 0.1, 1.0], [0.5, 0.0, 0.5]))
    start = [1.0, 1.0, 1.0]
    change = Modification(initial_modal_stress=start if given else None, feedbacks=feedback)
    direction = Direction(relaxed_stress=1.0) if given else Direction(initial_modal_stress=start)
    with pytest.raises(probation.InputError, match=r"initial_modal_stress\[1\].*weight 0"):
        base.sensitivity(time, strain, modification=change, directions=[direction])


@feedbacks
@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        ({"modal_weight": np.ones(400)}, r"direction.modal_weight has 400 .* 10 modes"),
        ({"log_relaxation_ratio": np.ones(9)}, r"direction.log_relaxation_ratio has 9 .* 10 modes"),
        ({"initial_modal_stress": np.ones(11)}, r"direction.initial_modal_stress has 11 .* 10 modes"),
        ({"extra_modulus": np.ones(4)}, r"direction.extra_modulus has 4 .* 0 extra modes"),
        ({"log_extra_time": np.ones(4)}, r"direction.log_extra_time has 4 .* 0 extra modes"),
        ({"true_strain": np.ones(3)}, r"direction.true_strain has 3"),
        ({"relaxed_stress": np.ones(3)}, r"direction.relaxed_stress has 3"),
        ({"strain_rate": np.ones(41)}, r"direction.strain_rate .* own rates"),
        ({"feedback": 2}, r"direction.feedback is 2"),
        ({"log_relaxation_time": np.nan}, r"direction.log_relaxation_time\[0\] is nan"),
    ],
)
def test_a_direction_that_does_not_fit_is_named(feedback, wrong, message):
    time, strain, _, _ = HISTORIES["smooth"]
    with pytest.raises(probation.InputError, match=message):
        law(False).sensitivity(
            time, strain, modification=Modification(feedbacks=feedback), directions=[Direction(**wrong)]
        )


def test_a_feedback_parameter_that_is_not_there_is_named():
    time, strain, _, _ = HISTORIES["smooth"]
    change = Modification(feedbacks=FEEDBACKS["both"])
    with pytest.raises(probation.InputError, match=r"feedback_parameter is 1; that feedback has 1"):
        law(False).sensitivity(
            time, strain, modification=change, directions=[Direction(feedback=0, feedback_parameter=1)]
        )


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
        return Modification(
            feedbacks=(StressActivation(v[0]), SelfHeating(*v[1:])),
            extra_modulus=[50.0],
            extra_relaxation_time=[4.0],
        )

    where = (0, 0) if parameter == 0 else (1, parameter - 1)
    direction = Direction(feedback=where[0], feedback_parameter=where[1])
    _, found = base.sensitivity(
        StrainHistory(time, strain, **options), scheme=scheme, modification=change(values), directions=[direction]
    )
    step = 1e-4 * values[parameter]
    moved = np.eye(5)[parameter]
    expected = central(
        lambda d: base.stress(
            StrainHistory(time, strain, **options), scheme=scheme, modification=change(values + d * moved)
        ),
        step,
    )
    agree(found[:, 0], expected, 3e-6)
