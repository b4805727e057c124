"""Whether levels and probabilities were calibrated on campaigns such as this one."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from probation.inference.modal_law import DnlrLaw
from probation.inference.wrapped_law import WrappedLaw
from probation.records.noise import noise_level
from probation.settings.calibrated import CALIBRATED
from probation.settings.detection import DETECTION
from probation.wording import percentage

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation.inference.base_fit import BaseFit


@dataclass(frozen=True)
class CalibrationCheck:
    """Whether a campaign lies within the ranges of those on which the probabilities were calibrated.

    Attributes
    ----------
    inside : bool
    why : tuple of str
        What lies outside, with what was found and what is covered; empty if nothing does.
    """

    inside: bool
    why: tuple[str, ...] = ()

    def gap_level(self, misfit_over_noise: float) -> float:
        """p-value below which a gap is declared; lower for a small gap where noise may be unlike any that was tried.

        Parameters
        ----------
        misfit_over_noise : float
            Misfit over the noise from sample to sample, in the record where this ratio is largest.
        """
        doubtful = not self.inside and misfit_over_noise < CALIBRATED.large_misfit_outside
        return CALIBRATED.gap_level_outside if doubtful else DETECTION.gap_level

    @property
    def warnings(self) -> tuple[str, ...]:
        """One sentence where the campaign lies outside, else none."""
        if self.inside:
            return ()
        held, right, said = (
            " to ".join(percentage(part) for part in parts)
            for parts in (CALIBRATED.held_elsewhere, CALIBRATED.right_elsewhere, CALIBRATED.said_elsewhere)
        )
        return (
            f"the probabilities were calibrated on other campaigns ({'; '.join(self.why)}): evidence counts for less; "
            f"in laboratories of others what led had a probability of {said} % and was right in {right} % of gaps, in "
            f"{percentage(CALIBRATED.right_with_a_gap_left)} % where it left a gap, and the truth was in {held} % of "
            "the answer sets",
        )

    def to_dict(self) -> dict[str, Any]:
        """As in `calibration` of docs/formats.md."""
        return {"inside": self.inside, "why": list(self.why)}


@dataclass(frozen=True)
class Extent:
    """What is looked at, least and most over the fitted records.

    Attributes
    ----------
    records : int
    samples : tuple of float
    noise : tuple of float
        Of the stress, over the record's largest stress.
    strain_noise : tuple of float
    gap : float
        Misfit of the base law over the noise.
    scatter : float
        Standard deviation between specimens, of what they differ in most.
    law : str
        The modal one, or another.
    """

    records: int
    samples: tuple[float, float]
    noise: tuple[float, float]
    strain_noise: tuple[float, float]
    gap: float
    scatter: float
    law: str


def extent_of(base: BaseFit) -> Extent:
    """What the fitted records have, as far as probabilities may depend on it."""
    fitted = [view.record for view in base.model.views]
    noises = base.whitened.noises
    relative = [
        noise.sigma / float(np.max(np.abs(record.true_stress))) for noise, record in zip(noises, fitted, strict=True)
    ]
    strain = [
        noise_level(record.time, record.true_strain) if record.noise.strain is None else record.noise.strain
        for record in fitted
    ]
    misfit, noise = base.misfit
    law = base.law.law if isinstance(base.law, WrappedLaw) else base.law
    return Extent(
        len(fitted),
        _ends([len(record) for record in fitted]),
        _ends(relative),
        _ends(strain),
        misfit / max(noise, 1e-300),
        max(base.scatter.deviations, default=0.0),
        "modal law" if isinstance(law, DnlrLaw) else "another law",
    )


def check_calibration(base: BaseFit) -> CalibrationCheck:
    """Hold a campaign against the ranges of `CALIBRATED`.

    Parameters
    ----------
    base : BaseFit
        On the records that causes are fitted to.
    """
    extent, why = extent_of(base), []
    compared = (
        ("records", (extent.records, extent.records), CALIBRATED.records, "{:.0f}".format),
        ("samples a record", extent.samples, CALIBRATED.samples, "{:.0f}".format),
        ("a noise over the largest stress", extent.noise, CALIBRATED.noise, "{:.2g}".format),
        ("a strain noise", extent.strain_noise, CALIBRATED.strain_noise, "{:.2g}".format),
        ("a misfit over the noise", (extent.gap, extent.gap), CALIBRATED.gap, _two_digits),
        ("a scatter between specimens", (extent.scatter, extent.scatter), CALIBRATED.scatter, "{:.2g}".format),
    )
    for name, (low, high), (least, most), form in compared:
        if low < least or high > most:
            outside = high if high > most else low
            covered = f"{form(least)} to {form(most)} are" if least < most else f"{form(least)} is"
            why.append(f"{name} of {form(outside)}, where {covered} covered")
    if extent.law != CALIBRATED.law:
        why.append(f"{extent.law}, where the {CALIBRATED.law} is covered")
    return CalibrationCheck(not why, tuple(why))


def _two_digits(value: float) -> str:
    """Two digits at least, and no power of ten: "4.8", "180"."""
    return f"{value:.0f}" if value >= 10.0 else f"{value:.2g}"


def _ends(values: Sequence[float]) -> tuple[float, float]:
    return float(min(values)), float(max(values))
