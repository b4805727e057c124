"""A relation's parameters identified on all records at once, through the law with alpha held at 1.

The way for records whose rate is not constant, where a tau_max of one record alone belongs to no rate; and a check of
the other way where it is.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Literal

import numpy as np

from probation._arrays import FloatArray
from probation.calibration.calibrated import CalibratedCompanion, seen_rates
from probation.errors import InputError
from probation.identify.base_law import base_law
from probation.identify.covariance import covariance
from probation.identify.variable_projection import search, time_bounds
from probation.inference.least_squares import Bounds, minimise
from probation.inference.measured_view import measured_view
from probation.inference.modal_law import DnlrLaw, solver_of
from probation.inference.problem import Problem
from probation.law.direction import Direction
from probation.law.modified import UNCHANGED
from probation.law.schemes import as_scheme
from probation.records.record import Noise
from probation.settings.companion import COMPANION
from probation.smoothing.excitation import excite_each

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from probation.calibration.companion_forms import Form
    from probation.effects.record_view import RecordView
    from probation.law.companion import Companion
    from probation.law.modal import Law
    from probation.law.schemes import Scheme, SchemeName
    from probation.law.settings import LawSettings
    from probation.records.record import Record
    from probation.smoothing.excitation import Excitation

Hardening = Literal["by-record", "shared"]
HARDENINGS: tuple[Hardening, ...] = ("by-record", "shared")

FINAL_STEP, MOST_SEARCH_STEPS = 1e-6, 40
"""Step [standard errors] at which the search for a relation ends, and the most steps that it takes."""

LONGEST_STEP = 2.0
"""Largest change of ln tau_max in one step."""

_HELD = ("unrelaxed_modulus_MPa", "hardening_modulus_MPa")
"""What a campaign may hold here: the relation takes the place of tau_max and alpha."""


@dataclass(frozen=True, eq=False)
class DirectFit:
    """A relation identified through the law.

    Attributes
    ----------
    hardening_modulus : ndarray, shape (n_records,) [MPa]
        All alike where it is shared.
    unrelaxed_modulus : float [MPa]
    unrelaxed_modulus_se : float [MPa]
        0 where it is held.
    rms : ndarray, shape (n_records,) [MPa]
        Of the fit residual.
    correlated : bool
        Whether the fit residual is autocorrelated, which the covariance includes.
    """

    companion: CalibratedCompanion
    hardening_modulus: FloatArray
    unrelaxed_modulus: float
    unrelaxed_modulus_se: float
    rms: FloatArray
    correlated: bool


@dataclass(frozen=True, eq=False)
class DirectRoute:
    """A problem whose law's tau_max a relation replaces: its parameters, E_u and every G are searched at once.

    Attributes
    ----------
    problem : Problem
        The law with a constant tau_max and what is held in it; the records; and what scatters each around that law
        with a tau_max, E_u and G of its own: its noise and what the law leaves out, the same for every form.
    hardening : {"by-record", "shared"}
    """

    problem: Problem
    hardening: Hardening

    @classmethod
    def of(
        cls,
        records: Sequence[Record],
        settings: LawSettings,
        scheme: Scheme | SchemeName,
        hardening: Hardening,
        excitations: Sequence[Excitation] | None = None,
        own_rms: Sequence[float] | None = None,
    ) -> DirectRoute:
        """The direct route on records.

        Parameters
        ----------
        records : sequence of Record
        settings : LawSettings
            Spectrum, and what is held; its companion relation is not used.
        scheme : {"be2", "sa2", "sa3"}
        hardening : {"by-record", "shared"}
        excitations : sequence of Excitation, optional
            What drives the law along each record, where that is known already.
        own_rms : sequence of float, optional
            Rms of each record's own fit [MPa], where it is known already.
        """
        kept = {name: value for name, value in settings.fixed.items() if name in _HELD}
        law, held = base_law(replace(settings, companion=None, fixed=kept), {})
        driven = list(excite_each(records)) if excitations is None else excitations
        views = [measured_view(record, excitation, scheme) for record, excitation in zip(records, driven, strict=True)]
        if own_rms is None:
            levels = [_own_level(view, law) for view in views]
        else:
            levels = [max(view.stress_noise, own) for view, own in zip(views, own_rms, strict=True)]
        return cls(Problem.white(DnlrLaw(law, held), views, levels), hardening)

    def only(self, kept: Sequence[int]) -> DirectRoute:
        """The same on some of the records."""
        return replace(self, problem=self.problem.only(kept))

    def thinned(self) -> DirectRoute:
        """The same on at most about `enough_samples` of each record: for searches, and where noise does not matter."""
        whole = self.problem
        views = [thinned(view, COMPANION.enough_samples) for view in whole.views]
        if all(new is old for new, old in zip(views, whole.views, strict=True)):
            return self
        return replace(self, problem=Problem.white(whole.law, views, [noise.sigma for noise in whole.whitener.noises]))

    @property
    def views(self) -> tuple[RecordView, ...]:
        """The records."""
        return self.problem.views

    def held(self, name: str) -> float | None:
        """The value of a parameter that is held; None of one that is not."""
        law = self.problem.engine_law()
        return float(getattr(law.law, name)) if name in law.held else None

    @property
    def shared_hardening(self) -> bool:
        """Whether one G is that of all records."""
        return self.hardening == "shared" or self.held("hardening_modulus") is not None

    def time_bounds(self) -> tuple[float, float]:
        """Relaxation times worth searching [s]."""
        steps = min(float(np.min(np.diff(view.time))) for view in self.views)
        longest = max(float(np.ptp(view.time)) for view in self.views)
        low, high = COMPANION.searched_times
        return low * steps, high * longest

    def law(self, relation: Companion, modulus: float, hardening: float) -> Law:
        """The law with alpha = 1."""
        return replace(
            self.problem.engine_law().law,
            unrelaxed_modulus=modulus,
            hardening_modulus=hardening,
            tau_max=None,
            alpha=1.0,
            companion=relation,
        )

    def unit_solves(self, view: RecordView, form: Form, relation: Companion) -> tuple[FloatArray, FloatArray]:
        """Unit solves of one record, u (of E_u) and v (of G), and their derivatives along the form's parameters.

        Returns
        -------
        unit : ndarray, shape (n_times, 2)
            The stress is E_u u + G v.
        slopes : ndarray, shape (n_times, 2, p)
        """
        gradient = form.log_gradient(relation, seen(view, relation.rate_floor))
        directions = [Direction(log_relaxation_time=column)._engine() for column in gradient.T]
        count = len(view)
        unit, slopes = np.empty((count, 2)), np.empty((count, 2, gradient.shape[1]))
        for which, (modulus, hardening) in enumerate(((1.0, 0.0), (0.0, 1.0))):
            stress, derivative = np.empty(count), np.empty((count, gradient.shape[1]))
            law = self.law(relation, modulus, hardening)
            solver_of(view).tangent(law.engine, UNCHANGED, directions, stress, derivative)
            unit[:, which], slopes[:, which] = stress, derivative
        return unit, slopes

    def fit(self, form: Form, start: Sequence[FloatArray], calibrated: tuple[float, float]) -> DirectFit:
        """The best relation of one form.

        Parameters
        ----------
        form : Form
        start : sequence of ndarray, shape (p,)
            Where the search begins; the best end is taken.
        calibrated : (float, float) [1/s]
            Rates that the records cover.

        Raises
        ------
        InputError
            If no start gives a positive relaxation time on every record.
        """
        best: tuple[float, FloatArray] | None = None
        for values in start:
            try:
                trial = _Search(self, form, calibrated, values)
                ended = trial.run() if len(start) > 1 else values
            except InputError:
                continue
            cost = trial.cost(ended)
            if best is None or cost < best[0]:
                best = cost, ended
        if best is None:
            raise InputError(f"companion {form.name}: found no positive relaxation time at every rate of the records")
        last = _Search(self, form, calibrated, best[1])
        return last.describe(last.run() if len(start) == 1 else best[1])


class _Search:
    """The nonlinear search over the form's parameters alone; E_u and G are linear and follow (variable projection).

    What is searched over is ln tau_max at the ends of the range of rates (in its middle, for one parameter): hardly
    correlated, and positive between the ends whatever is tried.
    """

    def __init__(self, route: DirectRoute, form: Form, calibrated: tuple[float, float], start: FloatArray) -> None:
        self.route, self.form, self.calibrated = route, form, calibrated
        low, high = calibrated
        self.anchors = np.array([low, high] if len(start) == 2 and high > 1.01 * low else [np.sqrt(low * high)])
        self.start = np.log(self.relation_at(start).relaxation_time(self.anchors))  # raises where it cannot be
        self._cache: dict[bytes, _State] = {}

    def parameters(self, log_times: FloatArray) -> FloatArray:
        """The form's parameters from ln tau_max at the anchors."""
        return self.form.start(self.anchors, np.exp(np.clip(log_times, -200.0, 200.0)))

    def relation_at(self, values: FloatArray) -> Companion:
        relation = self.form.relation(values, np.empty(0), self.calibrated)
        for view in self.route.views:
            relation.relaxation_time(seen(view, relation.rate_floor))
        return relation

    def run(self) -> FloatArray:
        low, high = np.log(self.route.time_bounds())
        count = len(self.start)
        minimum = minimise(
            self,
            self.start,
            bounds=Bounds(np.full(count, low), np.full(count, high)),
            tolerance=FINAL_STEP,
            longest_step=LONGEST_STEP,
            most_steps=MOST_SEARCH_STEPS,
        )
        return self.parameters(minimum.x)

    def residual(self, log_times: FloatArray) -> FloatArray:
        """Weighted fit residual with the best moduli at ln tau_max of the anchors, shape (n_samples,)."""
        return self._state(self.parameters(log_times)).white

    def tangent(self, log_times: FloatArray) -> tuple[FloatArray, FloatArray]:
        """The same, and its derivatives along ln tau_max of the anchors, shape (n_samples, n_anchors)."""
        values = self.parameters(log_times)
        return self._state(values).white, self._projected(values)

    def _state(self, values: FloatArray) -> _State:
        key = values.tobytes()
        if key not in self._cache:
            self._cache = {key: self._solved(self.relation_at(values))}
        return self._cache[key]

    def _solved(self, relation: Companion) -> _State:
        route, problem = self.route, self.route.problem
        values = [route.held("unrelaxed_modulus")]
        values += [route.held("hardening_modulus")] * (1 if route.shared_hardening else len(route.views))
        held = np.array([value is not None for value in values])
        linear = np.array([value or 0.0 for value in values])
        data = problem.model.data
        design, along = np.zeros((len(data), len(linear))), []
        for at, (view, rows) in enumerate(problem.model.parts):
            place = 1 if route.shared_hardening else 1 + at
            unit, slopes = route.unit_solves(view, self.form, relation)
            design[rows, 0], design[rows, place] = unit.T
            along.append((place, slopes))
        columns = problem.whitener.columns(design)
        target = problem.whitener.residual(data) - columns[:, held] @ linear[held]
        linear[~held] = np.linalg.lstsq(columns[:, ~held], target, rcond=None)[0]
        moved = np.concatenate([linear[0] * slopes[:, 0] + linear[place] * slopes[:, 1] for place, slopes in along])
        residual = design @ linear - data
        jacobian = np.column_stack([columns, problem.whitener.columns(moved)])
        free = np.append(~held, np.ones(moved.shape[1], dtype=bool))
        return _State(residual, problem.whitener.residual(residual), linear, jacobian, free)

    def _projected(self, values: FloatArray) -> FloatArray:
        """Jacobian of the projected residual (Kaufman 1975): slopes, less what E_u and G take up."""
        state = self._state(values)
        count = len(state.linear)
        basis = np.linalg.qr(state.jacobian[:, :count][:, state.free[:count]])[0]
        slopes = state.jacobian[:, count:]
        inward = np.linalg.inv(self.form.log_gradient(self.relation_at(values), self.anchors))
        return np.asarray((slopes - basis @ (basis.T @ slopes)) @ inward)

    def cost(self, values: FloatArray) -> float:
        """Weighted sum of squares."""
        return float(np.sum(self._state(values).white ** 2))

    def describe(self, values: FloatArray) -> DirectFit:
        problem, state = self.route.problem, self._state(values)
        linear, free = state.linear, state.free
        everything = np.concatenate([linear, values])
        with np.errstate(over="ignore", invalid="ignore"):  # forms that do not fit may determine nothing
            known = covariance(state.jacobian[:, free], state.white, problem.lengths, everything[free])
        # In the order of the form's parameters, then E_u.
        order = [*range(len(linear), len(everything)), 0]
        place = np.cumsum(free) - 1
        matrix = np.zeros((len(order), len(order)))
        for a, one in enumerate(order):
            for b, other in enumerate(order):
                if free[one] and free[other]:
                    matrix[a, b] = known.matrix[place[one], place[other]]
        return DirectFit(
            CalibratedCompanion(self.relation_at(values), matrix, 0.0, float(linear[0]), self.form),
            np.broadcast_to(linear[1:], (len(problem.views),)).copy(),
            float(linear[0]),
            float(np.sqrt(max(matrix[-1, -1], 0.0))),
            np.array([np.sqrt(np.mean(state.residual[rows] ** 2)) for _, rows in problem.model.parts]),
            known.correlated,
        )


