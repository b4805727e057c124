"""What certificate and diagnosis say of the virtual specimen, beside what is known of it."""

from __future__ import annotations

import json
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from probation.answers import json_answer
from probation.certificate.certify import certify
from probation.diagnosis.diagnose import diagnose
from probation.report.certificate_summary import parameter_table, prediction_table
from probation.report.table import Table

if TYPE_CHECKING:
    from pathlib import Path

    from probation._arrays import FloatArray
    from probation.certificate.result import Certificate
    from probation.diagnosis.result import Diagnosis
    from probation.records.campaign import Campaign
    from probation_studies.specimen.experiments import Experiment
    from probation_studies.specimen.recording import Recording
    from probation_studies.specimen.trial import Specimen

NECK, CONTROL = "neck", "uniaxial"
"""Folders of the two campaigns."""

_IDENTIFIED = "experiment-1"

_LIKELY = 0.01


@dataclass(frozen=True, eq=False)
class Judged:
    """One campaign, judged.

    Attributes
    ----------
    campaign : Campaign
    certificate : Certificate
        Identified on experiment 1, the others predicted.
    diagnosis : Diagnosis
        Of all three.
    """

    campaign: Campaign
    certificate: Certificate
    diagnosis: Diagnosis


@dataclass(frozen=True, eq=False)
class Findings:
    """All there is to report.

    Attributes
    ----------
    specimen : Specimen
    neck : Judged
    control : Judged or None
    """

    specimen: Specimen
    neck: Judged
    control: Judged | None

    def summary(self) -> str:
        """For people."""
        parts = [known_table(self.specimen).text()]
        for judged, words in ((self.control, "The control, without a neck's triaxiality"), (self.neck, "The specimen")):
            if judged is not None:
                parts += [f"{words}: probation test\n{judged.certificate.headline}"]
                parts += [parameter_table(judged.certificate).text(), prediction_table(judged.certificate).text()]
                parts += [f"{words}: diagnosis\n{judged.diagnosis.summary()}", blame_table(judged).text()]
        return "\n\n".join(parts)

    def to_json(self) -> str:
        """The answer, schema "probation.specimen/1"."""
        made_with = {
            "unrelaxed_modulus_MPa": self.specimen.law.unrelaxed_modulus,
            "alpha": self.specimen.law.alpha,
            "hardening_modulus_MPa": self.specimen.law.hardening_modulus,
            "bulk_modulus_MPa": self.specimen.bulk_modulus,
        }
        return json_answer(
            "probation.specimen/1",
            {
                "made_with": made_with,
                "known": {each.name: known(each) for each in self.specimen.experiments},
                "neck": _answers(self.neck),
                "control": None if self.control is None else _answers(self.control),
            },
        )


def judge(specimen: Specimen, recording: Recording, *, control: bool = True, folder: Path | None = None) -> Findings:
    """Record the specimen, put the law on probation, and diagnose.

    Parameters
    ----------
    specimen : Specimen
    recording : Recording
    control : bool
        Whether to judge the same strains with the stress of one dimension, too.
    folder : path, optional
        Where to leave the campaigns.

    Returns
    -------
    Findings
    """
    campaigns = {NECK: specimen.campaign(recording)}
    if control:
        campaigns[CONTROL] = specimen.uniaxial_campaign(recording)
    judged = {}
    for name, campaign in campaigns.items():
        if folder is not None:
            campaign.save(folder / name)
        judged[name] = _judged(campaign, recording.seed)
    return Findings(specimen, judged[NECK], judged.get(CONTROL))


def known(experiment: Experiment) -> dict[str, float]:
    """What no experimenter can see: the triaxiality gap and what goes with it."""
    gap = experiment.gap
    largest = int(np.argmax(np.abs(gap)))
    return {
        "largest_gap_MPa": float(gap[largest]),
        "largest_gap_relative": _relative(gap, experiment)[largest],
        "at_true_strain": float(experiment.true_strain[largest]),
        "bridgman_relative": float(experiment.bridgman[largest] - 1.0),
        "gap_at_end_MPa": float(gap[-1]),
        "largest_triaxiality": float(experiment.triaxiality.max()),
        "largest_volume_change": float(experiment.volume_change.max()),
        "fastest_over_slowest_rate": _rate_ratio(experiment),
        "fastest_rate_per_s": float(experiment.strain_rate.max()),
    }


def known_table(specimen: Specimen) -> Table:
    """One row for each experiment."""
    rows = []
    for each in specimen.experiments:
        what = known(each)
        rows.append(
            (
                each.name,
                f"{what['fastest_rate_per_s']:.3g}",
                f"{what['fastest_over_slowest_rate']:.3g}",
                f"{what['largest_gap_MPa']:.2f}",
                f"{100 * what['largest_gap_relative']:.1f}",
                f"{100 * what['bridgman_relative']:.1f}",
                f"{what['at_true_strain']:.2f}",
                f"{what['gap_at_end_MPa']:.2f}",
                f"{what['largest_triaxiality']:.2f}",
                f"{100 * what['largest_volume_change']:.2f}",
            )
        )
    headings = (
        "experiment",
        "fastest rate [1/s]",
        "ratio",
        "triaxiality gap [MPa]",
        "[%]",
        "Bridgman [%]",
        "at strain",
    )
    return Table(
        (*headings, "gap at end [MPa]", "triaxiality", "volume [%]"),
        tuple(rows),
        "What is known: mean axial stress of the centre section less the law's in one dimension along the same strain",
    )


def blame_table(judged: Judged) -> Table:
    """How likely the diagnosis holds that each effect has a part, over all explanations that name it; 1 % and more.

    A change of volume is listed in any case: it is what a catalogue of uniaxial effects has nearest to triaxiality.
    """
    parts: dict[str, float] = {"volume_change": 0.0}
    for cause in json.loads(judged.diagnosis.to_json())["causes"]:
        for effect in cause["effects"] or ["no effect is needed"]:
            parts[effect] = parts.get(effect, 0.0) + cause["probability"]
    rows = sorted(parts.items(), key=lambda each: -each[1])
    return Table(
        ("effect", "has a part [%]"),
        tuple((name, f"{100 * part:.0f}") for name, part in rows if part >= _LIKELY or name == "volume_change"),
        "What the diagnosis blames",
    )


def _judged(campaign: Campaign, seed: int) -> Judged:
    records = tuple(
        replace(record, role="identify" if record.id == _IDENTIFIED else "held-out") for record in campaign.records
    )
    return Judged(campaign, certify(replace(campaign, records=records)), diagnose(campaign, seed=seed, design=False))


def _answers(judged: Judged) -> dict[str, Any]:
    return {
        "certificate": json.loads(judged.certificate.to_json()),
        "diagnosis": json.loads(judged.diagnosis.to_json()),
    }


def _relative(gap: FloatArray, experiment: Experiment) -> list[float]:
    relative: list[float] = (gap / np.maximum(np.abs(experiment.uniaxial_stress), 1e-9)).tolist()
    return relative


def _rate_ratio(experiment: Experiment) -> float:
    """As in the necking run: the fastest over the slowest before it."""
    rate = experiment.strain_rate
    fastest = int(np.argmax(rate))
    return float(rate[fastest] / rate[: fastest + 1].min())
