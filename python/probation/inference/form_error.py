"""How an effect's form may be wrong: what it does, times a slow function of strain, of the rate and of time.

Locking by Gent is not locking by Langevin, and nature's is neither; but both stiffen where the network is stretched. So
an effect's contribution is let be larger here and smaller there by some tenths, in the same way in all records.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.settings.evidence import EVIDENCE

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.effects.record_view import RecordView
    from probation.inference.refit import Refit
    from probation.noise.whitener import Whitener


def form_columns(found: Refit, whitener: Whitener) -> FloatArray:
    """Whitened stress of every modulation of every cause, each of one standard deviation; shape (N, m).

    Parameters
    ----------
    found : Refit
    whitener : Whitener
        Of its records.
    """
    model = found.model
    if not model.causes:
        return np.zeros((len(found.residual), 0))
    still = model.residual(found.parameters)
    largest = max(float(np.max(view.true_strain)) for view in model.views)
    modulations = np.vstack([_modulations(view, largest) for view in model.views])
    columns = []
    for cause, at in zip(model.causes, model.amplitudes, strict=True):
        absent = found.parameters.copy()
        absent[at] = 0.0
        contribution = still - model.residual(absent)
        size = EVIDENCE.material_form_error if cause.effect.kind == "material" else EVIDENCE.rig_form_error
        columns.append(size * contribution[:, None] * modulations)
    return whitener.columns(np.hstack(columns))


def _modulations(view: RecordView, largest: float) -> FloatArray:
    """Three polynomials of the strain, decades of the rate, and time; within about ±1; shape (n_samples, 5)."""
    strain = np.clip(view.sampled(view.true_strain) / largest, 0.0, 1.0) if largest > 0.0 else view.sampled(view.time)
    polynomials = np.polynomial.legendre.legvander(2.0 * strain - 1.0, 3)[:, 1:]
    rate = np.clip(view.sampled(view.log_rate) / np.log(10.0), -2.0, 2.0) / 2.0
    time = 2.0 * view.sampled(view.elapsed) / view.duration - 1.0
    return np.column_stack([polynomials, rate, time])
