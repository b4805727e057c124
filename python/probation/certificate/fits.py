"""The fits that a certificate rests on: every record alone, under several hypotheses."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from probation.certificate.bias import model_bias
from probation.certificate.consistency import Estimate
from probation.identify.fit import fit
from probation.identify.given import given
from probation.inference.parameter import outside_name
from probation.law.schemes import scheme_of
from probation.records.campaign import Campaign
from probation.settings.certificate import CERTIFICATE

if TYPE_CHECKING:
    from collections.abc import Iterable

    from probation._arrays import FloatArray
    from probation.calibration.calibrated import CalibratedCompanion
    from probation.identify.record_fit import RecordFit
    from probation.identify.result import Fit
    from probation.inference.scatter import Scatter
    from probation.law.schemes import Scheme
    from probation.law.settings import LawSettings
    from probation.records.record import Record
    from probation.smoothing.excitation import Excitation
    from probation.smoothing.methods import Method as ExcitationMethod


LATE = 1e-6
"""Strain over which the start of a specimen's strain is shifted for a difference quotient [-]."""

PARAMETERS = 3
"""Of the law: E_u, tau_max or alpha, G."""


@dataclass(frozen=True)
class CertificateFits:
    """How every fit of a certificate is made.

    Attributes
    ----------
    campaign : Campaign
        Whose law is put to the test.
    excitation : str
        As in `probation.fit`.
    """

    campaign: Campaign
    scheme: Scheme
    excitation: ExcitationMethod

    @property
    def all_given(self) -> bool:
        """Whether the campaign holds every parameter: a law that is given, not identified."""
        return len(self.campaign.law.fixed) == PARAMETERS

    def base(self) -> Fit:
        """The law on the records with role "identify": identified, or as it is given."""
        if self.all_given:
            return given(self.campaign, self.scheme, excitation=self.excitation)
        return self.on(self.campaign.identify)

    def on(self, records: Iterable[Record], law: LawSettings | None = None) -> Fit:
        """Identify on records, whatever their role, with the campaign's law or another."""
        chosen = self.campaign.identified_on([record.id for record in records])
        campaign = Campaign(self.campaign.name, chosen, law or self.campaign.law)
        return fit(
            campaign,
            self.scheme,
            method="variable-projection",
            excitation=self.excitation,
            gap=False,
        )

    def holding(self, base: Fit, names: Iterable[str]) -> LawSettings:
        """The campaign's law with these parameters held at the values of a fit, all others free."""
        values = {outside_name(name): float(getattr(base.law, name)) for name in names}
        return replace(self.campaign.law, fixed=values)


def free_parameters(found: Fit) -> list[int]:
    """Which of the law's parameters a fit identified."""
    return [index for index, name in enumerate(found.law.parameter_names) if name in found.names]


def companion_factor(found: Fit, excitation: Excitation, relation: CalibratedCompanion | None) -> FloatArray:
    """What independent errors of the companion relation's calibration do to the stress, (n_times, n_sources) [MPa].

    No column where the campaign does not say how well its relation is known.
    """
    if relation is None:
        return np.zeros((len(excitation.time), 0))
    return relation.prediction_factor(found.law, excitation, scheme=scheme_of(found.scheme, found.start), scatter=False)


def specimen_factor(found: Fit, record: RecordFit, scatter: Scatter | None) -> FloatArray:
    """What deviations of a record's specimen do to its stress, of one standard deviation each, (n_times, k) [MPa]."""
    if scatter is None or not scatter.any:
        return np.zeros((len(record.time), 0))
    history = record.excitation
    scheme = scheme_of(found.scheme, found.start)
    late = replace(history, true_strain=history.true_strain - LATE * (np.arange(len(record.time)) > 0))
    stress, shifted = (found.law.stress(driven.strain_history(), scheme=scheme) for driven in (history, late))
    columns = np.column_stack([record.sensitivity * found.law.parameters, stress, (shifted - stress) / LATE])
    return np.asarray(columns * np.array(scatter.deviations))


def estimates(
    found: Fit,
    record_id: str,
    modulus_error: float = 0.0,
    relation: CalibratedCompanion | None = None,
    specimens: Scatter | None = None,
) -> dict[str, Estimate]:
    """What a fit on one record alone says of its parameters, with noise and model bias in the errors.

    Parameters
    ----------
    modulus_error : float
        Standard error of E_u [MPa] where the fit holds it.
    relation : CalibratedCompanion, optional
        What is known of the law's companion relation.
    specimens : Scatter, optional
        How far specimens differ.
    """
    free = free_parameters(found)
    record = found.records[record_id]
    bias = np.diag(model_bias(record, free).covariance)
    common = np.column_stack(
        [record.sensitivity[:, 0] * modulus_error, companion_factor(found, record.excitation, relation)]
    )
    moves = -np.linalg.lstsq(record.sensitivity[:, free], common, rcond=None)[0]
    deviations = specimen_factor(found, record, specimens)
    apart = np.linalg.norm(np.linalg.lstsq(record.sensitivity[:, free], deviations, rcond=None)[0], axis=1)
    scatter = 0.0 if relation is None else relation.log_scatter  # of single tests: in tau_max, and so in alpha
    result = {}
    for position, index in enumerate(free):
        name = found.law.parameter_names[index]
        known = found.parameters[name]
        own = scatter * known.value if name == "alpha" else 0.0
        error = None if known.se is None else float(np.linalg.norm([known.se, np.sqrt(bias[position]), own]))
        if error is None or error > CERTIFICATE.weakly_identifiable * abs(known.value):
            result[name] = Estimate(known.value, None, None)
        else:
            shifts = tuple(moves[position].tolist())
            result[name] = Estimate(known.value, error, known.se, shifts, float(apart[position]))
    return result


def joint_covariance(found: Fit) -> FloatArray:
    """Covariance of a fit's parameters by its own errors and by the model bias of its records.

    Every record's bias acts on the joint estimate by its share of the information; shape (free, free).
    """
    free = free_parameters(found)
    if not free:
        return np.zeros((0, 0))
    information = {}
    for name, record in found.records.items():
        slopes = record.sensitivity[:, free]
        information[name] = slopes.T @ slopes / max(record.rms_MPa, 1e-12) ** 2
    total = np.linalg.pinv(sum(information.values(), np.zeros((len(free), len(free)))), hermitian=True)
    covariance = np.zeros_like(total)
    for name, record in found.records.items():
        share = total @ information[name]
        covariance += share @ model_bias(record, free).covariance @ share.T
    own = np.array([found.parameters[found.law.parameter_names[index]].se or 0.0 for index in free])
    return np.asarray(covariance + np.outer(own, own) * found.correlation)
