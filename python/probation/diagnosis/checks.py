"""What else speaks for or against an explanation: records left out, one amplitude for all, bounds.

How they are read: docs/diagnosis.md. They change no probability.

Both are worked out from the Jacobian at the optimum: leaving a record out moves the parameters little, and the solves
would be spent for the same figures.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.detection.tail import chi_square_tail
from probation.diagnosis.result import Checks
from probation.effects.visible_temperature import measured_against_work
from probation.effects.visible_volume import measured_volume
from probation.settings.evidence import EVIDENCE

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from probation._arrays import FloatArray
    from probation.diagnosis.hypothesis import Hypothesis
    from probation.effects.record_view import RecordView
    from probation.inference.refit import Refit
    from probation.noise.whitening import Whitened


MEASURED_BESIDE: Mapping[str, Callable[[RecordView], str]] = {
    "self_heating": measured_against_work,
    "volume_change": measured_volume,
}
"""What a record was measured to do, in one sentence, of the effects that a measurement judges."""


def checks(hypothesis: Hypothesis, base: Refit, whitened: Whitened, remaining_p_value: float) -> Checks:
    """Check an explanation that has causes.

    Parameters
    ----------
    hypothesis : Hypothesis
    base : Refit
        Of the base law.
    whitened : Whitened
    remaining_p_value : float
        Of the gap test after it.
    """
    refit = hypothesis.refit
    shared = all(cause.records is None for cause in hypothesis.causes)
    left_out = None
    if shared and len(whitened.records) >= EVIDENCE.fewest_to_leave_out:
        count = len(whitened)
        before, after = (
            float(np.sum(left_out_squares(base, whitened))),
            float(np.sum(left_out_squares(refit, whitened))),
        )
        least = count + EVIDENCE.left_out_gap * np.sqrt(2.0 * count)
        left_out = 1.0 - (after - count) / (before - count) if before > least else None
    p_value, scatter = amplitude_consistency(hypothesis, whitened) if shared else (None, 0.0)
    notes = []
    if p_value is not None and p_value < EVIDENCE.disagreement_level and scatter > EVIDENCE.disagreement_scatter:
        notes.append(f"the records want amplitudes that differ by {100.0 * scatter:.0f} %")
    low, high = refit.at_bound
    for index, name in enumerate(refit.model.parameter_names[refit.model.base_count :], refit.model.base_count):
        # An amplitude at zero is an effect that is not there; a nonlinear parameter at its bound asks for another form.
        if low[index] or high[index]:
            notes.append(f"{name.rsplit('.', 1)[-1]} ended at its {'lower' if low[index] else 'upper'} bound")
    for name in dict.fromkeys(cause.effect.name for cause in hypothesis.causes):
        if (say := MEASURED_BESIDE.get(name)) is not None:
            notes += [said for view in refit.model.views if (said := say(view))]
    return Checks(left_out, p_value, remaining_p_value, tuple(notes))


def left_out_squares(found: Refit, whitened: Whitened) -> FloatArray:
    """|z_r|^2 of every record as the others predict it, shape (n_records,)."""
    coordinates = found.coordinates
    prior = np.diag(coordinates.prior.precision)
    normal = found.jacobian.T @ found.jacobian + prior
    squares = []
    for part in whitened.slices:
        own, z = found.jacobian[part], found.residual[part]
        rest = normal - own.T @ own
        size = np.sqrt(np.maximum(np.diag(rest), 1e-300))
        step = np.linalg.pinv(rest / np.outer(size, size), rcond=1e-10, hermitian=True) @ ((own.T @ z) / size) / size
        predicted = z + own @ step
        squares.append(float(predicted @ predicted))
    return np.array(squares)


def amplitude_consistency(hypothesis: Hypothesis, whitened: Whitened) -> tuple[float | None, float]:
    """Cochran's Q of the first cause's amplitude over the records: p-value, and its relative scatter beyond chance."""
    refit = hypothesis.refit
    column = refit.model.base_count
    own = np.zeros((len(whitened), len(whitened.records)))
    for index, part in enumerate(whitened.slices):
        own[part, index] = refit.jacobian[part, column]
    design = np.hstack([own, np.delete(refit.jacobian, column, axis=1)])
    count = own.shape[1]
    size = np.linalg.norm(design, axis=0)
    used = size > 0.0
    left, upper = np.linalg.qr(design[:, used] / size[used])
    inverse = np.linalg.pinv(upper, rcond=1e-8) / size[used][:, None]
    change, covariance = np.zeros(len(size)), np.full((len(size), len(size)), np.nan)
    change[used] = -inverse @ (left.T @ refit.residual)
    covariance[np.ix_(used, used)] = inverse @ inverse.T
    amplitude = float(refit.coordinates.of(refit.parameters)[column])
    deviation = np.sqrt(np.diag(covariance)[:count])
    # Records that say next to nothing of the amplitude have no vote.
    known = np.flatnonzero(used[:count] & (deviation < EVIDENCE.voting_error * abs(amplitude)))
    if known.size < 2 or amplitude == 0.0:
        return None, 0.0
    weight = np.linalg.pinv(covariance[np.ix_(known, known)], hermitian=True)
    value = change[known]
    common = float(weight.sum(axis=0) @ value / weight.sum())
    away = value - common
    q = float(away @ weight @ away)
    excess = max(float(np.var(away)) - float(np.mean(deviation[known] ** 2)), 0.0)
    p_value = float(chi_square_tail(q, known.size - 1, whitened.scale_spread))
    return p_value, float(np.sqrt(excess)) / abs(amplitude)
