"""A law whose parameters are all given, against records: nothing is identified."""

from __future__ import annotations

from typing import TYPE_CHECKING

from probation.errors import InputError
from probation.identify.base_law import base_law
from probation.identify.describe import describe
from probation.identify.weighting import Weighted
from probation.inference.measured_view import measured_view
from probation.inference.modal_law import DnlrLaw
from probation.inference.problem import Problem
from probation.law.schemes import identifying
from probation.smoothing.excitation import excite_each

if TYPE_CHECKING:
    from probation.identify.result import Fit
    from probation.law.schemes import Scheme, SchemeName
    from probation.records.campaign import Campaign
    from probation.smoothing.methods import Method as ExcitationMethod


def given(
    campaign: Campaign,
    scheme: Scheme | SchemeName = "be2",
    *,
    excitation: ExcitationMethod = "auto",
) -> Fit:
    """The campaign's law as it is, with the records of role "identify".

    Parameters
    ----------
    campaign : Campaign
        Its `law.fixed` holds every parameter.
    scheme, excitation
        As in `probation.fit`.

    Raises
    ------
    InputError
        If a parameter is not held.
    """
    law, held = base_law(campaign.law, {})
    if len(held) < len(law.parameter_names):
        raise InputError(f"campaign {campaign.name!r}: found law.fixed without every parameter; use fit")
    chosen, substeps = identifying(scheme)
    steps = 1 if substeps == "auto" else substeps
    driven = excite_each(campaign.identify, excitation, further=campaign.held_out)
    views = [
        measured_view(record, drive, chosen, steps) for record, drive in zip(campaign.identify, driven, strict=True)
    ]
    problem = Problem.white(DnlrLaw(law, held), views)
    weighted = Weighted(problem, problem.law.start)
    limits = dict.fromkeys(law.parameter_names, (0.0, float("inf")))
    return describe(campaign, weighted, chosen, "least-squares", "plain", limits, "standard-error")
