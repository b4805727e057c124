"""How far gaps are closed, beside an oracle, and whether intervals of closures hold what they should."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from probation_studies.blind.scores.intervals import Average, Rate

if TYPE_CHECKING:
    from probation_studies.blind.scores.case import Case

GOOD = 0.95
_ROLES = {"identify": "identify", "held_out": "held-out"}


def closure(cases: Sequence[Case]) -> dict[str, object]:
    """Closures on the fitted and on the held-out records, where something acts and the answer can say a closure.

    Returns
    -------
    dict
        By role: "median" of what is said; "over_oracle", of causes of the catalogue, the median of the
        closure over that of a refit that was told the cause (the noise's floor cancels: (before^2 - after^2)/(before^2
        - told^2)), and "good", how often it is 0.95 or more; "interval_holds", how often the interval of 90 % holds
        the closure over the noise that was drawn.
    """
    found: dict[str, object] = {}
    for name, role in _ROLES.items():
        said, over, held = [], [], []
        for case in cases:
            shrink = getattr(case.answer, name)
            if not case.causes or shrink.closure is None or shrink.before is None or shrink.after is None:
                continue
            said.append(shrink.closure)
            closed = shrink.before**2 - shrink.after**2
            drawn, told = (case.squares(each, role) for each in ("noise_drawn_MPa", "left_when_told_MPa"))
            if drawn is not None and shrink.before**2 > drawn and shrink.interval is not None:
                held.append(shrink.interval[0] <= closed / (shrink.before**2 - drawn) <= shrink.interval[1])
            if told is not None and shrink.before**2 > told and case.stratum in ("single", "pair"):
                over.append(closed / (shrink.before**2 - told))
        found[name] = {
            "median": Average.median(said).plain(),
            "over_oracle": Average.median(over).plain() | {"good": Rate.of(each >= GOOD for each in over).plain()},
            "interval_holds": Rate.of(held).plain(),
        }
    return found
