"""Records predicted by the relation of the others: nothing adjusted, and how far alpha would have to move."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from probation.calibration.cross_validation import Score
from probation.errors import InputError
from probation.identify.covariance import covariance
from probation.identify.variable_projection import search
from probation.inference.modal_law import DnlrLaw
from probation.inference.problem import Problem
from probation.settings.companion import COMPANION

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from numpy.typing import NDArray

    from probation._arrays import FloatArray
    from probation.calibration.companion_forms import Form
    from probation.calibration.direct import DirectFit, DirectRoute
    from probation.law.companion import Companion


@dataclass(frozen=True, eq=False)
class RecordAlpha:
    """What one record makes of a relation, E_u held.

    Attributes
    ----------
    log_alpha : float
        ln of the uniform correction of tau_max that fits the record best, G free [-].
    se : float
        Its standard error; infinite where the record does not determine it.
    rms : float
        Of the fit residual, alpha and G free [MPa].
    """

    log_alpha: float
    se: float
    rms: float


@dataclass(frozen=True)
class Predicted:
    """One record left out of the calibration, and predicted.

    Attributes
    ----------
    rms : float
        Of the prediction with nothing adjusted: E_u, relation and G are those of the other records [MPa].
    hardening_rms : float
        With G free: what of it is the relation's and E_u's [MPa].
    refit_rms : float
        With alpha and G free [MPa]: what is left of the form and the law.
    largest_stress : float
        Of the record [MPa].
    """

    record: str
    form: str
    rms: float
    hardening_rms: float
    refit_rms: float
    largest_stress: float


def record_alpha(direct: DirectRoute, at: int, relation: Companion, modulus: float) -> RecordAlpha:
    """Fit alpha and G of one record to a relation, E_u held."""
    hardening = direct.held("hardening_modulus")
    law = direct.law(relation, modulus, 1.0 if hardening is None else hardening)
    held = ("unrelaxed_modulus",) if hardening is None else ("unrelaxed_modulus", "hardening_modulus")
    alone = Problem.white(DnlrLaw(law, held), [direct.views[at]])
    best = search(alone, COMPANION.searched_alpha)
    residual, jacobian = alone.residual_and_jacobian(best)
    known = covariance(jacobian, residual, alone.lengths, best)
    return RecordAlpha(float(np.log(best[0])), float(known.relative_error[0]), _rms(alone.model.residual(best)))


def leave_one_rate_out(
    direct: DirectRoute,
    groups: Sequence[NDArray[np.intp]],
    forms: Mapping[str, Form],
    start: Callable[[Form], list[FloatArray]],
    calibrated: Callable[[Sequence[int]], tuple[float, float]],
    progress: Callable[[str], None],
) -> tuple[dict[str, Score], tuple[Predicted, ...]]:
    """Calibrate on all records but those of one rate, and predict these; each rate in turn, by every form.

    Parameters
    ----------
    groups : sequence of arrays
        Indices of the records of each rate.
    forms : mapping of name to Form
    start : callable
        Where the search of a form begins.
    calibrated : callable
        The range of rates of some records [1/s].
    progress : callable
        Called with what is being done.
    """
    count = len(direct.views)
    scores, predicted = {}, []
    for name, form in forms.items():
        error, weights = np.full(count, np.nan), np.ones(count)
        for group in groups:
            kept = [at for at in range(count) if at not in group]
            progress(f"{name} without {', '.join(direct.views[at].id for at in group)}")
            try:
                fitted = direct.only(kept).fit(form, start(form), calibrated(kept))
                for at in group:
                    prediction, own = _predict(direct, int(at), name, fitted)
                    predicted.append(prediction)
                    error[at] = -own.log_alpha
            except InputError:  # no positive relaxation time at the rates left out
                continue
        scores[name] = Score(name, error, weights)
    return scores, tuple(predicted)


def _predict(direct: DirectRoute, at: int, form: str, fitted: DirectFit) -> tuple[Predicted, RecordAlpha]:
    view = direct.views[at]
    relation, modulus = fitted.companion.relation, fitted.unrelaxed_modulus
    hardening = float(np.exp(np.mean(np.log(np.maximum(fitted.hardening_modulus, 1e-300)))))
    law = DnlrLaw(direct.law(relation, modulus, hardening))
    base, unit, whole = (law.stress(view, np.array([modulus, 1.0, value])) for value in (0.0, 1.0, hardening))
    own = record_alpha(direct, at, relation, modulus)
    largest = float(np.max(np.abs(view.data)))
    slope = unit - base  # the stress is linear in G
    left = base - view.data
    left = left - slope * float(slope @ left) / float(slope @ slope)
    return Predicted(view.id, form, _rms(whole - view.data), _rms(left), own.rms, largest), own


def _rms(error: FloatArray) -> float:
    return float(np.sqrt(np.mean(error**2)))
