r"""How probable the data are under an explanation: Laplace's integral, with allowance for the form of an effect.

A catalogue's form of an effect is never quite nature's. Taken at their word, two explanations that leave 40 and 60
MPa^2 of a gap of 10 000 would differ by hundreds of log units; taken as forms known to some per cent, both have found
nearly all of it. So what an explanation leaves is let be noise, the freedom of its form, and a smooth discrepancy,

    y ~ N(J d, I + s^2 F F^T + B (D + H) B^T),

y the whitened residual, J the whitened Jacobian, d the parameters' distance from the optimum with their prior. F are
the effects' contributions times smooth functions of their own coordinates (`form_freedom`), alike in all records; s is
the relative error of a form. B are smooth waves over every record, H slow noise along them that whitening has left
(`noise.nuisance_drift`), D = (s/4)^2 lambda_r v the variance of a discrepancy that is no function of the coordinate:
lambda_r what the explanation does to record r, v the spectrum of smooth curves. s is a quarter as large, in F and in D,
for a fault of the rig. s is integrated out, so that a form that is right is not charged for a freedom that it does not
need. "Unknown" has nothing but a discrepancy of any size, of several kinds (`inference.unknown`;
docs/diagnosis-method.md, sections 4 and 7). A discrepancy as a Gaussian process is Kennedy and O'Hagan's (2001); that
its prior has to say what it can be is Brynjarsdóttir and O'Hagan's (2014).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from scipy.special import logsumexp

from probation.inference.form_error import form_size
from probation.inference.laplace import Linearised
from probation.inference.unknown import log_evidence_of_unknown
from probation.noise.span import span_of, without
from probation.settings.evidence import EVIDENCE

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.inference.discrepancy import Discrepancy
    from probation.inference.form_error import FormFreedom
    from probation.inference.refit import Refit


@dataclass(frozen=True, eq=False)
class Evidence:
    """What the data say of one explanation.

    Attributes
    ----------
    log_evidence : float
        Up to a constant that all explanations of a campaign share.
    form_error : float
        Posterior mean of the relative error of its form.
    log_evidence_unknown : float
        Jointly with an effect outside the catalogue.
    covariance : ndarray, shape (p, p)
        Of the search coordinates, the form's error included; parameters at a bound have none.
    log_evidence_exact : float
        If its form were exact: what tells the forms of one effect apart.
    """

    log_evidence: float
    form_error: float
    log_evidence_unknown: float
    covariance: FloatArray
    log_evidence_exact: float = -np.inf


def evidence(
    found: Refit,
    base: Refit,
    discrepancy: Discrepancy,
    *,
    forms: FormFreedom | None = None,
    unknown: bool = True,
) -> Evidence:
    """Evidence of an explanation, or of the base law itself.

    Parameters
    ----------
    found : Refit
    base : Refit
        Of the base law without causes.
    discrepancy : Discrepancy
    forms : FormFreedom, optional
        Ways in which the forms may be wrong; left out, there is only the rest that is no function of a coordinate.
    unknown : bool
        Whether it is also judged jointly with an unknown effect; else its evidence is -inf.
    """
    columns: FloatArray | None = None
    if forms is not None and forms.columns.shape[1]:
        # What the parameters follow is theirs. Left in, it would let the prior draw a large effect back to nothing
        # while the errors of its form, which are part of the effect, stay as large as they were.
        columns = without(forms.columns, span_of(found.jacobian))
    free = Linearised.of(found, discrepancy, columns)
    plain = free.without_forms
    variance = forms.variance if forms else max((form_size(cause) ** 2 for cause in found.model.causes), default=1.0)
    done = variance * discrepancy.energy(found.residual - base.residual)
    errors, weights = (EVIDENCE.form_errors, EVIDENCE.form_error_weights) if done.any() else ((0.0,), (1.0,))
    size, wrong = np.array(errors), np.array(errors) > 0.0

    def variances_at(error: float) -> FloatArray:
        """Of the discrepancy where the form is wrong by so much."""
        return discrepancy.variances((EVIDENCE.form_rest * error) ** 2 * done)

    exact = plain.log_integral(variances_at(0.0))
    scores = np.full(len(errors), exact)
    if wrong.any():
        variances = np.array([variances_at(error) for error in size[wrong]])
        scores[wrong] = free.log_integrals(variances, free.form_count, size[wrong])
    scores += np.log(weights)
    together = float(logsumexp(scores))
    form_error = float(np.exp(scores - together) @ size)
    # A freedom of nearly no size would leave no digits in the covariance's inverse.
    allowed = form_error if form_error >= EVIDENCE.negligible_form_error else 0.0
    problem = free.with_last(free.form_count, allowed) if allowed > 0.0 else plain
    covariance = problem.covariance(variances_at(allowed))
    with_unknown = -np.inf
    if unknown:
        ways = None if columns is None or allowed == 0.0 else allowed * columns
        with_unknown = log_evidence_of_unknown(problem, found, discrepancy, ways)
    return Evidence(together, form_error, with_unknown, covariance, exact)
