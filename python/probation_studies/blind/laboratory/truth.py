"""What is withheld: what was done to a campaign, and what could have been found out."""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass, field

SCHEMA = "probation.blind.truth/1"
_OUTSIDE_NAMES = {
    "noise_level": "noise_MPa",
    "added_stress": "added_MPa",
    "noise_drawn": "noise_drawn_MPa",
    "left_when_told": "left_when_told_MPa",
}


@dataclass(frozen=True)
class Window:
    """Where in a record a cause shows: nine tenths of its squared signal.

    Attributes
    ----------
    record : str
    time_s : tuple of float [s]
    true_strain : tuple of float [-]
        Least and largest recorded strain within.
    """

    record: str
    time_s: tuple[float, float]
    true_strain: tuple[float, float]


@dataclass(frozen=True)
class WithheldCause:
    """A cause that acts.

    Attributes
    ----------
    effect : str
        A name of the catalogue, or "unknown".
    kind : str
        The laboratory's own name of it.
    everywhere : bool
        Whether it acts in all records.
    records : tuple of str
        Those identified records that it touches.
    amplitude, scale : float
        As the laboratory's form has it, and a usual one.
    shape : dict
        Its other parameters.
    detectability : float
        sqrt(lambda): norm of its whitened signal without what the base law can follow.
    localised : bool
    windows : tuple of Window
    alike : dict
        For every other cause (the laboratory's name), the largest cosine of its signals with this one's.
    left_by_best_other : float
        Detectability that is left when the nearest single cause of the catalogue has taken its part.
    left_by_best_pair : float
        The same of the nearest pair.
    """

    effect: str
    kind: str
    everywhere: bool
    records: tuple[str, ...]
    amplitude: float
    scale: float
    shape: dict[str, float]
    detectability: float
    localised: bool
    windows: tuple[Window, ...]
    alike: dict[str, float]
    left_by_best_other: float
    left_by_best_pair: float


@dataclass(frozen=True)
class Truth:
    """All that a solver must not know.

    Attributes
    ----------
    split, seed, index : what it was made from.
    stratum : str
        "none", "single", "pair", "outside" or "mimic".
    target : float
        Detectability that was aimed at; 0 for none.
    causes : tuple of WithheldCause
    mimics : str
        Of a mimic, the effect of the catalogue it looks like.
    explanation : tuple of str
        Sorted names; "unknown" for what is outside the catalogue.
    detectability : float
        Of all causes together.
    base : dict
        Parameters of the base law, as docs/formats.md names them.
    noise_level : dict
        Root mean square of the noise of every record [MPa].
    noise : dict
        Its make.
    records : dict
        Kind, role and duration of every record's history, and its number of samples.
    sampling_detectability : float
        What sampling and filtering alone make of the base law's stress.
    drift_detectability : float
        Largest projection of the noise's drift on a signal of the catalogue.
    oracle : dict
        Posterior, part of repeats in which it is right, answer set, whether the truth is resolvable.
    added_stress : dict
        Root mean square of what the causes add to every record [MPa].
    noise_drawn : dict
        Root mean square of what the true law with its causes leaves of every record, along the recorded strain [MPa].
    left_when_told : dict
        The same of that law refitted to the identified records; see `probation_studies.blind.laboratory.known_causes`.
    """

    split: str
    seed: int
    index: int
    stratum: str
    target: float
    causes: tuple[WithheldCause, ...]
    mimics: str
    explanation: tuple[str, ...]
    detectability: float
    base: dict[str, float]
    noise_level: dict[str, float]
    noise: dict[str, float]
    records: dict[str, dict[str, str | float | int]]
    sampling_detectability: float
    drift_detectability: float
    oracle: dict[str, object]
    added_stress: dict[str, float] = field(default_factory=dict)
    noise_drawn: dict[str, float] = field(default_factory=dict)
    left_when_told: dict[str, float] = field(default_factory=dict)

    @property
    def name(self) -> str:
        """Of the campaign."""
        return campaign_name(self.split, self.index)

    def to_json(self) -> str:
        """As JSON text, in full precision."""
        content = {_OUTSIDE_NAMES.get(name, name): value for name, value in asdict(self).items()}
        return json.dumps({"schema": SCHEMA, "name": self.name, **content}, allow_nan=False, indent=1) + "\n"


def campaign_name(split: str, index: int) -> str:
    """Such as "develop-0012"; it says nothing of the truth, nor of the seed that would give it away."""
    return f"{split}-{index:04d}"
