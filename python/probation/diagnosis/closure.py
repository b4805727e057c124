"""How far a gap shrinks, gap-method section 8."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Closure:
    """The gap before and after the best explanation, against the noise's floor.

    Attributes
    ----------
    before_MPa, after_MPa : float
        Root mean square of the fit residual with the base law and with the best explanation.
    noise_MPa : float
        Root mean square of the noise.
    closure : float or None
        1 - (after^2 - noise^2)/(before^2 - noise^2), not clipped; None where before^2 - noise^2 is below two of its
        standard errors.
    interval : (float, float) or None
        90 %.
    how : str
        Where the interval comes from, in words.
    """

    before_MPa: float  # noqa: N815 - as it leaves the program
    after_MPa: float  # noqa: N815
    noise_MPa: float  # noqa: N815
    closure: float | None
    interval: tuple[float, float] | None
    how: str

    def to_dict(self) -> dict[str, Any]:
        """As in the contract."""
        return {
            "before_MPa": self.before_MPa,
            "after_MPa": self.after_MPa,
            "noise_MPa": self.noise_MPa,
            "closure": self.closure,
            "interval": self.interval,
            "how": self.how,
        }
