"""A free function of one variable in addition to the law, judged on records left out.

docs/diagnosis-method.md, section 12.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

import numpy as np
from scipy.interpolate import BSpline

from probation.diagnosis.variables import every_phase, every_variable, least_below
from probation.inference.model import CampaignModel
from probation.noise.own_deviations import specimen_columns
from probation.records.noise import noise_level
from probation.settings.remainder import REMAINDER

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from numpy.typing import NDArray

    from probation._arrays import FloatArray
    from probation.diagnosis.variables import Variable
    from probation.effects.record_view import RecordView
    from probation.inference.base_fit import BaseFit
    from probation.inference.refit import Refit
    from probation.noise.model import NoiseModel

Acts = Literal["added", "factor"]

POINTS = 300
"""Samples and points of the function that are kept for the figure."""

SMALLEST_STRESS = 0.05
"""Stress of which the figure still draws parts, over the largest."""


@dataclass(frozen=True)
class Dependence:
    """The remainder as a function of one variable.

    Attributes
    ----------
    variable : str
        "strain", "strain_rate", "time", "temperature", "largest_strain", "strain_below_largest", "specimen", "order"
        or "loading_or_unloading".
    title : str
        For people.
    when : str or None
        Phase of the test in which it acts, a key of `variables.PHASES`; None: always.
    acts : {"added", "factor"}
        Whether the function is a stress, or a factor of the predicted stress less 1.
    explained : float
        Part of the remainder's mean square, the noise set apart, that it predicts where it was not fitted.
    judged_on : {"records", "parts"}
        What was left out: whole records, or contiguous parts.
    """

    variable: str
    title: str
    when: str | None
    acts: Acts
    explained: float
    judged_on: Literal["records", "parts"]

    def to_dict(self) -> dict[str, Any]:
        """As in `remainder` of docs/formats.md."""
        return {
            "variable": self.variable,
            "when": self.when,
            "acts": self.acts,
            "explained": self.explained,
            "judged_on": self.judged_on,
        }


@dataclass(frozen=True, eq=False)
class RemainderCurve:
    """The remainder against the variable that it depends on most.

    Attributes
    ----------
    label, unit : str
        Of the variable's axis, with its unit; "MPa" or "%" of the predicted stress.
    x, y : ndarray, shape (n,)
        Measured less predicted at some samples, what refitted parameters follow taken off.
    inside, unloading : ndarray of bool, shape (n,)
        Samples of the phase in which the function acts, and those where the strain falls.
    function_x, function_y : ndarray, shape (m,)
        The function, without what the law's parameters follow.
    """

    label: str
    unit: str
    x: FloatArray
    y: FloatArray
    inside: NDArray[np.bool_]
    unloading: NDArray[np.bool_]
    function_x: FloatArray
    function_y: FloatArray


@dataclass(frozen=True, eq=False)
class FreeFunction:
    """A function of one variable, fitted together with the law.

    Attributes
    ----------
    dependence : Dependence
    term : Term
    found : Refit
        The explanation that leaves it.
    parameters : ndarray, shape (p,)
        Of law and explanation, refitted.
    coefficients : ndarray, shape (size,)
    root : ndarray, shape (p + size, k)
        R with R R^T the covariance of search coordinates and coefficients.
    samples : ndarray
        Values of the variable that it was fitted to.
    least : float
        As in `variables.every_phase`.
    error_MPa : float
        Root mean square of what it leaves where it was not fitted, noise included.
    """

    dependence: Dependence
    term: Term
    found: Refit
    parameters: FloatArray
    coefficients: FloatArray
    root: FloatArray
    samples: FloatArray
    least: float
    error_MPa: float  # noqa: N815

    def on(self, view: RecordView) -> tuple[FloatArray, FloatArray]:
        """Stress (n_samples,) and factor (n_samples, k) of its covariance on a record that is not done yet [MPa]."""
        base, causes = self.found.model.split(self.parameters)
        shared = [(cause, values) for cause, values in causes if cause.records is None]
        model = CampaignModel(self.found.model.law, (view,), [cause for cause, _ in shared])
        parameters = model.parameters(base, *(values for _, values in shared))
        residual, jacobian = model.residual_and_jacobian(parameters)
        stress = residual + model.data
        variable = next(
            candidate for candidate in every_variable((view,), ("",)) if candidate.name == self.dependence.variable
        )
        inside = np.ones(len(stress), dtype=bool)
        if self.term.when is not None:
            inside = every_phase((view,), self.least)[self.term.when]
        columns = np.zeros((len(stress), self.term.size))
        columns[inside] = _basis(variable.values[inside], self.samples, self.term)
        if self.term.acts == "factor":
            columns *= stress[:, None]
        kept = [at for at, name in enumerate(self.found.model.parameter_names) if name in model.parameter_names]
        slopes = jacobian * self.found.coordinates.slopes(self.parameters)[kept]
        rows = [*kept, *range(len(self.root) - self.term.size, len(self.root))]
        return stress + columns @ self.coefficients, np.hstack([slopes, columns]) @ self.root[rows]


class Term(NamedTuple):
    """A variable in a phase, as a stress or as a factor, with so many coefficients."""

    variable: Variable
    when: str | None
    acts: Acts
    size: int


class TriedTerm(NamedTuple):
    """A function, the part of the remainder that it explains where it was not fitted, and its rank among others."""

    term: Term
    explained: float
    judged_on: Literal["records", "parts"]
    rank: float


def terms_of(variables: Sequence[Variable], problem: FreeFunctions) -> Iterator[Term]:
    """Every variable, alone and in every phase, as a stress and as a factor."""
    for variable in variables:
        if variable.is_category:
            levels = len(np.unique(variable.values))
            yield from (Term(variable, None, acts, levels) for acts in ("added", "factor"))
            continue
        for when in (None, *problem.phases):
            inside = variable.values[problem.inside(when)]
            distinct = len(np.unique(np.round(inside, 6)))
            for size in REMAINDER.function_sizes:
                if size < distinct or size == REMAINDER.function_sizes[0]:
                    yield from (Term(variable, when, acts, size) for acts in ("added", "factor"))


class FreeFunctions:
    """What refitted parameters cannot follow, linearised at some parameters.

    Samples are weighed by the noise's standard deviation alone: where a gap is, the noise's slow part is not known.
    """

    def __init__(
        self, base: BaseFit, found: Refit, parameters: FloatArray, phases: dict[str, NDArray[np.bool_]], noise: float
    ) -> None:
        self.phases = phases
        self._found, self._parameters = found, parameters
        residual, jacobian = found.model.residual_and_jacobian(parameters)
        self._missing = -residual
        self._stress = residual + found.model.data
        self.has_stress = bool(np.any(self._stress))
        """False where the parameters are at bounds at which the law gives none: nothing is a factor of that."""
        specimens = specimen_columns(base.whitened.noises, base.whitener.slices)
        own = np.hstack([np.zeros((len(residual), 0)), *specimens])
        self._count = jacobian.shape[1]
        self._tangent = np.hstack([jacobian * found.coordinates.slopes(parameters), own])
        self._precision = np.append(found.coordinates.prior.precision, np.ones(own.shape[1]))
        self._weight = np.concatenate([_weights(noise_model) for noise_model in base.whitened.noises])
        self._slices = base.whitener.slices
        # Kinks of a gap make the noise look larger than it is; from sample to sample they do not.
        rough = [
            len(view.data) * noise_level(view.sampled(view.time), self._missing[part]) ** 2
            for view, part in found.model.parts
        ]
        self._noise = min(noise, float(np.sqrt(sum(rough) / len(self._missing))))
        records = [np.arange(part.start, part.stop) for part in self._slices]
        parts = [np.array(block) for rows in records for block in np.array_split(rows, REMAINDER.left_out_parts)]
        self._folds: dict[Literal["records", "parts"], list[NDArray[np.int_]]] = {"records": records, "parts": parts}
        self.before: dict[str, float] = {
            kind: self._square_left_out(None, folds) for kind, folds in self._folds.items() if len(folds) > 1
        }

    def with_function(self, term: Term) -> FloatArray:
        """Parameters of the explanation refitted jointly with a function, to first order."""
        solved = self._fitted_jointly(term)[: self._count]
        coordinates = self._found.coordinates
        moved = np.clip(coordinates.of(self._parameters) + solved, coordinates.bounds.lower, coordinates.bounds.upper)
        return coordinates.parameters(np.asarray(moved))

    def inside(self, when: str | None) -> NDArray[np.bool_]:
        """Samples of a phase."""
        return np.ones(len(self._missing), dtype=bool) if when is None else self.phases[when]

    def trial(self, term: Term, before_of: Mapping[str, float]) -> TriedTerm:
        """How much of what is left a function explains where it was not fitted, of so much `before`."""
        kind: Literal["records", "parts"] = "records" if self._is_elsewhere(term) else "parts"
        before, least = before_of[kind], self._noise**2
        after = self._square_left_out(term, self._folds[kind])
        surely = before - least > REMAINDER.certain * np.sqrt(2.0 / len(self._missing)) * least
        explained = 1.0 - (after - least) / (before - least) if surely else 0.0
        rank = explained - REMAINDER.per_coefficient * term.size - REMAINDER.per_phase * (term.when is not None)
        return TriedTerm(term, explained, kind, rank - REMAINDER.on_parts * (kind == "parts" and len(self._slices) > 1))

    def _is_elsewhere(self, term: Term) -> bool:
        """Whether there are several records with what the function says something about: each group of a category."""
        values, inside = term.variable.values, self.inside(term.when)
        groups = np.unique(values[inside]) if term.variable.is_category else [None]
        member = [inside if group is None else inside & (values == group) for group in groups]
        return all(sum(bool(mask[part].any()) for part in self._slices) > 1 for mask in member)

    def curve(self, term: Term) -> RemainderCurve:
        """For a figure.

        Where parameters, refitted without the function, follow most of it, only the rest is known, and shown.
        """
        count, columns, weight = self._tangent.shape[1], self._columns(term), self._weight
        solved = self._fitted_jointly(term)
        followed, shown = self._tangent @ solved[:count], solved[count:]
        whole = columns @ shown
        taken = self._followed(whole)
        if np.linalg.norm(weight * (whole - taken)) < REMAINDER.least_of_its_own * np.linalg.norm(weight * whole):
            followed += taken
            shown = np.asarray(np.linalg.lstsq(weight[:, None] * columns, weight * (whole - taken), rcond=1e-10)[0])
        least = SMALLEST_STRESS * float(np.max(np.abs(self._stress)))
        size = np.copysign(np.maximum(np.abs(self._stress), least), self._stress) / 100.0
        scale = size if term.acts == "factor" else np.ones(len(self._missing))
        inside, x = self.inside(term.when), term.variable.values
        some = np.unique(np.linspace(0, len(x) - 1, POINTS).astype(int))
        grid = np.unique(x[inside])
        if not term.variable.is_category:
            grid = np.linspace(float(grid[0]), float(grid[-1]), POINTS)
        function = _basis(grid, x[inside], term) @ shown
        return RemainderCurve(
            label=term.variable.label,
            unit="%" if term.acts == "factor" else "MPa",
            x=x[some],
            y=((self._missing - followed) / scale)[some],
            inside=inside[some],
            unloading=self.phases.get("unloading", np.zeros(len(x), dtype=bool))[some],
            function_x=grid,
            function_y=100.0 * function if term.acts == "factor" else function,
        )

    def function(self, term: Term, dependence: Dependence, before_of: Mapping[str, float]) -> FreeFunction:
        """Fitted to all records."""
        together = self._weight[:, None] * np.hstack([self._tangent, self._columns(term)])
        normal = _regular(together.T @ together, self._precision, smooth=_is_smooth(term))
        solved = self._fitted_jointly(term)
        size = np.sqrt(np.diag(normal))
        size[size == 0.0] = 1.0  # a parameter that nothing depends on
        values, vectors = np.linalg.eigh(normal / np.outer(size, size))
        least = self._noise**2
        error = least + (1.0 - dependence.explained) * max(before_of[dependence.judged_on] - least, 0.0)
        root = vectors / np.sqrt(np.maximum(values, 1e-10 * values[-1])) / size[:, None] * np.sqrt(error / least)
        kept = [*range(self._count), *range(len(solved) - term.size, len(solved))]
        return FreeFunction(
            dependence=dependence,
            term=term,
            found=self._found,
            parameters=self.with_function(term),
            coefficients=solved[len(solved) - term.size :],
            root=root[kept],
            samples=term.variable.values[self.inside(term.when)],
            least=least_below(self._found.model.views),
            error_MPa=float(np.sqrt(error)),
        )

    def _columns(self, term: Term) -> FloatArray:
        """The stress that each coefficient of a function adds, shape (n_samples, size) [MPa]."""
        inside, values = self.inside(term.when), term.variable.values
        columns = np.zeros((len(values), term.size))
        columns[inside] = _basis(values[inside], values[inside], term)
        return columns * self._stress[:, None] if term.acts == "factor" else columns

    def _fitted_jointly(self, term: Term) -> FloatArray:
        """Change of the parameters and coefficients of a function that together describe what is left best."""
        columns, smooth = self._columns(term), _is_smooth(term)
        together = self._weight[:, None] * np.hstack([self._tangent, columns])
        return _solved(
            together.T @ together, together.T @ (self._weight * self._missing), self._precision, smooth=smooth
        )

    def _followed(self, values: FloatArray) -> FloatArray:
        """What refitted parameters alone follow of a change of the prediction, shape (N,) [MPa]."""
        tangent = self._weight[:, None] * self._tangent
        along = tangent.T @ (self._weight * values)
        return np.asarray(self._tangent @ _solved(tangent.T @ tangent, along, self._precision, smooth=False))

    def _square_left_out(self, term: Term | None, folds: Sequence[NDArray[np.int_]]) -> float:
        """Mean square of every fold as the others predict it, with a function or without [MPa^2]."""
        raw, smooth = self._tangent, False
        if term is not None:
            raw, smooth = np.hstack([raw, self._columns(term)]), _is_smooth(term)
        together, left = self._weight[:, None] * raw, self._weight * self._missing
        # Summed over the other records: to subtract one from all leaves rounding errors of what acts in it alone.
        normals = np.stack([together[rows].T @ together[rows] for rows in folds])
        along = np.stack([together[rows].T @ left[rows] for rows in folds])
        total = 0.0
        for at, rows in enumerate(folds):
            others = np.arange(len(folds)) != at
            solved = _solved(normals[others].sum(axis=0), along[others].sum(axis=0), self._precision, smooth=smooth)
            used = self._weight[rows] > 0.0
            total += float(np.sum((self._missing[rows] - raw[rows] @ solved)[used] ** 2))
        return total / max(int(np.count_nonzero(self._weight)), 1)


def _weights(noise: NoiseModel) -> FloatArray:
    """1 over the noise of every sample; 0 for outliers."""
    weight = 1.0 / noise.deviation
    weight[list(noise.outliers)] = 0.0
    return np.asarray(weight)


def _is_smooth(term: Term) -> bool:
    return not term.variable.is_category and term.size > REMAINDER.function_sizes[0]


def _regular(normal: FloatArray, precision: FloatArray, *, smooth: bool) -> FloatArray:
    """Normal equations with the priors of what was there before; of the function hardly more than that it is smooth."""
    normal = normal.copy()
    count = len(precision)
    size = len(normal) - count
    if size:
        diagonal = np.diag(normal)
        bent = np.diff(np.eye(size), 2, axis=0) if smooth else np.zeros((0, size))
        own = max(float(diagonal[count:].mean()), 1e-12 * max(float(diagonal.max()), 1e-300))
        normal[count:, count:] += own * (REMAINDER.ridge * np.eye(size) + REMAINDER.smoothness * bent.T @ bent)
    normal[:count, :count] += np.diag(precision)
    return normal


def _solved(normal: FloatArray, along: FloatArray, precision: FloatArray, *, smooth: bool) -> FloatArray:
    """Least squares of `_regular` equations."""
    normal = _regular(normal, precision, smooth=smooth)
    scale = np.sqrt(np.diag(normal))
    scale[scale == 0.0] = 1.0  # a parameter that nothing depends on
    return np.asarray(np.linalg.lstsq(normal / np.outer(scale, scale), along / scale, rcond=1e-10)[0] / scale)


def _basis(values: FloatArray, samples: FloatArray, term: Term) -> FloatArray:
    """Splines on the quantiles of the samples, constant beyond these, or a level for each group; shape (n, size)."""
    if term.variable.is_category:
        return np.asarray(values[:, None] == np.unique(samples)[None, :], dtype=np.float64)
    low, high = float(samples.min()), float(samples.max())
    if high <= low:
        return np.column_stack([np.ones(len(values)), np.zeros((len(values), term.size - 1))])
    x = (np.clip(values, low, high) - low) / (high - low)
    if term.size == REMAINDER.function_sizes[0]:
        return np.column_stack([np.ones(len(x)), x])
    inner = np.quantile((samples - low) / (high - low), np.linspace(0.0, 1.0, term.size - 2)[1:-1])
    knots = np.concatenate([np.zeros(4), np.clip(inner, 1e-6, 1.0 - 1e-6), np.ones(4)])
    return np.asarray(BSpline.design_matrix(np.clip(x, 0.0, 1.0), knots, 3).toarray())
