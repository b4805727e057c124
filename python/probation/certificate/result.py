"""What `probation.certify` found: the certificate."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

from probation.inference.parameter import outside_name
from probation.results.data import Stored
from probation.results.rendering import Result

if TYPE_CHECKING:
    from collections.abc import Mapping

    from probation.certificate.consistency import Consistency
    from probation.certificate.hardening import HardeningRegression
    from probation.certificate.prediction import Prediction
    from probation.certificate.verdict import Verdict
    from probation.identify.result import Fit
    from probation.inference.gap import Gap

VERDICTS = {
    "intrinsic": "intrinsic",
    "intrinsic_except": "intrinsic, with exceptions",
    "not_intrinsic": "not intrinsic",
}


@dataclass(frozen=True, eq=False)
class Certificate(Result, Stored):
    """Whether a law is intrinsic to a material, and on what grounds.

    `plot` draws every record: measured, predicted with nothing adjusted, identified (the paper's Figures 4 to 6).

    Attributes
    ----------
    campaign : str
    verdict : {"intrinsic", "intrinsic_except", "not_intrinsic"}
    reason : str
        One sentence.
    tolerance : float
        Systematic error that is let pass, as a fraction of a record's largest stress.
    base : Fit
        On the records with role "identify".
    parameters : dict of str to Consistency
        By name: unrelaxed_modulus, tau_max or alpha, hardening_modulus.
    predictions : dict of str to Prediction
        By record.
    alone : dict of str to Fit
        Each record alone, E_u held as identified: identifications 2, 3 of Tables 3, 4.
    free : dict of str to Fit
        Each record alone, all parameters free: identification 4.
    described : dict of str to Fit
        Each record with the parameters free that do not pass, the others held as identified; all free where all pass.
    without_companion : dict of str to Fit
        Each record alone with a constant tau_max, all parameters free (Figure 3); empty if the law has no companion.
    regressions : dict of str to HardeningRegression
        G as the slope over Haward-Thackray strain (Figure S1), where a record reaches a strain of 0.4.
    warnings : tuple of str
    data_sha256 : str
    gap : Gap or None
        Whether the records hold a gap, by the test of `probation.diagnose`; None where it could not be done.
    """

    SCHEMA: ClassVar[str] = "probation.certificate/1"

    campaign: str
    verdict: Verdict
    reason: str
    tolerance: float
    base: Fit
    parameters: Mapping[str, Consistency]
    predictions: Mapping[str, Prediction]
    alone: Mapping[str, Fit]
    free: Mapping[str, Fit]
    described: Mapping[str, Fit]
    without_companion: Mapping[str, Fit]
    regressions: Mapping[str, HardeningRegression]
    warnings: tuple[str, ...]
    data_sha256: str
    gap: Gap | None = None

    @property
    def headline(self) -> str:
        """Verdict and reason."""
        if self.verdict == "not_intrinsic" and self.gap is not None and not self.gap.exists:
            return f"Whether the law is intrinsic is not known: {self.reason}."
        return f"The law is {VERDICTS[self.verdict]}: {self.reason}."

    def to_dict(self) -> dict[str, Any]:
        """The answer as Python objects, `probation.certificate/1` of docs/formats.md."""
        return {
            "campaign": self.campaign,
            "data_sha256": self.data_sha256,
            "verdict": self.verdict,
            "reason": self.reason,
            "tolerance": self.tolerance,
            "gap": None if self.gap is None else self.gap.to_dict(),
            "scheme": self.base.scheme,
            "parameters": {
                outside_name(name): {
                    "passes": parameter.passes,
                    "tested": parameter.tested,
                    "p_value": parameter.p_value,
                    "mean": parameter.mean if parameter.passes else None,
                    "by_record": {
                        record: {
                            "value": estimate.value,
                            "se": estimate.total_se,
                            "se_noise": estimate.se_noise,
                            "se_specimen": estimate.se_specimen,
                        }
                        for record, estimate in parameter.by_record.items()
                    },
                }
                for name, parameter in self.parameters.items()
            },
            "prediction": {name: prediction.to_json() for name, prediction in self.predictions.items()},
            "base": {
                "records": list(self.base.records),
                "parameters": {outside_name(name): p.to_json() for name, p in self.base.parameters.items()},
            },
            "identified_alone": {
                variant: {record: _fit_json(fit, record) for record, fit in fits.items()}
                for variant, fits in (
                    ("unrelaxed_modulus_held", self.alone),
                    ("all_free", self.free),
                    ("failing_free", self.described),
                    ("without_companion", self.without_companion),
                )
            },
            "hardening_regression": {
                record: {
                    "hardening_modulus_MPa": regression.hardening_modulus,
                    "r_squared": regression.r_squared,
                    "from_strain": regression.from_strain,
                }
                for record, regression in self.regressions.items()
            },
            "warnings": list(self.warnings),
        }


def _fit_json(fit: Fit, record: str) -> dict[str, object]:
    return {
        "parameters": {outside_name(name): float(getattr(fit.law, name)) for name in fit.law.parameter_names},
        "rms_MPa": fit.rms_MPa,
        "max_MPa": fit.records[record].max_MPa,
        "bias_MPa": fit.bias_MPa,
    }
