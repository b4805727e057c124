"""How an effect's form may be wrong: what it does, times a smooth function of the effect's own coordinate.

Locking by Gent is not locking by Langevin, and nature's is neither; but both stiffen where the network is stretched. So
an effect's contribution may be larger here and smaller there along what the effect follows (`Effect.coordinate`), in
the same way in all records. That is in proportion to what of it the law's own parameters cannot follow: of an effect
that acts much like another modulus little shows, and little may be wrong. A second effect has to explain more than that
(docs/diagnosis-method.md, section 4).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from probation.effects.coordinate import coordinate_of, is_one_value
from probation.noise.span import span_of, without
from probation.settings.evidence import EVIDENCE

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation._arrays import FloatArray
    from probation.effects.cause import Cause
    from probation.effects.effect import Values
    from probation.effects.record_view import RecordView
    from probation.inference.refit import Refit
    from probation.noise.whitener import Whitener


@dataclass(frozen=True, eq=False)
class FormFreedom:
    """Ways in which the forms of an explanation may be wrong, by the relative size 1.

    Attributes
    ----------
    columns : ndarray, shape (N, m)
        Whitened stress of every polynomial along every cause's coordinate.
    variance : float
        Of the rest, which is no function of the coordinate, over that of an effect of the material: less for a fault
        of the rig, whose form is known better; a mean over the causes by what each of them does to the records.
    """

    columns: FloatArray
    variance: float


def form_freedom(found: Refit, whitener: Whitener) -> FormFreedom:
    """The freedom of every cause of an explanation.

    Parameters
    ----------
    found : Refit
    whitener : Whitener
        Of its records.
    """
    model = found.model
    columns = [np.zeros((len(found.residual), 0))]
    energies, variances = [], []
    law = span_of(found.jacobian[:, : model.base_count])
    for cause, values in model.split(found.parameters)[1]:
        contribution = whitener.columns(model.contribution(found.parameters, cause)[:, None])
        seen = without(contribution, law)
        size = form_size(cause)
        columns.append(size * seen * _waves(cause, values, model.views))
        energies.append(float(np.sum(seen**2)))
        variances.append(size**2)
    does = np.array(energies) if sum(energies) > 0.0 else np.ones(len(energies))
    return FormFreedom(np.hstack(columns), float(np.average(variances, weights=does)) if variances else 1.0)


def form_size(cause: Cause) -> float:
    """How far a cause's form may be wrong, over that of an effect of the material."""
    return 1.0 if cause.effect.kind == "material" else EVIDENCE.rig_form_error


def _waves(cause: Cause, at: Values, views: Sequence[RecordView]) -> FloatArray:
    """Legendre polynomials along the cause's coordinate over the records that it touches, shape (N, m)."""
    coordinate = cause.effect.coordinate
    values = [coordinate_of(view, coordinate, at) for view in views]
    touched = np.concatenate([own for own, view in zip(values, views, strict=True) if cause.touches(view.id)])
    low, high = float(touched.min()), float(touched.max())
    if is_one_value(low, high, coordinate):
        return np.zeros((sum(len(own) for own in values), 0))
    scaled = np.clip(2.0 * (np.concatenate(values) - low) / (high - low) - 1.0, -1.0, 1.0)
    return np.asarray(np.polynomial.legendre.legvander(scaled, EVIDENCE.form_waves)[:, 1:], dtype=np.float64)
