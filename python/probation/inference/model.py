"""A base law with effects, on all records of a campaign: predictions, fit residuals and their derivatives."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Final

import numpy as np

from probation._complaint import suggestion
from probation.effects.cause import Cause
from probation.errors import ConvergenceError, InputError
from probation.inference.elastic_frame import ElasticFrame
from probation.inference.own_force import ROUGHLY, SETTLED, SLOPE, OwnForce
from probation.inference.unsolvable import UNSOLVABLE
from probation.law.modification import ONCE, Modification
from probation.noise.moving_parabola import moving_parabola
from probation.noise.outliers import without_outliers
from probation.noise.own_deviations import own_deviations
from probation.settings.noise import NOISE

if TYPE_CHECKING:
    from collections.abc import Callable

    from probation._arrays import FloatArray
    from probation.effects.effect import Effect, EffectParameter
    from probation.effects.record_view import RecordView
    from probation.inference.protocol import GapLaw
    from probation.noise.model import NoiseModel

_PROBE = 1e-3
"""Stress by which what was recorded is probed for its derivative [MPa]."""

_ONE_SIDED = 0.1
"""Step of a one-sided difference, over that of a central one."""

_PARABOLA = 3
"""Samples through which a parabola always goes."""

CauseValues = tuple[tuple[Cause, tuple[float, ...]], ...]


@dataclass(frozen=True, eq=False)
class Specimen:
    """What the specimen did along one record.

    Attributes
    ----------
    stress : ndarray, shape (n,) [MPa]
        As a faultless force channel would have recorded it.
    sensitivity : ndarray, shape (n, n_base), or None
        Its derivatives along the base parameters.
    own_force : OwnForce or None
        How the stress answers where the force is the model's own.
    """

    stress: FloatArray
    sensitivity: FloatArray | None
    own_force: OwnForce | None = None


_MOVED_KINKS = 3
"""How often a force is sought whose own change moves a kink of the strain past a sample."""


class CampaignModel:
    """A base law and causes, on the records of a campaign: the forward model, which a `Problem` holds with the noise.

    It knows of no noise: screens, designs and predictions of records that were held out ask it alone for stresses and
    derivatives in MPa. It is never changed, and several threads may use it: it keeps nothing between calls, and the law
    sees to its own.

    Parameters
    ----------
    law : GapLaw
    views : sequence of RecordView
        From `views_of`: those to be fitted, or all.
    causes : sequence of Cause

    Attributes
    ----------
    law, views, causes
    parameter_names : tuple of str
        The law's, then each cause's.
    data : ndarray, shape (n_samples,) [MPa]
        Recorded true stress of all records, stacked.
    base_count : int
        How many parameters the base law has.

    Raises
    ------
    InputError
        For a record that is not there, a cause that the law cannot follow, or one given twice.
    """

    def __init__(self, law: GapLaw, views: Sequence[RecordView], causes: Iterable[Cause] = ()) -> None:
        self.law: Final = law
        self.views: Final = tuple(views)
        self.causes: Final = tuple(causes)
        ids = [view.id for view in self.views]
        for cause in self.causes:
            for record in cause.records or ():
                if record not in ids:
                    raise InputError(f"{cause.effect.name}: found no record {record!r}; {suggestion(record, ids)}")
            if missing := self.missing_capabilities(cause):
                raise InputError(f"{cause.effect.name}: the law does not understand {', '.join(sorted(missing))}")
        names = (*law.parameter_names, *(name for own in self.causes for name in own.parameter_names))
        if len(set(names)) < len(names):
            raise InputError("a cause is given twice for the same records")
        self.parameter_names: Final = tuple(names)
        ends = np.cumsum([len(view.data) for view in self.views]).tolist()
        self._rows = {view.id: slice(end - len(view.data), end) for view, end in zip(self.views, ends, strict=True)}
        self.data: Final = np.concatenate([view.data for view in self.views])
        self.base_count: Final = len(law.parameter_names)

    @property
    def base_scales(self) -> FloatArray:
        """Standard deviations of normal priors about 0 of the law's parameters; infinite, where it states none."""
        return np.asarray(getattr(self.law, "scales", np.full(self.base_count, np.inf)))

    @property
    def effect_parameters(self) -> tuple[EffectParameter, ...]:
        """What is known of the causes' parameters, in the order of `parameter_names` behind the law's."""
        return tuple(parameter for cause in self.causes for parameter in cause.form.parameters)

    @property
    def bounds(self) -> tuple[FloatArray, FloatArray]:
        """Lower and upper bounds of all parameters, each of shape (n_parameters,)."""
        lower, upper = self.law.bounds
        known = self.effect_parameters
        return (
            np.append(lower, [parameter.lower for parameter in known]),
            np.append(upper, [parameter.upper for parameter in known]),
        )

    @property
    def start(self) -> FloatArray:
        """The law's start; causes absent (amplitude 0), with their first shapes; shape (n_parameters,)."""
        absent = [value for cause in self.causes for value in (0.0, *cause.form.typical[1:])]
        return np.append(self.law.start, absent)

    def parameters(self, base: FloatArray, *values: Sequence[float]) -> FloatArray:
        """All parameters in one vector, from the law's and each cause's; shape (n_parameters,).

        Raises
        ------
        InputError
            For too many or too few.
        """
        if len(values) != len(self.causes) or len(base) != self.base_count:
            expected = [", ".join(self.law.parameter_names), *(cause.label for cause in self.causes)]
            raise InputError(f"found {1 + len(values)} groups of values, expected {'; '.join(expected)}")
        checked = [cause.checked(given) for cause, given in zip(self.causes, values, strict=True)]
        return np.concatenate([base, *checked])

    def split(self, parameters: FloatArray) -> tuple[FloatArray, CauseValues]:
        """The law's parameters, and each cause with its values."""
        if len(parameters) != len(self.parameter_names):
            raise InputError(
                f"found {len(parameters)} parameters, expected {len(self.parameter_names)}: "
                + ", ".join(self.parameter_names)
            )
        first, parts = self.base_count, []
        for cause in self.causes:
            last = first + len(cause.form.parameters)
            parts.append((cause, tuple(float(value) for value in parameters[first:last])))
            first = last
        return np.asarray(parameters[: self.base_count], dtype=np.float64), tuple(parts)

    def rows(self, record_id: str) -> slice:
        """Which rows of the stacked samples belong to a record.

        Raises
        ------
        InputError
            If there is none of that id.
        """
        if record_id not in self._rows:
            raise InputError(f"found no record {record_id!r}; {suggestion(record_id, self._rows)}")
        return self._rows[record_id]

    @property
    def parts(self) -> tuple[tuple[RecordView, slice], ...]:
        """Every view with its rows among the stacked samples."""
        return tuple((view, self._rows[view.id]) for view in self.views)

    @property
    def amplitudes(self) -> tuple[int, ...]:
        """Where the causes' amplitudes stand among the parameters."""
        sizes = [len(cause.form.parameters) for cause in self.causes]
        return tuple(int(place) for place in self.base_count + np.cumsum([0, *sizes])[: len(sizes)])

    def with_causes(self, causes: Iterable[Cause]) -> CampaignModel:
        """The same law and records with other causes."""
        return CampaignModel(self.law, self.views, causes)

    def on(self, views: Iterable[RecordView]) -> CampaignModel:
        """The same law and causes on other records; causes confined to records that are left out go with them."""
        views = tuple(views)
        ids = {view.id for view in views}
        kept = [cause for cause in self.causes if cause.records is None or ids.issuperset(cause.records)]
        return CampaignModel(self.law, views, kept)

    def quietened(self, parameters: FloatArray, noises: Sequence[NoiseModel] = ()) -> CampaignModel:
        """The same model with the noise taken off the recorded stress where effects hand it back to the strain.

        What is left of a record is its prediction and the fit residual's slow part (Savitzky & Golay 1964, parabolas
        over a twenty-fifth of the record): the knees of the stress are the prediction's, the gap is kept. Where the
        noises of all records are given, in their order, the slow part is made smaller by what noise has of it (James &
        Stein 1961); what a specimen's own deviations make stays whole.
        """
        base, causes = self.split(parameters)
        predicted = [self.recorded(view, base, causes) for view in self.views]
        missing = [view.data - view.sampled(own) for view, own in zip(self.views, predicted, strict=True)]
        deviations = [np.zeros(len(each)) for each in missing]
        if noises:
            missing = [without_outliers(each, noise.outliers) for each, noise in zip(missing, noises, strict=True)]
            deviations = own_deviations(missing, noises)
        views = []
        for index, view in enumerate(self.views):
            slow = _slow_part(missing[index] - deviations[index])
            if noises:
                slow = slow * _beyond_noise(slow, noises[index])
            between = np.interp(view.time, view.sampled(view.time), deviations[index] + slow)
            views.append(view.quietened(predicted[index] + between))
        return CampaignModel(self.law, views, self.causes)

    def missing_capabilities(self, cause: Cause) -> frozenset[str]:
        """What the law would have to understand to follow a cause; empty if it can."""
        if cause.form.modification is None:
            return frozenset()
        modification = cause.form.modification(self.views[0], cause.form.typical)
        return frozenset() if modification is None else modification.changed - self.law.capabilities

    def followed(self, effects: Iterable[Effect]) -> tuple[Effect, ...]:
        """The effects with those of their forms that the law can follow; without those that have none.

        A form whose own function fails is kept: where it is tried it is listed.
        """
        kept = []
        for effect in effects:
            forms = tuple(form for form in effect.forms if self._can_follow(Cause(effect, form)))
            if forms:
                kept.append(effect if len(forms) == len(effect.forms) else replace(effect, forms=forms))
        return tuple(kept)

    def _can_follow(self, cause: Cause) -> bool:
        try:
            return not self.missing_capabilities(cause)
        except UNSOLVABLE:
            return True

    def clashes(self, cause: Cause) -> bool:
        """Whether a cause changes what a law can change once only, and one of the model's does."""
        taken = frozenset[str]().union(*(self._once(own) for own in self.causes))
        return bool(self._once(cause) & taken)

    def _once(self, cause: Cause) -> frozenset[str]:
        if cause.form.modification is None:
            return frozenset()
        modification = cause.form.modification(self.views[0], cause.form.typical)
        return frozenset() if modification is None else modification.changed & ONCE

    def log_prior(self, parameters: FloatArray) -> float:
        """Log prior density of the parameters, in their search coordinates; -inf outside the bounds of a cause's.

        Up to a constant of the law's own.
        """
        base, causes = self.split(parameters)
        law = -0.5 * float(np.sum((base / self.base_scales) ** 2))
        return law + sum(cause.log_prior(values) for cause, values in causes)

    def predict(self, parameters: FloatArray) -> dict[str, FloatArray]:
        """Recorded true stress as the model has it, by record; each of shape (n_samples,) [MPa]."""
        base, causes = self.split(parameters)
        return {view.id: view.sampled(self.recorded(view, base, causes)) for view in self.views}

    def residual(self, parameters: FloatArray) -> FloatArray:
        """Fit residual, model - data, of all records stacked; shape (n_samples,) [MPa]."""
        return np.asarray(np.concatenate(list(self.predict(parameters).values())) - self.data)

    def jacobian(self, parameters: FloatArray) -> FloatArray:
        """Derivatives of the fit residual along all parameters; shape (n_samples, n_parameters)."""
        return self.residual_and_jacobian(parameters)[1]

    def residual_and_jacobian(self, parameters: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Fit residual (n_samples,) and its derivatives (n_samples, n_parameters).

        Along the base parameters by the law's own sensitivities, along effects by difference quotients.
        """
        base, causes = self.split(parameters)
        residual = np.empty(len(self.data))
        jacobian = np.zeros((len(self.data), len(parameters)))
        for view in self.views:
            rows = self.rows(view.id)
            here = _touching(causes, view)
            specimen = self.specimen(view, base, here, sensitivity=True)
            stress = _as_recorded(view, here, specimen.stress)
            residual[rows] = view.sampled(stress) - view.data
            assert specimen.sensitivity is not None
            jacobian[rows, : self.base_count] = view.sampled(_recorded_sensitivity(view, here, specimen))
            column = self.base_count
            for index, (cause, values) in enumerate(causes):
                for position in range(len(values)):
                    if cause.touches(view.id):
                        jacobian[rows, column + position] = view.sampled(
                            self._slope(view, base, causes, index, position, specimen, stress)
                        )
                column += len(values)
        return residual, jacobian

    def contribution(self, parameters: FloatArray, cause: Cause) -> FloatArray:
        """What one of the causes adds to the recorded stress, all others staying; shape (n_samples,) [MPa]."""
        absent = parameters.copy()
        absent[self.amplitudes[self.causes.index(cause)]] = 0.0
        (base, causes), (_, others) = self.split(parameters), self.split(absent)
        added = np.zeros(len(self.data))
        for view, rows in self.parts:
            if cause.touches(view.id):
                added[rows] = view.sampled(self.recorded(view, base, causes) - self.recorded(view, base, others))
        return added

    def specimen(
        self,
        view: RecordView,
        base: FloatArray,
        causes: CauseValues,
        *,
        sensitivity: bool = False,
        settled: float = SETTLED,
        near: OwnForce | None = None,
    ) -> Specimen:
        """What the specimen did: strains as it saw them, the law as it was; before faults of the force channel.

        Where the force is the model's own, to `settled` of the largest (`own_force.ROUGHLY`): sought from what that of
        a model `near` to this one would become, or else from the recorded one.
        """
        if not any(cause.form.own_force for cause, _ in causes):
            return self._driven(view, base, causes, sensitivity)

        force = self.balance(view, base, causes, settled, near)
        if not sensitivity:
            return Specimen(force.stress, None, force)
        slopes = self._driven(_held(view, force).quietened(force.stress), base, causes, sensitivity=True).sensitivity
        assert slopes is not None
        answers = np.empty_like(slopes)  # of no column, where all of the law is held
        for column, slope in enumerate(slopes.T):
            answers[:, column] = force.answer(slope, SLOPE)
        return Specimen(force.stress, answers, force)

    def balance(
        self, view: RecordView, base: FloatArray, causes: CauseValues, settled: float, near: OwnForce | None = None
    ) -> OwnForce:
        """The force at which frame and specimen are in balance; as in `specimen`.

        Kinks of the strain stay where they are while it is sought; it is sought once more where they have moved then.
        """
        start = view.smooth_true_data
        if near is not None:  # a small change is lost within `settled` of the force, unless its first order is taken
            there = _held(view, near).quietened(near.stress)
            start = near.moved(self._driven(there, base, causes, sensitivity=False).stress)
        kinks = self._kinks(view, causes, start)
        found: OwnForce | None = None
        for _ in range(_MOVED_KINKS):
            held = view.with_kinks(kinks)

            def under(stress: FloatArray, held: RecordView = held) -> FloatArray:
                return self._driven(held.quietened(stress), base, causes, sensitivity=False).stress

            def about(stress: FloatArray, held: RecordView = held) -> Callable[[FloatArray], FloatArray]:
                return self._frame(held.quietened(stress), base, causes).answer

            try:
                force = OwnForce(under, start, about, settled)
            except ConvergenceError:
                if found is None:
                    raise
                break
            found, start = force, force.stress
            found.kinks = kinks
            kinks = self._kinks(view, causes, start)
            if kinks == found.kinks:
                break
        assert found is not None
        return found

    def _kinks(self, view: RecordView, causes: CauseValues, stress: FloatArray) -> tuple[int, ...]:
        """Jumps of the rate of what drives the law under this recorded stress (n,) [MPa]."""
        return _seen(view.quietened(stress), causes)[0].jumps

    def _driven(self, view: RecordView, base: FloatArray, causes: CauseValues, sensitivity: bool) -> Specimen:
        """The same with the force that the view has."""
        seen, conversion = _seen(view, causes)
        stress, slopes = self._solved(seen, base, _modification(seen, causes), sensitivity)
        if conversion is not None:
            factor = np.exp(conversion)
            stress = factor * stress
            slopes = None if slopes is None else factor[:, None] * slopes
        return Specimen(stress, slopes)

    def _frame(self, view: RecordView, base: FloatArray, causes: CauseValues) -> ElasticFrame:
        """About how the specimen's stress answers, with what a change of the force does to its strain."""
        seen, conversion = _seen(view, causes)
        assert view.quiet_stress is not None
        probe = _PROBE * max(float(np.max(np.abs(view.quiet_stress))), 1.0)
        moved, other = _seen(view.quietened(view.quiet_stress + probe), causes)
        give = (moved.true_strain - seen.true_strain) / probe
        change = _modification(seen, causes)

        def stress_at(step: FloatArray) -> FloatArray:
            return self.law.stress(seen.driven(seen.true_strain + step), base, change)

        growth = None
        if conversion is not None and other is not None:
            growth = view.quiet_stress * (other - conversion) / probe
        return ElasticFrame.of(seen.time, seen.true_strain, give, stress_at, conversion, growth)

    def recorded(
        self,
        view: RecordView,
        base: FloatArray,
        causes: CauseValues,
        specimen_stress: FloatArray | None = None,
    ) -> FloatArray:
        """Recorded true stress as the model has it, at the view's instants; shape (n,) [MPa].

        With `specimen_stress`, of the same base and causes but for their force channel, nothing is solved.
        """
        here = _touching(causes, view)
        if specimen_stress is None:
            specimen_stress = self.specimen(view, base, here).stress
        return _as_recorded(view, here, specimen_stress)

    def moved(self, view: RecordView, to: RecordView, parameters: FloatArray) -> FloatArray:
        """Change of the recorded stress from a view to one that is nearly the same; (n_samples,) [MPa]."""
        base, causes = self.split(parameters)
        here = _touching(causes, view)
        specimen = self.specimen(view, base, here)
        other = self.specimen(to, base, here, near=specimen.own_force)
        return view.sampled(_as_recorded(to, here, other.stress) - _as_recorded(view, here, specimen.stress))

    def at_rest(self, view: RecordView, base: FloatArray, causes: CauseValues) -> tuple[Specimen, FloatArray]:
        """The specimen by the model as it is, and the recorded stress, (n,) [MPa]: where `with_one_more` begins."""
        specimen = self.specimen(view, base, _touching(causes, view))
        return specimen, self.recorded(view, base, causes, specimen.stress)

    def with_one_more(
        self,
        view: RecordView,
        base: FloatArray,
        causes: CauseValues,
        cause: Cause,
        values: tuple[float, ...],
        specimen: Specimen,
    ) -> FloatArray:
        """Recorded stress (n,) [MPa] with one more cause, before it is refitted; `specimen` is that without it."""
        here = _touching((*causes, (cause, values)), view)
        stress = specimen.stress
        if cause.form.needs_solve:
            stress = self.specimen(view, base, here, settled=ROUGHLY, near=specimen.own_force).stress
        return _as_recorded(view, here, stress)

    def _solved(
        self, seen: RecordView, base: FloatArray, modification: Modification | None, sensitivity: bool
    ) -> tuple[FloatArray, FloatArray | None]:
        if sensitivity:
            return self.law.sensitivity(seen, base, modification)
        return self.law.stress(seen, base, modification), None

    def _slope(
        self,
        view: RecordView,
        base: FloatArray,
        causes: CauseValues,
        index: int,
        position: int,
        specimen: Specimen,
        stress: FloatArray,
    ) -> FloatArray:
        """Derivative of the recorded stress along one parameter of one cause; shape (n,)."""
        cause, values = causes[index]
        parameter, value = cause.form.parameters[position], values[position]

        def changed(value: float) -> CauseValues:
            moved = (*values[:position], value, *values[position + 1 :])
            return (*causes[:index], (cause, moved), *causes[index + 1 :])

        def recorded(value: float) -> FloatArray:
            return self.recorded(view, base, changed(value), None if cause.form.needs_solve else specimen.stress)

        own = specimen.own_force
        if own is None or not cause.form.needs_solve:
            return _difference(recorded, stress, value, parameter)

        def with_this_force(value: float) -> FloatArray:
            here = _touching(changed(value), view)
            return self._driven(_held(view, own).quietened(specimen.stress), base, here, False).stress

        answer = own.answer(_difference(with_this_force, specimen.stress, value, parameter), SLOPE)

        def linear(other: float) -> FloatArray:
            return self.recorded(view, base, changed(other), specimen.stress + (other - value) * answer)

        return _difference(linear, stress, value, parameter)


def _difference(
    at: Callable[[float], FloatArray], here: FloatArray, value: float, parameter: EffectParameter
) -> FloatArray:
    """Derivative at a value where it is `here`: a forward difference, a backward one at the upper bound.

    A central one costs twice as much; it is taken where the step is the sampling's, since there the answer has corners.
    """
    step = parameter.step(value)
    ends = value + step > parameter.upper
    if not parameter.resolution:
        step *= _ONE_SIDED
    elif not ends and value - step >= parameter.lower:
        return (at(value + step) - at(value - step)) / (2.0 * step)
    step = -step if ends else step
    return (at(value + step) - here) / step


def _slow_part(residual: FloatArray) -> FloatArray:
    """Along axis 0, by parabolas over a window of samples; all of a record that is too short for one."""
    window = 2 * (len(residual) // NOISE.quieting_window) + 1
    return moving_parabola(residual, window) if window > _PARABOLA else residual


def _beyond_noise(slow: FloatArray, noise: NoiseModel) -> float:
    """How much of a residual's slow part to keep, 0 to 1: what is larger than that of every draw of the noise."""
    draws = _slow_part(noise.alike.drifting.simulate(np.random.default_rng(0), NOISE.quieting_draws).T)
    of_noise = float(np.max(noise.weight @ draws**2))
    return max(1.0 - of_noise / max(float(noise.weight @ slow**2), 1e-300), 0.0)


def _held(view: RecordView, force: OwnForce) -> RecordView:
    """The view with the kinks with which the force was sought: with others it would not be in balance."""
    return view if force.kinks is None else view.with_kinks(force.kinks)


def _seen(view: RecordView, causes: CauseValues) -> tuple[RecordView, FloatArray | None]:
    """The record as the specimen saw it, and the true strain by which its stress was converted too far (n,) [-]."""
    seen, conversion = view, None
    for cause, values in causes:
        if cause.form.driving_strain is None:
            continue
        strain = cause.form.driving_strain(seen, values)
        if cause.form.converts:
            conversion = (0.0 if conversion is None else conversion) + seen.true_strain - strain
        seen = seen.driven(strain)
    return seen, conversion


def _modification(seen: RecordView, causes: CauseValues) -> Modification | None:
    """What the causes change in the law."""
    modification = None
    for cause, values in causes:
        if cause.form.modification is not None and (change := cause.form.modification(seen, values)) is not None:
            modification = change if modification is None else modification.and_(change)
    return modification


def _touching(causes: CauseValues, view: RecordView) -> CauseValues:
    return tuple(pair for pair in causes if pair[0].touches(view.id))


def _as_recorded(view: RecordView, causes: CauseValues, stress: FloatArray) -> FloatArray:
    """What the force channel made of the stress, shape (n,) [MPa]."""
    for cause, values in causes:
        if cause.form.recorded_stress is not None:
            stress = cause.form.recorded_stress(view, values, stress)
    return stress


def _recorded_sensitivity(view: RecordView, causes: CauseValues, specimen: Specimen) -> FloatArray:
    """Sensitivities through the force channel, shape (n, n_base)."""
    slopes = specimen.sensitivity
    assert slopes is not None
    if all(cause.form.recorded_stress is None for cause, _ in causes):
        return slopes
    recorded = np.empty_like(slopes)
    for k, slope in enumerate(slopes.T):
        step = _PROBE / max(float(np.max(np.abs(slope))), 1e-300)
        up = _as_recorded(view, causes, specimen.stress + step * slope)
        down = _as_recorded(view, causes, specimen.stress - step * slope)
        recorded[:, k] = (up - down) / (2.0 * step)
    return recorded
