"""What `calibrate_companion` found: relations, how well they are known, which one, and why."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, ClassVar

import numpy as np
from scipy.special import stdtrit

from probation.calibration.cross_validation import percent
from probation.calibration.rate_table import rate_groups
from probation.normal import TWO_SIDED_95
from probation.records.saving import companion_text
from probation.results.data import Stored, named_in
from probation.results.rendering import Result
from probation.wording import percentage, plus_minus

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.calibration.calibrated import CalibratedCompanion
    from probation.calibration.companion_forms import Form
    from probation.calibration.cross_validation import Score
    from probation.calibration.direct import DirectFit
    from probation.calibration.left_out import Predicted
    from probation.calibration.rate_table import RateTable
    from probation.calibration.record_fits import RecordFits, RecordRate
    from probation.records.campaign import Campaign


@dataclass(frozen=True, eq=False)
class CalibratedForm:
    """One form, calibrated.

    Attributes
    ----------
    labels : tuple of str
        Of the rows or records below.
    percent_residual : ndarray, shape (n,) [%]
        Relation over what each row (or record) says by itself, minus one.
    r_squared : float
        In the form's own measure; NaN for the direct route.
    score : Score or None
        On rates left out.
    direct : DirectFit or None
        Where it was identified through the law.
    degrees : int or None
        Of Student's t for its intervals; None for the normal distribution.
    """

    form: Form = field(metadata=named_in("calibration.companion_forms.FORMS"))
    companion: CalibratedCompanion
    labels: tuple[str, ...]
    percent_residual: FloatArray
    r_squared: float
    score: Score | None
    direct: DirectFit | None = None
    degrees: int | None = None

    def interval95(self) -> FloatArray | None:
        """Of the parameters, shape (p, 2); None where nothing is known of their errors."""
        errors = self.companion.standard_errors
        if not np.all(np.isfinite(errors)):
            return None
        reach = (TWO_SIDED_95 if self.degrees is None else float(stdtrit(self.degrees, 0.975))) * errors
        values = self.companion.parameters
        return np.stack([values - reach, values + reach], axis=1)

    def to_dict(self) -> dict[str, object]:
        """Numbers only."""
        known, interval = self.companion, self.interval95()
        errors = known.standard_errors
        parameters = {
            name: {
                "value": float(value),
                "se": float(errors[at]),
                "interval95": None if interval is None else interval[at],
            }
            for at, (name, value) in enumerate(zip(known.parameter_names, known.parameters, strict=True))
        }
        return {
            "form": self.form.name,
            "title": self.form.title,
            "parameters": parameters,
            "covariance": known.covariance,
            "log_scatter": known.log_scatter,
            "unrelaxed_modulus_MPa": known.unrelaxed_modulus,
            "calibrated_rates_per_s": known.relation.calibrated,
            "r_squared": self.r_squared,
            "r_squared_of": self.form.measure,
            "residual_percent": dict(zip(self.labels, self.percent_residual.tolist(), strict=True)),
            "left_out": None
            if self.score is None
            else {"rms": self.score.rms, "largest": self.score.largest, "log_error": self.score.log_error},
            "rms_MPa": None if self.direct is None else dict(zip(self.labels, self.direct.rms.tolist(), strict=True)),
        }


_REASONS = {
    "request": "as asked for",
    "fit": "it leaves least on these records; too few rates to leave one out",
    "preference": "by preference: too few rates to leave one out",
    "cross-validation": "it predicts left-out rates best",
}


@dataclass(frozen=True, eq=False)
class Calibration(Result, Stored):
    """Companion relations calibrated on one source.

    `plot` draws tau_max and We against the strain rate, as the paper's Figure S2.

    Attributes
    ----------
    source : str
    route : {"table", "by-rate", "direct"}
    table : RateTable or None
        tau_max at each rate; None for the direct route.
    candidates : dict of str to CalibratedForm
        By form.
    chosen : str
    chosen_by : {"cross-validation", "request", "fit", "preference"}
        Where there are too few rates to leave one out, "fit": the form that leaves least on the records themselves;
        "preference": nothing chooses, the forms' order does.
    why_constant : str or None
        Why one tau_max for all rates is enough; None where it depends on the rate.
    discriminated : tuple of str
        Forms that predict left-out rates worse than the chosen one by more than chance.
    record_rates : tuple of RecordRate
    record_fits : RecordFits or None
    check : DirectFit or None
        Of the by-rate route: the chosen form identified on all records at once.
    predicted : tuple of Predicted
        Of the direct route: each record predicted from those at other rates.
    hardening : str
        How the direct route takes G.
    warnings : tuple of str
    data_sha256 : str
    """

    SCHEMA: ClassVar[str] = "probation.companion/1"

    source: str
    route: str
    table: RateTable | None
    candidates: dict[str, CalibratedForm]
    chosen: str
    chosen_by: str
    discriminated: tuple[str, ...]
    why_constant: str | None = None
    record_rates: tuple[RecordRate, ...] = ()
    record_fits: RecordFits | None = None
    check: DirectFit | None = None
    predicted: tuple[Predicted, ...] = ()
    hardening: str = "by-record"
    warnings: tuple[str, ...] = field(default=())
    data_sha256: str = ""

    @property
    def companion(self) -> CalibratedCompanion:
        """The chosen relation."""
        return self.candidates[self.chosen].companion

    @property
    def verdict(self) -> str:
        """One sentence: the relation, or that none is needed."""
        if self.why_constant is None:
            return f"{self._relation_text()}."
        known = self.candidates["constant"].companion
        value = plus_minus(float(known.parameters[0]), float(known.standard_errors[0]))
        return (
            f"A constant τ_max of {value} s is enough and no companion relation is needed: {self.why_constant}. "
            f"If one is wanted, {self._relation_text()}."
        )

    def _relation_text(self) -> str:
        chosen = self.candidates[self.chosen]
        rivals = [
            candidate
            for name, candidate in self.candidates.items()
            if name != self.chosen and not candidate.form.reference and candidate.score is not None
        ]
        low, high = chosen.companion.relation.calibrated or (np.nan, np.nan)
        start = f"τ_max follows the form {self.chosen} between {low:.2g} and {high:.2g} 1/s"
        if chosen.score is None or not np.isfinite(chosen.score.rms):
            largest = float(np.max(np.abs(chosen.percent_residual)))
            why = _REASONS[self.chosen_by]
            points = self.table is not None and len(self.table.groups) <= len(chosen.form.parameter_names)
            how_well = (
                "through every rate, which leaves nothing to test it by"
                if points
                else f"to {percentage(0.01 * largest)} %"
            )
            sentence = f"{start} {how_well} ({why})"
            if len(rate_groups(np.array([rate.rate for rate in self.record_rates] or [1.0, 2.0]))) == 1:
                sentence += "; the records run at one rate, so that it is confounded with what else changes with strain"
            return sentence
        sentence = f"{start}; rates left out are predicted to {percent(chosen.score.rms)} %"
        for rival in rivals if self.chosen_by == "cross-validation" else ():
            rms = rival.score.rms if rival.score else np.nan
            how = "" if rival.form.name in self.discriminated else ", not discriminated"
            error = f"to {percent(rms)} %{how}" if np.isfinite(rms) else "gives no positive time at one of them"
            sentence += f"; {rival.form.name} {error}"
        return sentence

    def toml(self) -> str:
        """The [law.companion] to paste into a campaign.toml, covariance and range included."""
        return companion_text(self.companion.settings())

    def apply(self, campaign: Campaign) -> Campaign:
        """The campaign with the chosen relation as its companion.

        Where E_u was identified along with the relation it is held from then on, as in the paper: alpha = 1 means
        something at that E_u only. What the campaign holds itself stays, but for tau_max and alpha.

        Parameters
        ----------
        campaign : Campaign

        Returns
        -------
        Campaign
            In memory; `Campaign.save` writes it.
        """
        fixed = {name: value for name, value in campaign.law.fixed.items() if name not in ("tau_max_s", "alpha")}
        if self.companion.unrelaxed_modulus is not None:
            fixed.setdefault("unrelaxed_modulus_MPa", float(self.companion.unrelaxed_modulus))
        law = replace(campaign.law, companion=self.companion.settings(), fixed=fixed)
        return replace(campaign, law=law, path=None, file_sha256="")

    def to_dict(self) -> dict[str, object]:
        """The answer, as Python objects."""
        companion = self.companion.settings()
        content: dict[str, object] = {
            "source": self.source,
            "data_sha256": self.data_sha256,
            "verdict": self.verdict,
            "route": self.route,
            "chosen": self.chosen,
            "chosen_by": self.chosen_by,
            "discriminated": self.discriminated,
            "constant_is_enough": self.why_constant is not None,
            "companion": {"form": companion.form, **companion.parameters},
            "relations": {name: candidate.to_dict() for name, candidate in self.candidates.items()},
            "rates": self._rates(),
        }
        if self.record_fits is not None:
            content["unrelaxed_modulus_MPa"] = {
                "value": self.record_fits.unrelaxed_modulus,
                "se": self.record_fits.unrelaxed_modulus_se,
            }
        if self.check is not None:
            content["all_records_at_once"] = {
                "parameters": self.check.companion.parameters,
                "se": self.check.companion.standard_errors,
                "unrelaxed_modulus_MPa": self.check.unrelaxed_modulus,
                "rms_MPa": self.check.rms,
            }
        if self.predicted:
            content["predicted"] = [
                {
                    "record": prediction.record,
                    "form": prediction.form,
                    "rms_MPa": prediction.rms,
                    "hardening_free_rms_MPa": prediction.hardening_rms,
                    "refit_rms_MPa": prediction.refit_rms,
                }
                for prediction in self.predicted
            ]
        return {**content, "warnings": self.warnings}

    def _rates(self) -> list[dict[str, object]]:
        if self.table is None:
            return [
                {"record": rate.id, "rate_per_s": rate.rate, "from_per_s": rate.slow, "to_per_s": rate.fast}
                for rate in self.record_rates
            ]
        table = self.table
        return [
            {
                "label": table.labels[at],
                "rate_per_s": table.rates[at],
                "tau_max_s": table.tau_max[at],
                "se_s": None if table.se is None else table.se[at],
                "hardening_modulus_MPa": None if table.hardening_modulus is None else table.hardening_modulus[at],
            }
            for at in range(len(table))
        ]
