"""A relation's parameters identified on all records at once, through the law with alpha held at 1.

The way for records whose rate is not constant, where a tau_max of one record alone belongs to no rate; and a check of
the other way where it is.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Literal

import numpy as np

from probation import _core
from probation._arrays import FloatArray
from probation.calibration.calibrated import CalibratedCompanion, seen_rates
from probation.errors import InputError
from probation.identify.covariance import covariance
from probation.identify.variable_projection import search, time_bounds
from probation.inference.least_squares import Bounds, minimise
from probation.inference.measured_view import measured_view
from probation.inference.modal_law import DnlrLaw
from probation.inference.problem import Problem
from probation.law.direction import Direction
from probation.law.modal import Law
from probation.law.schemes import as_scheme, make_solver
from probation.law.spectrum import spectrum_of
from probation.records.record import Noise
from probation.settings.companion import COMPANION
from probation.smoothing.excitation import excite_each

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation.calibration.companion_forms import Form
    from probation.effects.record_view import RecordView
    from probation.law.companion import Companion
    from probation.law.schemes import Scheme, SchemeName
    from probation.law.settings import LawSettings
    from probation.records.record import Record
    from probation.smoothing.excitation import Excitation

Hardening = Literal["by-record", "shared"]
HARDENINGS: tuple[Hardening, ...] = ("by-record", "shared")

FINE, MOST_STEPS = 1e-6, 40
"""Step [standard errors] at which the search for a relation ends, and the most steps that it takes."""

LONGEST_STEP = 2.0
"""Largest change of ln tau_max in one step."""


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


class DirectProblem:
    """All records, ready to be solved for again and again.

    Each is weighted by what scatters it around the law with a constant tau_max, E_u and G of its own: its noise and
    what the law leaves out, the same for every form.

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

    def __init__(
        self,
        records: Sequence[Record],
        settings: LawSettings,
        scheme: Scheme | SchemeName,
        hardening: Hardening,
        excitations: Sequence[Excitation] | None = None,
        own_rms: Sequence[float] | None = None,
    ) -> None:
        self.settings, self.scheme, self.hardening = settings, scheme, hardening
        self._solvers: dict[RecordView, _core.Solver] = {}
        driven = list(excite_each(records)) if excitations is None else excitations
        self.views = [
            measured_view(record, excitation, scheme) for record, excitation in zip(records, driven, strict=True)
        ]
        if own_rms is None:
            own_rms = [_own_rms(view, settings) for view in self.views]
        self.weights = np.array(
            [1.0 / max(view.stress_noise, own) for view, own in zip(self.views, own_rms, strict=True)]
        )
        self.held_modulus = settings.fixed.get("unrelaxed_modulus_MPa")
        self.held_hardening = settings.fixed.get("hardening_modulus_MPa")

    def only(self, kept: Sequence[int]) -> DirectProblem:
        """The same problem on some of the records."""
        part = DirectProblem([], self.settings, self.scheme, self.hardening)
        part.views, part._solvers = [self.views[at] for at in kept], self._solvers
        part.weights = self.weights[list(kept)]
        return part

    def thinned(self) -> DirectProblem:
        """The same on at most about `enough_samples` of each record: for searches, and where noise does not matter."""
        if all(len(view) <= COMPANION.enough_samples for view in self.views):
            return self
        part = self.only(range(len(self.views)))
        part.views = [thinned(view, COMPANION.enough_samples) for view in self.views]
        return part

    @property
    def moduli(self) -> int:
        """How many hardening moduli are identified."""
        if self.held_hardening is not None:
            return 0
        return 1 if self.hardening == "shared" else len(self.views)

    def time_bounds(self) -> tuple[float, float]:
        """Relaxation times worth searching [s]."""
        steps = min(float(np.min(np.diff(view.time))) for view in self.views)
        longest = max(float(np.ptp(view.time)) for view in self.views)
        low, high = COMPANION.searched_times
        return low * steps, high * longest

    def law(self, relation: Companion, modulus: float, hardening: float) -> Law:
        """The law with alpha = 1."""
        return Law(
            unrelaxed_modulus=modulus,
            hardening_modulus=hardening,
            alpha=1.0,
            companion=relation,
            decades=self.settings.decades,
            spectrum=spectrum_of(self.settings.modes, self.settings.decades, self.settings.accuracy),
        )

    def seen(self, at: int, floor: float) -> FloatArray:
        """Rates that the relation is asked for along one record, shape (n_times,) [1/s]."""
        view = self.views[at]
        return seen_rates(view.history, as_scheme(view.scheme).name, floor, view.direction)

    def solver(self, at: int) -> _core.Solver:
        """Of one record, made once: it keeps its arrays between calls."""
        view = self.views[at]
        if view not in self._solvers:
            self._solvers[view] = make_solver(view.history, view.scheme)
        return self._solvers[view]

    def linear(self, at: int, form: Form, relation: Companion) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Unit solves of one record, u (of E_u) and v (of G), and its derivatives of ln tau_max for each.

        Returns
        -------
        unit : ndarray, shape (n_times, 2)
            The stress is E_u u + G v.
        time_slopes : ndarray, shape (n_times, 2, p)
            Of u and v along the parameters of the form.
        rates : ndarray, shape (n_times,)
        """
        rates, solver = self.seen(at, relation.rate_floor), self.solver(at)
        gradient = form.log_gradient(relation, rates)
        count = len(rates)
        directions = [Direction(log_relaxation_time=column)._engine() for column in gradient.T]
        unit, slopes = np.empty((count, 2)), np.empty((count, 2, gradient.shape[1]))
        for which, (modulus, hardening) in enumerate(((1.0, 0.0), (0.0, 1.0))):
            stress, derivative = np.empty(count), np.empty((count, gradient.shape[1]))
            law = self.law(relation, modulus, hardening)
            solver.tangent(law.engine, _core.LawChange(), directions, stress, derivative)
            unit[:, which], slopes[:, which] = stress, derivative
        return unit, slopes, rates

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
        found: tuple[float, FloatArray] | None = None
        for values in start:
            try:
                trial = _Search(self, form, calibrated, values)
                ended = trial.run() if len(start) > 1 else values
            except InputError:
                continue
            cost = trial.cost(ended)
            if found is None or cost < found[0]:
                found = cost, ended
        if found is None:
            raise InputError(f"companion {form.name}: found no positive relaxation time at every rate of the records")
        last = _Search(self, form, calibrated, found[1])
        return last.describe(last.run() if len(start) == 1 else found[1])


class _Search:
    """The nonlinear search over the form's parameters alone; E_u and G are linear and follow (variable projection).

    What is searched over is ln tau_max at the ends of the range of rates (in its middle, for one parameter): hardly
    correlated, and positive between the ends whatever is tried.
    """

    def __init__(self, problem: DirectProblem, form: Form, calibrated: tuple[float, float], start: FloatArray) -> None:
        self.problem, self.form, self.calibrated = problem, form, calibrated
        low, high = calibrated
        self.anchors = np.array([low, high] if len(start) == 2 and high > 1.01 * low else [np.sqrt(low * high)])
        self.start = np.log(self.relation_at(start).relaxation_time(self.anchors))  # raises where it cannot be
        self._cache: dict[bytes, tuple[FloatArray, FloatArray, FloatArray]] = {}

    def parameters(self, log_times: FloatArray) -> FloatArray:
        """The form's parameters from ln tau_max at the anchors."""
        return self.form.start(self.anchors, np.exp(np.clip(log_times, -200.0, 200.0)))

    def relation_at(self, values: FloatArray) -> Companion:
        relation = self.form.relation(values, np.empty(0), self.calibrated)
        for at in range(len(self.problem.views)):
            relation.relaxation_time(self.problem.seen(at, relation.rate_floor))
        return relation

    def run(self) -> FloatArray:
        low, high = np.log(self.problem.time_bounds())
        count = len(self.start)
        found = minimise(
            self,
            self.start,
            bounds=Bounds(np.full(count, low), np.full(count, high)),
            tolerance=FINE,
            longest_step=LONGEST_STEP,
            most_steps=MOST_STEPS,
        )
        return self.parameters(found.x)

    def residual(self, log_times: FloatArray) -> FloatArray:
        """Weighted fit residual with the best moduli at ln tau_max of the anchors, shape (n_samples,)."""
        return self._state(self.parameters(log_times))[0]

    def tangent(self, log_times: FloatArray) -> tuple[FloatArray, FloatArray]:
        """The same, and its derivatives along ln tau_max of the anchors, shape (n_samples, n_anchors)."""
        values = self.parameters(log_times)
        return self._state(values)[0], self._projected(values)

    def _state(self, values: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Weighted residual, linear parameters (E_u, G's), and the Jacobian along (E_u, G's, form's parameters)."""
        key = values.tobytes()
        if key not in self._cache:
            self._cache = {key: self._solved(self.relation_at(values))}
        return self._cache[key]

    def _solved(self, relation: Companion) -> tuple[FloatArray, FloatArray, FloatArray]:
        problem = self.problem
        parts = [problem.linear(at, self.form, relation) for at in range(len(problem.views))]
        shared = problem.hardening == "shared" or problem.held_hardening is not None
        columns = 1 + (1 if shared else len(parts))
        rows, data, places = [], [], []
        for at, ((unit, _, _), weight) in enumerate(zip(parts, problem.weights, strict=True)):
            block = np.zeros((len(unit), columns))
            block[:, 0] = weight * unit[:, 0]
            place = 1 if shared else 1 + at
            block[:, place] = weight * unit[:, 1]
            rows.append(block)
            places.append(place)
            data.append(weight * problem.views[at].data)
        design, target = np.concatenate(rows), np.concatenate(data)
        linear, held = np.zeros(columns), np.zeros(columns, dtype=bool)
        if problem.held_modulus is not None:
            linear[0], held[0] = problem.held_modulus, True
        if problem.held_hardening is not None:
            linear[1], held[1] = problem.held_hardening, True
        free = design[:, ~held]
        linear[~held] = np.linalg.lstsq(free, target - design[:, held] @ linear[held], rcond=None)[0]
        residual = design @ linear - target
        slopes = np.concatenate(
            [
                weight * (linear[0] * slope[:, 0] + linear[place] * slope[:, 1])
                for (_, slope, _), weight, place in zip(parts, problem.weights, places, strict=True)
            ]
        )
        return residual, linear, np.column_stack([design, slopes])

    def _free(self) -> FloatArray:
        """Which columns of the Jacobian are identified."""
        shared = self.problem.hardening == "shared" or self.problem.held_hardening is not None
        columns = 1 + (1 if shared else len(self.problem.views))
        free = np.ones(columns + len(self.anchors), dtype=bool)
        free[0] = self.problem.held_modulus is None
        if self.problem.held_hardening is not None:
            free[1] = False
        return free

    def _projected(self, values: FloatArray) -> FloatArray:
        """Jacobian of the projected residual (Kaufman 1975): slopes, less what E_u and G take up."""
        _, linear, jacobian = self._state(values)
        design = jacobian[:, : len(linear)][:, self._free()[: len(linear)]]
        slopes = jacobian[:, len(linear) :]
        basis = np.linalg.qr(design)[0]
        inward = np.linalg.inv(self.form.log_gradient(self.relation_at(values), self.anchors))
        return np.asarray((slopes - basis @ (basis.T @ slopes)) @ inward)

    def cost(self, values: FloatArray) -> float:
        """Weighted sum of squares."""
        return float(np.sum(self._state(values)[0] ** 2))

    def rms(self, values: FloatArray) -> FloatArray:
        """Of the fit residual of each record, shape (n_records,) [MPa]."""
        residual = self._state(values)[0]
        lengths = np.cumsum([len(view) for view in self.problem.views])[:-1]
        parts = np.split(residual, lengths)
        return np.array([np.sqrt(np.mean(part**2)) / w for part, w in zip(parts, self.problem.weights, strict=True)])

    def describe(self, values: FloatArray) -> DirectFit:
        problem = self.problem
        residual, linear, jacobian = self._state(values)
        relation = self.relation_at(values)
        free, everything = self._free(), np.concatenate([linear, values])
        lengths = [len(view) for view in problem.views]
        with np.errstate(over="ignore", invalid="ignore"):  # forms that do not fit may determine nothing
            known = covariance(jacobian[:, free], residual, lengths, everything[free])
        # In the order of the form's parameters, then E_u.
        order = [*range(len(linear), len(everything)), 0]
        place = np.cumsum(free) - 1
        matrix = np.zeros((len(order), len(order)))
        for a, one in enumerate(order):
            for b, other in enumerate(order):
                if free[one] and free[other]:
                    matrix[a, b] = known.matrix[place[one], place[other]]
        hardening = np.broadcast_to(linear[1:], (len(problem.views),)).copy()
        return DirectFit(
            CalibratedCompanion(relation, matrix, 0.0, float(linear[0]), self.form),
            hardening,
            float(linear[0]),
            float(np.sqrt(max(matrix[-1, -1], 0.0))),
            self.rms(values),
            known.correlated,
        )


def _own_rms(view: RecordView, settings: LawSettings) -> float:
    """Rms of one record's own fit, constant tau_max, E_u and G free [MPa]."""
    law = Law(
        unrelaxed_modulus=1.0,
        hardening_modulus=1.0,
        tau_max=1.0,
        decades=settings.decades,
        spectrum=spectrum_of(settings.modes, settings.decades, settings.accuracy),
    )
    alone = Problem.white(DnlrLaw(law), [thinned(view, COMPANION.enough_samples)])
    best = search(alone, time_bounds(alone))
    return float(np.sqrt(np.mean(alone.model.residual(best) ** 2)))


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
