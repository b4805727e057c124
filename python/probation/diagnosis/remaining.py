"""Is a gap left after an explanation? (docs/diagnosis-method.md, section 7)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.detection.gap_test import GapTest, GapTester
from probation.inference.form_error import form_freedom
from probation.noise.joint_noise import jointly_whitened
from probation.settings.evidence import EVIDENCE

if TYPE_CHECKING:
    from probation.diagnosis.remainder import Remainder
    from probation.diagnosis.result import Shrink
    from probation.inference.base_fit import BaseFit
    from probation.inference.refit import Refit


def leaves_too_much(shrink: Shrink, left: Remainder | None = None) -> bool:
    """Whether the misfit after the best explanation is plainly larger than what noise there may be.

    Noise may be more than is estimated: as much as any smooth correction leaves. But what is mostly a function of what
    was recorded, where that was left out, is no noise; and where a good part of the gap is left, nothing is explained,
    whatever it is.

    Parameters
    ----------
    shrink : Shrink
    left : Remainder, optional
        What the explanation leaves, described.
    """
    fitted = shrink.identify
    reachable = fitted.noise_MPa
    explained = fitted.closure is None or fitted.closure >= EVIDENCE.explained_part
    if shrink.ceiling is not None and explained:
        reachable = max(reachable, shrink.ceiling.after_MPa)
    if left is not None and left.mostly_a_function:
        reachable = fitted.noise_MPa
    return fitted.after_MPa > EVIDENCE.most_left * reachable


def remaining_gap(found: Refit, base: BaseFit, *, seed: int, share: float = EVIDENCE.reported_remainder) -> GapTest:
    """The gap test on what an explanation leaves, its parameters refitted, its form's error let pass.

    Parameters
    ----------
    found : Refit
        With the explanation's causes.
    base : BaseFit
    seed : int
    share : float
        Part of the errors of a form, as evidence takes them, that is let pass.
    """
    discrepancy = base.discrepancy
    error = share * EVIDENCE.tolerated_form_error
    forms = form_freedom(found, base.whitener)
    done = forms.variance * discrepancy.energy(found.residual - base.refit.residual)
    rest = discrepancy.factor((EVIDENCE.form_rest * error) ** 2 * done)
    allowed = np.hstack([rest, error * forms.columns])
    scatter = base.uncertain_scatter
    both = jointly_whitened(allowed, np.column_stack([found.residual, found.jacobian]))
    return GapTester(
        base.whitened.with_residual(both[:, 0], both[:, 1:]),
        scatter=scatter and scatter.seen_by(lambda columns: jointly_whitened(allowed, columns)),
        size=EVIDENCE.remaining_draws,
        seed=seed,
    )()
