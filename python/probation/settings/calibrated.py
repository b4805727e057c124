"""The campaigns on which the probabilities of a diagnosis were calibrated: the ranges that they cover."""

from __future__ import annotations

from dataclasses import dataclass

from probation.settings.setting import setting

_SOURCE = "60 campaigns of calibrate, seed 43: python -m bench.calibrated_ranges"


@dataclass(frozen=True)
class CalibratedRanges:
    """What the campaigns have on which the probabilities were calibrated, least and most."""

    records: tuple[float, float] = setting(
        (3.0, 8.0),
        "Records that are fitted.",
        unit="records",
        origin="calibrated",
        source=_SOURCE,
        used_in="diagnosis/calibration.py",
    )
    samples: tuple[float, float] = setting(
        (270.0, 660.0),
        "Samples of a record.",
        unit="samples",
        origin="calibrated",
        source=_SOURCE,
        used_in="diagnosis/calibration.py",
    )
    noise: tuple[float, float] = setting(
        (2e-4, 0.08),
        "Noise of the stress, as a part of the record's largest stress.",
        unit="-",
        origin="calibrated",
        source=_SOURCE,
        used_in="diagnosis/calibration.py",
    )
    strain_noise: tuple[float, float] = setting(
        (0.0, 3e-5),
        "Noise of the recorded strain from sample to sample.",
        unit="-",
        origin="calibrated",
        source=_SOURCE,
        used_in="diagnosis/calibration.py",
    )
    gap: tuple[float, float] = setting(
        (0.0, 4.8),
        "Misfit of the base law, over the noise.",
        unit="-",
        origin="calibrated",
        source=_SOURCE,
        used_in="diagnosis/calibration.py",
    )
    evidence_power_outside: float = setting(
        0.2,
        "Power of the evidence of a campaign outside these ranges.",
        unit="-",
        origin="calibrated",
        source="docs/diagnosis-method.md, section 4: university, seed 8801; industry, seed 8802",
        used_in="diagnosis/calibration.py",
    )
    credible_set_outside: float = setting(
        0.98,
        "Probability that an answer set holds of a campaign outside these ranges.",
        unit="probability",
        origin="chosen",
        used_in="diagnosis/calibration.py",
    )


CALIBRATED = CalibratedRanges()
