"""Effects once more, for sizes far beyond those of a sound rig, or of a polymer.

The catalogue's priors say what a sound rig has: some per cent of the force, some tenths of a per cent of the strain. A
crosshead that shows twice the specimen's strain lies forty of their standard deviations away; as long as such a prior
is all there is, a plain large fault is impossible and something else, or an unknown effect, is certain. So each fault
that can be large has its forms a second time, with a prior as wide as the records are large. Networks of long chains
lock at stretches of ten; one of short chains, or a drawn one, within some tenths of strain. Where 20 MPa activate the
flow of a stiff polymer, a tenth of that may do so with a soft one. A metal's back stress is a good part of its stress.
What a stress breaks is relative to the largest one.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from probation.effects.catalogue.machine_compliance import REFERENCE_STRESS as CONTACT_STRESS
from probation.effects.catalogue.machine_compliance import gross_contact
from probation.effects.catalogue.strain_offset import behind_slack
from probation.effects.catalogue.stress_activated_flow import REFERENCE_STRESS
from probation.settings.effects import EFFECTS

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence

    from probation._arrays import FloatArray
    from probation.effects.effect import Effect, Form, Values
    from probation.effects.record_view import RecordView


def with_large_forms(effects: Iterable[Effect], views: Sequence[RecordView]) -> tuple[Effect, ...]:
    """The same effects, those that can be large with further forms for that.

    Parameters
    ----------
    views : sequence of RecordView
        Of the records: large is relative to their forces and elongations.
    """
    size = _Size.of(views)
    return tuple(
        replace(effect, forms=(*effect.forms, *_LARGE[effect.name](effect, size))) if effect.name in _LARGE else effect
        for effect in effects
    )


class _Size(NamedTuple):
    """Largest nominal stress [MPa], true strain [-], elongation [-], and elongation over nominal stress [1/MPa].

    Of any record. And the mean elongation from sample to sample [-].
    """

    force: float
    strain: float
    elongation: float
    per_force: float
    per_sample: float

    @classmethod
    def of(cls, views: Sequence[RecordView]) -> _Size:
        forces = [float(np.max(np.abs(view.data / view.sampled(view.stretch)))) for view in views]
        strains = [float(np.max(np.abs(view.true_strain))) for view in views]
        elongations = [float(np.max(np.abs(np.expm1(view.true_strain)))) for view in views]
        ratios = [own / force for own, force in zip(elongations, forces, strict=True) if force > 0.0]
        steps = [float(np.mean(np.abs(np.diff(np.expm1(view.sampled(view.true_strain)))))) for view in views]
        return cls(max(forces), max(strains), max(elongations), max(ratios, default=0.0), max(steps))


def _widened(form: Form, scale: float, lower: float, upper: float, starts: tuple[float, ...] = ()) -> Form:
    """The form under another name, its amplitude with another prior and bounds; `starts` of the amplitude."""
    known = form.amplitude
    wide = replace(known, scale=scale, lower=lower, upper=upper, reason="far beyond what is usual", starts=())
    nonlinear = form.nonlinear_starts(())
    grid = [(start, *others) for start in starts for others in nonlinear] if starts else nonlinear
    return replace(
        form,
        name=f"large_{form.name}",
        parameters=(wide, *form.parameters[1:]),
        threshold=bool(starts),
        starts=lambda _views, _residuals: list(grid),
    )


def _gain(effect: Effect, size: _Size) -> tuple[Form, ...]:
    del size
    return (_widened(effect.form("factor"), EFFECTS.large_gain, -0.9, 4.0),)


def _offset(effect: Effect, size: _Size) -> tuple[Form, ...]:
    return (_widened(effect.form("constant"), EFFECTS.large_force * size.force, -size.force, size.force),)


def _prestress(effect: Effect, size: _Size) -> tuple[Form, ...]:
    scale = EFFECTS.large_prestress * size.force
    return tuple(_widened(effect.form(name), scale, -size.force, size.force) for name in ("fresh", "held"))


def _drift(effect: Effect, size: _Size) -> tuple[Form, ...]:
    most = EFFECTS.largest_drift * size.force
    return (_widened(effect.form("over_record"), EFFECTS.large_force * size.force, -most, most),)


def _compliance(effect: Effect, size: _Size) -> tuple[Form, ...]:
    # The noise of the recorded force would become a strain of the specimen, which is stiffer than the frame by far.
    linear = _of_travel(replace(effect.form("crosshead"), own_force=True), size.per_force)
    contact = replace(effect.form("contact"), driving_strain=gross_contact, own_force=True)
    powers, far = contact.parameters[1].starts, max(size.force, 1e-300) / CONTACT_STRESS
    grid: list[tuple[float, ...]] = [
        (part * size.per_force * far ** (1.0 - power), power) for part in EFFECTS.travel_starts for power in powers
    ]
    whole = max(size.per_force * far ** (1.0 - power) for power in powers)
    return linear, replace(_of_travel(contact, whole), starts=lambda _views, _residuals: grid)


def _slack_from_zero(view: RecordView, values: Values) -> FloatArray:
    """Nothing is seen until the elongation exceeds a: from zero, which the first reading may be far from."""
    return behind_slack(view.true_strain, values[0], begin=0.0)


def _slack(effect: Effect, size: _Size) -> tuple[Form, ...]:
    # Slack ends between two samples, where the force begins to rise.
    large = _of_travel(replace(effect.form("slack"), driving_strain=_slack_from_zero), size.elongation)
    fixed = large.nonlinear_starts(())

    def starts(views: Sequence[RecordView], residuals: Sequence[FloatArray] | None) -> list[tuple[float, ...]]:
        del residuals
        begun = float(np.clip(np.median([_force_begins(view) for view in views]), 0.0, large.amplitude.upper))
        return [(begun,), *fixed] if begun > 0.0 else fixed

    return (
        replace(large, parameters=(replace(large.amplitude, resolution=size.per_sample),), starts=starts),
        *(_taken_up(effect.form(name), size) for name in ("straightening", "seating")),
        *(_zeroed_elsewhere(effect.form(name), size) for name in ("shift", "settling")),
    )


def _zeroed_elsewhere(form: Form, size: _Size) -> Form:
    """A zero of the strain that is wrong by a good part of it."""
    wide = _widened(replace(form, starts=None), EFFECTS.large_zero * size.strain, -size.strain, size.strain)
    return replace(wide, starts=form.starts, variant=True)


def _taken_up(form: Form, size: _Size) -> Form:
    """Slack that the force takes up."""
    pull = form.parameters[1]
    large = _of_travel(replace(form, starts=None), size.elongation)
    grid: list[tuple[float, ...]] = [
        (travel * size.elongation, pull.inside(part * size.force))
        for travel in EFFECTS.travel_starts
        for part in EFFECTS.take_up_starts
    ]
    return replace(large, starts=lambda _views, _residuals: grid, hidden_by=None)


def _force_begins(view: RecordView) -> float:
    """Elongation to which the first rise of the force is extended back: toe compensation, ASTM D638, annex A1."""
    force = np.abs(view.data / view.sampled(view.stretch))
    elongation = np.expm1(view.sampled(view.true_strain))
    low, high = (int(np.argmax(force >= part * np.max(force))) for part in EFFECTS.first_rise)
    if not high > low:
        return float(elongation[low])
    slope, begun = np.polyfit(force[low : high + 1], elongation[low : high + 1], 1)
    return float(begun) if slope > 0.0 else float(elongation[low])


def _of_travel(form: Form, whole: float) -> Form:
    """Searched for from several sizes; `whole` is the amplitude that would take all of the elongation.

    A frame that takes half of the travel hides a slack of a quarter of it, and the reverse.
    """
    return _widened(
        replace(form, hidden_by="travel"),
        EFFECTS.large_travel * whole,
        0.0,
        EFFECTS.largest_travel * whole,
        tuple(part * whole for part in EFFECTS.travel_starts),
    )


def _hysteresis(effect: Effect, size: _Size) -> tuple[Form, ...]:
    del size
    bounds = 0.0, effect.form("loop").amplitude.upper
    return tuple(_widened(effect.form(name), EFFECTS.large_hysteresis, *bounds) for name in ("presliding", "stops"))


def _lag(effect: Effect, size: _Size) -> tuple[Form, ...]:
    del size
    both_ways = (*(-start for start in EFFECTS.lag_starts), *EFFECTS.lag_starts)
    delay = effect.form("delay")
    filtered = (effect.form(name) for name in ("filter", "strain_filter"))
    return (
        _widened(delay, EFFECTS.large_lag, delay.amplitude.lower, delay.amplitude.upper, both_ways),
        *(_widened(form, EFFECTS.large_lag, 0.0, form.amplitude.upper, EFFECTS.lag_starts) for form in filtered),
    )


def _locking(effect: Effect, size: _Size) -> tuple[Form, ...]:
    del size
    amplitude = effect.form("langevin").amplitude
    return tuple(
        _widened(effect.form(name), EFFECTS.short_chains, amplitude.lower, amplitude.upper, EFFECTS.locking_starts)
        for name in ("langevin", "three_chains")
    )


def _flow(effect: Effect, size: _Size) -> tuple[Form, ...]:
    # Eyring's gain at the reference stress goes with the square of that over the activation stress.
    amplitude = effect.form("eyring").amplitude
    softer = max(REFERENCE_STRESS / max(size.force, 1e-300), 1.0) ** 2
    return (
        _widened(effect.form("eyring"), EFFECTS.easy_flow * softer, amplitude.lower, EFFECTS.easiest_flow * softer),
    )


def _damage(effect: Effect, size: _Size) -> tuple[Form, ...]:
    # The energy that is set free goes with the square of the stress.
    softer = (REFERENCE_STRESS / max(size.force, 1e-300)) ** 2
    return (_widened(effect.form("by_stress"), EFFECTS.large_damage * softer, 0.0, EFFECTS.largest_damage * softer),)


def _back_stress(effect: Effect, size: _Size) -> tuple[Form, ...]:
    names = ("armstrong_frederick", "several_surfaces", "slip_element")
    scale = EFFECTS.large_back_stress * size.force
    return tuple(_widened(effect.form(name), scale, 0.0, size.force) for name in names)


_LARGE: dict[str, Callable[[Effect, _Size], tuple[Form, ...]]] = {
    "back_stress": _back_stress,
    "cell_hysteresis": _hysteresis,
    "damage": _damage,
    "force_gain": _gain,
    "force_offset": _offset,
    "force_drift": _drift,
    "force_strain_lag": _lag,
    "finite_extensibility": _locking,
    "machine_compliance": _compliance,
    "prestress": _prestress,
    "strain_gain": _gain,
    "strain_offset": _slack,
    "stress_activated_flow": _flow,
}
