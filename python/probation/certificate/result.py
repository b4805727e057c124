"""What `probation.certify` found: the certificate."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from probation.answers import json_answer
from probation.estimate import plus_minus
from probation.inference.parameter import SYMBOLS, UNITS, outside_name
from probation.report.table import Table

if TYPE_CHECKING:
    from collections.abc import Mapping
    from os import PathLike

    from matplotlib.figure import Figure

    from probation.certificate.consistency import Consistency, Estimate
    from probation.certificate.hardening import HardeningRegression
    from probation.certificate.prediction import Prediction
    from probation.certificate.verdict import Verdict
    from probation.identify.result import Fit

VERDICTS = {
    "intrinsic": "intrinsic",
    "intrinsic_except": "intrinsic, with exceptions",
    "not_intrinsic": "not intrinsic",
}


@dataclass(frozen=True, eq=False)
class Certificate:
    """Whether a law is intrinsic to a material, and on what grounds.

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
    """

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

    @property
    def headline(self) -> str:
        """Verdict and reason."""
        return f"The law is {VERDICTS[self.verdict]}: {self.reason}."

    def parameter_table(self) -> Table:
        """Every parameter over the records."""
        records = list(self.alone)
        rows = []
        for name, each in self.parameters.items():
            label = f"{SYMBOLS[name]} [{UNITS[name]}]" if UNITS[name] else SYMBOLS[name]
            verdict = "passes" if each.passes else "fails"
            if not each.tested:
                verdict = "not tested"
            cells = [_estimate(each.by_record[record]) for record in records]
            rows.append((label, *cells, _probability(each.p_value), verdict))
        return Table(
            ("parameter", *records, "p", "verdict"),
            tuple(rows),
            "Does a parameter keep its value? (± standard error by noise and model bias)",
        )

    def prediction_table(self) -> Table:
        """Every predicted record."""
        rows = tuple(
            (
                each.id,
                f"{each.rms_MPa:.3g}",
                f"{each.max_MPa:.3g}",
                f"{each.true_strain[each.worst]:.2g}",
                f"{each.noise_units:.3g}",
                f"{each.tolerance_MPa:.3g}",
                "within" if each.passes else "beyond",
            )
            for each in self.predictions.values()
        )
        headings = ("record", "rms [MPa]", "largest [MPa]", "at strain", "rms / noise", "tolerance [MPa]", "tolerance?")
        return Table(headings, rows, "Direct prediction, nothing adjusted")

    def identification_table(self) -> Table:
        """Every record identified alone, as the paper's Tables 3 and 4."""
        variants = [("E_u held", self.alone), ("all free", self.free), ("constant τ_max", self.without_companion)]
        rows = []
        for record in self.alone:
            for label, fits in variants:
                if record not in fits:
                    continue
                found = fits[record]
                values = [f"{found.parameters[name].value:.5g}" for name in found.law.parameter_names]
                if fits is self.without_companion:
                    values[1] += " s"
                rows.append((record, label, *values, f"{found.rms_MPa:.3g}", f"{found.records[record].max_MPa:.3g}"))
        second = SYMBOLS[self.base.law.parameter_names[1]]
        unit = UNITS[self.base.law.parameter_names[1]]
        headings = ("record", "identified", "E_u [MPa]", f"{second} [{unit}]" if unit else second, "G [MPa]")
        return Table((*headings, "rms [MPa]", "largest [MPa]"), tuple(rows), "Each record identified alone", left=2)

    def hardening_table(self) -> Table:
        """G by regression beside G identified."""
        rows = tuple(
            (
                record,
                f"{each.hardening_modulus:.4g}",
                f"{self.alone[record].law.hardening_modulus:.4g}",
                f"{each.r_squared:.4f}",
            )
            for record, each in self.regressions.items()
        )
        return Table(
            ("record", "G by regression [MPa]", "G identified [MPa]", "R²"),
            rows,
            "G as the slope of stress over Haward–Thackray strain beyond a strain of 0.4",
        )

    def tables(self) -> tuple[Table, ...]:
        """All of them, the most important first."""
        found = (self.parameter_table(), self.prediction_table(), self.identification_table())
        return (*found, self.hardening_table()) if self.regressions else found

    def summary(self) -> str:
        """Verdict first, then numbers, then details."""
        parts = [f"{self.campaign}: {self.headline}"]
        parts += [table.text() for table in self.tables()]
        base = self.base
        values = ", ".join(
            f"{SYMBOLS[name]} {getattr(base.law, name):.5g} {UNITS[name]}".rstrip() for name in base.law.parameter_names
        )
        ending = f"  identified on {', '.join(base.records)}: {values}; scheme {base.scheme}"
        parts.append("\n".join([ending, *(f"  warning: {warning}" for warning in self.warnings)]))
        return "\n\n".join(parts)

    def to_dict(self) -> dict[str, Any]:
        """The answer in the form of the contract, `probation.certificate/1`, as Python objects."""
        return {
            "campaign": self.campaign,
            "data_sha256": self.data_sha256,
            "verdict": self.verdict,
            "reason": self.reason,
            "tolerance": self.tolerance,
            "scheme": self.base.scheme,
            "parameters": {
                outside_name(name): {
                    "passes": each.passes,
                    "tested": each.tested,
                    "p_value": each.p_value,
                    "mean": each.mean if each.passes else None,
                    "by_record": {
                        record: {"value": found.value, "se": found.total_se, "se_noise": found.se_noise}
                        for record, found in each.by_record.items()
                    },
                }
                for name, each in self.parameters.items()
            },
            "prediction": {name: each.to_json() for name, each in self.predictions.items()},
            "base": {
                "records": list(self.base.records),
                "parameters": {outside_name(name): p.to_json() for name, p in self.base.parameters.items()},
            },
            "identified_alone": {
                variant: {record: _fit_json(found, record) for record, found in fits.items()}
                for variant, fits in (
                    ("unrelaxed_modulus_held", self.alone),
                    ("all_free", self.free),
                    ("failing_free", self.described),
                    ("without_companion", self.without_companion),
                )
            },
            "hardening_regression": {
                record: {
                    "hardening_modulus_MPa": each.hardening_modulus,
                    "r_squared": each.r_squared,
                    "from_strain": each.from_strain,
                }
                for record, each in self.regressions.items()
            },
            "warnings": list(self.warnings),
        }

    def to_json(self) -> str:
        """The answer as JSON text."""
        return json_answer("probation.certificate/1", self.to_dict())

    def plot(self) -> Figure:
        """Every record: measured, predicted with nothing adjusted, identified (Figures 4 to 6)."""
        from probation.report.certificate_page import certificate_figure  # noqa: PLC0415 - plotting only when asked for

        return certificate_figure(self)

    def report(self, path: str | PathLike[str]) -> Path:
        """Write a self-contained HTML page and return its path."""
        from probation.report.certificate_page import write_certificate_page  # noqa: PLC0415

        return write_certificate_page(self, Path(path))


def _estimate(found: Estimate) -> str:
    if found.total_se is None:
        return f"{found.value:.4g}, not determined"
    return plus_minus(found.value, found.total_se)


def _probability(value: float) -> str:
    return f"{value:.2g}" if value >= 1e-6 else "< 1e-6"


def _fit_json(found: Fit, record: str) -> dict[str, object]:
    return {
        "parameters": {outside_name(name): float(getattr(found.law, name)) for name in found.law.parameter_names},
        "rms_MPa": found.rms_MPa,
        "max_MPa": found.records[record].max_MPa,
        "bias_MPa": found.bias_MPa,
    }
