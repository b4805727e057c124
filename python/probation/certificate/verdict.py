"""The verdict of a probation test, and its reason in one sentence."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

from probation.inference.parameter import SYMBOLS, UNITS
from probation.settings.certificate import CERTIFICATE
from probation.wording import listed, percentage, times

if TYPE_CHECKING:
    from collections.abc import Mapping

    from probation.certificate.consistency import Consistency
    from probation.certificate.prediction import Prediction
    from probation.inference.gap import Gap


Verdict = Literal["intrinsic", "intrinsic_except", "not_intrinsic"]


def decide(
    parameters: Mapping[str, Consistency],
    predictions: Mapping[str, Prediction],
    described_MPa: Mapping[str, float],
    tolerances_MPa: Mapping[str, float],
    held: Mapping[str, float] | None = None,
    gap: Gap | None = None,
) -> tuple[Verdict, str]:
    """Decide, and say why.

    Parameters
    ----------
    parameters : dict of str to Consistency
        By name.
    predictions : dict of str to Prediction
        By record.
    described_MPa : dict of str to float
        Bias that is left on each record when the parameters that fail are free on it and the others shared; when all
        are free where none fails [MPa].
    tolerances_MPa : dict of str to float
        Bias that is let pass on each record [MPa].
    held : dict of str to float, optional
        Parameters that the campaign holds, by name.
    gap : Gap, optional
        Whether the law departs from its records at all.

    Returns
    -------
    verdict : str
        "intrinsic": no parameter changes and every prediction is within tolerance; also where the latter holds and
        there is no gap. "intrinsic_except": some parameters
        change and others do not, and with those free the law describes every record within tolerance; also where all
        change, but so little that every prediction is within tolerance. "not_intrinsic" otherwise, and where a
        prediction errs by more than `CERTIFICATE.far` of the largest stress.
    reason : str
    """
    failing = [name for name, parameter in parameters.items() if not parameter.passes]
    kept = [name for name in parameters if name not in failing]
    worst = max(
        predictions.values(), key=lambda prediction: prediction.bias_MPa / max(prediction.tolerance_MPa, 1e-300)
    )
    predicted = (
        f"{worst.id} is predicted to {worst.rms_MPa:.2g} MPa rms, {times(worst.noise_units)} times the noise "
        f"(tolerance {worst.tolerance_MPa:.2g} MPa)"
    )
    if gap is not None and not gap.exists and not worst.passes:
        return "not_intrinsic", (
            f"{predicted}, though there is no gap: noise, the uncertainty of the parameters and the scatter of "
            "specimens make as much, so that these records do not determine the law well enough"
        )
    if gap is not None and not gap.exists and failing:
        changes = " and ".join(_change(name, parameters[name]) for name in failing)
        return "intrinsic", (
            "there is no gap: one set of parameters serves every record, and noise and the scatter of specimens "
            f"explain that {changes}; {predicted}"
        )
    if not failing and worst.passes:
        if gap is not None and gap.exists:
            predicted += f"; {_small_gap(gap)}"
        tested = [name for name in kept if parameters[name].tested]
        seen = _listed(tested) if tested else "none is determined by two of them"
        return "intrinsic", f"one set of parameters serves every record ({seen}); {predicted}"
    beyond = [name for name, left in described_MPa.items() if left > tolerances_MPa[name]]
    if beyond:
        name = max(beyond, key=lambda record: described_MPa[record] / tolerances_MPa[record])
        freed = f"with {_listed(failing)} free on each record" if failing else "with parameters of its own"
        return "not_intrinsic", (
            f"even {freed} the law leaves {described_MPa[name]:.2g} MPa on {name} "
            f"(tolerance {tolerances_MPa[name]:.2g} MPa); {predicted}"
        )
    if not failing:
        return (
            "not_intrinsic",
            f"{predicted}, and {_why_missed(worst, described_MPa[worst.id], parameters, held or {})}",
        )
    return _exceptions(failing, kept, parameters, worst, predicted)


def _small_gap(gap: Gap) -> str:
    size = gap.size
    return (
        f"there is a gap, of {size.rms_MPa:.2g} MPa in {size.record} ({percentage(size.relative)} % of its largest "
        "stress), within the tolerance"
    )


def _why_missed(
    worst: Prediction, left: float, parameters: Mapping[str, Consistency], held: Mapping[str, float]
) -> str:
    """Why a prediction errs though no parameter fails; `left` stays with parameters of its own [MPa]."""
    if left > CERTIFICATE.own_fault * worst.bias_MPa:
        return f"{left:.2g} MPa stay with parameters of its own: the law's form is at fault rather than a parameter"
    wrong = [name for name, value in held.items() if parameters[name].contradicts(value)]
    if wrong:
        values = " and ".join(f"{SYMBOLS[name]} {held[name]:.4g} {UNITS[name]}".rstrip() for name in wrong)
        return f"the records contradict what the campaign holds: {values}"
    return "no parameter is seen to change: the records do not determine them well enough to tell which one does"


def _exceptions(
    failing: list[str], kept: list[str], parameters: Mapping[str, Consistency], worst: Prediction, predicted: str
) -> tuple[Verdict, str]:
    """Some parameters change, and with those free the law describes every record."""
    changes = " and ".join(_change(name, parameters[name]) for name in failing)
    if worst.passes and not kept:
        return "intrinsic_except", f"{changes}, but too little to spoil the prediction: {predicted}"
    if not kept:
        return "not_intrinsic", f"no parameter keeps its value from record to record: {changes}; {predicted}"
    if worst.relative > CERTIFICATE.far and not worst.passes:
        return "not_intrinsic", f"{changes}; {predicted}"
    tested = [name for name in kept if parameters[name].tested]
    if not tested:
        return "intrinsic_except", f"{changes}, while {_listed(kept)} cannot be compared between records; {predicted}"
    keep = "keep theirs" if len(tested) > 1 else "keeps its value"
    freed = f"with {_listed(failing)} free on each record all are described within tolerance"
    return "intrinsic_except", f"{changes}, while {_listed(tested)} {keep}: {freed}; {predicted}"


def _listed(names: list[str]) -> str:
    return listed([SYMBOLS[name] for name in names], "and")


def _change(name: str, consistency: Consistency) -> str:
    known = {record: estimate for record, estimate in consistency.by_record.items() if estimate.se is not None}
    low = min(known, key=lambda record: known[record].value)
    high = max(known, key=lambda record: known[record].value)
    unit = f" {UNITS[name]}" if UNITS[name] else ""
    return f"{SYMBOLS[name]} changes from {known[low].value:.4g} ({low}) to {known[high].value:.4g}{unit} ({high})"
