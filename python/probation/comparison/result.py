"""What a comparison of two campaigns found: whether anything changed, what, in which record, and by how much."""

from __future__ import annotations

from dataclasses import asdict, dataclass, field
from typing import TYPE_CHECKING, Any, ClassVar, Literal

from probation.diagnosis.result import EffectSize
from probation.inference.calibration_check import CalibrationCheck
from probation.results.data import CURVE, Stored, WithCurves
from probation.results.rendering import Result

if TYPE_CHECKING:
    from collections.abc import Mapping

    from probation._arrays import FloatArray
    from probation.diagnosis.skipped import Skipped
    from probation.inference.scatter import Scatter

Verdict = Literal["nothing_changed", "changed", "unknown_change"]


@dataclass(frozen=True)
class ChangedParameter(EffectSize):
    """The size of a change.

    Attributes
    ----------
    interval95 : (float, float)
    """

    interval95: tuple[float, float]


@dataclass(frozen=True)
class ChangeExplanation:
    """What may have changed.

    Attributes
    ----------
    effects : tuple of str
        Sorted; empty: nothing; ("unknown",): something that no known effect does; a name and "unknown": both.
    records : tuple of str
        Ids of the records that changed.
    probability : float
    parameters : tuple of ChangedParameter
    """

    effects: tuple[str, ...]
    records: tuple[str, ...]
    probability: float
    parameters: tuple[ChangedParameter, ...] = ()


@dataclass(frozen=True, eq=False)
class ChangeCurves(WithCurves):
    """One record minus what its references predict.

    Attributes
    ----------
    time, true_strain, change, noise : ndarray, shape (n,) [s], [-], [MPa], [MPa]
    explained : ndarray, shape (n,) [MPa], or None
        What the best explanation says of the change.
    """

    time: FloatArray = field(metadata=CURVE)
    true_strain: FloatArray = field(metadata=CURVE)
    change: FloatArray = field(metadata=CURVE)
    noise: FloatArray = field(metadata=CURVE)
    explained: FloatArray | None = field(metadata=CURVE)


@dataclass(frozen=True, eq=False)
class Comparison(Result, Stored):
    """What changed from one campaign to another.

    `plot` draws every record's change and what the best explanation says of it.

    Attributes
    ----------
    campaign, reference : str
    verdict : {"nothing_changed", "changed", "unknown_change"}
    headline : str
    pairs : dict of str to tuple of str
        Reference records of each record.
    explanations : tuple of ChangeExplanation
        By probability, which sums to 1.
    answer_set : tuple of ChangeExplanation
        The most probable ones that hold 95 % together.
    rms_MPa, noise_MPa : dict of str to float
        Of each record's change, and of its noise.
    curves : dict of str to ChangeCurves
    skipped : tuple of Skipped
        What was left out, and why.
    scatter : Scatter
        How far specimens may differ without a change.
    warnings : tuple of str
    calibration : CalibrationCheck
        Whether the records lie within those on which the probabilities of diagnoses were calibrated.
    leaves_a_gap : bool
        Whether the best explanation leaves more than noise and its forms' errors, or something unknown leads.
    """

    SCHEMA: ClassVar[str] = "probation.comparison/1"

    campaign: str
    reference: str
    verdict: Verdict
    headline: str
    pairs: Mapping[str, tuple[str, ...]]
    explanations: tuple[ChangeExplanation, ...]
    answer_set: tuple[ChangeExplanation, ...]
    rms_MPa: Mapping[str, float]  # noqa: N815 - as it leaves the program
    noise_MPa: Mapping[str, float]  # noqa: N815
    curves: Mapping[str, ChangeCurves]
    skipped: tuple[Skipped, ...]
    scatter: Scatter
    warnings: tuple[str, ...] = ()
    calibration: CalibrationCheck = field(default_factory=lambda: CalibrationCheck(inside=True))
    leaves_a_gap: bool = False

    @property
    def best(self) -> ChangeExplanation:
        """The most probable explanation."""
        return self.explanations[0]

    def to_dict(self) -> dict[str, Any]:
        """The answer as Python objects."""
        return {
            "campaign": self.campaign,
            "against": self.reference,
            "verdict": self.verdict,
            "headline": self.headline,
            "records": {
                name: {"references": list(others), "rms_MPa": self.rms_MPa[name], "noise_MPa": self.noise_MPa[name]}
                for name, others in self.pairs.items()
            },
            "leaves_a_gap": self.leaves_a_gap,
            "changes": [asdict(explanation) for explanation in self.explanations],
            "answer_set": [
                {"effects": explanation.effects, "records": explanation.records} for explanation in self.answer_set
            ],
            "skipped": [entry.to_dict() for entry in self.skipped],
            "scatter": self.scatter.to_dict(),
            "warnings": list(self.warnings),
            "calibration": self.calibration.to_dict(),
        }