@dataclass(frozen=True, eq=False)
class _State:
    """What the search knows of one relation.

    Attributes
    ----------
    residual : ndarray, shape (n_samples,) [MPa]
        Of the fit with the best moduli.
    white : ndarray, shape (n_samples,) [-]
        The same in white coordinates.
    linear : ndarray, shape (n_linear,) [MPa]
        E_u, then the G's.
    jacobian : ndarray, shape (n_samples, n_linear + p)
        White, along E_u, the G's and the form's parameters.
    free : ndarray of bool, shape (n_linear + p,)
        Which of them are identified.
    """

    residual: FloatArray
    white: FloatArray
    linear: FloatArray
    jacobian: FloatArray
    free: NDArray[np.bool_]


def seen(view: RecordView, floor: float) -> FloatArray:
    """Rates that the relation is asked for along one record, shape (n_times,) [1/s]."""
    return seen_rates(view.history, as_scheme(view.scheme).name, floor, view.direction)


def _own_level(view: RecordView, law: Law) -> float:
    """What scatters a record around its own fit, constant tau_max, E_u and G free [MPa]."""
    alone = Problem.white(DnlrLaw(law), [thinned(view, COMPANION.enough_samples)])
    (noise,) = alone.reweighed(search(alone, time_bounds(alone))).whitener.noises
    return noise.sigma


def thinned(view: RecordView, count: int) -> RecordView:
    """A record and its excitation at every n-th sample, its jumps and its end kept."""
    whole, drive = view.record, view.excitation
    stride = -(-len(whole) // count)
    if stride == 1:
        return view
    kept = np.unique([*range(0, len(whole), stride), *drive.jumps, len(whole) - 1])
    record = replace(
        whole,
        time=whole.time[kept],
        true_strain=whole.true_strain[kept],
        true_stress=whole.true_stress[kept],
        strain_rate=None if whole.strain_rate is None else whole.strain_rate[kept],
        transverse_strain=None,
        temperature=None,
        noise=Noise(view.stress_noise, whole.noise.strain),
    )
    excitation = replace(
        drive,
        time=drive.time[kept],
        true_strain=drive.true_strain[kept],
        strain_rate=None if drive.strain_rate is None else drive.strain_rate[kept],
        jumps=tuple(np.searchsorted(kept, drive.jumps).tolist()),
        direction=drive.direction[kept[:-1]],
    )
    return measured_view(record, excitation, view.scheme)
