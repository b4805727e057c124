"""A companion relation that knows how well it is known, and what that does to a predicted stress."""

from __future__ import annotations

from dataclasses import dataclass, field, fields
from typing import TYPE_CHECKING

import numpy as np

from probation import _core
from probation._arrays import FloatArray
from probation.calibration.companion_forms import FORMS, NAMEABLE, Form
from probation.errors import InputError
from probation.law.calibration_settings import CalibrationSettings
from probation.law.companion import Companion, from_settings
from probation.law.direction import Direction
from probation.law.history import as_history
from probation.law.modification import Modification
from probation.law.schemes import as_scheme
from probation.law.settings import COMPANION_FORMS, CompanionSettings
from probation.results.data import named_in

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from probation.law.history import AnyHistory
    from probation.law.modal import Law
    from probation.law.schemes import Scheme, SchemeName


@dataclass(frozen=True, eq=False)
class CalibratedCompanion:
    """A companion relation with the covariance of its parameters.

    Attributes
    ----------
    relation : Companion
        Its `calibrated` says between which rates.
    covariance : ndarray, shape (p, p), or (p + 1, p + 1) with `unrelaxed_modulus`; or None
        Of the form's parameters in the order of campaign.toml, in their own units; last E_u [MPa], if it is known
        which one the relation belongs to. E_u and the scale of tau_max are all but perfectly anticorrelated. None
        where nothing is known: as many rates as parameters, and no standard errors.
    log_scatter : float [-]
        Standard deviation of ln tau_max of single tests around the relation.
    unrelaxed_modulus : float or None
        E_u that the relation was calibrated with [MPa].
    form : Form
        That of the relation, unless it is given.

    Raises
    ------
    InputError
        For a user's function of rate, which has no parameters to be uncertain of, or a covariance of another shape.
    """

    relation: Companion
    covariance: FloatArray | None
    log_scatter: float = 0.0
    unrelaxed_modulus: float | None = None

    form: Form = field(default=None, metadata=named_in("calibration.companion_forms.FORMS"))  # type: ignore[assignment]  # below

    def __post_init__(self) -> None:
        if self.form is None:
            if self.relation.form not in FORMS:
                raise InputError(f"a companion relation of the form {self.relation.form!r} has no parameters to know")
            object.__setattr__(self, "form", FORMS[self.relation.form])
        if self.covariance is not None:
            size = len(self.parameters) + (self.unrelaxed_modulus is not None)
            if np.shape(self.covariance) != (size, size):
                raise InputError(f"covariance has the shape {np.shape(self.covariance)}; expected ({size}, {size})")

    @property
    def parameters(self) -> FloatArray:
        """Of the form, shape (p,)."""
        return self.form.parameters(self.relation)

    @property
    def parameter_names(self) -> tuple[str, ...]:
        """As in campaign.toml, one per parameter."""
        return self.form.parameter_names or tuple(f"tau_max_s[{at}]" for at in range(len(self.parameters)))

    @property
    def standard_errors(self) -> FloatArray:
        """Of `parameters`, shape (p,); NaN where nothing is known."""
        if self.covariance is None:
            return np.full(len(self.parameters), np.nan)
        variance = np.diag(self.covariance)[: len(self.parameters)]
        return np.asarray(np.sqrt(np.where(variance >= 0.0, variance, np.nan)))  # a form that fits ill may tell nothing

    def relaxation_time(self, rate: ArrayLike) -> FloatArray:
        """Longest relaxation time, shape (n,) [s]."""
        return self.relation.relaxation_time(rate)

    def log_gradient(self, rate: ArrayLike) -> FloatArray:
        """Derivatives of ln tau_max along the parameters, shape (n, p)."""
        seen = np.maximum(np.abs(np.atleast_1d(np.asarray(rate, dtype=np.float64))), self.relation.rate_floor)
        return self.form.log_gradient(self.relation, seen)

    def log_time_se(self, rate: ArrayLike, *, scatter: bool = False) -> FloatArray:
        """Standard error of ln tau_max, that of E_u included; it grows outside the calibrated range.

        Parameters
        ----------
        rate : array_like, shape (n,) [1/s]
        scatter : bool
            Whether to add the scatter of single tests around the relation.

        Returns
        -------
        ndarray, shape (n,) [-]
        """
        gradient = self.log_gradient(rate)
        if self.covariance is None:
            return np.full(len(gradient), np.nan)
        own = self.covariance[: gradient.shape[1], : gradient.shape[1]]
        variance = np.einsum("ij,jk,ik->i", gradient, own, gradient) + (self.log_scatter**2 if scatter else 0.0)
        return np.asarray(np.sqrt(np.maximum(variance, 0.0)))

    def extrapolation(self, rate: ArrayLike) -> str | None:
        """A warning where the rates leave the calibrated range, else None."""
        return self.relation.extrapolation(rate)

    def prediction_factor(
        self,
        law: Law,
        time: ArrayLike | AnyHistory,
        true_strain: ArrayLike | None = None,
        scheme: Scheme | SchemeName = "be2",
        *,
        modification: Modification | None = None,
        scatter: bool = True,
    ) -> FloatArray:
        """What the uncertainty of the relation does to a predicted stress, as a factor L of its covariance L Lᵀ.

        First order (delta method): the law's sensitivity to ln tau_max along the record, in the directions of
        independent errors of the parameters, E_u moving along where the calibration says so.

        Parameters
        ----------
        law : Law
            With this companion relation; any alpha.
        time, true_strain, scheme, modification
            As in `Law.sensitivity`.
        scatter : bool
            Whether the record is a new test, which scatters around the relation as a whole: one more column.

        Returns
        -------
        ndarray, shape (n_times, n_sources) [MPa]

        Raises
        ------
        InputError
            If the law has another companion relation, or none; otherwise as `Law.sensitivity`.
        """
        if law.companion is None or not _same_relation(law.companion, self.relation):
            raise InputError(f"law.companion is {law.companion}; expected the calibrated relation, {self.relation}")
        if self.covariance is None:
            raise InputError("the covariance of the companion relation is not known; calibrate it with standard errors")
        history = as_history(time, true_strain)
        rates = seen_rates(history.engine, as_scheme(scheme).name, self.relation.rate_floor, history.direction)
        gradient = self.log_gradient(rates)
        values, vectors = np.linalg.eigh(self.covariance)
        factor = vectors * np.sqrt(np.maximum(values, 0.0))
        count = gradient.shape[1]
        directions = [
            Direction(
                unrelaxed_modulus=float(column[count]) if len(column) > count else None,
                log_relaxation_time=gradient @ column[:count],
            )
            for column in factor.T
        ]
        if scatter and self.log_scatter > 0.0:
            directions.append(Direction(log_relaxation_time=self.log_scatter))
        return law.sensitivity(history, scheme=scheme, directions=directions, modification=modification)[1]

    def prediction_se(
        self,
        law: Law,
        time: ArrayLike | AnyHistory,
        true_strain: ArrayLike | None = None,
        scheme: Scheme | SchemeName = "be2",
        *,
        modification: Modification | None = None,
        scatter: bool = True,
    ) -> FloatArray:
        """Standard error of a predicted stress that the uncertainty of the relation brings; see `prediction_factor`.

        Returns
        -------
        ndarray, shape (n_times,) [MPa]
        """
        factor = self.prediction_factor(law, time, true_strain, scheme, modification=modification, scatter=scatter)
        return np.asarray(np.sqrt(np.sum(factor**2, axis=1)))

    def settings(self) -> CompanionSettings:
        """As a campaign holds it, covariance and range included.

        Raises
        ------
        InputError
            For a form that campaigns cannot name.
        """
        if self.form.name not in NAMEABLE:
            raise InputError(f"a campaign cannot name the form {self.form.name!r}; expected {', '.join(NAMEABLE)}")
        names, values = COMPANION_FORMS[self.form.name], self.parameters.tolist()
        parameters: dict[str, float | tuple[float, ...]] = dict(zip(names, values, strict=False))
        if self.form.name == "table":
            parameters = {"rates": tuple(self.relation.rates), "tau_max_s": tuple(values)}  # type: ignore[attr-defined]
        calibration = CalibrationSettings(
            rates=self.relation.calibrated,
            covariance=None if self.covariance is None else _symmetric(self.covariance),
            log_scatter=float(self.log_scatter),
            unrelaxed_modulus_MPa=None if self.unrelaxed_modulus is None else float(self.unrelaxed_modulus),
        )
        return CompanionSettings(self.form.name, parameters, calibration)

    @classmethod
    def from_settings(cls, settings: CompanionSettings | None) -> CalibratedCompanion | None:
        """The relation that a campaign names, if it says how well it is known; else None."""
        relation = from_settings(settings)
        if relation is None or settings is None or settings.calibration is None:
            return None
        known = settings.calibration
        if known.covariance is None:
            return None
        return cls(relation, np.array(known.covariance), known.log_scatter, known.unrelaxed_modulus_MPa)


def _same_relation(one: Companion, other: Companion) -> bool:
    """The same relation, wherever it was calibrated."""
    names = [declared.name for declared in fields(one) if declared.name != "calibrated"]  # type: ignore[arg-type]
    return type(one) is type(other) and all(getattr(one, name) == getattr(other, name) for name in names)


def _symmetric(matrix: FloatArray) -> tuple[tuple[float, ...], ...]:
    return tuple(tuple(row) for row in (0.5 * (matrix + matrix.T)).tolist())


def seen_rates(history: _core.History, scheme: str, floor: float, direction: ArrayLike | None = None) -> FloatArray:
    """The rate that the law feeds its companion relation at the end of each step, first that of the start.

    Parameters
    ----------
    scheme : str
        Its differentiator is used.
    floor : float [1/s]
        What a rate that noise turned against the commanded direction is set to.
    direction : array_like, shape (n_times - 1,), optional

    Returns
    -------
    ndarray, shape (n_times,) [1/s]
    """
    differentiator = _core.Differentiator.backward if scheme == "be2" else _core.Differentiator.three_point
    begin, end = history.rates(differentiator)
    if direction is not None:
        sign = np.sign(np.asarray(direction, dtype=np.float64))
        begin, end = (np.where(sign * side < 0.0, 0.0, side) for side in (begin, end))
    return np.asarray(np.maximum(np.abs(np.concatenate([begin[:1], end])), floor))
